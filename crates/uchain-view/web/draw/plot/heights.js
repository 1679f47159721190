// @ts-check
// The robots of an exploration from the side: where each is along the map's x, how high, and on which level.

import { onUav, palette, uavColour } from "uchain/draw/colours.js";

/** So many levels are shown at least. */
const LEVELS = 3;
/** How high the strip is (pixels). */
export const STRIP_PX = 116;

/**
 * @param {CanvasRenderingContext2D} context @param {any} pane
 * @param {{left: number, top: number, width: number}} area the strip, with room for names at its left
 */
export function drawHeights(context, pane, area) {
  const robots = pane.frame.robots;
  const used = Math.max(LEVELS, ...robots.map((/** @type {any} */ robot) => robot.level + 1));
  const levels = pane.scene.exploration.level_z_m.slice(0, used);
  const colours = palette();
  const [left, top, right, bottom] = [area.left + 76, area.top + 24, area.left + area.width - 66, area.top + STRIP_PX - 22];
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillStyle = colours.ink;
  context.fillText("from the side: height (m), by level", area.left + 8, area.top + 5);
  context.fillStyle = colours.free;
  context.fillRect(left, top, right - left, bottom - top);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = colours.soft;
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  const highest = Math.max(1e-3, ...levels, ...robots.map((/** @type {any} */ robot) => robot.z_m)) * 1.15;
  const py = (/** @type {number} */ z_m) => bottom - (z_m / highest) * (bottom - top);
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const z_m of levels) {
    const y = Math.round(py(z_m)) + 0.5;
    context.beginPath();
    context.moveTo(left, y);
    context.lineTo(right, y);
    context.stroke();
    context.fillText(z_m.toFixed(2), left - 6, y);
  }
  const [x0, , x1] = pane.scene.map.bounds;
  const offset_m = pane.scene.map.offset_m?.[0] ?? 0;
  context.textBaseline = "top";
  context.fillText("x (m)", left - 8, bottom + 4);
  context.textAlign = "left";
  context.fillText((x0 + offset_m).toFixed(1), left, bottom + 4);
  context.textAlign = "right";
  context.fillText((x1 + offset_m).toFixed(1), right, bottom + 4);
  robots.forEach((/** @type {any} */ robot, /** @type {number} */ id) => {
    const [x, y] = [left + ((robot.x_m - x0) / Math.max(1e-3, x1 - x0)) * (right - left), py(robot.z_m)];
    context.beginPath();
    context.arc(x, y, 7, 0, 7);
    context.fillStyle = uavColour(id);
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = colours.free;
    context.stroke();
    context.fillStyle = onUav(id);
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.font = "700 10px system-ui, sans-serif";
    context.fillText(String(id), x, y + 0.5);
  });
}
