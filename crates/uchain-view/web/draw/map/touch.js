// @ts-check
// The map under pointer and keyboard: pan, zoom, hover, select.

import { app } from "uchain/app.js";

/** A press that moves less is a click (pixels). */
const CLICK_PX = 5;
/** How near counts as on it (pixels). */
const NEAR_PX = 14;

export class Touch {
  /** @type {Map<number, {x: number, y: number}>} */
  #down = new Map();
  #moved = 0;
  /** What another part of the page is dragging. @type {{move: (x_m: number, y_m: number) => void, up: () => void}|null} */
  #grabbed = null;

  /** @param {import("uchain/draw/map/map.js").MapView} map */
  constructor(map) {
    this.map = map;
    const canvas = map.canvas;
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#lift(event, true));
    canvas.addEventListener("pointercancel", (event) => this.#lift(event, false));
    canvas.addEventListener("pointerleave", () => (map.tip.hidden = true));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => this.#zoom(1.6, event));
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  #place(/** @type {MouseEvent} */ event) {
    const box = this.map.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #press(/** @type {PointerEvent} */ event) {
    if (event.button !== 0) return;
    const at = this.#place(event);
    this.#down.set(event.pointerId, at);
    this.map.canvas.setPointerCapture(event.pointerId);
    this.map.tip.hidden = true;
    if (this.#down.size > 1) {
      this.#moved = CLICK_PX;
      return;
    }
    this.#moved = 0;
    const { x_m, y_m } = this.map.view.toMetre(at.x, at.y);
    for (const grab of this.map.grabs) this.#grabbed ??= grab(x_m, y_m, NEAR_PX / this.map.view.scale, this.map.pane);
    this.map.canvas.classList.add("grabbed");
  }

  #move(/** @type {PointerEvent} */ event) {
    const at = this.#place(event);
    const was = this.#down.get(event.pointerId);
    if (!was) return this.#hover(at);
    const others = [...this.#down].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    this.#down.set(event.pointerId, at);
    this.#moved += Math.hypot(at.x - was.x, at.y - was.y);
    const view = this.map.view;
    if (this.#grabbed) {
      const { x_m, y_m } = view.toMetre(at.x, at.y);
      this.#grabbed.move(x_m, y_m);
    } else if (others.length) {
      const [other] = others;
      const before = Math.hypot(was.x - other.x, was.y - other.y);
      const now = Math.hypot(at.x - other.x, at.y - other.y);
      if (before > 4 && now > 4) view.zoom(now / before, (at.x + other.x) / 2, (at.y + other.y) / 2);
      view.pan((at.x - was.x) / 2, (at.y - was.y) / 2);
    } else if (this.#moved > CLICK_PX) {
      view.pan(at.x - was.x, at.y - was.y);
    }
    app.redraw();
  }

  #lift(/** @type {PointerEvent} */ event, /** @type {boolean} */ whole) {
    const at = this.#down.get(event.pointerId);
    if (!at) return;
    this.#down.delete(event.pointerId);
    if (this.#down.size) return;
    this.map.canvas.classList.remove("grabbed");
    if (this.#grabbed) {
      this.#grabbed.up();
      this.#grabbed = null;
    } else if (whole && this.#moved <= CLICK_PX) {
      app.selected = this.map.at(at.x, at.y);
    }
  }

  #hover(/** @type {{x: number, y: number}} */ at) {
    const { tip, pane, view, canvas } = this.map;
    const id = this.map.at(at.x, at.y);
    canvas.style.cursor = id === null ? "" : "pointer";
    tip.hidden = id === null || !pane;
    if (id === null || !pane) return;
    tip.textContent = words(pane, id);
    tip.style.left = `${Math.min(at.x + 14, view.width - 190)}px`;
    tip.style.top = `${Math.max(4, at.y - 46)}px`;
  }

  #wheel(/** @type {WheelEvent} */ event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.#zoom(Math.exp(Math.max(-0.4, Math.min(0.4, -event.deltaY * lines * 0.0022))), event);
  }

  #zoom(/** @type {number} */ by, /** @type {MouseEvent} */ event) {
    const at = this.#place(event);
    this.map.view.zoom(by, at.x, at.y);
    app.redraw();
  }

  /** Arrows move the map while it has the focus and nobody steers. */
  #key(/** @type {KeyboardEvent} */ event) {
    const step = /** @type {Record<string, number[]>} */ ({ ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] })[event.key];
    if (!step || app.mode === "fly") return;
    event.preventDefault();
    this.map.view.pan(step[0], step[1]);
    app.redraw();
  }
}

/** A UAV or robot in a few words. @param {any} pane @param {number} id */
function words(pane, id) {
  if (pane.explores) {
    const robot = pane.frame.robots[id];
    return `${pane.nameOf(id)}: ${robot.holds ? "holds for another" : robot.purpose}\nlevel ${robot.level}, ${robot.z_m.toFixed(2)} m high`;
  }
  const uav = pane.frame.uavs[id];
  if (!uav.airborne) return `${pane.nameOf(id)}: on the ground`;
  const link = pane.frame.links.find((/** @type {any} */ one) => one.uav === id);
  const speed = `forward ${uav.forward_mps.toFixed(2)} m/s`;
  if (!link) return `${pane.nameOf(id)}\n${speed}`;
  const to = link.behind === null ? "base" : pane.nameOf(link.behind);
  return `${pane.nameOf(id)}\nlink to ${to}: ${link.true_db.toFixed(1)} dB\n${speed}`;
}
