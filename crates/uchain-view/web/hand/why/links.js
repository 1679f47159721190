// The two links of a UAV against each other: losses as it believes them, on one axis, with the band within which its
// law does nothing. Where the two dots lie in one band, the links are level.

import { drawn, shown } from "uchain/hand/element.js";

const WIDTH = 340;
const LEFT = 112;
const RIGHT = 12;
const ROW = 50;
const TOP = 22;
/** Silence worth a word (s): packets come several times a second. */
const LATE_S = 0.3;

/**
 * @param {any} why what the engine says of the UAV
 * @param {{ahead: string, behind: string, s_min_db: number, colour: (loss_db: number) => string}} about
 */
export function linksDrawing(why, about) {
  const rows = why.back || why.stage === "flying" ? [{ name: "back", whom: about.behind, link: why.back }] : [];
  // Whoever leads has nobody in front.
  if (why.role !== "head" || why.front) rows.unshift({ name: "front", whom: about.ahead, link: why.front });
  const [low_db, high_db] = extent(rows, why, about.s_min_db);
  const x = (db) => LEFT + ((Math.min(Math.max(db, low_db), high_db) - low_db) / (high_db - low_db)) * (WIDTH - LEFT - RIGHT);
  const bottom = TOP + rows.length * ROW;
  const svg = drawn("svg", { viewBox: `0 0 ${WIDTH} ${bottom + 34}`, class: "why-links", role: "img", "aria-label": spoken(rows, why) });
  band(svg, why, x, bottom);
  rule(svg, about.s_min_db, x, bottom);
  rows.forEach((row, i) => drawRow(svg, row, TOP + i * ROW + ROW / 2, x, about));
  difference(svg, why, x);
  axis(svg, low_db, high_db, x, bottom);
  return svg;
}

/** What the drawing shows, in words. */
function spoken(rows, why) {
  const links = rows.map(({ name, whom, link }) => (link ? `${name} link, to ${whom}: ${shown(link.filtered_db, 1, "dB")}` : `no ${name} link heard`));
  const level = typeof why.imbalance_db === "number" ? `; front minus back ${shown(why.imbalance_db, 1, "dB", true)}` : "";
  const dead = typeof why.dead_band_db === "number" ? `, it counts as level within ${shown(why.dead_band_db, 1, "dB")}` : "";
  return `${links.join("; ")}${level}${dead}`;
}

/** Room for all that is drawn, at least 20 dB of it, so that noise does not look like news. */
function extent(rows, why, s_min_db) {
  const values = [s_min_db];
  for (const { link } of rows) {
    if (!link) continue;
    const sd = Math.sqrt(Math.max(0, link.variance_db2 ?? 0));
    for (const db of [link.filtered_db - sd, link.filtered_db + sd, link.raw_db]) if (Number.isFinite(db)) values.push(db);
  }
  let low = Math.min(...values) - 3;
  let high = Math.max(...values) + 3;
  const lack = (20 - (high - low)) / 2;
  if (lack > 0) [low, high] = [low - lack, high + lack];
  return [Math.floor(low / 5) * 5, Math.ceil(high / 5) * 5];
}

/** What counts as level with the back link. */
function band(svg, why, x, bottom) {
  const middle_db = why.back?.filtered_db;
  if (!Number.isFinite(middle_db) || !(why.dead_band_db > 0) || !why.front) return;
  const [from, to] = [x(middle_db - why.dead_band_db), x(middle_db + why.dead_band_db)];
  svg.append(drawn("rect", { x: from, y: TOP, width: Math.max(1, to - from), height: bottom - TOP, class: "dead-band" }));
}

function rule(svg, s_min_db, x, bottom) {
  const at = x(s_min_db);
  svg.append(
    drawn("line", { x1: at, x2: at, y1: TOP - 4, y2: bottom, class: "s-min" }),
    drawn("text", { x: Math.min(Math.max(at, LEFT + 34), WIDTH - 36), y: TOP - 8, class: "small", "text-anchor": "middle" }, `s_min ${shown(s_min_db, 0, "dB")}`),
  );
}

function drawRow(svg, { name, whom, link }, y, x, about) {
  svg.append(drawn("text", { x: 0, y: y - 8, class: "name" }, `${name}: ${whom}`));
  if (!link || !Number.isFinite(link.filtered_db)) {
    svg.append(drawn("text", { x: 0, y: y + 7, class: "small" }, "nothing heard yet"));
    return;
  }
  const db = link.filtered_db;
  const colour = about.colour(db);
  const sd = Math.sqrt(Math.max(0, link.variance_db2 ?? 0));
  svg.append(drawn("text", { x: 0, y: y + 7, class: "value" }, `${shown(db, 1)} ± ${shown(sd, 1, "dB")}`));
  if (link.silent_s > LATE_S) svg.append(drawn("text", { x: 0, y: y + 21, class: "late" }, `silent for ${shown(link.silent_s, 1, "s")}`));
  svg.append(drawn("line", { x1: LEFT, x2: x(db), y1: y, y2: y, class: "reach", stroke: colour }));
  if (Number.isFinite(link.raw_db) && x(link.raw_db) > LEFT) svg.append(drawn("circle", { cx: x(link.raw_db), cy: y, r: 4, fill: colour, opacity: 0.35 }, drawn("title", {}, `raw: ${shown(link.raw_db, 1, "dB")}`)));
  svg.append(
    drawn("path", { d: `M${x(db - sd)} ${y - 5}v10M${x(db - sd)} ${y}H${x(db + sd)}M${x(db + sd)} ${y - 5}v10`, class: "spread" }),
    drawn("circle", { cx: x(db), cy: y, r: 6, fill: colour, class: "dot" }),
  );
}

/** From the back link's dot to the front link's: what the law works on. */
function difference(svg, why, x) {
  const [front, back] = [why.front?.filtered_db, why.back?.filtered_db];
  if (!Number.isFinite(front) || !Number.isFinite(back)) return;
  const [y0, y1] = [TOP + ROW * 1.5 - 7, TOP + ROW / 2 + 7];
  svg.append(drawn("line", { x1: x(back), x2: x(front), y1: y0, y2: y1, class: "difference" }));
}

function axis(svg, low_db, high_db, x, bottom) {
  svg.append(drawn("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: bottom, y2: bottom, class: "axis" }));
  const step = high_db - low_db > 50 ? 20 : 10;
  for (let db = Math.ceil(low_db / step) * step; db <= high_db; db += step) {
    svg.append(drawn("text", { x: x(db), y: bottom + 14, class: "small", "text-anchor": "middle" }, String(db)));
    svg.append(drawn("line", { x1: x(db), x2: x(db), y1: bottom, y2: bottom + 3, class: "axis" }));
  }
  svg.append(drawn("text", { x: (LEFT + WIDTH - RIGHT) / 2, y: bottom + 29, class: "small", "text-anchor": "middle" }, "loss (dB): further right is weaker"));
}
