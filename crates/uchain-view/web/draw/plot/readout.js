// @ts-check
// What moves over a plot: the cursor, names at the ends of lines, and the values under the pointer; a press goes there.

import { app } from "uchain/app.js";
import { palette, uavInk } from "uchain/draw/colours.js";
import { WIDE_PX } from "uchain/draw/plot/layout.js";
import { clock } from "uchain/panel/events.js";

/** Names at line ends keep this apart (pixels). */
const APART_PX = 13;

export class Readout {
  #hover_s = /** @type {number|null} */ (null);
  #at = /** @type {import("uchain/draw/plot/box.js").Box|null} */ (null);

  /** @param {import("uchain/draw/plot/plot.js").PlotView} plot @param {HTMLElement} box */
  constructor(plot, box) {
    this.plot = plot;
    this.tip = document.createElement("div");
    this.tip.className = "tip";
    this.tip.hidden = true;
    box.append(this.tip);
    const canvas = plot.canvas;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#go(event);
      if (event.pointerType === "mouse") canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.#go(event);
      this.#hover(event);
    });
    canvas.addEventListener("pointerleave", () => {
      this.#hover_s = null;
      this.tip.hidden = true;
      app.redraw();
    });
  }

  /** The time and box under a pointer. */
  #under(/** @type {PointerEvent} */ event) {
    const frame = this.plot.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - frame.left, event.clientY - frame.top];
    const box = this.plot.boxes.find(({ area }) => x >= area.left - 8 && x <= area.left + area.width + 8 && y >= area.top - 12 && y <= area.top + area.height + 14);
    if (!box) return null;
    const share = Math.max(0, Math.min(1, (x - box.area.left) / box.area.width));
    return { box, time_s: share * this.plot.scale.span_s, x, y };
  }

  #go(event) {
    const under = this.#under(event);
    if (!under || !this.plot.pane || app.mode === "fly") return;
    app.seek(under.time_s / this.plot.pane.scene.tick_s);
  }

  #hover(event) {
    const under = this.#under(event);
    const pane = this.plot.pane;
    this.#hover_s = under ? under.time_s : null;
    this.#at = under ? under.box : null;
    app.redraw();
    this.tip.hidden = !under || !pane;
    if (!under || !pane) return;
    this.tip.textContent = valuesAt(pane, under.box, under.time_s);
    const wide = this.tip.offsetWidth;
    this.tip.style.left = `${under.x + 16 + wide > this.plot.width ? under.x - wide - 12 : under.x + 16}px`;
    this.tip.style.top = `${Math.max(2, Math.min(under.y - 20, this.plot.height - this.tip.offsetHeight - 4))}px`;
  }

  /** @param {CanvasRenderingContext2D} context @param {any} pane */
  draw(context, pane) {
    const colours = palette();
    const { boxes, scale } = this.plot;
    context.font = "600 11px system-ui, sans-serif";
    const time_s = pane.frame?.time_s ?? 0;
    for (const box of boxes) {
      const { area, spec } = box;
      const x = Math.min(area.left + area.width, box.px(time_s, scale));
      context.globalAlpha = 0.55;
      context.fillStyle = colours.card;
      context.fillRect(x, area.top, area.left + area.width - x, area.height);
      context.globalAlpha = 1;
      context.fillStyle = colours.ink;
      context.fillRect(x - 0.75, area.top, 1.5, area.height);
      if (this.#hover_s !== null) {
        context.fillStyle = colours.soft;
        context.fillRect(box.px(this.#hover_s, scale), area.top, 1, area.height);
      }
      if (spec.title && boxes.length > 2) this.#corner(context, box, colours);
      if (boxes.length <= 2 || spec.lines.length > 1) this.#names(context, pane, box, colours);
    }
    this.#titles(context, colours);
  }

  #corner(context, box, colours) {
    context.textAlign = "left";
    context.textBaseline = "top";
    context.lineWidth = 3;
    context.strokeStyle = colours.free;
    context.strokeText(box.spec.title, box.area.left + 4, box.area.top + 3);
    context.fillStyle = colours.ink;
    context.fillText(box.spec.title, box.area.left + 4, box.area.top + 3);
  }

  #titles(context, colours) {
    const { boxes, width, pane } = this.plot;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillStyle = colours.ink;
    if (!pane?.explores) {
      context.fillText("loss of the link toward the base (dB)", 8, 5);
      const from = context.measureText("loss of the link toward the base (dB)").width + 24;
      if (width < WIDE_PX) styles(context, 8, 27, colours);
      else styles(context, from, 11, colours);
    } else {
      for (const box of boxes) context.fillText(box.spec.title, box.all.left + 8, box.all.top + 5);
    }
  }

  /** Names at the right ends of the lines, and of s_min. */
  #names(context, pane, box, colours) {
    const { scale } = this.plot;
    const { area, spec } = box;
    const { series } = pane;
    const range = scale.ranges[spec.scale];
    /** @type {{y: number, text: string, ink: string}[]} */
    const names = [];
    for (const { solid, label, id, ink } of spec.lines) {
      const value = lastOf(series, series.column(solid));
      if (value === null || !label) continue;
      names.push({ y: box.py(value * spec.times, range), text: this.plot.boxes.length > 2 ? String(id) : label, ink: uavInk(ink) });
    }
    if (spec.scale === "loss" && this.plot.boxes.length === 1) names.push({ y: box.py(scale.s_min_db, range), text: this.plot.width < 480 ? "s_min" : `s_min ${scale.s_min_db}`, ink: colours.soft });
    names.sort((a, b) => a.y - b.y);
    const apart = Math.min(APART_PX, area.height / Math.max(1, names.length));
    names.forEach((one, i) => (one.y = Math.max(one.y, i ? names[i - 1].y + apart : area.top + 4)));
    for (let i = names.length - 1; i >= 0; i -= 1) names[i].y = Math.min(names[i].y, i + 1 < names.length ? names[i + 1].y - apart : area.top + area.height - 2);
    context.textAlign = "left";
    context.textBaseline = "middle";
    for (const { y, text, ink } of names) {
      context.fillStyle = ink;
      context.fillText(text, area.left + area.width + 5, y);
    }
  }
}

