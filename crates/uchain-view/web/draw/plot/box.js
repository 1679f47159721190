// @ts-check
// One box of a plot over time: its axes and its lines, painted row by row as they come.

import { palette } from "uchain/draw/colours.js";

/** A good distance between ticks, for about `count` of them. @param {number} span @param {number} count */
export function niceStep(span, count) {
  const rough = Math.max(1e-9, span) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((step) => step * power >= rough) ?? 10);
  // Two lines at least, wherever they fall.
  if (span / step >= 2) return step;
  return Math.round(step / power) === 2 ? step / 2 : step / 2.5;
}

export class Box {
  /** How many rows are painted. */
  done = 0;
  /** False = to be cleared and painted from the first row. */
  valid = false;
  /** How far along each dashed line is, so that its dashes go on. @type {number[]} */
  #along = [];

  /**
   * @param {import("uchain/draw/plot/spec.js").Spec} spec
   * @param {{left: number, top: number, width: number, height: number}} area where lines are
   * @param {{left: number, top: number, width: number, height: number}} all with what is around it
   * @param {{ticksY: boolean, ticksX: boolean, last: boolean}} axes
   */
  constructor(spec, area, all, axes) {
    this.spec = spec;
    this.area = area;
    this.all = all;
    this.axes = axes;
  }

  /** @param {number} time_s @param {{span_s: number}} scale */
  px(time_s, scale) {
    return this.area.left + (time_s / scale.span_s) * this.area.width;
  }

  /** @param {number} value @param {{low: number, high: number}} range */
  py(value, range) {
    return this.area.top + (1 - (value - range.low) / (range.high - range.low)) * this.area.height;
  }

  /** Clears the box and paints its axes. @param {CanvasRenderingContext2D} context @param {any} scale */
  begin(context, scale) {
    const colours = palette();
    const { area, all, spec } = this;
    const range = scale.ranges[spec.scale];
    this.done = 0;
    this.valid = true;
    this.#along = spec.lines.map(() => 0);
    context.fillStyle = colours.card;
    context.fillRect(all.left, all.top, all.width, all.height);
    context.fillStyle = colours.free;
    context.fillRect(area.left, area.top, area.width, area.height);
    context.lineWidth = 1;
    context.strokeStyle = colours.line;
    context.fillStyle = colours.soft;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "right";
    context.textBaseline = "middle";
    const stepY = Math.max(spec.whole ? 1 : 0, niceStep(range.high - range.low, Math.max(2, area.height / 38)));
    for (let value = Math.ceil(range.low / stepY) * stepY; value <= range.high + 1e-6; value += stepY) {
      const y = Math.round(this.py(value, range)) + 0.5;
      line(context, area.left, y, area.left + area.width, y);
      if (this.axes.ticksY) context.fillText(String(Math.round(value * 10) / 10), area.left - 6, Math.max(y, all.top + 6));
    }
    context.textAlign = "center";
    context.textBaseline = "top";
    const stepX = niceStep(scale.span_s, area.width / 90);
    for (let time_s = 0; time_s <= scale.span_s + 1e-6; time_s += stepX) {
      const x = Math.round(this.px(time_s, scale)) + 0.5;
      line(context, x, area.top, x, area.top + area.height);
      const room = time_s === 0 || this.axes.last || x < area.left + area.width - 12;
      if (this.axes.ticksX && room) context.fillText(String(Number(time_s.toPrecision(4))), Math.min(x, all.left + all.width - 11), area.top + area.height + 4);
    }
    context.textAlign = "right";
    if (this.axes.ticksX && this.axes.ticksY) context.fillText("time (s)", area.left - 8, area.top + area.height + 4);
    if (spec.scale === "loss") {
      context.strokeStyle = colours.soft;
      context.setLineDash([1.5, 3]);
      const y = this.py(scale.s_min_db, range);
      line(context, area.left, y, area.left + area.width, y);
      context.setLineDash([]);
    }
  }

  /**
   * Paints rows that have come since, with about so many points at most; returns with how many.
   * @param {CanvasRenderingContext2D} context @param {any} scale @param {any} series @param {{true: boolean, raw: boolean}} shown @param {number} most
   */
  grow(context, scale, series, shown, most) {
    const { area, spec } = this;
    const every = scale.every;
    const rows = Math.ceil(most / (3 * spec.lines.length)) * every;
    const to = Math.min(series.rows - (series.rows % every), this.done + rows);
    if (to <= this.done) return 0;
    const range = scale.ranges[spec.scale];
    context.save();
    context.beginPath();
    context.rect(area.left, area.top, area.width, area.height);
    context.clip();
    context.lineJoin = "round";
    context.lineCap = "butt";
    spec.lines.forEach((one, i) => {
      context.strokeStyle = context.fillStyle = one.colour;
      if (shown.raw && one.dots) this.#dots(context, scale, series, series.column(one.dots), to, range);
      if (shown.true && one.dashed) {
        context.lineWidth = 1.4;
        context.setLineDash([5, 3]);
        context.lineDashOffset = this.#along[i] % 8;
        this.#along[i] += this.#line(context, scale, series, series.column(one.dashed), to, range);
        context.setLineDash([]);
      }
      context.lineWidth = 2;
      this.#line(context, scale, series, series.column(one.solid), to, range);
    });
    context.restore();
    const points = (3 * spec.lines.length * (to - this.done)) / every;
    this.done = to;
    return points;
  }

  /** Returns how long the line is that it has painted (pixels). */
  #line(context, scale, series, column, to, range) {
    if (column < 0) return 0;
    const perSecond = this.area.width / scale.span_s;
    const perUnit = this.area.height / (range.high - range.low);
    const base = this.area.top + this.area.height + range.low * perUnit;
    let [x, y, long, begun] = [0, 0, 0, false];
    context.beginPath();
    for (let row = Math.max(0, this.done - scale.every); row < to; row += scale.every) {
      const value = series.at(row, column);
      if (!(value === value)) {
        begun = false;
        continue;
      }
      const nx = this.area.left + series.at(row, 0) * perSecond;
      const ny = base - value * perUnit * this.spec.times;
      if (begun) {
        context.lineTo(nx, ny);
        long += Math.hypot(nx - x, ny - y);
      } else {
        context.moveTo(nx, ny);
      }
      [x, y, begun] = [nx, ny, true];
    }
    context.stroke();
    return long;
  }

  #dots(context, scale, series, column, to, range) {
    if (column < 0) return;
    context.globalAlpha = 0.35;
    for (let row = this.done; row < to; row += scale.every) {
      const value = series.at(row, column);
      if (value === value) context.fillRect(Math.round(this.px(series.at(row, 0), scale)) - 1, Math.round(this.py(value, range)) - 1, 2, 2);
    }
    context.globalAlpha = 1;
  }
}

function line(context, ax, ay, bx, by) {
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
}
