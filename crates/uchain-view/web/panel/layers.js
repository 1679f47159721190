// @ts-check
// What is shown on maps and plots: a list of boxes to tick.

import { app } from "uchain/app.js";
import { key } from "uchain/panel/keys.js";

/** What is shown now. @type {Record<string, boolean>} */
export const shown = { trails: true, beams: true, losses: true, overrides: true, raw: true, true: true, stars: true, graph: true, frontiers: true, targets: true };

const WORDS = {
  chain: { trails: "trails", beams: "time-of-flight beams", losses: "losses beside the links", overrides: "what overrides a UAV", true: "true losses in the plot", raw: "raw losses in the plot" },
  exploration: { trails: "trails", stars: "stars: what was seen", graph: "the graph", frontiers: "frontiers", targets: "targets" },
};

function list() {
  const box = /** @type {HTMLElement} */ (document.getElementById("layer-list"));
  const words = app.panes[0]?.explores ? WORDS.exploration : WORDS.chain;
  box.replaceChildren();
  for (const [name, text] of Object.entries(words)) {
    const line = document.createElement("label");
    const tick = document.createElement("input");
    tick.type = "checkbox";
    tick.checked = shown[name];
    tick.addEventListener("change", () => {
      shown[name] = tick.checked;
      app.emit("layers", name);
      app.redraw();
    });
    line.append(tick, ` ${text}`);
    box.append(line);
  }
}

export function start() {
  const button = /** @type {HTMLElement} */ (document.getElementById("layers"));
  const box = document.createElement("div");
  box.id = "layer-list";
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", "What is shown");
  box.hidden = true;
  button.after(box);
  const open = (/** @type {boolean} */ now) => {
    if (now) list();
    box.hidden = !now;
    button.setAttribute("aria-expanded", String(now));
    if (now) box.querySelector("input")?.focus();
  };
  button.addEventListener("click", () => open(box.hidden === true));
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    open(false);
    button.focus();
  });
  document.addEventListener("pointerdown", (event) => {
    const at = /** @type {Node} */ (event.target);
    if (!box.hidden && !box.contains(at) && at !== button) open(false);
  });
  app.on("scene", () => open(false));
  key(["v"], "v", "what is shown", () => open(box.hidden === true));
}
