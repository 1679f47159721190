// @ts-check
// What happened, in all flights on the page, in the order of time; and how it looks and reads.

import { app } from "uchain/app.js";

/** Rows of the time line, top to bottom: which kinds of events, and their sign. */
const CHAIN = [
  { words: "launches", kinds: /took-off|launch|failed|^over$/, sign: "▲" },
  { words: "links", kinds: /link/, sign: "●" },
  { words: "contacts", kinds: /contact/, sign: "◆" },
  { words: "overrides", kinds: /override/, sign: "■" },
  { words: "walls", kinds: /./, sign: "▪" },
];
const EXPLORATION = [
  { words: "purposes", kinds: /purpose|^over$/, sign: "▲" },
  { words: "contacts", kinds: /contact|level-pass/, sign: "◆" },
  { words: "holds, levels", kinds: /./, sign: "■" },
];

/** Words of rows that neither the list nor the keys stop at. @type {Set<string>} */
export const hidden = new Set(["walls"]);

/** The rows of what is flown. */
export function rows() {
  return app.panes[0]?.explores ? EXPLORATION : CHAIN;
}

/** Kinds are few and events many: each kind is looked at once. @type {Map<string, {row: number, sign: string}>} */
const looks = new Map();

/** The row of an event, and its sign. @param {{kind: string}} event */
export function lookOf({ kind }) {
  const all = rows();
  const name = `${kind} ${all.length}`;
  const known = looks.get(name);
  if (known) return known;
  const row = Math.max(0, all.findIndex(({ kinds }) => kinds.test(kind)));
  const sign = /failed|link-lost/.test(kind) ? "✕" : kind.startsWith("launch-") ? "△" : all[row].sign;
  const look = { row, sign };
  looks.set(name, look);
  return look;
}

/** How much an event matters among others beside it. @param {{kind: string, gravity: string}} event */
export function weightOf({ kind, gravity }) {
  const grave = { error: 4, warning: 3 }[gravity] ?? 0;
  return grave || (/took-off|override-begins/.test(kind) ? 2 : 1);
}

/** The events that the list and the keys stop at. */
export function listed() {
  const { events, version } = happened();
  const state = `${version} ${[...hidden]}`;
  if (state !== kept.state) {
    const all = rows();
    kept = { state, events: events.filter((event) => !hidden.has(all[lookOf(event).row].words)) };
  }
  return kept;
}

let kept = { state: "", events: /** @type {any[]} */ ([]) };

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
