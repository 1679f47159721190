// @ts-check
// What a newcomer reads first: three sentences, and the scenarios to choose from.

import { app } from "uchain/app.js";
import { fly, scenarios } from "uchain/panel/bar.js";

const TEXT = [
  "A chain of small UAVs carries radio into a tunnel. Nobody knows a position: each UAV listens how loud its two neighbours are, and flies until both are equally loud. When the chain is stretched, the next one takes off.",
  matchMedia("(pointer: coarse)").matches
    ? "Tap ❚❚ to stop, drag the time line, tap a UAV to ask why it moves."
    : "Press Space to stop and go, drag the time line, click a UAV to ask why it moves.",
  matchMedia("(pointer: coarse)").matches
    ? "Or fly the head yourself: faster and slower, left or right at a branch. It keeps off the walls by itself, and the others keep your link."
    : "Or fly the head yourself: ↑ and ↓ for its speed, ← and → for the way at a branch, Space stops it. It keeps off the walls by itself, and the others keep your link.",
];

function card(/** @type {any} */ one, /** @type {() => void} */ close) {
  const button = document.createElement("button");
  button.type = "button";
  const name = document.createElement("strong");
  name.textContent = one.name;
  const words = document.createElement("span");
  words.textContent = one.description;
  button.append(name, words);
  button.addEventListener("click", () => {
    close();
    fly(one.name, 1)
      .then(() => app.play())
      .catch((fault) => app.fault(fault));
  });
  return button;
}

/** Shows it over the stage; what flies behind it goes on. */
export function show() {
  document.getElementById("welcome")?.remove();
  const box = document.createElement("section");
  box.id = "welcome";
  box.setAttribute("aria-label", "Welcome");
  const close = () => {
    box.remove();
    document.getElementById("play")?.focus({ preventScroll: true });
  };
  const title = document.createElement("h2");
  title.textContent = "See a swarm fly";
  box.append(title);
  for (const text of TEXT) {
    const line = document.createElement("p");
    line.textContent = text;
    box.append(line);
  }
  const row = document.createElement("div");
  row.className = "ways";
  const watch = document.createElement("button");
  watch.type = "button";
  watch.className = "main";
  watch.textContent = "Watch";
  watch.addEventListener("click", close);
  const steer = document.createElement("button");
  steer.type = "button";
  steer.textContent = "Fly the head yourself";
  steer.addEventListener("click", () => {
    close();
    document.getElementById("fly-mode")?.click();
  });
  row.append(watch, steer);
  const list = document.createElement("div");
  list.className = "scenarios";
  const explores = (/** @type {any} */ one) => Number(one.mission.includes("exploration"));
  for (const one of scenarios.filter((one) => one.flies).sort((a, b) => explores(a) - explores(b))) list.append(card(one, close));
  box.append(row, list);
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
  });
  document.getElementById("stage")?.append(box);
  watch.focus({ preventScroll: true });
}

export function start() {
  app.on("scene", () => {
    if (app.panes[0]?.flight.label !== "circuit.toml") document.getElementById("welcome")?.remove();
  });
  app.on("mode", () => document.getElementById("welcome")?.remove());
}
