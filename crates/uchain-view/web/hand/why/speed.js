// Speeds against each other on one axis: what a UAV wishes, what it is allowed, what it does.

import { drawn, shown } from "uchain/hand/element.js";

/**
 * @param {{name: string, mps: number|null|undefined, kind: string}[]} marks @param {number} max_mps
 * @param {{label: string, width?: number, row?: number, hasAxis?: boolean}} how
 */
export function speedDrawing(marks, max_mps, { label, width = 340, row = 18, hasAxis = true }) {
  const known = marks.filter((mark) => Number.isFinite(mark.mps));
  const max = Math.max(max_mps, 0.05, ...known.map((mark) => Math.abs(mark.mps)));
  const x = (mps) => width / 2 + (mps / max) * (width / 2 - 4);
  const bottom = known.length * row;
  const words = known.map((mark) => `${mark.name} ${shown(mark.mps, 2, "m/s", true)}`).join(", ");
  const svg = drawn("svg", { viewBox: `0 0 ${width} ${bottom + (hasAxis ? 20 : 2)}`, class: "why-speed", role: "img", "aria-label": `${label}: ${words}` });
  known.forEach((mark, i) => {
    const [y, height] = [i * row + 1, row - 4];
    const [from, to] = [Math.min(x(0), x(mark.mps)), Math.max(x(0), x(mark.mps))];
    const isForward = mark.mps >= 0;
    svg.append(
      drawn("rect", { x: from, y, width: Math.max(to - from, 2), height, class: `bar ${mark.kind}` }),
      drawn("text", { x: x(0) + (isForward ? -6 : 6), y: y + height / 2 + 4, class: "small", "text-anchor": isForward ? "end" : "start" }, `${mark.name} ${shown(mark.mps, 2, "", true)}`),
    );
  });
  svg.append(drawn("line", { x1: x(0), x2: x(0), y1: 0, y2: bottom, class: "axis" }));
  if (hasAxis) {
    svg.append(
      drawn("text", { x: 2, y: bottom + 14, class: "small" }, `backward ${shown(max, 2)}`),
      drawn("text", { x: width - 2, y: bottom + 14, class: "small", "text-anchor": "end" }, `forward ${shown(max, 2)} m/s`),
    );
  }
  return svg;
}
