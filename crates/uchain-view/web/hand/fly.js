// Flying the head by hand: keys and buttons, taking over at the cursor, and handing back.

import { app } from "uchain/app.js";
import { Stick } from "uchain/hand/fly/stick.js";
import { SteeringBar } from "uchain/hand/fly/panel.js";
import { key } from "uchain/panel/keys.js";

/** Times real time when somebody takes over: half a minute round the circuit, and slow enough to steer. */
const RATE = 2;
/** Faster nobody steers. */
const MOST_RATE = 20;
/** The engine is asked so often why the head is held (ms). */
const WHY_MS = 300;
/** A key that is held steps so often (ms): full speed is a second away. */
const HOLD_MS = 200;

let bar;
let place;
let stick = new Stick(0.2);
/** The tick at which hand takes over, until the flight has been flown up to there again. @type {number|null} */
let taking = null;
/** The flight as it was before the first take-over. @type {any} */
let before = null;
let rateBefore = 0;
let whyAt_ms = 0;
let whyWords = "";
let steppedAt_ms = 0;

export function start() {
  place = document.getElementById("fly");
  bar = new SteeringBar(place, {
    take: (follow) => steer(stick.take(follow)),
    faster: (by) => steer(stick.faster(by)),
    stop: () => steer(stick.stop()),
    again: () => takeOver(0),
    back: giveBack,
    done: () => (app.mode = "watch"),
  });
  document.getElementById("fly-mode").addEventListener("click", toggle);
  app.on("mode", changed);
  app.on("scene", (pane) => {
    if (pane !== app.panes[0]) return;
    document.getElementById("fly-mode").disabled = false;
    taking = null;
  });
  app.on("frame", (pane) => pane === app.panes[0] && look(pane));
  app.on("grown", (pane) => pane === app.panes[0] && look(pane));
  app.on("rate", (rate) => app.mode === "fly" && rate > MOST_RATE && (app.rate = MOST_RATE));
  key(["f", "F"], "f", "fly the head by hand from the cursor on, and hand back", toggle);
  key(["ArrowUp", "ArrowDown"], "↑ ↓", "faster, slower; hold to go on; backward below zero", () => {}, "fly");
  key(["ArrowLeft", "ArrowRight"], "← →", "which way at a branch", () => {}, "fly");
  key([" "], "Space", "stop the head: it hovers", () => {}, "fly");
  key(["p", "P"], "p", "hold time, and let it go on", () => (app.playing ? app.pause() : app.play()), "fly");
  // Before anything else on the page, so that a button or the time line that has the focus does not eat the keys.
  document.addEventListener("keydown", pressed, { capture: true });
  document.addEventListener("keyup", (event) => app.mode === "fly" && event.key === " " && !isText(event.target) && event.preventDefault(), { capture: true });
}

function toggle() {
  if (app.mode === "fly") {
    app.mode = "watch";
    return;
  }
  const pane = app.panes[0];
  if (!pane) return;
  takeOver(app.cursor >= pane.end ? 0 : app.cursor);
}

/** Hand flies from this tick on; what was flown later is forgotten. @param {number} tick @param {Stick|null} [with_] */
function takeOver(tick, with_ = null) {
  const pane = app.panes[0];
  if (!pane || app.mode !== "fly" && !mayFly(pane)) return;
  try {
    const old = pane.engine.do("flight");
    const head = pane.frame?.head;
    const follow = followAt(pane, old.inputs ?? [], tick);
    if (app.mode !== "fly") [before, rateBefore] = [pane.flight.kind === "recording" ? pane.flight : old, app.rate];
    stick = with_ ?? new Stick(pane.scene.chain.v_max_mps, tick === 0 ? 0 : Number((head?.pilot_mps ?? 0).toFixed(4)), tick === 0 ? "centre" : follow);
    app.cut(tick);
  } catch (fault) {
    app.fault(fault);
    return;
  }
  taking = tick;
  whyWords = "";
  app.mode = "fly";
  bar.back.hidden = tick === 0 && (before?.inputs ?? []).length === 0 && before?.kind !== "recording";
  bar.wished(stick);
  app.play();
  look(pane);
}

/** Whether somebody can steer in this flight; says why not. */
function mayFly(pane) {
  if (pane.explores) {
    app.say("note", "Nobody steers here: in an exploration the robots decide by themselves. Choose a chain of UAVs, circuit for one, to fly the head by hand.");
    return false;
  }
  if (pane.scene.recorded && !pane.scene.flies_again) {
    app.say("note", "This recording cannot be flown again here, so there is nothing to steer. Open its scenario, or choose another one.");
    return false;
  }
  return true;
}

