// What a UAV wishes and what it is allowed, on one axis of speed.

import { drawn, shown } from "uchain/hand/element.js";

const WIDTH = 340;

/** @param {{name: string, mps: number|null|undefined, kind: string}[]} marks @param {number} max_mps @param {string} label */
export function speedDrawing(marks, max_mps, label) {
  const known = marks.filter((mark) => Number.isFinite(mark.mps));
  const max = Math.max(max_mps, 0.05, ...known.map((mark) => Math.abs(mark.mps)));
  const x = (mps) => WIDTH / 2 + (mps / max) * (WIDTH / 2 - 14);
  const row = 18;
  const height = known.length * row + 22;
  const words = known.map((mark) => `${mark.name} ${shown(mark.mps, 2, "m/s", true)}`).join(", ");
  const svg = drawn("svg", { viewBox: `0 0 ${WIDTH} ${height}`, class: "why-speed", role: "img", "aria-label": `${label}: ${words}` });
  known.forEach((mark, i) => {
    const y = i * row + 2;
    const [from, to] = [Math.min(x(0), x(mark.mps)), Math.max(x(0), x(mark.mps))];
    svg.append(drawn("rect", { x: from, y, width: Math.max(to - from, 2), height: row - 6, class: `bar ${mark.kind}` }));
    const isLeft = mark.mps >= 0;
    svg.append(drawn("text", { x: isLeft ? x(0) - 6 : x(0) + 6, y: y + 10, class: "small", "text-anchor": isLeft ? "end" : "start" }, `${mark.name} ${shown(mark.mps, 2, "", true)}`));
  });
  const bottom = known.length * row + 2;
  svg.append(
    drawn("line", { x1: x(0), x2: x(0), y1: 0, y2: bottom, class: "axis" }),
    drawn("text", { x: 2, y: bottom + 14, class: "small" }, `backward ${shown(max, 2)}`),
    drawn("text", { x: WIDTH - 2, y: bottom + 14, class: "small", "text-anchor": "end" }, `forward ${shown(max, 2)} m/s`),
  );
  return svg;
}
