// @ts-check
// The stage: a section for each flight, with its title, its map and its plot over time.

import { app } from "uchain/app.js";
import { MapView } from "uchain/draw/map/map.js";
import { PlotView } from "uchain/draw/plot/plot.js";
import { valuesAt } from "uchain/draw/plot/readout.js";
import { LINES } from "uchain/draw/plot/spec.js";
import { about } from "uchain/panel/bar.js";
import { clock } from "uchain/panel/events.js";
import { key } from "uchain/panel/keys.js";

/** What belongs to each pane, in the order of `app.panes`. @type {{section: HTMLElement, map: MapView, plot: PlotView}[]} */
export const views = [];

function part(/** @type {string} */ tag, /** @type {string} */ name) {
  const made = document.createElement(tag);
  made.className = name;
  return made;
}

function add() {
  const index = views.length;
  const section = part("section", "pane");
  section.dataset.pane = String(index);
  section.setAttribute("aria-label", `Flight ${index + 1}`);
  const head = document.createElement("header");
  head.append(document.createElement("h2"), part("span", "told"), part("span", "clock"));
  const mapBox = part("div", "map");
  const plotBox = part("div", "plot");
  section.append(head, mapBox, plotBox);
  document.getElementById("stage")?.append(section);
  const map = new MapView(mapBox, index);
  const plot = new PlotView(plotBox, index);
  const view = { section, map, plot };
  views.push(view);
  new ResizeObserver(() => arrange(view, app.panes[index])).observe(section);
}

/** Height of a pane's head (pixels), and least room around the map. */
const [HEAD_PX, AROUND_PX] = [36, 56];

/**
 * Where map and plot are: a plot below a wide map, beside a high one; the map gets no more height than it fills.
 * @param {{section: HTMLElement, plot: PlotView}} view @param {import("uchain/pane.js").Pane|undefined} pane
 */
function arrange({ section }, pane) {
  if (!pane) return;
  const [x0, y0, x1, y1] = pane.scene.map.bounds;
  const [wide, high] = [Math.max(1e-3, x1 - x0), Math.max(1e-3, y1 - y0)];
  const phone = matchMedia("(max-width: 760px)").matches;
  const width = section.clientWidth;
  const height = section.clientHeight - HEAD_PX;
  const filled = ((width - AROUND_PX) * high) / wide + 2 * AROUND_PX;
  if (phone) {
    const map = Math.round(Math.max(190, Math.min(filled, 0.46 * window.innerHeight)));
    section.style.gridTemplate = `"head" auto "map" ${map}px "plot" ${pane.explores ? 300 : 210}px / minmax(0, 1fr)`;
    return;
  }
  const many = pane.explores || pane.crew > LINES;
  const most = many ? 0.62 * height : 330;
  const plot = Math.max(Math.min(190, 0.45 * height), Math.min(most, Math.max(0.38 * height, height - filled)));
  const side = Math.round(Math.max(0.5 * width, Math.min(0.64 * width, ((height - AROUND_PX) * wide) / high + 2 * AROUND_PX)));
  const below = Math.min(width / wide, (height - plot) / high);
  const beside = Math.min(side / wide, height / high);
  const turned = width >= 820 && beside > 1.2 * below;
  section.style.gridTemplate = turned
    ? `"head head" auto "map plot" minmax(0, 1fr) / ${side}px minmax(0, 1fr)`
    : `"head" auto "map" minmax(0, 1fr) "plot" ${Math.round(plot)}px / minmax(0, 1fr)`;
  section.classList.toggle("turned", turned);
}

/** As many sections as flights. */
function fit() {
  while (views.length < app.panes.length) add();
  while (views.length > Math.max(1, app.panes.length)) views.pop()?.section.remove();
}

/** The line above the map: what flies, and what came of it. */
function tell(/** @type {import("uchain/pane.js").Pane} */ pane, /** @type {HTMLElement} */ section) {
  const [title, told, time] = /** @type {any} */ (section.querySelector("header")).children;
  title.textContent = pane.scene.title || pane.scene.name;
  const over = pane.stopped && app.cursor >= pane.tick;
  const words = over ? pane.verdict : `${about(pane)}${pane.scene.recorded ? "recorded" : `seed ${pane.scene.seed}`}`;
  if (told.textContent !== words) told.textContent = words;
  const shown = `${clock(pane.frame ? pane.frame.time_s : 0)}${pane.frame && !pane.frame.exact ? " …" : ""}`;
  if (time.textContent !== shown) time.textContent = shown;
}

/** Says what the plots show at the cursor to those who do not see them. */
function read() {
  const words = app.panes.map((pane, i) => {
    const name = app.panes.length > 1 ? `${"AB"[i]}: ` : "";
    return name + views[i].plot.boxes.map((box) => valuesAt(pane, box, app.time_s)).join("\n");
  });
  const live = document.getElementById("live");
  if (live) live.textContent = words.join(". ").replaceAll("\n", ". ");
}

export function start() {
  fit();
  app.on("panes", fit);
  app.on("scene", (pane) => {
    fit();
    const view = views[app.panes.indexOf(pane)];
    view.map.open(pane);
    view.plot.open(pane);
    arrange(view, pane);
    app.redraw();
  });
  app.on("draw", () => {
    app.panes.forEach((pane, i) => {
      tell(pane, views[i].section);
      views[i].map.draw();
      views[i].plot.draw();
    });
  });
  const each = (/** @type {(map: MapView) => void} */ run) => () => {
    for (const { map } of views) run(map);
    app.redraw();
  };
  key(["+", "="], "+", "zoom in", each((map) => map.view.zoom(1.25)));
  key(["-"], "-", "zoom out", each((map) => map.view.zoom(0.8)));
  key(["r"], "r", "say the values at the cursor", read);
  key(["w"], "w", "the whole map", each((map) => map.view.fit()));
}
