// @ts-check
// The map of one flight on a canvas in device pixels: rock, then what flies over it.

import { app } from "uchain/app.js";
import { drawChain, nearestUav } from "uchain/draw/map/chain.js";
import { Explored, nearestRobot } from "uchain/draw/map/explore.js";
import { drawKey } from "uchain/draw/map/key.js";
import { Rock } from "uchain/draw/map/rock.js";
import { Touch } from "uchain/draw/map/touch.js";
import { View } from "uchain/draw/map/view.js";

export class MapView {
  view = new View();
  /** Drawn on top, by others: `(context, view, pane) => void`. @type {Set<(context: CanvasRenderingContext2D, view: View, pane: any) => void>} */
  overlays = new Set();
  /**
   * Asked first when the map is pressed: return `{move(x_m, y_m), up()}` to take the pointer, or null.
   * @type {Set<(x_m: number, y_m: number, near_m: number, pane: any) => {move: (x_m: number, y_m: number) => void, up: () => void}|null>}
   */
  grabs = new Set();
  /** @type {import("uchain/pane.js").Pane|null} */
  pane = null;
  #rock = new Rock();
  #explored = new Explored();
  #ratio = 1;

  /** @param {HTMLElement} box @param {number} index */
  constructor(box, index) {
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-roledescription", "map");
    this.canvas.dataset.map = String(index);
    this.context = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    this.tip = document.createElement("div");
    this.tip.className = "tip";
    this.tip.hidden = true;
    box.append(this.canvas, this.#buttons(), this.tip);
    this.touch = new Touch(this);
    new ResizeObserver(([entry]) => this.#resize(entry.contentRect.width, entry.contentRect.height)).observe(box);
  }

  /** @param {import("uchain/pane.js").Pane} pane */
  open(pane) {
    this.pane = pane;
    this.#explored = new Explored();
    this.#rock = new Rock();
    this.view.fit(pane.scene.map.bounds);
    this.canvas.setAttribute("aria-label", `Map of ${pane.scene.title || pane.scene.name}: arrows move it, plus and minus zoom, w shows all, digits select`);
  }

  /** The UAV or robot at a pixel of the canvas; null = none. @param {number} px @param {number} py */
  at(px, py) {
    if (!this.pane?.frame) return null;
    return this.pane.explores ? nearestRobot(this.pane, this.view, px, py) : nearestUav(this.pane, this.view, px, py);
  }

  draw() {
    const pane = this.pane;
    if (!pane || this.view.width < 2) return;
    const context = this.context;
    context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    this.#rock.draw(context, this.view, pane.scene.map, this.#ratio);
    if (pane.frame) {
      if (pane.explores) this.#explored.draw(context, this.view, pane, this.#ratio);
      else drawChain(context, this.view, pane);
    }
    for (const overlay of this.overlays) overlay(context, this.view, pane);
    drawKey(context, this.view, pane);
  }

  #buttons() {
    const zoom = document.createElement("div");
    zoom.className = "zoom";
    const add = (/** @type {string} */ text, /** @type {string} */ words, /** @type {() => void} */ run) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = text;
      button.title = words;
      button.setAttribute("aria-label", words);
      button.addEventListener("click", () => {
        run();
        app.redraw();
      });
      zoom.append(button);
    };
    add("+", "Zoom in (+)", () => this.view.zoom(1.4));
    add("−", "Zoom out (-)", () => this.view.zoom(1 / 1.4));
    add("⤢", "The whole map (w)", () => this.view.fit());
    return zoom;
  }

  #resize(width, height) {
    this.#ratio = Math.min(3, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(width * this.#ratio);
    this.canvas.height = Math.round(height * this.#ratio);
    this.view.resize(width, height);
    app.redraw();
  }
}
