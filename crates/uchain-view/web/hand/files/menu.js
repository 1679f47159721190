// A small menu that opens below a button of the bar.

import { element } from "uchain/hand/element.js";

let open = null;

/** Makes a button open a menu. @param {HTMLElement} button @param {() => {words: string, more?: string, run: () => any, off?: string|null}[]} entries @param {(fault: any) => void} failed */
export function menu(button, entries, failed) {
  button.setAttribute("aria-haspopup", "menu");
  button.setAttribute("aria-expanded", "false");
  button.addEventListener("click", () => (open?.button === button ? close() : show(button, entries(), failed)));
}

function show(button, entries, failed) {
  close();
  const items = entries.map(({ words, more, run, off }) => element(
    "button",
    { type: "button", role: "menuitem", "aria-disabled": String(Boolean(off)), onclick: () => choose(off, run, failed) },
    element("strong", {}, words), (off || more) && element("span", {}, off || more),
  ));
  const list = element("div", { className: "hand-menu", role: "menu", "aria-label": button.textContent, onkeydown: (event) => moved(event, items) }, ...items);
  document.body.append(list);
  const at = button.getBoundingClientRect();
  list.style.top = `${at.bottom + 4}px`;
  list.style.left = `${Math.max(6, Math.min(at.left, innerWidth - list.offsetWidth - 6))}px`;
  list.style.maxHeight = `${Math.max(120, innerHeight - at.bottom - 12)}px`;
  button.setAttribute("aria-expanded", "true");
  open = { button, list };
  items[0]?.focus();
  document.addEventListener("pointerdown", outside, { capture: true });
}

function close() {
  if (!open) return;
  document.removeEventListener("pointerdown", outside, { capture: true });
  open.list.remove();
  open.button.setAttribute("aria-expanded", "false");
  if (document.activeElement === document.body) open.button.focus({ preventScroll: true });
  open = null;
}

function outside(event) {
  if (open && !open.list.contains(event.target) && !open.button.contains(event.target)) close();
}

async function choose(off, run, failed) {
  if (off) return;
  close();
  try {
    await run();
  } catch (fault) {
    failed(fault);
  }
}

function moved(event, items) {
  const at = items.indexOf(document.activeElement);
  const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
  if (to !== undefined) items[(to + items.length) % items.length].focus();
  if (event.key === "Escape" || event.key === "Tab") close();
  if (to !== undefined || event.key === "Escape") event.preventDefault();
  event.stopPropagation();
}
