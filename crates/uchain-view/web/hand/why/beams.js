// A UAV seen from above, nose up: its four distance beams, and the walls that it steers by.

import { drawn, shown } from "uchain/hand/element.js";

const SIZE = 160;
const MIDDLE = SIZE / 2;
/** Front left, front right, rear left, rear right: directions on the page, nose up. */
const BEAMS = [
  ["nw_m", "front left", -1, -1],
  ["ne_m", "front right", 1, -1],
  ["sw_m", "rear left", -1, 1],
  ["se_m", "rear right", 1, 1],
];

/**
 * @param {{nw_m: number, ne_m: number, sw_m: number, se_m: number}|null} tof
 * @param {{range_m: number, walls: string|null, colour: string, number: number}} about
 */
export function beamsDrawing(tof, about) {
  const seen = BEAMS.map(([key, name]) => `${name} ${tof ? shown(tof[key], 2, "m") : "not measured"}`);
  const svg = drawn("svg", { viewBox: `0 0 ${SIZE} ${SIZE}`, class: "why-beams", role: "img", "aria-label": `Distances to the walls: ${seen.join(", ")}` });
  if (tof) drawBeams(svg, tof, about);
  svg.append(
    drawn("circle", { cx: MIDDLE, cy: MIDDLE, r: 9, fill: about.colour }),
    drawn("path", { d: `M${MIDDLE - 5} ${MIDDLE - 10}L${MIDDLE} ${MIDDLE - 17}L${MIDDLE + 5} ${MIDDLE - 10}`, fill: "none", stroke: about.colour, "stroke-width": 2 }),
    drawn("text", { x: MIDDLE, y: MIDDLE + 4, class: "number", "text-anchor": "middle" }, String(about.number)),
  );
  return svg;
}

function drawBeams(svg, tof, { range_m, walls }) {
  const isBlind = ([key]) => !(tof[key] < range_m);
  const longest = Math.max(0.3, ...BEAMS.filter((beam) => !isBlind(beam)).map(([key]) => tof[key]));
  // A beam that meets nothing goes to the edge of the drawing.
  const tip = (beam) => {
    const part = (Math.min(tof[beam[0]], 1.2 * longest) / (1.2 * longest)) * (MIDDLE - 26);
    return [MIDDLE + beam[2] * part, MIDDLE + beam[3] * part];
  };
  for (const [side, front, rear] of [["left", BEAMS[0], BEAMS[2]], ["right", BEAMS[1], BEAMS[3]]]) {
    if (isBlind(front) || isBlind(rear)) continue;
    const [[x1, y1], [x2, y2]] = [tip(front), tip(rear)];
    svg.append(drawn("line", { x1, y1, x2, y2, class: walls === side || walls === "both" ? "wall used" : "wall" }));
  }
  for (const beam of BEAMS) {
    const [x, y] = tip(beam);
    const isRight = beam[2] > 0;
    svg.append(
      drawn("line", { x1: MIDDLE, y1: MIDDLE, x2: x, y2: y, class: isBlind(beam) ? "beam blind" : "beam" }),
      drawn("circle", { cx: x, cy: y, r: isBlind(beam) ? 0 : 2.5, class: "tip" }),
      drawn("text", { x: x + (isRight ? 6 : -6), y: y + (beam[3] < 0 ? -1 : 10), class: "small", "text-anchor": isRight ? "start" : "end" }, isBlind(beam) ? "none" : shown(tof[beam[0]], 2)),
    );
  }
}
