// @ts-check
// The plot over time below a map: losses of the links, or what an exploration has seen, with the cursor in it.

import { app } from "uchain/app.js";
import { palette } from "uchain/draw/colours.js";
import { drawHeights, STRIP_PX } from "uchain/draw/plot/heights.js";
import { niceStep } from "uchain/draw/plot/box.js";
import { layOut } from "uchain/draw/plot/layout.js";
import { Readout } from "uchain/draw/plot/readout.js";
import { specOf } from "uchain/draw/plot/spec.js";
import { shown } from "uchain/panel/layers.js";

/** So many points are painted in a frame, and for so long (ms); the rest follows in the next ones. */
const [PAINT_POINTS, PAINT_MS] = [6000, 2];

/** To clear a box and paint its axes counts as so many points. */
const BEGIN_POINTS = 100;

export class PlotView {
  /** @type {import("uchain/pane.js").Pane|null} */
  pane = null;
  /** @type {import("uchain/draw/plot/box.js").Box[]} */
  boxes = [];
  /** What all boxes share: time span, ranges by name, every which row. */
  scale = { span_s: 1, every: 1, s_min_db: 0, ranges: /** @type {Record<string, {low: number, high: number}>} */ ({}) };
  width = 0;
  height = 0;
  #specs = /** @type {import("uchain/draw/plot/spec.js").Spec[]} */ ([]);
  #kept = document.createElement("canvas");
  #ratio = 1;
  #laid = "";
  #painted = "";
  /** Least and greatest value of each scale, of `#looked` rows. */
  #extremes = /** @type {Record<string, number[]>} */ ({});
  #looked = 0;
  #version = -1;
  #next = 0;
  /** How many UAVs have flown so far: the others have no line. */
  #flown = 1;

  /** @param {HTMLElement} box @param {number} index */
  constructor(box, index) {
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.dataset.plot = String(index);
    this.context = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    box.append(this.canvas);
    this.readout = new Readout(this, box);
    new ResizeObserver(([entry]) => {
      [this.width, this.height] = [entry.contentRect.width, entry.contentRect.height];
      this.#ratio = Math.min(3, window.devicePixelRatio || 1);
      for (const canvas of [this.canvas, this.#kept]) {
        canvas.width = Math.round(this.width * this.#ratio);
        canvas.height = Math.round(this.height * this.#ratio);
      }
      this.#laid = "";
      app.redraw();
    }).observe(box);
  }

  /** @param {import("uchain/pane.js").Pane} pane */
  open(pane) {
    this.pane = pane;
    this.#flown = 1;
    this.#specs = specOf(pane, 1);
    this.#laid = "";
    this.#forget();
    const what = pane.explores ? "What the robots have seen, and how many nodes have a frontier left, over time" : "Loss of each link toward the base over time: true, filtered and raw";
    this.canvas.setAttribute("aria-label", what);
  }

  draw() {
    const pane = this.pane;
    if (!pane || this.width < 40) return;
    if (pane.version !== this.#version) this.#forget();
    this.#lay(pane);
    this.#look(pane);
    this.#paint(pane);
    const context = this.context;
    context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.drawImage(this.#kept, 0, 0, this.width, this.height);
    this.readout.draw(context, pane);
    if (pane.explores && pane.frame) drawHeights(context, pane, { left: 0, top: this.height - STRIP_PX, width: this.width });
  }

  #forget() {
    this.#version = this.pane?.version ?? -1;
    this.#extremes = {};
    this.#looked = 0;
    this.#painted = "";
  }

  /** Least and greatest values of what has come, and the axes they ask for. */
  #look(pane) {
    const { series, scene } = pane;
    for (const spec of this.#specs) {
      const seen = (this.#extremes[spec.scale] ??= spec.least ? [...spec.least] : [scene.chain.s_min_db - 25, scene.chain.s_min_db + 10]);
      if (spec.least && !spec.whole) continue;
      for (const { solid, dashed } of spec.lines) {
        for (const name of [solid, dashed]) {
          const column = name === null ? -1 : series.column(name);
          if (column < 0) continue;
          for (let row = this.#looked; row < series.rows; row += 1) {
            const value = series.at(row, column);
            if (value < seen[0]) seen[0] = value;
            if (value > seen[1]) seen[1] = value;
          }
        }
      }
    }
    this.#looked = series.rows;
    for (const [name, [low, high]] of Object.entries(this.#extremes)) {
      const step = name === "loss" ? 10 : 1;
      this.scale.ranges[name] = { low: Math.floor(low / step) * step, high: Math.max(Math.ceil(high / step), Math.floor(low / step) + 1) * step };
    }
    this.scale.s_min_db = scene.chain?.s_min_db ?? 0;
    const flown_s = pane.tick * scene.tick_s;
    const ends = pane.stopped ? flown_s : scene.runs_to_the_end ? scene.duration_s : Math.min(scene.duration_s, roomFor(flown_s));
    this.scale.span_s = Math.max(ends, scene.tick_s);
    const row_s = series.rows > 8 ? (series.at(series.rows - 1, 0) - series.at(0, 0)) / (series.rows - 1) : 0.1;
    const pixels = Math.max(60, this.boxes[0]?.area.width ?? 400) * 1.5;
    this.scale.every = 2 ** Math.max(0, Math.floor(Math.log2(this.scale.span_s / Math.max(1e-3, row_s) / pixels)));
  }

  #lay(pane) {
    const flying = pane.explores ? pane.crew : flown(pane.series, pane.crew, this.#flown);
    const state = `${this.width} ${this.height} ${flying}`;
    if (state === this.#laid) return;
    this.#laid = state;
    this.#flown = flying;
    this.#specs = specOf(pane, flying);
    this.boxes = layOut(this.#specs, this.width, this.height - (pane.explores ? STRIP_PX : 0));
    this.#painted = "";
  }

  /** Paints boxes for a while, each from where it is. */
  #paint(pane) {
    const colours = palette();
    const state = `${JSON.stringify(this.scale)} ${colours.dark} ${shown.true} ${shown.raw}`;
    const context = /** @type {CanvasRenderingContext2D} */ (this.#kept.getContext("2d"));
    context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    if (this.#painted === "") {
      context.fillStyle = colours.card;
      context.fillRect(0, 0, this.width, this.height);
    }
    if (state !== this.#painted) for (const box of this.boxes) box.valid = false;
    this.#painted = state;
    const until = performance.now() + PAINT_MS;
    let left = PAINT_POINTS;
    for (let i = 0; i < this.boxes.length; i += 1) {
      const box = this.boxes[this.#next % this.boxes.length];
      if (!box.valid) {
        box.begin(context, this.scale);
        left -= BEGIN_POINTS;
      }
      left -= box.grow(context, this.scale, pane.series, /** @type {any} */ (shown), Math.max(left, 1));
      if (left <= 0 || performance.now() > until) {
        app.redraw();
        break;
      }
      this.#next += 1;
    }
  }
}

/** How many of a crew have a link in the newest row, and never less than `least`. @param {any} series @param {number} crew @param {number} least */
function flown(series, crew, least) {
  let count = Math.min(least, crew);
  const last = series.rows - 1;
  for (let id = count; last >= 0 && id < crew; id += 1) {
    const value = series.at(last, series.column(`true_db.${id}`));
    if (value === value) count = id + 1;
  }
  return count;
}

/** A time axis that has room for a flight of unknown length. @param {number} flown_s */
function roomFor(flown_s) {
  const wanted = Math.max(60, flown_s * 1.1);
  const step = niceStep(wanted, 4);
  return Math.ceil(wanted / step) * step;
}
