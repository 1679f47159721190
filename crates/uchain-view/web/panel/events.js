// @ts-check
// The events of the flight as a list: the newest up to the cursor first; a click goes there. Also says them to screen readers.

import { app } from "uchain/app.js";
import { clock, countTo, happened, lookOf } from "uchain/panel/time/happened.js";

export { clock };

/** So many are listed at once: those around the cursor. */
const SHOWN = 120;

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
  if (!app.panes.length || place.hidden) return;
  const { events, version } = happened();
  const upTo = countTo(events, app.cursor);
  const from = Math.max(0, upTo - SHOWN);
  const state = `${version} ${from} ${upTo}`;
  if (state === listed) return;
  listed = state;
  const lines = events.slice(from, upTo).reverse().map(line);
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
  const { events } = happened();
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
    listed = "";
    app.redraw();
  });
  app.on("scene", () => {
    listed = "";
    said = 0;
  });
}
