// @ts-check
// The stage: a section for each flight, with its title, its map and its plot over time.

import { app } from "uchain/app.js";
import { MapView } from "uchain/draw/map.js";
import { PlotView } from "uchain/draw/plot/plot.js";
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
  views.push({ section, map, plot });
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
  const words = pane.stopped && app.cursor >= pane.tick ? pane.stopped.words : pane.scene.recorded ? "recorded" : `seed ${pane.scene.seed}`;
  if (told.textContent !== words) told.textContent = words;
  const shown = `${clock(pane.frame ? pane.frame.time_s : 0)}${pane.frame && !pane.frame.exact ? " …" : ""}`;
  if (time.textContent !== shown) time.textContent = shown;
}

export function start() {
  fit();
  app.on("panes", fit);
  app.on("scene", (pane) => {
    fit();
    const view = views[app.panes.indexOf(pane)];
    view.map.open(pane);
    view.plot.open(pane);
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
  key(["w"], "w", "the whole map", each((map) => map.view.fit()));
}
