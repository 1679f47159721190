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

/** True while a key is meant for what has the focus: text, a menu, or a control that uses that key itself. */
function taken(/** @type {KeyboardEvent} */ event) {
  const at = /** @type {HTMLElement} */ (event.target);
  if (at.isContentEditable || ["TEXTAREA", "SELECT"].includes(at.tagName)) return true;
  if (at.tagName === "INPUT") return true;
  if (at.closest("dialog")) return true;
  return at.tagName === "BUTTON" && (event.key === " " || event.key === "Enter");
}

function list() {
  const dialog = document.createElement("dialog");
  dialog.className = "keys";
  dialog.setAttribute("aria-label", "List of keys");
  const title = document.createElement("h2");
  title.textContent = "Keys";
  const table = document.createElement("table");
  for (const { shown, words, mode } of ALL) {
    const row = table.insertRow();
    for (const name of shown.split(" ")) {
      const cap = document.createElement("kbd");
      cap.textContent = name;
      row.append(row.cells[0] ?? row.insertCell());
      row.cells[0].append(cap, " ");
    }
    row.insertCell().textContent = mode ? `${words} (${mode === "fly" ? "while flying" : "while watching"})` : words;
  }
  const close = document.createElement("button");
  close.type = "button";
  close.className = "main";
  close.textContent = "Close";
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  dialog.append(title, table, close);
  document.body.append(dialog);
  dialog.showModal();
}

export function start() {
  document.getElementById("keys")?.addEventListener("click", list);
  key(["?"], "?", "this list", list);
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || taken(event)) return;
    const found = ALL.find((one) => one.keys.includes(event.key) && (one.mode === null || one.mode === app.mode));
    if (!found) return;
    event.preventDefault();
    found.run(event);
  });
}
