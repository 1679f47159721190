// @ts-check
// Time: play, pause, scrub, rate, step; what happened as marks with words.

import { app, RATES } from "uchain/app.js";
import { clock } from "uchain/panel/events.js";
import { key } from "uchain/panel/keys.js";

/** @type {Record<string, HTMLElement>} */
const at = {};

function button(/** @type {string} */ id, /** @type {string} */ text, /** @type {string} */ words, /** @type {() => void} */ run) {
  const made = document.createElement("button");
  made.type = "button";
  made.id = id;
  made.textContent = text;
  made.title = words;
  made.setAttribute("aria-label", words);
  made.addEventListener("click", run);
  return made;
}

const toggle = () => (app.playing ? app.pause() : app.play());

/** The next rate of the ladder, up or down. @param {number} by */
function faster(by) {
  const i = RATES.findIndex((rate) => rate >= app.rate - 1e-9);
  app.rate = RATES[Math.max(0, Math.min(RATES.length - 1, i + by))];
}

function controls() {
  const row = document.createElement("div");
  row.className = "controls";
  at.play = button("play", "▶", "Play (Space)", toggle);
  at.play.classList.add("main");
  const back = button("step-back", "❘◀", "One tick back (comma)", () => app.step(-1));
  const on = button("step-on", "▶❘", "One tick on (full stop)", () => app.step(1));
  at.clock = document.createElement("output");
  at.clock.id = "clock";
  const slower = button("slower", "−", "Slower ([)", () => faster(-1));
  const quicker = button("faster", "+", "Faster (])", () => faster(1));
  const rate = document.createElement("select");
  rate.id = "rate";
  rate.setAttribute("aria-label", "Rate, times real time");
  for (const one of RATES) rate.append(new Option(`${one.toLocaleString("en")} ×`, String(one)));
  rate.addEventListener("change", () => (app.rate = Number(rate.value)));
  at.rate = rate;
  row.append(back, at.play, on, at.clock, slower, rate, quicker);
  return row;
}

function track() {
  const track = document.createElement("div");
  track.className = "track";
  const slider = document.createElement("input");
  slider.type = "range";
  slider.id = "scrub";
  slider.min = "0";
  slider.step = "1";
  slider.setAttribute("aria-label", "Time");
  slider.addEventListener("input", () => app.seek(Number(slider.value)));
  at.slider = slider;
  track.append(slider);
  return track;
}

function show() {
  const slider = /** @type {HTMLInputElement} */ (at.slider);
  slider.max = String(app.end);
  slider.value = String(app.cursor);
  slider.setAttribute("aria-valuetext", clock(app.time_s));
  at.clock.textContent = `${clock(app.time_s)} of ${clock(app.end * app.tick_s)}`;
}

export function start() {
  const place = /** @type {HTMLElement} */ (document.getElementById("timeline"));
  place.append(controls(), track());
  const playing = () => {
    at.play.textContent = app.playing ? "❚❚" : "▶";
    at.play.setAttribute("aria-label", app.playing ? "Pause (Space)" : "Play (Space)");
  };
  app.on("playing", playing);
  app.on("rate", (rate) => (/** @type {HTMLSelectElement} */ (at.rate).value = String(rate)));
  app.on("draw", show);
  app.rate = 5;
  key([" "], "Space", "play or pause", toggle, "watch");
  key([","], ",", "one tick back", () => app.step(-1));
  key(["."], ".", "one tick on", () => app.step(1));
  key(["["], "[", "slower", () => faster(-1));
  key(["]"], "]", "faster", () => faster(1));
  key(["Home"], "Home", "to the beginning", () => app.seek(0));
  key(["End"], "End", "to the end", () => app.seek(app.end));
  key([..."0123456789"], "0 … 9", "select a UAV", (event) => (app.selected = Number(event.key)));
  key(["Escape"], "Esc", "select none", () => (app.selected = null));
}
