// @ts-check
// What lasts: overrides, walls left out, lost links, launches that are armed or held, as bars in the UAV's colour.

import { app } from "uchain/app.js";
import { uavColour } from "uchain/draw/colours.js";
import { lookOf } from "uchain/panel/time/happened.js";

/** What begins, and what ends it. */
const PAIRS = [
  { begins: /^launch-(armed|held)$/, ends: /^(launch-disarmed|took-off)$/ },
  { begins: /^link-lost$/, ends: /^link-found$/ },
  { begins: /^override-begins$/, ends: /^override-ends$/ },
  { begins: /^wall-invalid$/, ends: /^wall-valid$/ },
  { begins: /^holds$/, ends: /^hold-ends$/ },
  { begins: /^keeps-clear$/, ends: /^keeps-clear-ends$/ },
];
/** Heights of a row and of a bar in it (pixels); bars of a row lie in so many lanes. */
const ROW_PX = 13;
const [BAR_PX, LANES] = [3, 4];

/** @typedef {{from: number, to: number, row: number, uav: number}} Span */

/** @type {Map<string, [number, boolean][]>} */
const parts = new Map();

/** Of which pairs a kind is the beginning (true) or the end (false). @param {string} kind */
function partsOf(kind) {
  let known = parts.get(kind);
  if (!known) {
    known = PAIRS.flatMap(({ begins, ends }, i) => /** @type {[number, boolean][]} */ (ends.test(kind) ? [[i, false]] : begins.test(kind) ? [[i, true]] : []));
    parts.set(kind, known);
  }
  return known;
}

/** What an override is called: the word in brackets. @param {string} text */
function wordOf(text) {
  return /\(([a-z-]+)\)/.exec(text)?.[1] ?? "";
}

/** What began and ended, in ticks; what has not ended yet goes on to `edge`. @param {any[]} events @param {number} edge @returns {Span[]} */
export function spansOf(events, edge) {
  const spans = [];
  /** @type {Map<string, Span>} */
  const open = new Map();
  for (const event of events) {
    const { kind, uav, tick, text, pane } = event;
    for (const [i, begins] of partsOf(kind)) {
      const name = `${i} ${pane} ${uav} ${kind.startsWith("override") ? wordOf(text) : ""}`;
      const begun = open.get(name);
      if (!begins && begun) {
        begun.to = tick;
        open.delete(name);
      } else if (begins && !begun) {
        const span = { from: tick, to: edge, row: lookOf(event).row, uav: uav ?? 0 };
        open.set(name, span);
        spans.push(span);
      }
    }
  }
  return spans;
}

/** @param {HTMLCanvasElement} canvas @param {Span[]} spans @param {number} width @param {number} rows */
export function drawBars(canvas, spans, width, rows) {
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(rows * ROW_PX * ratio);
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  context.scale(ratio, ratio);
  const perTick = width / Math.max(1, app.end);
  context.globalAlpha = 0.8;
  for (const { from, to, row, uav } of spans) {
    context.fillStyle = uavColour(uav);
    context.fillRect(from * perTick, row * ROW_PX + 1 + (uav % LANES) * BAR_PX, Math.max(1.5, (to - from) * perTick), BAR_PX);
  }
}
