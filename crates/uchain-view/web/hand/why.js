// Why does it do what it does: the panel about the UAV that is selected, at the cursor. The sentences are the engine's.

import { app } from "uchain/app.js";
import { element, shown } from "uchain/hand/element.js";
import { linksDrawing } from "uchain/hand/why/links.js";
import { recordedPart } from "uchain/hand/why/recorded.js";
import { robotWhy } from "uchain/hand/why/robot.js";
import { speedDrawing } from "uchain/hand/why/speed.js";
import { pairs, wallsPart, wayOf } from "uchain/hand/why/walls.js";
import { linkColour, uavColour } from "uchain/draw/colours.js";

/** Asked so often while it plays (ms): the engine may have to fly a stretch again for it. */
const PAUSE_MS = 120;

let panel;
let body;
let isDue = false;
let askedAt_ms = 0;
/** What is shown of each pane: `tick:uav`, so that nothing is asked twice. */
let drawnOf = new WeakMap();

export function start() {
  panel = document.getElementById("why");
  body = element("div", { className: "why-body" });
  panel.append(element("div", { className: "why-who", role: "group", "aria-label": "Whose why" }), body);
  app.on("selected", (uav) => {
    drawnOf = new WeakMap();
    if (uav !== null) document.getElementById("tab-why")?.click();
    ask();
  });
  for (const name of ["cursor", "frame", "scene", "panes"]) app.on(name, ask);
  app.on("scene", () => (drawnOf = new WeakMap()));
  document.getElementById("tab-why")?.addEventListener("click", ask);
  ask();
}

/** Asks the engine in the next animation frame. */
function ask() {
  if (isDue) return;
  isDue = true;
  requestAnimationFrame(look);
}

function look(now_ms) {
  isDue = false;
  if (panel.hidden || app.panes.length === 0) return;
  if (app.playing && now_ms - askedAt_ms < PAUSE_MS) return ask();
  askedAt_ms = now_ms;
  who();
  if (app.selected === null) {
    const what = app.panes[0].scene.robot;
    body.replaceChildren(element("p", { className: "quiet" }, `Click a ${what} on the map, or press its number: here it says why it does what it does.`));
    return;
  }
  body.replaceChildren(...app.panes.map((pane, i) => aboutPane(pane, i)));
}

/** A button for each UAV, so that the map is not the only way. */
function who() {
  const row = panel.querySelector(".why-who");
  const { crew, robot } = app.panes[0].scene;
  const count = Math.min(crew, 100);
  if (row.children.length !== count) {
    row.replaceChildren(...Array.from({ length: count }, (_, uav) => {
      const button = element("button", { type: "button", className: "chip", onclick: () => (app.selected = uav), "aria-label": `${robot} ${uav}` }, String(uav));
      button.style.setProperty("--of-uav", uavColour(uav));
      return button;
    }));
  }
  [...row.children].forEach((button, uav) => button.setAttribute("aria-pressed", String(uav === app.selected)));
}

function aboutPane(pane, index) {
  const key = `${app.cursor}:${app.selected}:${pane.tick < app.cursor}`;
  const had = drawnOf.get(pane);
  if (had?.key === key) return had.node;
  const node = element("section", { className: "why-pane" });
  if (app.panes.length > 1) node.append(element("h3", {}, `${"AB"[index]}: ${pane.scene.label ?? pane.scene.name}`));
  let isWhole = true;
  try {
    isWhole = fill(node, pane);
  } catch (error) {
    node.append(element("p", { className: "quiet" }, error.words ?? error.message));
  }
  if (isWhole) {
    drawnOf.set(pane, { key, node });
    return node;
  }
  ask();
  // Until the engine has flown up to here again, what was shown stays.
  return had?.node ?? node;
}

