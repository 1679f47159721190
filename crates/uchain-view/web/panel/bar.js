// @ts-check
// The bar on top: which scenario is flown, dark or light.

import { app } from "uchain/app.js";
import { key } from "uchain/panel/keys.js";

/** The scenarios that come along: `{name, description, mission, flies}`. @type {any[]} */
export let scenarios = [];

/** What a scenario is about, for the line above its map. @param {import("uchain/pane.js").Pane} pane */
export function about(pane) {
  const words = pane.scene.description ?? scenarios.find((one) => `${one.name}.toml` === pane.scene.label)?.description;
  return words ? `${words}; ` : "";
}

const menu = () => /** @type {HTMLSelectElement} */ (document.getElementById("scenario"));

/** An engine that is only asked for the texts of scenarios. @type {import("uchain/engine.js").Engine} */
let library;

/** Flies a scenario that comes along. @param {string} name @param {number} seed */
export async function fly(name, seed) {
  const { text } = library.do("text", { name });
  return app.open({ kind: "scenario", label: `${name}.toml`, text, seed, walls_csv: null, map_offset_m: [0, 0], inputs: [] });
}

/** Fills the menu from what the engine says about itself. @param {import("uchain/engine.js").Engine} engine */
export function list(engine) {
  library = engine;
  scenarios = engine.do("about").scenarios;
  for (const [explores, words] of /** @type {[boolean, string][]} */ ([[false, "Chains of UAVs"], [true, "Explorations"]])) {
    const group = document.createElement("optgroup");
    group.label = words;
    for (const one of scenarios.filter((one) => one.mission.includes("exploration") === explores)) {
      const option = new Option(one.flies ? one.name : `${one.name} (needs its map: open it)`, one.name);
      option.title = one.description;
      option.disabled = !one.flies;
      group.append(option);
    }
    if (group.children.length) menu().append(group);
  }
}

function chosen() {
  const name = menu().value;
  fly(name, 1)
    .then(() => app.play())
    .catch((fault) => app.fault(fault));
}

/** The menu says what is flown, also when it is a file. */
function name_it(pane) {
  if (pane !== app.panes[0]) return;
  const label = String(pane.scene.label ?? pane.scene.name);
  const name = label.replace(/\.toml$/, "");
  for (const old of [...menu().querySelectorAll("option.file")]) old.remove();
  if (!scenarios.some((one) => one.name === name && one.flies)) {
    const option = new Option(label, label, true, true);
    option.className = "file";
    menu().prepend(option);
  }
  menu().value = scenarios.some((one) => one.name === name && one.flies) ? name : label;
  document.title = `${pane.scene.title || name}: uchain`;
}

function theme(/** @type {string} */ kind) {
  document.documentElement.dataset.theme = kind;
  app.emit("theme", kind);
  app.redraw();
}

export function start() {
  menu().addEventListener("change", chosen);
  app.on("scene", name_it);
  const wanted = matchMedia("(prefers-color-scheme: dark)");
  theme(wanted.matches ? "dark" : "light");
  wanted.addEventListener("change", () => theme(wanted.matches ? "dark" : "light"));
  const swap = () => theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  document.getElementById("theme")?.addEventListener("click", swap);
  key(["d"], "d", "dark or light", swap);
}
