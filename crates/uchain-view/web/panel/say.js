// @ts-check
// Lines that stay until they are closed: what went wrong, and what is worth knowing.

import { app } from "uchain/app.js";

/** More lines than these push the oldest out. */
const MOST = 4;

export function start() {
  const place = /** @type {HTMLElement} */ (document.getElementById("said"));
  app.on("say", ({ kind, text }) => {
    for (const old of [...place.children]) if (old.firstElementChild?.textContent === text) old.remove();
    const line = document.createElement("p");
    line.className = kind;
    const words = document.createElement("span");
    words.textContent = text;
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = "Close";
    close.setAttribute("aria-label", "Close this line");
    close.addEventListener("click", () => line.remove());
    line.append(words, close);
    place.append(line);
    while (place.children.length > MOST) place.firstElementChild?.remove();
  });
}