/** The way at a branch that is in force at a tick: of the inputs by hand, or of the scenario's script. */
function followAt(pane, inputs, tick) {
  const byHand = inputs.filter((input) => input.tick <= tick).at(-1);
  const scripted = (pane.scene.chain.pilot ?? []).filter((step) => step.start_s <= tick * pane.scene.tick_s + 1e-9).at(-1);
  return (byHand ?? scripted)?.follow ?? "centre";
}

/** Tells the engine what is wished now. @param {boolean} isNew */
function steer(isNew) {
  bar.wished(stick);
  const pane = app.panes[0];
  if (!pane || app.mode !== "fly" || taking !== null) return;
  if (pane.stopped && app.cursor >= pane.tick) return;
  // Somebody went back in time: he flies on from there.
  if (app.cursor < pane.tick) return takeOver(app.cursor, stick);
  if (isNew) send(pane);
  if (!app.playing) app.play();
}

function send(pane) {
  try {
    pane.engine.do("steer", { speed_mps: stick.speed_mps, follow: stick.follow });
  } catch (fault) {
    app.fault(fault);
  }
}

function giveBack() {
  const old = before;
  app.mode = "watch";
  if (old) app.open(old).catch((fault) => app.fault(fault));
}

function changed(mode) {
  const flies = mode === "fly";
  place.hidden = !flies;
  const button = document.getElementById("fly-mode");
  button.setAttribute("aria-pressed", String(flies));
  if (flies) {
    app.rate = RATE;
    document.getElementById("stage").focus({ preventScroll: true });
    scrollTo(0, 0);
  } else {
    taking = null;
    if (rateBefore > 0) app.rate = rateBefore;
  }
}

/** Shows what became of what was wished; ends a take-over once the flight is there. */
function look(pane) {
  if (app.mode !== "fly") return;
  if (taking !== null && pane.tick >= taking) {
    taking = null;
    send(pane);
  }
  bar.became(pane.frame?.head, pane.scene.chain.v_max_mps);
  if (taking !== null) return bar.says("Flying up to here again …", false);
  if (pane.stopped && app.cursor >= pane.tick) {
    return bar.says(`The flight is over: ${pane.stopped.words}. Save or share it, change a key under Edit and fly again with the same inputs, or fly from the start.`, false);
  }
  const head = pane.frame?.head;
  if (!head) return bar.says("The head takes off by itself: press ↑ for what it shall do then.", false);
  const isHeld = Math.abs(head.pilot_mps - head.allowed_mps) > 0.002;
  if (isHeld) return bar.says(`Held back: ${whyOf(pane)}`, true);
  whyWords = "";
  if (head.pilot_mps === 0) return bar.says("It hovers. ↑ faster, ↓ slower or backward, ← → which way at a branch, Space stops.", false);
  bar.says("It keeps to the middle of the tunnel by itself. ← → choose the way at a branch, Space stops.", false);
}

/** The engine's own words about the head, asked now and then. */
function whyOf(pane) {
  const now_ms = performance.now();
  if (now_ms - whyAt_ms > WHY_MS || !whyWords) {
    whyAt_ms = now_ms;
    const why = pane.engine.do("why", { tick: Math.min(app.cursor, pane.tick), uav: pane.frame.leader ?? 0 });
    if (why.reached) whyWords = why.words?.[0] ?? "";
  }
  return whyWords || "its link to the chain is too weak.";
}

const isText = (at) => at instanceof HTMLElement && (at.isContentEditable || at.matches("textarea, select, input:not([type=range]):not([type=checkbox])") || at.closest("dialog") !== null);

function pressed(event) {
  if (app.mode !== "fly" || event.ctrlKey || event.metaKey || event.altKey || isText(event.target)) return;
  const sideways = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  // Tabs that were reached by keyboard keep the keys that go from one to the next.
  if (sideways && event.target.matches?.('[role="tab"]:focus-visible')) return;
  const along = { ArrowUp: 1, ArrowDown: -1 }[event.key];
  if (!sideways && !along && event.key !== " ") return;
  event.preventDefault();
  event.stopPropagation();
  if (along) {
    if (event.repeat && event.timeStamp - steppedAt_ms < HOLD_MS) return;
    steppedAt_ms = event.timeStamp;
    steer(stick.faster(along));
  } else if (sideways) !event.repeat && steer(stick.turn(sideways));
  else steer(stick.stop());
}
