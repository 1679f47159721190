// @ts-check
// What the page is about: one or two flights, one cursor in time, and the loop that flies and shows them.

import { Engine, EngineError } from "uchain/engine.js";
import { Pane } from "uchain/pane.js";

/** Script time that a frame may take (ms), flying and drawing together. */
const FRAME_MS = 8;
/** What is left for flying at least, however long drawing takes (ms). */
const FLY_MS = 1.5;
/** The steps of the rate: times real time. */
export const RATES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

class App {
  /** @type {Pane[]} */
  panes = [];
  /** The tick shown, in all panes. */
  cursor = 0;
  /** Script time of the last animation frames (ms), for measuring. @type {number[]} */
  times_ms = [];
  #rate = 5;
  #playing = false;
  #selected = /** @type {number|null} */ (null);
  #mode = "watch";
  /** Where the cursor wants to go, past what is flown (ticks). @type {number|null} */
  #wanted = null;
  /** The cursor between ticks. */
  #position = 0;
  #last_ms = 0;
  #draw_ms = 1;
  #dirty = true;
  /** @type {Map<string, Set<(detail: any) => void>>} */
  #heard = new Map();

  /** Calls `fn` whenever `name` happens; returns what takes it back. @param {string} name @param {(detail: any) => void} fn */
  on(name, fn) {
    const all = this.#heard.get(name) ?? new Set();
    this.#heard.set(name, all.add(fn));
    return () => all.delete(fn);
  }

  /** @param {string} name @param {any} [detail] */
  emit(name, detail) {
    for (const fn of this.#heard.get(name) ?? []) {
      try {
        fn(detail);
      } catch (fault) {
        this.fault(fault);
      }
    }
  }

  /** A line that stays until it is closed. @param {"error"|"note"} kind @param {string} text */
  say(kind, text) {
    this.emit("say", { kind, text });
  }

  /** Says what went wrong; ours goes to the console, too. @param {any} fault */
  fault(fault) {
    if (fault instanceof EngineError) return this.say("error", fault.words);
    console.error(fault);
    this.say("error", `The page has a fault: ${fault?.message ?? fault}`);
  }

  get rate() {
    return this.#rate;
  }

