// @ts-check
// An exploration on its map: stars as sectors, frontiers, the graph, targets, robots.

import { app } from "uchain/app.js";
import { discPx, drawDisc, drawTrails, label, nearest } from "uchain/draw/map/chain.js";
import { palette, uavColour } from "uchain/draw/colours.js";
import { shown } from "uchain/panel/layers.js";

export const FRONTIER = { light: "#B0438A", dark: "#E79AC4" };
export const STAR = { light: "#0072B2", dark: "#56B4E9" };

/** So many stars are drawn in a frame; the others follow in the next ones. */
const STARS_AT_ONCE = 250;

/** The robot at a pixel. @param {any} pane @param {import("uchain/draw/map/view.js").View} view @param {number} px @param {number} py */
export function nearestRobot(pane, view, px, py) {
  return nearest(pane.frame.robots, view, px, py, discPx(pane, view) + 6);
}

/** What the robots of one flight have drawn up, as a picture that grows with the cursor. */
export class Explored {
  #stars = document.createElement("canvas");
  #outlines = document.createElement("canvas");
  #edges = document.createElement("canvas");
  #state = "";
  /** How many nodes, labels and edges are in the pictures. */
  #done = { nodes: 0, labels: 0, edges: 0 };
  #tick = 0;
  /** Frontiers at the cursor: node * sectors + sector. @type {Set<number>} */
  #frontiers = new Set();

  /** @param {CanvasRenderingContext2D} context @param {import("uchain/draw/map/view.js").View} view @param {any} pane @param {number} ratio */
  draw(context, view, pane, ratio) {
    const colours = palette();
    const state = `${view.version} ${ratio} ${colours.dark} ${pane.version}`;
    if (state !== this.#state || pane.frame.tick < this.#tick) this.#begin(view, ratio);
    this.#state = state;
    this.#grow(view, pane, ratio, colours);
    if (shown.stars) {
      context.globalAlpha = colours.dark ? 0.34 : 0.26;
      context.drawImage(this.#stars, 0, 0, view.width, view.height);
      context.globalAlpha = 0.3;
      context.drawImage(this.#outlines, 0, 0, view.width, view.height);
      context.globalAlpha = 1;
    }
    if (shown.graph) context.drawImage(this.#edges, 0, 0, view.width, view.height);
    if (shown.frontiers) this.#drawFrontiers(context, view, pane, colours);
    if (shown.trails) drawTrails(context, view, pane);
    this.#robots(context, view, pane);
  }

  #begin(view, ratio) {
    for (const canvas of [this.#stars, this.#outlines, this.#edges]) {
      canvas.width = Math.round(view.width * ratio);
      canvas.height = Math.round(view.height * ratio);
    }
    this.#done = { nodes: 0, labels: 0, edges: 0 };
    this.#frontiers.clear();
  }

  /** Adds what has come up to the frame that is shown. */
  #grow(view, pane, ratio, colours) {
    const { nodes, labels, edges } = pane.graph;
    const tick = pane.frame.tick;
    this.#tick = tick;
    const done = this.#done;
    const star = this.#context(this.#stars, ratio);
    const outline = this.#context(this.#outlines, ratio);
    star.fillStyle = outline.strokeStyle = colours.dark ? STAR.dark : STAR.light;
    outline.lineWidth = 0.8;
    const most = done.nodes + STARS_AT_ONCE;
    for (; done.nodes < nodes.length && nodes[done.nodes].tick <= tick; done.nodes += 1) {
      if (done.nodes === most) {
        app.redraw();
        return;
      }
      drawStar(star, outline, view, nodes[done.nodes], pane.scene.exploration);
      this.#open(nodes[done.nodes], done.nodes, pane.scene.exploration);
    }
    const edge = this.#context(this.#edges, ratio);
    edge.strokeStyle = edge.fillStyle = colours.soft;
    edge.lineWidth = 1.2;
    for (; done.edges < edges.length && edges[done.edges][0] <= tick; done.edges += 1) {
      const [, from, to] = edges[done.edges];
      const [a, b] = [nodes[from], nodes[to]];
      edge.beginPath();
      edge.moveTo(view.px(a.at_m[0]), view.py(a.at_m[1]));
      edge.lineTo(view.px(b.at_m[0]), view.py(b.at_m[1]));
      edge.stroke();
    }
    for (; done.labels < labels.length && labels[done.labels][0] <= tick; done.labels += 1) {
      const [, node, sector, label] = labels[done.labels];
      const which = node * pane.scene.exploration.sectors + sector;
      if (label === "frontier") this.#frontiers.add(which);
      else this.#frontiers.delete(which);
    }
  }

  /** A new star's sectors without a return are frontiers, until a label says otherwise. */
  #open(node, number, { sectors, range_m }) {
    for (let sector = 0; sector < sectors; sector += 1) {
      if (node.r_m[sector] >= range_m - 1e-4) this.#frontiers.add(number * sectors + sector);
    }
  }

  #context(canvas, ratio) {
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return context;
  }

  #drawFrontiers(context, view, pane, colours) {
    const { sectors, first_rad } = pane.scene.exploration;
    const wide = (2 * Math.PI) / sectors;
    context.strokeStyle = colours.dark ? FRONTIER.dark : FRONTIER.light;
    context.lineWidth = 3;
    context.lineCap = "butt";
    context.beginPath();
    for (const which of this.#frontiers) {
      const node = pane.graph.nodes[Math.floor(which / sectors)];
      const from = -(first_rad + (which % sectors) * wide);
      const radius = node.r_m[which % sectors] * view.scale;
      const [x, y] = [view.px(node.at_m[0]), view.py(node.at_m[1])];
      context.moveTo(x + Math.cos(from) * radius, y + Math.sin(from) * radius);
      context.arc(x, y, radius, from, from - wide, true);
    }
    context.stroke();
  }

  #robots(context, view, pane) {
    const size = discPx(pane, view);
    if (shown.targets) {
      context.lineWidth = 1.6;
      pane.frame.robots.forEach((/** @type {any} */ robot, /** @type {number} */ id) => {
        if (!robot.to_m) return;
        const [x, y] = [view.px(robot.to_m[0]), view.py(robot.to_m[1])];
        context.strokeStyle = uavColour(id);
        context.setLineDash([4, 4]);
        context.beginPath();
        context.moveTo(view.px(robot.x_m), view.py(robot.y_m));
        context.lineTo(x, y);
        context.stroke();
        context.setLineDash([]);
        context.beginPath();
        context.arc(x, y, 5, 0, 7);
        context.stroke();
      });
    }
    for (let id = pane.frame.robots.length - 1; id >= 0; id -= 1) {
      const robot = pane.frame.robots[id];
      const [x, y] = [view.px(robot.x_m), view.py(robot.y_m)];
      drawDisc(context, x, y, robot.heading_rad, id, size);
      if (robot.holds) {
        context.font = "600 11px system-ui, sans-serif";
        label(context, "holds", x, y + size + 13, view);
      }
    }
  }
}

/** A star: as far as each sector was seen free; filled, and its outline on another picture. */
function drawStar(context, outlines, view, node, { sectors, first_rad }) {
  const wide = (2 * Math.PI) / sectors;
  const [x, y] = [view.px(node.at_m[0]), view.py(node.at_m[1])];
  const star = new Path2D();
  for (let sector = 0; sector < sectors; sector += 1) {
    const from = -(first_rad + sector * wide);
    star.arc(x, y, Math.max(0, node.r_m[sector] * view.scale), from, from - wide, true);
  }
  star.closePath();
  context.fill(star);
  outlines.stroke(star);
}
