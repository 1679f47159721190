// @ts-check
// One flight on the page: its engine, and what of it is flown and read so far.

/** Longest that one call of the engine should take (ms), so that a frame can end in time. */
const CALL_MS = 3;

/** Rows in a piece of memory: growing never copies what is there. */
const PIECE_ROWS = 512;

/** Numbers over time as they come from the engine, row by row. */
class Series {
  columns = /** @type {string[]} */ ([]);
  rows = 0;
  #width = 1;
  /** @type {Float32Array[]} */
  #pieces = [];
  #index = new Map();

  /** @param {string[]} columns */
  name(columns) {
    if (columns.length === this.columns.length) return;
    this.columns = columns;
    this.#width = columns.length;
    this.#index = new Map(columns.map((name, i) => [name, i]));
  }

  /** @param {Float32Array} more */
  append(more) {
    const width = this.#width;
    for (let from = 0; from + width <= more.length; ) {
      const at = this.rows % PIECE_ROWS;
      if (at === 0) this.#pieces.push(new Float32Array(PIECE_ROWS * width));
      const fit = Math.min(PIECE_ROWS - at, Math.floor((more.length - from) / width));
      this.#pieces[this.#pieces.length - 1].set(more.subarray(from, from + fit * width), at * width);
      this.rows += fit;
      from += fit * width;
    }
  }

  /** Where a column is in a row; -1 = there is none. @param {string} name */
  column(name) {
    return this.#index.get(name) ?? -1;
  }

  /** @param {number} row @param {number} column */
  at(row, column) {
    return this.#pieces[Math.floor(row / PIECE_ROWS)][(row % PIECE_ROWS) * this.#width + column];
  }

  /** The last row whose time is not after `time_s`; -1 = none. @param {number} time_s */
  rowAt(time_s) {
    let low = 0;
    let high = this.rows;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.at(middle, 0) <= time_s + 1e-4) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }
}

export class Pane {
  /** How far it is flown (ticks). */
  tick = 0;
  /** Why it is over: `{why, words}`; null = it is not. @type {{why: string, words: string}|null} */
  stopped = null;
  /** @type {any[]} */
  events = [];
  series = new Series();
  /** What an exploration's robots have drawn up so far: nodes; labels `[tick, node, sector, label]`; edges `[tick, node, node]`. */
  graph = { nodes: /** @type {any[]} */ ([]), labels: /** @type {any[]} */ ([]), edges: /** @type {any[]} */ ([]) };
  /** The frame at the cursor. @type {any} */
  frame = null;
  /** Counts up whenever what was read so far is forgotten (`cut`, thinning): drawings begin again. */
  version = 0;
  /** Fails once, then stands still. */
  broken = false;
  /** How often the engine has thinned its rows: then all are read again. */
  #generation = 0;
  #ms_per_tick = 0.05;
  #verdict = /** @type {string|null} */ (null);

  /** @param {import("uchain/engine.js").Engine} engine @param {any} scene @param {any} flight */
  constructor(engine, scene, flight) {
    this.engine = engine;
    this.scene = scene;
    this.flight = flight;
  }

  get explores() {
    return this.scene.mission === "exploration";
  }

  /** How many UAVs or robots. */
  get crew() {
    return this.scene.crew;
  }

  /** "UAV 3" or "robot 3". @param {number} id */
  nameOf(id) {
    return `${this.scene.robot} ${id}`;
  }

  /** The last tick it can have, as far as is known. */
  get end() {
    return this.stopped || this.broken ? this.tick : this.scene.ticks;
  }

  /** True for a recording that ends where it should not. */
  get torn() {
    return this.stopped?.why === "cut-short" || this.stopped?.why === "damaged";
  }

  /** What came of it, once it is over. */
  get verdict() {
    if (this.torn) return this.stopped?.words ?? "";
    if (this.#verdict === null && this.stopped) this.#verdict = this.engine.do("summary").verdict ?? this.stopped.words;
    return this.#verdict ?? "";
  }

  /**
   * Flies on to `to` (ticks) as far as it gets by `until_ms` (performance.now). True = something is new.
   * @param {number} to @param {number} until_ms
   */
  advance(to, until_ms) {
    let grown = false;
    let now = performance.now();
    // One call whatever it takes: where a tick once took longer than a frame may, nothing would ever fly again.
    while (!this.stopped && !this.broken && this.tick < to && (!grown || now + this.#ms_per_tick < until_ms)) {
      const fits = Math.floor(Math.min(CALL_MS, until_ms - now) / this.#ms_per_tick);
      const before = this.tick;
      const answer = this.engine.do("advance", { ticks: Math.max(1, Math.min(to - this.tick, fits, 20_000)) });
      this.tick = answer.tick;
      this.stopped = answer.stopped ?? null;
      for (const event of answer.events) this.events.push(event);
      if (answer.generation !== this.#generation) this.#forget(answer.generation);
      grown = true;
      const after = performance.now();
      const flown = Math.max(1, this.tick - before);
      this.#ms_per_tick = Math.max(1e-4, 0.7 * this.#ms_per_tick + (0.3 * (after - now)) / flown);
      now = after;
      if (this.tick === before) break;
    }
    if (grown) this.#read();
    return grown;
  }

  /** Forgets all from `tick` on, and is at tick 0 again; to be advanced to `tick`. @param {number} tick */
  cut(tick) {
    // A recording becomes a flight of its own.
    Object.assign(this.scene, this.engine.do("cut", { tick }));
    this.tick = 0;
    this.stopped = null;
    this.#verdict = null;
    this.broken = false;
    this.events = [];
    this.frame = null;
    this.graph = { nodes: [], labels: [], edges: [] };
    this.#forget();
  }

  /** The frame at `tick`, or the nearest kept one before; true = it is another one than before. @param {number} tick */
  look(tick) {
    // There is a frame after every tick, and none before the first.
    const at = Math.max(1, Math.min(tick, this.tick));
    if (this.tick === 0) return false;
    if (this.frame && this.frame.exact && this.frame.tick === at) return false;
    const had = this.frame;
    this.frame = this.engine.do("frame", { tick: at });
    return !had || had.tick !== this.frame.tick || had.exact !== this.frame.exact;
  }

  #forget(generation = 0) {
    this.#generation = generation;
    this.series = new Series();
    this.version += 1;
  }

  #read() {
    const told = this.engine.do("series", { from: this.series.rows });
    this.series.name(told.columns);
    const bytes = this.engine.payload();
    this.series.append(new Float32Array(bytes.buffer, 0, bytes.length >> 2));
    if (!this.explores) return;
    const { nodes, labels, edges } = this.graph;
    const more = this.engine.do("graph", { from: { nodes: nodes.length, labels: labels.length, edges: edges.length } });
    for (const one of more.nodes) nodes.push(one);
    for (const one of more.labels) labels.push(one);
    for (const one of more.edges) edges.push(one);
  }
}
