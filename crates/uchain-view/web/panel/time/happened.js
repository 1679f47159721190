// @ts-check
// What happened, in all flights on the page, in the order of time; and how it looks and reads.

import { app } from "uchain/app.js";

/** Rows of the time line, top to bottom: which kinds of events. */
export const ROWS = [
  { words: "launches", kinds: /took-off|launch|failed|purpose|^over$|^level$/ },
  { words: "links", kinds: /link/ },
  { words: "contacts", kinds: /contact|level-pass/ },
  { words: "overrides", kinds: /./ },
];
/** The row of an event's mark, and its sign. @param {{kind: string}} event */
export function lookOf(event) {
  const row = ROWS.findIndex(({ kinds }) => kinds.test(event.kind));
  if (/failed|link-lost/.test(event.kind)) return { row, sign: "✕" };
  if (/^launch-/.test(event.kind)) return { row, sign: "△" };
  return { row, sign: ["▲", "●", "◆", "■"][row] };
}

/** How many of `events` are not after `tick`. @param {any[]} events @param {number} tick */
export function countTo(events, tick) {
  let low = 0;
  let high = events.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (events[middle].tick <= tick) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** "1:23.4" or "23.4 s". @param {number} time_s */
export function clock(time_s) {
  if (time_s < 60) return `${time_s.toFixed(1)} s`;
  const minutes = Math.floor(time_s / 60);
  return `${minutes}:${(time_s - 60 * minutes).toFixed(1).padStart(4, "0")}`;
}

let known = { events: /** @type {any[]} */ ([]), version: 0, of: /** @type {any[]} */ ([]) };

/**
 * The events of all flights, each with the number of its `pane`; of two flights their texts say which.
 * `version` counts up whenever they are others than before.
 */
export function happened() {
  const of = app.panes.flatMap((pane) => [pane, pane.version, pane.events, pane.events.length]);
  if (of.length === known.of.length && of.every((one, i) => one === known.of[i])) return known;
  const events = app.panes.flatMap(({ events }, i) => (app.panes.length > 1 ? events.map((event) => ({ ...event, pane: i, text: `${"AB"[i]}, ${event.text}` })) : events));
  if (app.panes.length > 1) events.sort((a, b) => a.tick - b.tick);
  known = { events, version: known.version + 1, of };
  return known;
}
