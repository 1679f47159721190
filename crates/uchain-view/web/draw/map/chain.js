// @ts-check
// A chain on its map: trails, links by loss, beams, base and goal, the UAVs with heading and number.

import { app } from "uchain/app.js";
import { linkColour, onUav, palette, uavColour } from "uchain/draw/colours.js";
import { shown } from "uchain/panel/layers.js";

/** A UAV is never drawn smaller (pixels). */
const LEAST_PX = 8;
/** A link shorter than this has no room for its loss (pixels). */
const ROOM_PX = 54;
/** So many pieces of trail are drawn at most, all UAVs together. */
const TRAIL_PIECES = 4000;
/** Beams of all are drawn up to so many UAVs; past it, the selected one's. */
const BEAMS_OF_ALL = 12;
/** nw = front left, ne = front right, sw = rear left, se = rear right: angles to the heading (rad). */
const BEAMS = /** @type {[string, number][]} */ ([["nw_m", Math.PI / 4], ["ne_m", -Math.PI / 4], ["sw_m", (3 * Math.PI) / 4], ["se_m", (-3 * Math.PI) / 4]]);

/** How large a UAV is drawn (pixels). @param {any} pane @param {import("uchain/draw/map/view.js").View} view */
export function discPx(pane, view) {
  return Math.max(LEAST_PX, (pane.scene.radius_m ?? 0) * view.scale);
}

/** The UAV at a pixel. @param {any} pane @param {import("uchain/draw/map/view.js").View} view @param {number} px @param {number} py */
export function nearestUav(pane, view, px, py) {
  return nearest(pane.frame.uavs, view, px, py, discPx(pane, view) + 6);
}

/** @param {any[]} all @param {import("uchain/draw/map/view.js").View} view @param {number} px @param {number} py @param {number} within_px */
export function nearest(all, view, px, py, within_px) {
  let best = null;
  let least = within_px;
  all.forEach((one, id) => {
    const away = Math.hypot(view.px(one.x_m) - px, view.py(one.y_m) - py);
    if (away <= least) [best, least] = [id, away];
  });
  return best;
}

/** @param {CanvasRenderingContext2D} context @param {import("uchain/draw/map/view.js").View} view @param {any} pane */
export function drawChain(context, view, pane) {
  const { frame, scene } = pane;
  context.lineJoin = context.lineCap = "round";
  if (shown.trails) drawTrails(context, view, pane);
  if (shown.beams) drawBeams(context, view, pane);
  const size = discPx(pane, view);
  for (let id = frame.uavs.length - 1; id >= 0; id -= 1) {
    if (!frame.uavs[id].airborne) waiting(context, view, frame.uavs[id], size);
  }
  for (const link of frame.links) drawLink(context, view, frame, scene, link);
  if (shown.losses) drawLosses(context, view, frame, scene);
  places(context, view, pane);
  if (shown.overrides) drawOverrides(context, view, frame, size);
  for (let id = frame.uavs.length - 1; id >= 0; id -= 1) {
    if (frame.uavs[id].airborne) drawDisc(context, view.px(frame.uavs[id].x_m), view.py(frame.uavs[id].y_m), frame.uavs[id].heading_rad, id, size);
  }
}

/** Where each has been, up to the cursor. @param {CanvasRenderingContext2D} context @param {import("uchain/draw/map/view.js").View} view @param {any} pane */
export function drawTrails(context, view, pane) {
  const { series, frame } = pane;
  const last = series.rowAt(frame.time_s);
  const all = frame.uavs ?? frame.robots;
  const every = Math.max(1, 2 ** Math.ceil(Math.log2((last * all.length) / TRAIL_PIECES)));
  context.lineWidth = 1.6;
  context.globalAlpha = 0.5;
  all.forEach((/** @type {any} */ one, /** @type {number} */ id) => {
    const column = series.column(`x_m.${id}`);
    if (column < 0) return;
    context.strokeStyle = uavColour(id);
    context.beginPath();
    let begun = false;
    for (let row = 0; row <= last; row += every) {
      const x_m = series.at(row, column);
      if (!(x_m === x_m)) {
        begun = false;
        continue;
      }
      const [x, y] = [view.px(x_m), view.py(series.at(row, column + 1))];
      if (begun) context.lineTo(x, y);
      else context.moveTo(x, y);
      begun = true;
    }
    if (begun) context.lineTo(view.px(one.x_m), view.py(one.y_m));
    context.stroke();
  });
  context.globalAlpha = 1;
}

