// Corners of a corridor on the map, to be dragged: the numbers in the text change, its comments stay. By keyboard: Tab to
// a corner, then the arrow keys.

import { drawn } from "uchain/hand/element.js";
import { corners, valueOf } from "uchain/hand/edit/toml.js";
import { app } from "uchain/app.js";
import { views } from "uchain/draw/stage.js";

const PATH = "map.corridor.centre_line_m";
/** Corners snap to this (m). */
const SNAP_M = 0.05;
/** More corners than these are not shown: nobody could grasp them. */
const MOST = 200;

export class CornerHandles {
  #pane = null;
  #svg = drawn("svg", { class: "corner-handles", role: "group", "aria-label": "Corners of the corridor" });
  #line = drawn("path", { class: "corner-line" });
  #dots = [];
  #dragged = null;
  #seen = "";

  /** @param {{text: () => string, edit: (edits: any[]) => void, drawn: () => void}} via `drawn`: a corner was moved */
  constructor(via) {
    this.via = via;
    this.#svg.append(this.#line);
  }

  /** Shows the corners on this pane's map; null: on none. */
  shown(pane) {
    this.#pane = pane;
    this.#seen = "";
    // Where it stays on the same map, the corner that has the focus keeps it.
    if (pane) this.place();
    else this.#svg.remove();
  }

  /** Puts the handles where the text says, on the map as it is looked at now. */
  place() {
    const at = this.#pane && placeOf(this.#pane);
    if (!at) return this.#svg.remove();
    if (this.#svg.parentNode !== at.node) at.node.append(this.#svg);
    const key = `${at.view.version}:${at.view.width}:${at.view.height}`;
    const text = this.via.text();
    if (key === this.#seen && text === this.text && !this.#dragged) return;
    if (text !== this.text) {
      this.corners = corners(text, PATH).slice(0, MOST);
      this.isClosed = valueOf(text, "map.corridor.closed") === "true";
    }
    [this.#seen, this.text] = [key, text];
    this.#draw(at.view);
  }

  #draw(view) {
    const points = this.corners.map((corner, i) => (this.#dragged?.index === i ? { ...corner, ...this.#dragged.to } : corner));
    while (this.#dots.length < points.length) this.#dots.push(this.#dot(this.#dots.length));
    this.#dots.forEach((dot, i) => {
      if (i >= points.length) return dot.remove();
      if (dot.parentNode !== this.#svg) this.#svg.append(dot);
      const { x, y } = this.#onPage(view, points[i]);
      dot.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      dot.setAttribute("aria-label", `Corner ${i + 1} of ${points.length}: ${points[i].x} m, ${points[i].y} m`);
    });
    this.#line.setAttribute("d", points.map((point, i) => {
      const { x, y } = this.#onPage(view, point);
      return `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
    }).join("") + (this.isClosed ? "Z" : ""));
  }

  /** The text's coordinates less the offset are the map's. */
  #onPage(view, { x, y }) {
    const [dx, dy] = this.#pane.scene.map.offset_m ?? [0, 0];
    return { x: view.px(x - dx), y: view.py(y - dy) };
  }

  #dot(index) {
    return drawn(
      "g",
      {
        class: "corner", tabindex: "0", role: "button",
        onpointerdown: (event) => this.#grab(event, index),
        onpointermove: (event) => this.#move(event, index),
        onpointerup: (event) => this.#drop(event, index),
        onpointercancel: () => this.#leave(),
        onkeydown: (event) => this.#key(event, index),
      },
      drawn("circle", { r: 16, class: "grip" }),
      drawn("circle", { r: 7, class: "dot" }),
    );
  }

  #grab(event, index) {
    if (event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    event.currentTarget.setPointerCapture(event.pointerId);
    event.currentTarget.focus({ preventScroll: true });
    this.#dragged = { index, to: { x: this.corners[index].x, y: this.corners[index].y }, x0: event.clientX, y0: event.clientY };
  }

  #move(event, index) {
    const dragged = this.#dragged;
    if (dragged?.index !== index) return;
    event.stopPropagation();
    const { view } = placeOf(this.#pane);
    const corner = this.corners[index];
    dragged.to = {
      x: snapped(corner.x + (event.clientX - dragged.x0) / view.scale),
      y: snapped(corner.y - (event.clientY - dragged.y0) / view.scale),
    };
    this.#draw(view);
  }

  #drop(event, index) {
    const dragged = this.#dragged;
    if (dragged?.index !== index) return;
    event.stopPropagation();
    this.#dragged = null;
    this.#put(index, dragged.to);
  }

  #leave() {
    this.#dragged = null;
    this.#seen = "";
    this.place();
  }

  #key(event, index) {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!by || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const step_m = event.shiftKey ? 1 : 0.1;
    const { x, y } = this.corners[index];
    this.#put(index, { x: snapped(x + by[0] * step_m), y: snapped(y + by[1] * step_m) });
  }

  #put(index, to) {
    const corner = this.corners[index];
    if (to.x !== corner.x || to.y !== corner.y) {
      this.via.edit([
        { from: corner.xAt[0], to: corner.xAt[1], text: number(to.x) },
        { from: corner.yAt[0], to: corner.yAt[1], text: number(to.y) },
      ]);
      this.via.drawn();
    }
    this.#seen = "";
    this.place();
  }
}

/** Where a pane's map is on the page, and how it is looked at. */
function placeOf(pane) {
  const shown = views[app.panes.indexOf(pane)];
  return shown ? { view: shown.map.view, node: shown.section.querySelector(".map") } : null;
}

const snapped = (m) => Number((Math.round(m / SNAP_M) * SNAP_M).toFixed(3));
const number = (m) => (Number.isInteger(m) ? m.toFixed(1) : String(m));
