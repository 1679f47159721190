// @ts-check
// What happened, as marks on the time line: rows by kind, near ones together; words on hover and focus, a press goes there.

import { app } from "uchain/app.js";
import { uavInk } from "uchain/draw/colours.js";
import { clock, happened, lookOf, rows, weightOf } from "uchain/panel/time/happened.js";
import { drawBars, spansOf } from "uchain/panel/time/spans.js";

/** Kinds that only end what another began: a bar says so, and no mark. */
const ENDS = /-ends$|^wall-valid$|^link-found$|^launch-disarmed$/;

/** Events nearer than this are one mark (pixels). */
const NEAR_PX = 13;
/** Marks are made again at most this often (ms). */
const EVERY_MS = 500;
/** So many events of a mark are told in words. */
const TOLD = 6;

/** @typedef {{x: number, row: number, events: any[]}} Mark */

export class Marks {
  #made = "";
  #width = 0;
  #made_ms = 0;

  /** @param {HTMLElement} track @param {HTMLElement} tip */
  constructor(track, tip) {
    this.tip = tip;
    this.names = document.createElement("div");
    this.names.className = "rows";
    this.box = document.createElement("div");
    this.box.className = "marks";
    this.bars = document.createElement("canvas");
    this.bars.className = "bars";
    this.bars.setAttribute("aria-hidden", "true");
    this.box.setAttribute("role", "toolbar");
    this.box.setAttribute("aria-label", "What happened; arrows go from mark to mark");
    track.append(this.names, this.bars, this.box);
    // Asked for once: to ask in every frame makes the browser lay out the page in every frame.
    new ResizeObserver(([entry]) => (this.#width = Math.round(entry.contentRect.width))).observe(this.box);
    this.box.addEventListener("keydown", (event) => this.#walk(event));
    this.box.addEventListener("focusin", (event) => this.#tell(event.target));
    this.box.addEventListener("focusout", () => (tip.hidden = true));
    this.box.addEventListener("pointerover", (event) => this.#tell(event.target));
    this.box.addEventListener("pointerout", () => (tip.hidden = true));
  }

  /** Makes the marks, if something has changed and it is time for it. */
  show() {
    const pane = app.panes[0];
    const width = this.#width;
    if (!pane || width < 20) return;
    const { events, version } = happened();
    const theme = document.documentElement.dataset.theme;
    const state = `${version} ${events.length} ${width} ${app.end} ${theme}`;
    const now = performance.now();
    if (state === this.#made || (now < this.#made_ms + EVERY_MS && !pane.stopped)) return;
    if (this.box.contains(document.activeElement) && !pane.stopped) return;
    [this.#made, this.#made_ms] = [state, now];
    this.#rows();
    drawBars(this.bars, spansOf(events, app.edge), width, rows().length);
    this.box.replaceChildren(...gather(events, width).map((mark, i) => this.#button(mark, i === 0)));
  }

  #rows() {
    const words = rows().map((row) => row.words);
    if (this.names.textContent === words.join("")) return;
    this.names.parentElement?.style.setProperty("--rows", String(words.length));
    this.names.replaceChildren(
      ...words.map((text) => {
        const name = document.createElement("span");
        name.textContent = text;
        return name;
      }),
    );
  }

  /** @param {Mark} mark @param {boolean} first */
  #button(mark, first) {
    const button = document.createElement("button");
    button.type = "button";
    const shown = mark.events.reduce((most, event) => (weightOf(event) > weightOf(most) ? event : most));
    button.className = `mark ${shown.gravity}`;
    button.style.left = `${mark.x}px`;
    button.style.top = `${(mark.row * 100) / rows().length}%`;
    button.textContent = lookOf(shown).sign;
    if (weightOf(shown) < 3 && shown.uav !== null) button.style.color = uavInk(shown.uav);
    button.tabIndex = first ? 0 : -1;
    button.setAttribute("aria-label", wordsOf(mark).replaceAll("\n", ". "));
    button.addEventListener("click", () => {
      app.pause();
      app.seek(shown.tick);
      if (shown.uav !== null) app.selected = shown.uav;
    });
    this.#of.set(button, mark);
    return button;
  }

  /** @type {WeakMap<Element, Mark>} */
  #of = new WeakMap();

  #tell(/** @type {any} */ button) {
    const mark = this.#of.get(button);
    if (!mark) return;
    this.tip.textContent = wordsOf(mark);
    this.tip.hidden = false;
    const left = this.box.offsetLeft + mark.x;
    const room = /** @type {HTMLElement} */ (this.tip.offsetParent ?? this.box).clientWidth;
    this.tip.style.left = `${Math.max(4, Math.min(left - this.tip.offsetWidth / 2, room - this.tip.offsetWidth - 4))}px`;
  }

  #walk(/** @type {KeyboardEvent} */ event) {
    const all = /** @type {HTMLElement[]} */ ([...this.box.children]);
    const at = all.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: all.length - 1 }[event.key];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const next = all[Math.max(0, Math.min(all.length - 1, to))];
    all[at].tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
  }
}

/** What a mark says. @param {Mark} mark */
function wordsOf(mark) {
  const lines = mark.events.slice(0, TOLD).map((event) => `${clock(event.time_s)}  ${event.text}`);
  if (mark.events.length > TOLD) lines.push(`and ${mark.events.length - TOLD} more`);
  return lines.join("\n");
}

/** Events that are near each other in a row become one mark; all in the order of time. @param {any[]} events @param {number} width */
function gather(events, width) {
  /** @type {Mark[]} */
  const marks = [];
  /** @type {(Mark|undefined)[]} */
  const last = [];
  for (const event of events) {
    if (ENDS.test(event.kind)) continue;
    const x = (event.tick / Math.max(1, app.end)) * width;
    const { row } = lookOf(event);
    const open = last[row];
    if (open && x - open.x < NEAR_PX) open.events.push(event);
    else marks.push((last[row] = { x, row, events: [event] }));
  }
  return marks;
}
