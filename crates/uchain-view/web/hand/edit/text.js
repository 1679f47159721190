// A plain text area with line numbers and one marked line. Changes made for the writer (a corner dragged, a key set) go
// through the browser's own editing, so that Ctrl+Z takes them back like typed ones.

import { element } from "uchain/hand/element.js";
import { lineOf, rangeOfLine } from "uchain/hand/edit/toml.js";

export class TextPanel {
  /** @param {{label: string, changed: () => void, moved: () => void, enter: () => void}} told */
  constructor(told) {
    this.told = told;
    this.marked = null;
    this.lines = 0;
    this.gutter = element("div", { className: "edit-gutter", "aria-hidden": "true" });
    this.area = element("textarea", {
      className: "edit-area",
      "aria-label": told.label,
      "aria-describedby": "edit-verdict",
      spellcheck: false,
      autocapitalize: "off",
      autocomplete: "off",
      wrap: "off",
      oninput: () => this.#changed(),
      onscroll: () => this.#follow(),
      onkeydown: (event) => this.#key(event),
      onkeyup: () => told.moved(),
      onclick: () => told.moved(),
    });
    this.band = element("div", { className: "edit-band", hidden: true });
    this.node = element("div", { className: "edit-text" }, this.gutter, element("div", { className: "edit-sheet" }, this.band, this.area));
    document.addEventListener("selectionchange", () => {
      if (document.activeElement === this.area) told.moved();
    });
  }

  get text() {
    return this.area.value;
  }

  get caret() {
    return this.area.selectionStart;
  }

  /** Another text altogether: what was typed before is forgotten, undo included. */
  open(text) {
    this.area.value = text;
    this.mark(null);
    this.#number();
    this.area.setSelectionRange(0, 0);
    this.area.scrollTo(0, 0);
  }

  /**
   * Changes places of the text as one typed change each; Ctrl+Z takes them back.
   * @param {{from: number, to: number, text: string}[]} edits
   */
  edit(edits) {
    const { area } = this;
    const before = { caret: area.selectionStart, top: area.scrollTop, left: area.scrollLeft };
    const ordered = [...edits].sort((a, b) => b.from - a.from);
    if (ordered.length === 0) return;
    const from = ordered.at(-1).from;
    const to = ordered[0].to;
    let piece = area.value.slice(from, to);
    for (const one of ordered) piece = piece.slice(0, one.from - from) + one.text + piece.slice(one.to - from);
    if (piece === area.value.slice(from, to)) return;
    const focused = document.activeElement;
    area.focus({ preventScroll: true });
    area.setSelectionRange(from, to);
    // The only way that keeps the browser's undo; where it is refused, the text is set and undo starts anew.
    if (!document.execCommand("insertText", false, piece)) {
      area.setRangeText(piece, from, to, "end");
      this.#changed();
    }
    const caret = Math.min(before.caret, area.value.length);
    area.setSelectionRange(caret, caret);
    area.scrollTo(before.left, before.top);
    if (focused instanceof Element && focused !== area) focused.focus({ preventScroll: true });
  }

  /** Shows a place: the caret goes there. */
  goTo(from, to = from) {
    const { line } = lineOf(this.text, from);
    this.area.focus();
    this.area.setSelectionRange(from, to);
    const height = this.#lineHeight();
    const top = (line - 1) * height;
    if (top < this.area.scrollTop || top > this.area.scrollTop + this.area.clientHeight - 2 * height) {
      this.area.scrollTop = Math.max(0, top - this.area.clientHeight / 3);
    }
    this.told.moved();
  }

  goToLine(line, column = 1) {
    const { from, to } = rangeOfLine(this.text, line);
    const at = Math.min(from + Math.max(column, 1) - 1, to);
    this.goTo(at, to);
  }

  /** Marks the line of an error; null: no error. */
  mark(line) {
    this.marked = line;
    this.#number(true);
    this.area.setAttribute("aria-invalid", String(line !== null));
    this.#follow();
  }

  #changed() {
    this.#number();
    this.told.changed();
    this.told.moved();
  }

  #key(event) {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      this.told.enter();
    }
    // Tab moves on, as everywhere on a page: nobody is caught in here.
  }

  #number(anew = false) {
    const lines = this.area.value.split("\n").length;
    if (lines === this.lines && !anew) return;
    this.lines = lines;
    const numbers = Array.from({ length: lines }, (_, i) => `${i + 1}\n`);
    const bad = this.marked !== null && this.marked <= lines ? this.marked : null;
    if (bad === null) this.gutter.replaceChildren(numbers.join(""));
    else this.gutter.replaceChildren(numbers.slice(0, bad - 1).join(""), element("span", { className: "bad" }, `✕ ${bad}\n`), numbers.slice(bad).join(""));
    this.#follow();
  }

  #lineHeight() {
    return Number.parseFloat(getComputedStyle(this.area).lineHeight) || 18;
  }

  #follow() {
    this.gutter.scrollTop = this.area.scrollTop;
    this.band.hidden = this.marked === null;
    if (this.marked !== null) {
      const height = this.#lineHeight();
      const top = (this.marked - 1) * height + Number.parseFloat(getComputedStyle(this.area).paddingTop) - this.area.scrollTop;
      this.band.style.top = `${top}px`;
      this.band.style.height = `${height}px`;
      this.band.hidden = top < -height || top > this.area.clientHeight;
    }
  }
}