function drawBeams(context, view, pane) {
  const { frame, scene } = pane;
  const all = frame.uavs.length <= BEAMS_OF_ALL;
  const colours = palette();
  context.lineWidth = 1;
  frame.uavs.forEach((/** @type {any} */ uav, /** @type {number} */ id) => {
    if (!uav.tof || !uav.airborne || !(all || id === app.selected)) return;
    const [x, y] = [view.px(uav.x_m), view.py(uav.y_m)];
    context.strokeStyle = context.fillStyle = uavColour(id);
    for (const [name, angle_rad] of BEAMS) {
      const seen = uav.tof[name];
      const hit = seen !== null && seen < scene.chain.tof_range_m;
      const length = (hit ? seen : scene.chain.tof_range_m) * view.scale;
      const [ex, ey] = [x + Math.cos(uav.heading_rad + angle_rad) * length, y - Math.sin(uav.heading_rad + angle_rad) * length];
      context.globalAlpha = hit ? 0.75 : 0.25;
      context.setLineDash(hit ? [] : [2, 5]);
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(ex, ey);
      context.stroke();
      if (!hit) continue;
      context.beginPath();
      context.arc(ex, ey, 2.2, 0, 7);
      context.fill();
    }
  });
  context.setLineDash([]);
  context.globalAlpha = 1;
  context.strokeStyle = colours.ink;
}

/** What has taken over a UAV, in words below it. */
function drawOverrides(context, view, frame, size) {
  context.font = "600 11px system-ui, sans-serif";
  frame.uavs.forEach((/** @type {any} */ uav, /** @type {number} */ id) => {
    if (!uav.airborne || !uav.doing || (frame.uavs.length > BEAMS_OF_ALL && id !== app.selected)) return;
    const { overridden, pushed_by } = uav.doing;
    const words = [overridden?.replaceAll("-", " "), pushed_by ? `pushed off the ${pushed_by} wall` : null].filter(Boolean).join(", ");
    if (words) label(context, words, view.px(uav.x_m), view.py(uav.y_m) + size + 17, view);
  });
}

/** Base and goal, with their names. */
function places(context, view, pane) {
  const colours = palette();
  const { base_m, goal_m } = pane.scene.chain;
  context.font = "600 12px system-ui, sans-serif";
  if (goal_m) {
    const [x, y] = [view.px(goal_m[0]), view.py(goal_m[1])];
    context.strokeStyle = colours.ink;
    context.lineWidth = 2;
    for (const radius of [9, 4]) {
      context.beginPath();
      context.arc(x, y, radius, 0, 7);
      context.stroke();
    }
    label(context, "goal", x, y + 21, view);
  }
  const [x, y] = [view.px(base_m[0]), view.py(base_m[1])];
  context.fillStyle = colours.ink;
  context.fillRect(x - 7, y - 7, 14, 14);
  context.fillStyle = colours.free;
  context.fillRect(x - 2.5, y - 2.5, 5, 5);
  const ground = pane.frame.uavs.filter((/** @type {any} */ uav) => !uav.airborne);
  const launch = ground.find((/** @type {any} */ uav) => uav.doing?.launch)?.doing.launch.split(":")[0];
  label(context, ground.length ? `base, ${ground.length} waiting${launch ? `, launch ${launch}` : ""}` : "base", x, y + 20, view);
}

/** Words on a plate of their own, within the map. @param {CanvasRenderingContext2D} context @param {string} text @param {number} x @param {number} y the middle @param {import("uchain/draw/map/view.js").View} view */
export function label(context, text, x, y, view) {
  const colours = palette();
  const half = context.measureText(text).width / 2 + 5;
  const at = Math.max(half + 3, Math.min(view.width - half - 3, x));
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = colours.plate;
  context.beginPath();
  context.roundRect(at - half, y - 9, 2 * half, 17, 5);
  context.fill();
  context.fillStyle = colours.ink;
  context.fillText(text, at, y);
}

