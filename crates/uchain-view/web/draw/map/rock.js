// @ts-check
// The rock and the free ground of a map: drawn once for a view and kept as a picture.

import { palette } from "uchain/draw/colours.js";

export class Rock {
  #kept = document.createElement("canvas");
  #state = "";

  /**
   * @param {CanvasRenderingContext2D} context @param {import("uchain/draw/map/view.js").View} view
   * @param {{loops: number[][]}} map @param {number} ratio device pixels per CSS pixel
   */
  draw(context, view, map, ratio) {
    const colours = palette();
    const state = `${view.version} ${ratio} ${colours.dark}`;
    if (state !== this.#state) {
      this.#state = state;
      this.#paint(view, map, ratio, colours);
    }
    context.drawImage(this.#kept, 0, 0, view.width, view.height);
  }

  #paint(view, map, ratio, colours) {
    this.#kept.width = Math.round(view.width * ratio);
    this.#kept.height = Math.round(view.height * ratio);
    const context = /** @type {CanvasRenderingContext2D} */ (this.#kept.getContext("2d", { alpha: false }));
    context.scale(ratio, ratio);
    context.fillStyle = colours.rock;
    context.fillRect(0, 0, view.width, view.height);
    const path = new Path2D();
    for (const loop of map.loops) {
      for (let i = 0; i + 1 < loop.length; i += 2) {
        const [x, y] = [view.px(loop[i]), view.py(loop[i + 1])];
        if (i === 0) path.moveTo(x, y);
        else path.lineTo(x, y);
      }
      path.closePath();
    }
    context.fillStyle = colours.free;
    context.fill(path, "evenodd");
    context.strokeStyle = colours.wall;
    context.lineWidth = 1.5;
    context.lineJoin = "round";
    context.stroke(path);
  }
}