/** True = all is there; false = to be asked again. */
function fill(node, pane) {
  const { scene, frame } = pane;
  const uav = app.selected;
  if (uav >= pane.crew) {
    node.append(element("p", { className: "quiet" }, `There is no ${scene.robot} ${uav} in this flight.`));
    return true;
  }
  if (pane.explores) {
    node.append(...robotWhy(frame?.robots?.[uav], uav, scene));
    return true;
  }
  if (scene.recorded && !scene.flies_again) {
    node.append(...recordedPart(frame, uav, scene));
    return true;
  }
  const why = pane.engine.do("why", { tick: Math.min(app.cursor, pane.tick), uav });
  if (!why.reached) {
    node.append(element("p", { className: "quiet" }, "Flying up to here again …"));
    return false;
  }
  const [first, ...more] = why.words ?? [];
  const parts = [
    element("p", { className: "why-role" }, `UAV ${uav}, ${[why.role, why.stage].filter(Boolean).join(", ")}${Number.isInteger(why.place) ? `, place ${why.place} of the chain` : ""}`),
    element("p", { className: "why-first" }, first ?? ""),
    more.length > 0 && element("ul", { className: "why-more" }, ...more.map((line) => element("li", {}, line))),
    ...drawings(why, uav, pane),
    why.tells && tells(lastTold(pane, uav, why)),
  ];
  node.append(...parts.filter(Boolean));
  return true;
}

/** What each UAV told last: it speaks when it decides, and senses how fast it is only then. */
const toldOf = new WeakMap();

function lastTold(pane, uav, why) {
  const all = toldOf.get(pane) ?? new Map();
  toldOf.set(pane, all);
  if (pane.frame?.decision && pane.frame.tick === why.tick) all.set(uav, { tick: why.tick, tells: why.tells });
  const last = all.get(uav);
  const isLast = last && why.tick >= last.tick && why.tick - last.tick < pane.scene.chain.decision_ticks;
  return isLast ? last.tells : { ...why.tells, ground_speed_mps: null };
}

function drawings(why, uav, pane) {
  const { scene, frame } = pane;
  const chain = scene.chain;
  const link = frame?.links?.find((link) => link.uav === uav);
  const ahead = frame?.links?.find((link) => link.behind === uav) ?? (why.role === "relay" && !link ? frame?.links?.at(-1) : null);
  const made = [];
  if (why.front || why.back) {
    made.push(
      element("h4", {}, "Its links, as it believes them"),
      linksDrawing(why, {
        ahead: ahead ? `UAV ${ahead.uav}` : "nobody",
        behind: link && link.behind !== null ? `UAV ${link.behind}` : "the base",
        s_min_db: chain.s_min_db,
        colour: (db) => linkColour(db, chain.s_min_db),
      }),
    );
    if (typeof why.imbalance_db === "number") {
      made.push(element("p", { className: "quiet" }, `Front minus back: ${shown(why.imbalance_db, 1, "dB", true)}; ${why.dead_band_db > 0 ? `within ${shown(why.dead_band_db, 1, "dB")} (shaded) it counts as level` : "nothing but 0 counts as level"}. ± is one standard deviation, the pale dot the last packet.`));
    }
  }
  const head = frame && uav === frame.leader ? frame.head : null;
  const marks = head
    ? [
        { name: "pilot asks", mps: head.pilot_mps, kind: "pilot" },
        { name: "allowed", mps: head.allowed_mps, kind: "allowed" },
      ]
    : [
        { name: "its law wishes", mps: why.wish_mps, kind: "pilot" },
        { name: "allowed", mps: why.allowed_mps, kind: "allowed" },
      ];
  const doing = frame?.uavs?.[uav]?.doing;
  if (doing?.launch) made.push(element("p", { className: "why-override" }, "Its launch: ", element("strong", {}, doing.launch)));
  if (why.stage !== "flying") return made;
  marks.push({ name: "flies", mps: frame?.uavs?.[uav]?.forward_mps, kind: "asked" });
  made.push(element("h4", {}, "Forward speed"), speedDrawing(marks, chain.v_max_mps, { label: "Forward speed" }));
  if (why.overridden) made.push(element("p", { className: "why-override" }, "Overridden: ", element("strong", {}, String(why.overridden).replaceAll("-", " "))));
  made.push(...wallsPart({ ...why, pushed_by: doing?.pushed_by }, chain, uav));
  return made;
}

function tells(said) {
  return element("details", { className: "why-tells", open: true }, element("summary", {}, "What it tells the others"), element("dl", {}, ...pairs([
    ["its place", said.place],
    ["ground speed", shown(said.ground_speed_mps, 2, "m/s", true)],
    ["in the air for", Number.isFinite(said.flown_s) ? shown(said.flown_s, 1, "s") : null],
    ["wall choice", wayOf(said.follow)],
    ["imbalance", Number.isFinite(said.imbalance_db) ? shown(said.imbalance_db, 1, "dB", true) : null],
    ["battery", Number.isFinite(said.battery) ? `${shown(100 * said.battery, 0)} %` : null],
  ])));
}