function drawLink(context, view, frame, scene, link) {
  const ends = endsOf(view, frame, scene, link);
  if (!ends) return;
  const [ax, ay, bx, by] = ends;
  const lost = link.heard === false;
  context.strokeStyle = linkColour(link.true_db, scene.chain.s_min_db);
  context.lineWidth = 4;
  context.globalAlpha = 0.9;
  context.setLineDash(lost ? [3, 8] : []);
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
  if (missed(link, scene)) cross(context, (ax + bx) / 2, (ay + by) / 2);
}

/** The ends of a link on the screen; null = one of them is not there. */
function endsOf(view, frame, scene, link) {
  const front = frame.uavs[link.uav];
  const behind = link.behind === null ? { x_m: scene.chain.base_m[0], y_m: scene.chain.base_m[1] } : frame.uavs[link.behind];
  return front && behind ? [view.px(behind.x_m), view.py(behind.y_m), view.px(front.x_m), view.py(front.y_m)] : null;
}

/** The loss beside each link that has room for it, none over another. */
function drawLosses(context, view, frame, scene) {
  context.font = "600 12px system-ui, sans-serif";
  /** @type {number[][]} */
  const taken = [];
  for (const link of frame.links) {
    const ends = endsOf(view, frame, scene, link);
    if (!ends) continue;
    const [ax, ay, bx, by] = ends;
    const long_px = Math.hypot(bx - ax, by - ay);
    if (long_px < ROOM_PX) continue;
    const [nx, ny] = [-(by - ay) / long_px, (bx - ax) / long_px];
    const side = ny > 0 || (ny === 0 && nx > 0) ? -1 : 1;
    const off = 15 + Math.abs(nx) * 16;
    const [x, y] = [(ax + bx) / 2 + nx * side * off, (ay + by) / 2 + ny * side * off];
    if (taken.some(([ox, oy]) => Math.abs(ox - x) < ROOM_PX && Math.abs(oy - y) < 18)) continue;
    taken.push([x, y]);
    label(context, `${link.true_db.toFixed(0)} dB${link.heard === false ? ", lost" : ""}`, x, y, view);
  }
}

/** Whether the last packet from one of its ends did not come through. */
function missed(link, scene) {
  const due_s = 1.5 * scene.chain.decision_ticks * scene.tick_s;
  return Math.max(link.front_silence_s ?? 0, link.rear_silence_s ?? 0) > due_s;
}

/** A packet that was not heard. */
function cross(context, x, y) {
  const colours = palette();
  for (const [width, ink] of /** @type {[number, string][]} */ ([[6, colours.free], [2.4, colours.error]])) {
    context.lineWidth = width;
    context.strokeStyle = ink;
    context.beginPath();
    context.moveTo(x - 5, y - 5);
    context.lineTo(x + 5, y + 5);
    context.moveTo(x + 5, y - 5);
    context.lineTo(x - 5, y + 5);
    context.stroke();
  }
}

function waiting(context, view, uav, size) {
  const colours = palette();
  context.beginPath();
  context.arc(view.px(uav.x_m), view.py(uav.y_m), size * 0.6, 0, 7);
  context.fillStyle = colours.free;
  context.fill();
  context.lineWidth = 1.2;
  context.strokeStyle = colours.soft;
  context.stroke();
}

/** A disc with its heading and its number. @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} heading_rad @param {number} id @param {number} size */
export function drawDisc(context, x, y, heading_rad, id, size) {
  const colours = palette();
  const [cos, sin] = [Math.cos(heading_rad), -Math.sin(heading_rad)];
  if (id === app.selected) {
    context.beginPath();
    context.arc(x, y, size + 6, 0, 7);
    context.lineWidth = 3;
    context.strokeStyle = colours.ink;
    context.stroke();
  }
  for (const [width, ink, out] of /** @type {[number, string, number][]} */ ([[6, colours.free, 7], [3, uavColour(id), 6]])) {
    context.lineWidth = width;
    context.strokeStyle = ink;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + cos * (size + out), y + sin * (size + out));
    context.stroke();
  }
  context.beginPath();
  context.arc(x, y, size, 0, 7);
  context.lineWidth = 3;
  context.strokeStyle = colours.free;
  context.stroke();
  context.fillStyle = uavColour(id);
  context.fill();
  context.fillStyle = onUav(id);
  context.font = `700 ${Math.round(Math.max(10, Math.min(16, size * 1.25)))}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(String(id), x, y + 0.5);
}
