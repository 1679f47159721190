// @ts-check
// The events of the flight as a list: the newest up to the cursor first; a click goes there. Also says them to screen readers.

import { app } from "uchain/app.js";
import { show as showTab } from "uchain/panel/tabs.js";
import { clock, countTo, hidden, listed, lookOf, rows } from "uchain/panel/time/happened.js";

export { clock };

/** So many are listed at once: those around the cursor. */
const SHOWN = 80;

let made = "";
let said = 0;
/** Where the lines are, below the buttons that choose them. */
const list = document.createElement("div");
/** The lines that are shown, by their events. @type {Map<any, HTMLElement>} */
let lines = new Map();

/** Who it is about; what happened; the numbers and reasons. */
const PARTS = /^((?:[AB], )?(?:UAV|robot) \d+(?:, the head)?: )?(.*?)((?::|,| \().*)?$/s;

const bar = document.createElement("div");

/** Which rows are listed: a button for each. */
function filter() {
  bar.replaceChildren();
  for (const { words } of rows()) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words;
    button.setAttribute("aria-pressed", String(!hidden.has(words)));
    button.addEventListener("click", () => {
      if (!hidden.delete(words)) hidden.add(words);
      button.setAttribute("aria-pressed", String(!hidden.has(words)));
      app.redraw();
    });
    bar.append(button);
  }
}

function line(/** @type {any} */ event) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = `event ${event.gravity}`;
  const time = document.createElement("time");
  time.textContent = clock(event.time_s);
  const mark = document.createElement("i");
  mark.textContent = lookOf(event).sign;
  mark.setAttribute("aria-hidden", "true");
  const words = document.createElement("span");
  const [, who, what, more] = /** @type {RegExpMatchArray} */ (PARTS.exec(event.text));
  const details = document.createElement("small");
  details.textContent = more;
  words.append(`${who ?? ""}${what}`, details);
  button.append(time, mark, words);
  button.addEventListener("click", () => {
    app.pause();
    app.seek(event.tick);
    if (event.uav === null) return;
    app.selected = event.uav;
    // Who asks why goes there; who reads the list stays in it.
    showTab("events");
    button.focus({ preventScroll: true });
  });
  return button;
}

function show() {
  const place = /** @type {HTMLElement} */ (document.getElementById("events"));
  if (!app.panes.length || place.hidden) return;
  const { events, state: version } = listed();
  const upTo = countTo(events, app.cursor);
  const from = Math.max(0, upTo - SHOWN);
  const state = `${version} ${from} ${upTo}`;
  if (state === made) return;
  made = state;
  const before = lines;
  const focused = document.activeElement;
  lines = new Map(events.slice(from, upTo).reverse().map((event) => [event, before.get(event) ?? line(event)]));
  list.replaceChildren(...(lines.size ? lines.values() : [nothing()]));
  // A line that was moved has lost the focus.
  if (focused instanceof HTMLElement && focused !== document.activeElement && list.contains(focused)) focused.focus({ preventScroll: true });
}

function nothing() {
  const none = document.createElement("p");
  none.className = "none";
  none.textContent = "Nothing has happened yet: launches, lost links, contacts and what overrides a UAV are listed here.";
  return none;
}

/** Says what has just happened, while it is played slowly enough to be heard. */
function speak() {
  const { events } = listed();
  const upTo = countTo(events, app.cursor);
  const fresh = events.slice(said, upTo);
  said = upTo;
  if (!app.playing || app.rate > 10 || fresh.length === 0) return;
  const live = /** @type {HTMLElement} */ (document.getElementById("live"));
  live.textContent = fresh.slice(-3).map((event) => event.text).join(". ");
}

export function start() {
  app.on("draw", () => {
    show();
    speak();
  });
  app.on("tab", () => {
    made = "";
    app.redraw();
  });
  bar.className = "filters";
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", "Which events are listed");
  document.getElementById("events")?.append(bar, list);
  app.on("scene", () => {
    filter();
    made = "";
    said = 0;
  });
}
