// @ts-check
// The robots of an exploration from the side: how high each flies, and on which level.

import { onUav, palette, uavColour } from "uchain/draw/colours.js";

/** So many levels are shown at least. */
const LEVELS = 3;
const [WIDE, HIGH, EDGE] = [190, 92, 10];

/** @param {CanvasRenderingContext2D} context @param {import("uchain/draw/view.js").View} view @param {any} pane */
export function drawHeights(context, view, pane) {
  const robots = pane.frame.robots;
  const used = Math.max(LEVELS, ...robots.map((/** @type {any} */ robot) => robot.level + 1));
  const levels = pane.scene.exploration.level_z_m.slice(0, used);
  if (!levels.length || view.width < 420) return;
  const colours = palette();
  const [left, top] = [view.width - WIDE - EDGE, EDGE];
  context.globalAlpha = 0.92;
  context.fillStyle = colours.card;
  context.fillRect(left, top, WIDE, HIGH);
  context.globalAlpha = 1;
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.strokeRect(left + 0.5, top + 0.5, WIDE - 1, HIGH - 1);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillStyle = colours.soft;
  context.fillText("from the side: height (m)", left + 8, top + 11);
  const highest = Math.max(...levels, ...robots.map((/** @type {any} */ robot) => robot.z_m), 1e-3) * 1.1;
  const py = (/** @type {number} */ z_m) => top + HIGH - 8 - (z_m / highest) * (HIGH - 34);
  for (const z_m of levels) {
    context.beginPath();
    context.moveTo(left + 34, py(z_m));
    context.lineTo(left + WIDE - 8, py(z_m));
    context.stroke();
    context.fillText(z_m.toFixed(2), left + 6, py(z_m));
  }
  const [x0, , x1] = pane.scene.map.bounds;
  robots.forEach((/** @type {any} */ robot, /** @type {number} */ id) => {
    const x = left + 44 + ((robot.x_m - x0) / Math.max(1e-3, x1 - x0)) * (WIDE - 62);
    context.beginPath();
    context.arc(x, py(robot.z_m), 6, 0, 7);
    context.fillStyle = uavColour(id);
    context.fill();
    context.fillStyle = onUav(id);
    context.textAlign = "center";
    context.font = "700 9px system-ui, sans-serif";
    context.fillText(String(id), x, py(robot.z_m) + 0.5);
  });
}
