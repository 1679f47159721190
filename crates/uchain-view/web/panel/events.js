// @ts-check
// The events of the flight as a list: the newest up to the cursor first; a click goes there. Also says them to screen readers.

import { app } from "uchain/app.js";
import { lookOf } from "uchain/panel/time/marks.js";

/** So many are listed at once: those around the cursor. */
const SHOWN = 120;

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

let listed = "";
let said = 0;

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
  words.textContent = event.text;
  button.append(time, mark, words);
  button.addEventListener("click", () => {
    app.pause();
    app.seek(event.tick);
    if (event.uav !== null) app.selected = event.uav;
  });
  return button;
}

function show() {
  const place = /** @type {HTMLElement} */ (document.getElementById("events"));
  const pane = app.panes[0];
  if (!pane || place.hidden) return;
  const upTo = countTo(pane.events, app.cursor);
  const from = Math.max(0, upTo - SHOWN);
  const state = `${pane.version} ${from} ${upTo} ${pane.scene.label} ${pane.events[upTo - 1]?.text}`;
  if (state === listed) return;
  listed = state;
  const lines = pane.events.slice(from, upTo).reverse().map(line);
  if (!lines.length) {
    const none = document.createElement("p");
    none.className = "none";
    none.textContent = "Nothing has happened yet: launches, lost links, contacts and what overrides a UAV are listed here.";
    lines.push(/** @type {any} */ (none));
  }
  place.replaceChildren(...lines);
}

/** Says what has just happened, while it is played slowly enough to be heard. */
function speak() {
  const pane = app.panes[0];
  if (!pane) return;
  const upTo = countTo(pane.events, app.cursor);
  const fresh = pane.events.slice(said, upTo);
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
    listed = "";
    app.redraw();
  });
  app.on("scene", () => {
    listed = "";
    said = 0;
  });
}
