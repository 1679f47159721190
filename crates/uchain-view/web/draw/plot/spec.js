// @ts-check
// Which boxes a flight's plot has, and which lines are in them.

import { uavColour } from "uchain/draw/colours.js";

/** At most so many lines in a box. */
export const LINES = 6;
/** Up to so many links each has a box of its own; past it, six share one. */
const OWN_BOX = 30;

/**
 * @typedef {{id: number, label: string, ink: number, colour: string, solid: string, dashed: string|null, dots: string|null}} Line
 * @typedef {{title: string, unit: string, lines: Line[], scale: string, least: [number, number]|null, whole: boolean, times: number}} Spec
 */

/**
 * The boxes for a pane. `scale`: boxes of one scale share their axis; `times`: from the engine's number to the axis.
 * @param {any} pane @param {number} flown so many UAVs have flown @returns {Spec[]}
 */
export function specOf(pane, flown) {
  return pane.explores ? exploration(pane) : chain(pane, flown);
}

function chain(pane, flown) {
  const lines = [];
  for (let id = 0; id < flown; id += 1) {
    lines.push({ id, label: pane.nameOf(id), ink: id, colour: uavColour(id), solid: `filtered_db.${id}`, dashed: `true_db.${id}`, dots: `raw_db.${id}` });
  }
  const each = flown <= LINES ? LINES : flown <= OWN_BOX ? 1 : LINES;
  const boxes = [];
  for (let i = 0; i < lines.length; i += each) {
    const some = lines.slice(i, i + each);
    const title = flown <= LINES ? "" : some.length > 1 ? `${some[0].label} to ${some[some.length - 1].id}` : some[0].label;
    boxes.push({ title, unit: "dB", lines: some, scale: "loss", least: null, whole: false, times: 1 });
  }
  return boxes;
}

function exploration(pane) {
  const line = (/** @type {string} */ column, /** @type {string} */ label, /** @type {number} */ ink) => ({ id: -1, label, ink, colour: uavColour(ink), solid: column, dashed: null, dots: null });
  return [
    { title: "seen, of what can be reached (%)", unit: "%", lines: [line("coverage", "", 1)], scale: "coverage", least: /** @type {[number, number]} */ ([0, 100]), whole: false, times: 100 },
    { title: "hubs: nodes with a frontier left; robots that move", unit: "", lines: [line("hubs", "hubs", 0), line("moving", "moving", 2)], scale: "count", least: /** @type {[number, number]} */ ([0, pane.crew]), whole: true, times: 1 },
  ];
}
