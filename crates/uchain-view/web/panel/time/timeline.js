// @ts-check
// Time: play, pause, scrub, rate, step; what happened as marks with words.

import { app, RATES } from "uchain/app.js";
import { key } from "uchain/panel/keys.js";
import { clock, countTo, listed } from "uchain/panel/time/happened.js";
import { Marks } from "uchain/panel/time/marks.js";

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

function make(/** @type {string} */ tag, /** @type {string} */ name) {
  const made = document.createElement(tag);
  made.className = name;
  return made;
}

const toggle = () => (app.playing ? app.pause() : app.play());

/** The next rate of the ladder, up or down. @param {number} by */
function faster(by) {
  const i = RATES.findIndex((rate) => rate >= app.rate - 1e-9);
  app.rate = RATES[Math.max(0, Math.min(RATES.length - 1, i + by))];
}

/** To the next or the last event, and says it. @param {number} by */
function jump(by) {
  const { events } = listed();
  const upTo = countTo(events, app.cursor);
  const next = by > 0 ? events[upTo] : events.slice(0, upTo).findLast((event) => event.tick < app.cursor);
  if (!next) return;
  app.pause();
  app.seek(next.tick);
  if (next.uav !== null) app.selected = next.uav;
  const live = /** @type {HTMLElement} */ (document.getElementById("live"));
  live.textContent = `${clock(next.time_s)}: ${next.text}`;
}

function controls() {
  const row = make("div", "controls");
  at.play = button("play", "▶", "Play (Space)", toggle);
  at.play.classList.add("main");
  const first = button("to-start", "❘◂", "To the beginning (Home)", () => app.seek(0));
  const back = button("step-back", "◂", "One tick back (comma)", () => app.step(-1));
  const on = button("step-on", "▸", "One tick on (full stop)", () => app.step(1));
  const last = button("to-end", "▸❘", "To the end (End)", () => app.seek(app.end));
  at.clock = document.createElement("output");
  at.clock.id = "clock";
  at.now = make("strong", "");
  at.whole = make("small", "");
  at.clock.append(at.now, at.whole);
  at.clock.setAttribute("aria-live", "off");
  const slower = button("slower", "−", "Slower ([)", () => faster(-1));
  const quicker = button("faster", "+", "Faster (])", () => faster(1));
  const rate = document.createElement("select");
  rate.id = "rate";
  rate.setAttribute("aria-label", "Rate, times real time");
  for (const one of RATES) rate.append(new Option(`${one.toLocaleString("en")} ×`, String(one)));
  rate.addEventListener("change", () => (app.rate = Number(rate.value)));
  at.rate = rate;
  const speed = make("div", "speed");
  speed.append(slower, rate, quicker);
  row.append(first, back, at.play, on, last, at.clock, speed);
  return row;
}

function track() {
  const track = make("div", "track");
  const tip = make("div", "tip");
  tip.hidden = true;
  at.marks = track;
  marks = new Marks(track, tip);
  const bar = make("div", "bar");
  at.flown = make("div", "flown");
  const slider = document.createElement("input");
  slider.type = "range";
  slider.id = "scrub";
  slider.min = "0";
  slider.step = "1";
  slider.setAttribute("aria-label", "Time");
  slider.addEventListener("input", () => app.seek(Number(slider.value)));
  at.slider = slider;
  bar.append(at.flown, slider);
  track.append(bar, tip);
  return track;
}

/** @type {Marks} */
let marks;

function write(/** @type {HTMLElement} */ place, /** @type {string} */ text) {
  if (place.textContent !== text) place.textContent = text;
}

function show() {
  const slider = /** @type {HTMLInputElement} */ (at.slider);
  const end = Math.max(1, app.end);
  if (slider.max !== String(end)) slider.max = String(end);
  slider.value = String(app.cursor);
  slider.setAttribute("aria-valuetext", clock(app.time_s));
  at.flown.style.width = `${(100 * Math.min(app.edge, end)) / end}%`;
  write(at.now, clock(app.time_s));
  write(at.whole, ` of ${clock(end * app.tick_s)}${app.waits ? ", flying there" : ""}`);
  marks.show();
}

export function start() {
  const place = /** @type {HTMLElement} */ (document.getElementById("timeline"));
  place.append(controls(), track());
  app.on("playing", () => {
    at.play.textContent = app.playing ? "❚❚" : "▶";
    at.play.title = app.playing ? "Pause (Space)" : "Play (Space)";
    at.play.setAttribute("aria-label", at.play.title);
  });
  app.on("rate", (rate) => (/** @type {HTMLSelectElement} */ (at.rate).value = String(rate)));
  app.on("draw", show);
  app.rate = 5;
  key([" "], "Space", "play or pause", toggle, "watch");
  key([",", "<"], ",", "one tick back", () => app.step(-1));
  key([".", ">"], ".", "one tick on", () => app.step(1));
  key(["ArrowLeft"], "←", "one second back", () => app.step(-Math.round(1 / app.tick_s)), "watch");
  key(["ArrowRight"], "→", "one second on", () => app.step(Math.round(1 / app.tick_s)), "watch");
  key(["["], "[", "slower", () => faster(-1));
  key(["]"], "]", "faster", () => faster(1));
  key(["Home"], "Home", "to the beginning", () => app.seek(0), "watch");
  key(["End"], "End", "to the end", () => app.seek(app.end), "watch");
  key(["n"], "n", "to the next event", () => jump(1), "watch");
  key(["p"], "p", "to the event before", () => jump(-1), "watch");
  key([..."0123456789"], "0 … 9", "select a UAV", (event) => (app.selected = Number(event.key)));
  const next = (/** @type {number} */ by) => () => {
    const crew = app.panes[0]?.crew ?? 1;
    app.selected = app.selected === null ? (by > 0 ? 0 : crew - 1) : (app.selected + by + crew) % crew;
  };
  key(["u"], "u", "select the next UAV", next(1));
  key(["U"], "Shift u", "select the UAV before", next(-1));
  key(["Escape"], "Esc", "select none", () => (app.selected = null));
}
