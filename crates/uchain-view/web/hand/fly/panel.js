// The steering bar: what touch and mouse press, what the head is asked, and why it is held.

import { WAYS } from "uchain/hand/fly/stick.js";
import { element, shown } from "uchain/hand/element.js";
import { speedDrawing } from "uchain/hand/why/speed.js";

/** A button that is held repeats after so long (ms). */
const REPEAT_MS = 220;

export class SteeringBar {
  /** @param {HTMLElement} place @param {any} does what its buttons do */
  constructor(place, does) {
    this.ways = WAYS.map((way) => element("button", { type: "button", className: `way ${way.follow}`, "aria-pressed": "false", "aria-keyshortcuts": { left: "ArrowLeft", right: "ArrowRight" }[way.follow], onclick: () => does.take(way.follow) }, element("span", { "aria-hidden": "true" }, `${way.sign} `), way.words));
    this.speed = element("output", { className: "fly-speed", "aria-live": "polite", "aria-label": "asked of the head" });
    this.gauge = element("div", { className: "fly-gauge" });
    this.held = element("p", { className: "fly-held", role: "status" });
    this.back = element("button", { type: "button", hidden: true, onclick: does.back, title: "Undo the take-over: the flight is again as it was before" }, "Undo");
    place.replaceChildren(element("div", { className: "fly-bar" },
      element("div", { className: "fly-group ways", role: "group", "aria-label": "Which way at a branch" }, element("span", { className: "fly-word" }, "At a branch"), ...this.ways),
      element("div", { className: "fly-group speeds", role: "group", "aria-label": "Speed" },
        held(element("button", { type: "button", className: "big", "aria-keyshortcuts": "ArrowDown" }, "▼ Slower"), () => does.faster(-1)),
        element("button", { type: "button", className: "big stop", "aria-keyshortcuts": "Space", onclick: does.stop }, "■ Stop"),
        held(element("button", { type: "button", className: "big", "aria-keyshortcuts": "ArrowUp" }, "▲ Faster"), () => does.faster(1)),
        this.speed),
      this.held,
      this.gauge,
      element("div", { className: "fly-group ends", role: "group", "aria-label": "This flight by hand" },
        element("button", { type: "button", onclick: does.done, title: "Watch: it flies on with what you asked last (F)" }, "Done"),
        element("button", { type: "button", onclick: does.again, title: "Fly by hand from the start" }, "Restart"),
        this.back),
    ));
  }

  /** What is wished. */
  wished(stick) {
    this.ways.forEach((button, i) => button.setAttribute("aria-pressed", String(WAYS[i].follow === stick.follow)));
    const { speed_mps } = stick;
    this.speed.value = speed_mps === 0 ? "hover" : `${speed_mps > 0 ? "▲" : "▼ back"} ${shown(Math.abs(speed_mps), 2, "m/s")}`;
  }

  /** What became of it. @param {any} head the frame's `head` @param {number} v_max_mps */
  became(head, v_max_mps) {
    const marks = [
      { name: "you ask", mps: head?.pilot_mps ?? 0, kind: "pilot" },
      { name: "its link allows", mps: head?.allowed_mps ?? 0, kind: "allowed" },
      { name: "walls leave", mps: head?.asked_mps ?? 0, kind: "asked" },
    ];
    this.gauge.replaceChildren(speedDrawing(marks, v_max_mps, { label: "The head's speed", width: 230, row: 16, hasAxis: false }));
  }

  /** Why it is held, or what to do next. @param {string} words @param {boolean} isHeld */
  says(words, isHeld) {
    if (this.held.textContent !== words) this.held.textContent = words;
    this.held.classList.toggle("is-held", isHeld);
  }
}

/** A button that goes on while it is held. */
function held(button, does) {
  let timer = 0;
  const release = () => clearInterval(timer);
  button.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    release();
    does();
    timer = setInterval(() => (button.isConnected && button.offsetParent ? does() : release()), REPEAT_MS);
  });
  for (const name of ["pointerup", "pointercancel", "pointerleave", "blur"]) button.addEventListener(name, release);
  button.addEventListener("contextmenu", (event) => event.preventDefault());
  // By keyboard there is no pointer: a click of its own.
  button.addEventListener("click", (event) => event.detail === 0 && does());
  return button;
}
