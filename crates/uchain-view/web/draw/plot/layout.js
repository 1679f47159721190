// @ts-check
// Where the boxes of a plot are: one large one, two side by side, or small multiples in a grid.

import { Box } from "uchain/draw/plot/box.js";

/** Room around the lines of one large box (pixels); the time line below has the same left and right. */
export const AROUND = { left: 76, right: 66, top: 22, bottom: 22 };

/** From this width on title and kinds of lines stand in one row (pixels). */
export const WIDE_PX = 520;

/** @param {import("uchain/draw/plot/spec.js").Spec[]} specs @param {number} width @param {number} height */
export function layOut(specs, width, height) {
  const single = specs.length === 1;
  // How lines look is told in a row of its own where the title leaves no room beside it.
  const second = width < WIDE_PX && specs[0]?.scale === "loss" ? 16 : 0;
  const around = { ...AROUND, ...(width < 480 ? { left: 56, right: 58 } : {}), top: AROUND.top + second };
  const columns = single ? 1 : specs.length === 2 ? (width > 620 ? 2 : 1) : gridColumns(specs.length, width, height);
  const rows = Math.ceil(specs.length / columns);
  const few = specs.length <= 2;
  const left = few ? around.left : 58;
  const top = 20 + second;
  const bottom = 22;
  const cellWidth = (width - (few ? 0 : left + 6)) / columns;
  const cellHeight = (height - (few ? 0 : top + bottom)) / rows;
  return specs.map((spec, i) => {
    const [column, row] = [i % columns, Math.floor(i / columns)];
    if (few) {
      const all = { left: column * cellWidth, top: row * cellHeight, width: cellWidth, height: cellHeight };
      const area = { left: all.left + around.left, top: all.top + around.top, width: cellWidth - around.left - around.right, height: cellHeight - around.top - around.bottom };
      return new Box(spec, area, all, { ticksX: true, ticksY: true, last: true });
    }
    const last = i + columns >= specs.length;
    const all = { left: column === 0 ? 0 : left + column * cellWidth, top: top + row * cellHeight, width: cellWidth + (column === 0 ? left : 0), height: cellHeight + (last ? bottom : 0) };
    const gap = spec.lines.length > 1 ? 22 : 6;
    const area = { left: left + column * cellWidth, top: all.top + 2, width: cellWidth - gap, height: cellHeight - 6 };
    return new Box(spec, area, all, { ticksX: last, ticksY: column === 0, last: column === columns - 1 });
  });
}

/** So many columns that boxes are about three times as wide as high. @param {number} count @param {number} width @param {number} height */
function gridColumns(count, width, height) {
  let [best, off] = [1, Infinity];
  for (let columns = 1; columns <= count; columns += 1) {
    const rows = Math.ceil(count / columns);
    const ratio = Math.abs(Math.log(width / columns / (height / rows) / 3)) + (0.6 * (rows * columns - count)) / count;
    if (ratio < off) [best, off] = [columns, ratio];
  }
  return best;
}
