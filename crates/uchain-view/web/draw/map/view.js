// @ts-check
// Between metres on the map and pixels on the screen: fit, pan, zoom.

/** Least and greatest scale (pixels per metre). */
const SCALE = [0.2, 4000];
/** Room below the map for its key (pixels). */
const KEY_PX = 50;

export class View {
  /** Pixels per metre (CSS pixels). */
  scale = 50;
  width = 1;
  height = 1;
  /** What is in the middle (m). */
  x_m = 0;
  y_m = 0;
  /** False once somebody has moved it: then a new size keeps what is in the middle. */
  fitted = true;
  /** Counts up with every change. */
  version = 0;
  bounds = [0, 0, 1, 1];

  /** @param {number} width @param {number} height */
  resize(width, height) {
    if (width === this.width && height === this.height) return;
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.version += 1;
    if (this.fitted) this.fit();
  }

  /** Shows the whole of the map. @param {number[]} [bounds] */
  fit(bounds = this.bounds) {
    this.bounds = bounds;
    const [x0, y0, x1, y1] = bounds;
    const margin = Math.min(28, this.width / 10, this.height / 10);
    const below = Math.min(KEY_PX, this.height / 6);
    const fits = Math.min((this.width - 2 * margin) / Math.max(1e-3, x1 - x0), (this.height - margin - below) / Math.max(1e-3, y1 - y0));
    this.scale = Math.min(SCALE[1], Math.max(SCALE[0], fits));
    this.x_m = (x0 + x1) / 2;
    this.y_m = (y0 + y1) / 2 - (below - margin) / 2 / this.scale;
    this.fitted = true;
    this.version += 1;
  }

  /** @param {number} x_m */
  px(x_m) {
    return this.width / 2 + (x_m - this.x_m) * this.scale;
  }

  /** @param {number} y_m */
  py(y_m) {
    return this.height / 2 - (y_m - this.y_m) * this.scale;
  }

  /** The place at a pixel (m). @param {number} px @param {number} py */
  toMetre(px, py) {
    return { x_m: this.x_m + (px - this.width / 2) / this.scale, y_m: this.y_m - (py - this.height / 2) / this.scale };
  }

  /** @param {number} dx @param {number} dy by so many pixels */
  pan(dx, dy) {
    const [x0, y0, x1, y1] = this.bounds;
    this.x_m = Math.max(x0, Math.min(x1, this.x_m - dx / this.scale));
    this.y_m = Math.max(y0, Math.min(y1, this.y_m + dy / this.scale));
    this.fitted = false;
    this.version += 1;
  }

  /** Zooms, and what is at that pixel stays there. @param {number} by @param {number} [px] @param {number} [py] */
  zoom(by, px = this.width / 2, py = this.height / 2) {
    const kept = this.toMetre(px, py);
    this.scale = Math.min(SCALE[1], Math.max(SCALE[0], this.scale * by));
    const now = this.toMetre(px, py);
    this.x_m += kept.x_m - now.x_m;
    this.y_m += kept.y_m - now.y_m;
    this.fitted = false;
    this.version += 1;
  }
}
