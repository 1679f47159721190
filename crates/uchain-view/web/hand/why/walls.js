// How a UAV keeps off the walls: the little view from above, and its words.

import { element, shown } from "uchain/hand/element.js";
import { beamsDrawing } from "uchain/hand/why/beams.js";
import { uavColour } from "uchain/draw/colours.js";

const WAYS = { centre: "straight on", left: "left", right: "right" };
const WALLS = { both: "both walls", left: "the left wall", right: "the right wall" };

/** A way at a branch in words. */
export const wayOf = (follow) => WAYS[follow] ?? follow ?? null;

/**
 * How it steers; `walls` undefined and `follow` null: that is not known.
 * @param {{tof: any, follow: string|null, walls: string|null|undefined, pushed_by?: string|null, speed_share?: number, backward?: boolean}} by
 * How it steers; `walls` undefined and `follow` null: that is not known.
 * @param {{tof_range_m: number}} chain @param {number} uav
 */
export function wallsPart(by, chain, uav) {
  return [
    element("h4", {}, "Between the walls"),
    element(
      "div",
      { className: "why-walls" },
      beamsDrawing(by.tof ?? null, { range_m: chain.tof_range_m, walls: by.walls, colour: uavColour(uav), number: uav }),
      element("dl", {}, ...pairs([
        ["at a branch", wayOf(by.follow)],
        ["steers by", by.tof && by.walls !== undefined ? (WALLS[by.walls] ?? "no wall") : null],
        ["too near", by.pushed_by ? `the ${by.pushed_by} wall: pushed to the other side` : null],
        ["flies", by.backward ? "backward: its rear beams lead" : null],
        ["walls leave it", Number.isFinite(by.speed_share) ? `${shown(100 * by.speed_share, 0)} % of its speed` : null],
      ])),
    ),
  ];
}

/** Words and values as a list; what has no value is left out. */
export function pairs(rows) {
  return rows.filter(([, value]) => value !== null && value !== undefined && value !== "").flatMap(([word, value]) => [element("dt", {}, word), element("dd", {}, String(value))]);
}
