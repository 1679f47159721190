// Opens a flight; where that takes a while, the page says so first.

import { app } from "uchain/app.js";
import { element } from "uchain/hand/element.js";

/** Maps longer than this take more than a moment to be laid out: letters of walls, or bytes of a picture. */
const LONG = 100_000;

/** @param {any} flight as for `app.open` @param {number} [index] */
export async function openSaid(flight, index = 0) {
  const size = flight.kind === "map" ? flight.bytes.length : (flight.walls_csv?.length ?? 0);
  if (size < LONG) return app.open(flight, index);
  const words = `Laying out ${flight.label ?? "the map"} …`;
  const dialog = element("dialog", { className: "hand-dialog", "aria-label": words }, element("p", { role: "status" }, words));
  document.body.append(dialog);
  dialog.showModal();
  // The engine does it in one go: the page is painted with the words before.
  await new Promise((painted) => requestAnimationFrame(() => setTimeout(painted)));
  try {
    return await app.open(flight, index);
  } finally {
    dialog.close();
    dialog.remove();
  }
}