/** How the three kinds of line look, drawn as they are. */
function styles(context, x, y, colours) {
  context.strokeStyle = context.fillStyle = colours.soft;
  context.textBaseline = "middle";
  for (const [name, dash, width] of /** @type {[string, number[], number][]} */ ([["filtered", [], 2], ["true", [5, 3], 1.4], ["raw", [], 0]])) {
    if (width) {
      context.lineWidth = width;
      context.setLineDash(dash);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + 22, y);
      context.stroke();
      context.setLineDash([]);
    } else {
      context.globalAlpha = 0.6;
      for (const dx of [2, 10, 18]) context.fillRect(x + dx, y - 1, 2, 2);
      context.globalAlpha = 1;
    }
    context.fillText(name, x + 27, y);
    x += context.measureText(name).width + 44;
  }
}

function lastOf(series, column) {
  if (column < 0) return null;
  for (let row = series.rows - 1; row >= Math.max(0, series.rows - 2000); row -= 1) {
    const value = series.at(row, column);
    if (value === value) return value;
  }
  return null;
}

/** What the lines of a box say at a time. @param {any} pane @param {import("uchain/draw/plot/box.js").Box} box @param {number} time_s */
export function valuesAt(pane, box, time_s) {
  const { series } = pane;
  const row = series.rowAt(time_s);
  const lines = [clock(time_s)];
  if (row < 0) return `${lines[0]}: not flown yet`;
  const read = (/** @type {string|null} */ name) => {
    const column = name === null ? -1 : series.column(name);
    const value = column < 0 ? NaN : series.at(row, column);
    return value === value ? value * box.spec.times : null;
  };
  for (const { label, solid, dashed, dots } of box.spec.lines) {
    const values = [[solid, dashed ? "filtered" : ""], [dashed, "true"], [dots, "raw"]]
      .map(([name, word]) => ({ value: read(/** @type {string|null} */ (name)), word }))
      .filter(({ value }) => value !== null)
      .map(({ value, word }) => `${/** @type {number} */ (value).toFixed(box.spec.whole ? 0 : 1)}${word ? ` ${word}` : ""}`);
    if (values.length) lines.push(`${label ? `${label}: ` : ""}${values.join(", ")}${box.spec.unit ? ` ${box.spec.unit}` : ""}`);
  }
  return lines.join("\n");
}
