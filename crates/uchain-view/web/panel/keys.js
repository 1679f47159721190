// @ts-check
// Keys: one list of them all, which `?` opens.

import { app } from "uchain/app.js";

/** @type {{keys: string[], shown: string, words: string, mode: string|null, run: (event: KeyboardEvent) => void}[]} */
const ALL = [];

/**
 * Adds a key. `keys` are values of `KeyboardEvent.key`; `shown` is how the list names them; `mode` limits it to "watch" or "fly".
 * @param {string[]} keys @param {string} shown @param {string} words @param {(event: KeyboardEvent) => void} run @param {string|null} [mode]
 */
export function key(keys, shown, words, run, mode = null) {
  ALL.push({ keys, shown, words, mode, run });
}

/** Keys that a slider uses itself. */
const SLIDER = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"];

/** True while a key is meant for what has the focus: text, a menu, or a control that uses that key itself. */
function taken(/** @type {KeyboardEvent} */ event) {
  const at = /** @type {HTMLElement} */ (event.target);
  if (at.isContentEditable || ["TEXTAREA", "SELECT"].includes(at.tagName) || at.closest("dialog")) return true;
  const presses = event.key === " " || event.key === "Enter";
  if (at instanceof HTMLInputElement) {
    if (at.type === "range") return SLIDER.includes(event.key);
    return at.type === "checkbox" || at.type === "radio" ? presses : true;
  }
  return (at.tagName === "BUTTON" || at.tagName === "SUMMARY") && presses;
}

/** The keys of a mode as a table with its title. @param {string} title @param {string|null} mode */
function table(title, mode) {
  const part = document.createElement("section");
  const head = document.createElement("h3");
  head.textContent = title;
  const table = document.createElement("table");
  for (const { shown, words } of ALL.filter((one) => one.mode === mode)) {
    const row = table.insertRow();
    const cell = row.insertCell();
    for (const name of shown.split(" ")) {
      const cap = document.createElement(name === "…" ? "span" : "kbd");
      cap.textContent = name.length === 1 ? name.toUpperCase() : name;
      cell.append(cap, " ");
    }
    row.insertCell().textContent = words;
  }
  part.append(head, table);
  return part;
}

function list() {
  const dialog = document.createElement("dialog");
  dialog.className = "keys";
  dialog.setAttribute("aria-label", "List of keys");
  const columns = document.createElement("div");
  columns.append(table("Watching", "watch"), table("Flying by hand", "fly"), table("Always", null));
  const close = document.createElement("button");
  close.type = "button";
  close.className = "main";
  close.textContent = "Close";
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  dialog.append(columns, close);
  document.body.append(dialog);
  dialog.showModal();
}

export function start() {
  document.getElementById("keys")?.addEventListener("click", list);
  key(["?"], "?", "this list", list);
  // A button that was pressed with the pointer does not keep the keys.
  document.addEventListener("click", (event) => {
    const button = /** @type {HTMLElement} */ (event.target).closest?.("button");
    if (event.detail > 0 && button && !button.closest("dialog, [role=tablist]")) button.blur();
  });
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || taken(event)) return;
    const found = ALL.find((one) => one.keys.includes(event.key) && (one.mode === null || one.mode === app.mode));
    if (!found) return;
    event.preventDefault();
    found.run(event);
  });
}
