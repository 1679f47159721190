// @ts-check
// The tabs beside the map: events, why, edit.

import { app } from "uchain/app.js";

const NAMES = ["events", "why", "edit"];

/** Shows one of "events", "why", "edit". @param {string} name */
export function show(name) {
  for (const one of NAMES) {
    const tab = /** @type {HTMLElement} */ (document.getElementById(`tab-${one}`));
    tab.setAttribute("aria-selected", String(one === name));
    tab.tabIndex = one === name ? 0 : -1;
    /** @type {HTMLElement} */ (document.getElementById(one)).hidden = one !== name;
  }
  app.emit("tab", name);
}

export function start() {
  for (const [i, name] of NAMES.entries()) {
    const tab = /** @type {HTMLElement} */ (document.getElementById(`tab-${name}`));
    tab.addEventListener("click", () => show(name));
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const next = NAMES[(i + by + NAMES.length) % NAMES.length];
      show(next);
      document.getElementById(`tab-${next}`)?.focus();
    });
  }
  show("events");
}