  set rate(rate) {
    this.#rate = Math.min(1000, Math.max(0.1, rate));
    this.emit("rate", this.#rate);
  }

  get playing() {
    return this.#playing;
  }

  get selected() {
    return this.#selected;
  }

  set selected(id) {
    if (id !== null && !(id >= 0 && id < Math.max(0, ...this.panes.map((pane) => pane.crew)))) return;
    this.#selected = id;
    this.redraw();
    this.emit("selected", id);
  }

  /** "watch": it flies ahead and the cursor plays; "fly": the cursor is the edge of what is flown. */
  get mode() {
    return this.#mode;
  }

  set mode(mode) {
    if (mode === this.#mode) return;
    this.#mode = mode;
    this.emit("mode", mode);
  }

  get tick_s() {
    return this.panes[0]?.scene.tick_s ?? 0.01;
  }

  get time_s() {
    return this.cursor * this.tick_s;
  }

  /** The last tick that any pane has, as far as is known. */
  get end() {
    return Math.max(0, ...this.panes.map((pane) => pane.end));
  }

  /** How far the cursor can go: what every flight has flown, or is over before. */
  get edge() {
    const flown = this.panes.map((pane) => pane.tick);
    const flying = this.panes.filter((pane) => !pane.stopped && !pane.broken).map((pane) => pane.tick);
    return Math.min(Math.max(0, ...flown), ...flying);
  }

  /** True while the cursor waits for what is being flown. */
  get waits() {
    return this.#wanted !== null;
  }

  /**
   * Opens a flight in a pane: `{kind: "scenario", ...}`, `{kind: "recording", label, bytes | base64}`, or
   * `{kind: "map", asked, bytes}` with files of a map, which becomes a scenario.
   * Throws `EngineError`, and the pane is as it was.
   * @param {any} flight @param {number} [index]
   */
  async open(flight, index = 0) {
    const engine = await Engine.start();
    let scene;
    if (flight.kind === "recording") {
      const bytes = flight.bytes ?? Uint8Array.from(atob(flight.base64), (letter) => letter.charCodeAt(0));
      scene = engine.do("recording", { label: flight.label }, bytes);
      flight = { kind: "recording", label: flight.label, bytes };
    } else if (flight.kind === "map") {
      scene = engine.do("map", flight.asked, flight.bytes);
      flight = engine.do("flight");
    } else {
      scene = engine.do("open", { flight });
    }
    const pane = new Pane(engine, scene, flight);
    pane.advance(1, Infinity);
    pane.look(0);
    const added = index >= this.panes.length;
    this.panes[Math.min(index, this.panes.length)] = pane;
    this.#wanted = null;
    this.mode = "watch";
    this.#selected = null;
    if (added) this.emit("panes", this.panes);
    this.emit("scene", pane);
    this.emit("selected", null);
    if (index === 0) this.seek(0);
    else this.seek(this.cursor);
    return pane;
  }

  /** Closes the second pane. */
  close() {
    if (this.panes.length < 2) return;
    this.panes.length = 1;
    this.emit("panes", this.panes);
    this.redraw();
  }

  /** Back to `tick`, and forgets what was flown from there on, in the first pane; what was before is flown again. @param {number} tick */
  cut(tick) {
    this.panes[0].cut(tick);
    this.seek(tick);
  }

  /** Goes to a tick; waits at the edge if that is not flown yet. @param {number} tick */
  seek(tick) {
    const to = Math.round(Math.max(0, Math.min(tick, this.end)));
    this.#wanted = to > this.edge ? to : null;
    this.#go(Math.min(to, this.edge));
  }

  play() {
    if (this.#playing || !this.panes.length) return;
    if (this.#mode === "watch" && this.cursor >= this.end) this.seek(0);
    this.#playing = true;
    this.emit("playing", true);
  }

  pause() {
    if (!this.#playing) return;
    this.#playing = false;
    this.emit("playing", false);
  }

  /** Pauses, and goes so many ticks on or back. @param {number} ticks */
  step(ticks) {
    this.pause();
    this.seek(this.cursor + ticks);
  }

  /** Shows all again at the next animation frame. */
  redraw() {
    this.#dirty = true;
  }

  /** Begins the loop. */
  start() {
    const turn = (/** @type {number} */ now_ms) => {
      requestAnimationFrame(turn);
      const began = performance.now();
      this.#turn(now_ms, began);
      this.times_ms.push(performance.now() - began);
      if (this.times_ms.length > 300) this.times_ms.shift();
    };
    requestAnimationFrame(turn);
  }

  /** One animation frame: the cursor moves, what is at it is shown, and with the time that is left it flies on. */
  #turn(now_ms, began) {
    const passed_s = Math.min(0.1, Math.max(0, (now_ms - this.#last_ms) / 1000));
    this.#last_ms = now_ms;
    if (!this.panes.length) return;
    const until = began + Math.max(FLY_MS, FRAME_MS - 2.5 - this.#draw_ms);
    const target = this.#position + (this.#playing ? (passed_s * this.#rate) / this.tick_s : 0);
    const reach = this.#wanted ?? (this.#mode === "fly" ? Math.floor(target) : Infinity);
    for (const pane of this.panes) this.#fly(pane, reach, until);
    if (this.#wanted !== null) this.#follow();
    else if (this.#playing) this.#advance(target);
    const drawing = performance.now();
    for (const pane of this.panes) this.#look(pane);
    if (this.#dirty) {
      this.#dirty = false;
      this.emit("draw");
      this.#draw_ms = 0.8 * this.#draw_ms + 0.2 * (performance.now() - drawing);
    }
  }

  #fly(pane, reach, until) {
    try {
      if (pane.advance(reach, until)) {
        this.#dirty = true;
        this.emit("grown", pane);
      }
    } catch (fault) {
      pane.broken = true;
      this.fault(fault);
    }
  }

  #look(pane) {
    if (pane.broken) return;
    try {
      if (!pane.look(this.cursor)) return;
      this.#dirty = true;
      this.emit("frame", pane);
    } catch (fault) {
      pane.broken = true;
      this.fault(fault);
    }
  }

  #follow() {
    const wanted = Math.min(/** @type {number} */ (this.#wanted), this.end);
    if (this.edge >= wanted) this.#wanted = null;
    this.#go(Math.min(wanted, this.edge));
  }

  #advance(target) {
    // Part of a tick is kept: a frame at a low rate is shorter than a tick, and would never come to the next one.
    this.#go(Math.floor(Math.min(target, this.edge)), Math.min(target, this.edge + 0.999));
    if (this.edge >= this.end && this.cursor >= this.end) this.pause();
  }

  #go(tick, position = tick) {
    this.#position = position;
    if (tick === this.cursor) return;
    this.cursor = tick;
    this.#dirty = true;
    this.emit("cursor", tick);
  }
}

export const app = new App();
