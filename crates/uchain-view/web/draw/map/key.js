// @ts-check
// The key to a map, in its lower left corner: how long a metre is, and what the colours say.

import { linkColour, palette } from "uchain/draw/colours.js";
import { FRONTIER, STAR } from "uchain/draw/map/explore.js";

/** About how long the scale bar is (pixels). */
const BAR_PX = 90;
/** The colours of links: from so far below s_min to so far above it (dB). */
const SPAN_DB = 20;

/** @param {CanvasRenderingContext2D} context @param {import("uchain/draw/map/view.js").View} view @param {any} pane */
export function drawKey(context, view, pane) {
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "alphabetic";
  const end = scaleBar(context, view);
  if (view.width < 460) return;
  if (pane.explores) signs(context, end + 26, view.height - 14);
  else losses(context, end + 26, view.height - 14, pane.scene.chain.s_min_db);
}

/** Returns where it ends (pixels). */
function scaleBar(context, view) {
  const wanted = BAR_PX / view.scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const length_m = power * ([5, 2, 1].find((step) => step * power <= wanted) ?? 1);
  const [x, y, width] = [14, view.height - 14, length_m * view.scale];
  context.textAlign = "left";
  context.lineWidth = 2;
  context.strokeStyle = context.fillStyle = palette().ink;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + width, y);
  context.lineTo(x + width, y - 5);
  context.stroke();
  context.fillText(length_m < 1 ? `${Math.round(length_m * 100)} cm` : `${length_m} m`, x + 5, y - 6);
  return x + width;
}

/** The colours of links by their loss. */
function losses(context, x, y, s_min_db) {
  const wide = 110;
  // The colours are linear in between, as a gradient is.
  const gradient = context.createLinearGradient(x, 0, x + wide, 0);
  for (const share of [0, 0.5, 1]) gradient.addColorStop(share, linkColour(s_min_db + (2 * share - 1) * SPAN_DB, s_min_db));
  context.fillStyle = gradient;
  context.fillRect(x, y - 5, wide, 5);
  context.fillStyle = palette().ink;
  context.textAlign = "center";
  context.fillText(String(s_min_db - SPAN_DB), x, y - 9);
  context.fillText(`s_min ${s_min_db}`, x + wide / 2, y - 9);
  context.textAlign = "left";
  context.fillText(`${s_min_db + SPAN_DB} dB`, x + wide - 8, y - 9);
}

/** What is what on the map of an exploration. */
function signs(context, x, y) {
  const { dark, soft, ink } = palette();
  const all = /** @type {[string, (x: number) => void][]} */ ([
    ["seen", (at) => {
      context.globalAlpha = dark ? 0.5 : 0.35;
      context.fillStyle = dark ? STAR.dark : STAR.light;
      context.fillRect(at, y - 11, 16, 11);
      context.globalAlpha = 1;
    }],
    ["frontier", (at) => stroke(context, dark ? FRONTIER.dark : FRONTIER.light, 3, at, y - 5)],
    ["graph", (at) => stroke(context, soft, 1.5, at, y - 5)],
  ]);
  context.textAlign = "left";
  for (const [words, draw] of all) {
    draw(x);
    context.fillStyle = ink;
    context.fillText(words, x + 21, y - 1);
    x += context.measureText(words).width + 38;
  }
}

function stroke(context, ink, width, x, y) {
  context.strokeStyle = ink;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + 16, y);
  context.stroke();
}
