// The scenario as text: checked while it is typed, explained at the caret, flown with Ctrl+Enter. What is flown goes on
// until then.

import { app } from "uchain/app.js";
import { Engine } from "uchain/engine.js";
import { element } from "uchain/hand/element.js";
import { Cards } from "uchain/hand/edit/cards.js";
import { CornerHandles } from "uchain/hand/edit/handles.js";
import { TextPanel } from "uchain/hand/edit/text.js";
import { keyAt, lineOf, setting, statements } from "uchain/hand/edit/toml.js";
import { openSaid } from "uchain/hand/files/open.js";
import { saveText } from "uchain/hand/files/save.js";
import { SEEDS, seedOf } from "uchain/hand/seed.js";
import { show as showTab } from "uchain/panel/tabs.js";
import { key } from "uchain/panel/keys.js";

/** Checked so long after the last key (ms). */
const CHECK_MS = 250;
/** Walls longer than this take too long to be laid out while somebody types (letters). */
const MOST_WALLS = 100_000;
/** A text longer than this is no scenario of anybody's. */
const MOST_LETTERS = 4_000_000;

let panel;
let text;
let cards;
let handles;
let verdict;
let seed;
let flyButton;
let sameInputs;
let which;
/** The pane whose text is edited. */
let target = 0;
/** Texts that were changed and not flown yet, by pane; `label` where it is another scenario than what is flown. */
const drafts = new WeakMap();
let timer = 0;
let lastError = null;
/** Reads scenarios whose walls are a map's; the flight's own engine flies on. @type {Engine|null} */
let beside = null;
/** The flights of recordings, asked once: their walls may be long. */
const known = new WeakMap();

export function start() {
  panel = document.getElementById("edit");
  Engine.start().then((engine) => (beside = engine)).catch((fault) => app.fault(fault));
  text = new TextPanel({ label: "the scenario as text (TOML)", changed: typed, moved, enter: fly });
  cards = new Cards({ ask: (key) => pane().engine.do("explain", { key }).cards, put });
  handles = new CornerHandles({ text: () => text.text, edit: (edits) => text.edit(edits), drawn: () => check() && fly() });
  verdict = element("p", { id: "edit-verdict", className: "edit-verdict", role: "status", onclick: () => lastError?.line && text.goToLine(lastError.line, lastError.column ?? 1) });
  seed = element("input", { type: "text", inputMode: "numeric", value: "1", id: "edit-seed", onkeydown: (event) => event.key === "Enter" && fly() });
  sameInputs = element("input", { type: "checkbox", checked: true });
  flyButton = element("button", { type: "button", className: "main", onclick: fly, title: "Ctrl+Enter", "aria-keyshortcuts": "Control+Enter" }, "Fly this text");
  which = element("div", { className: "edit-which", role: "group", "aria-label": "Which flight is edited", hidden: true });
  panel.append(
    which,
    element("div", { className: "edit-row" },
      flyButton,
      element("label", {}, "seed ", seed),
      element("label", { className: "edit-same", hidden: true }, sameInputs, element("span", {}, "same inputs")),
      element("button", { type: "button", onclick: () => saveText(pane(), text.text), title: "Save this text as a TOML file" }, "Save TOML")),
    text.node,
    verdict,
    element("p", { className: "quiet edit-corners", hidden: true }, "Corners of the corridor can be dragged on the map (or Tab to one and move it with the arrow keys). Ctrl+Z in the text takes it back."),
    cards.node,
  );
  app.on("scene", opened);
  app.on("panes", panesChanged);
  app.on("tab", (name) => {
    showHandles();
    showInputs();
    if (name === "edit") check();
  });
  app.on("mode", () => {
    showHandles();
    showInputs();
  });
  app.on("draw", () => handles.place());
  key(["e", "E"], "e", "edit the scenario", () => {
    showTab("edit");
    text.area.focus();
  });
}

const pane = () => app.panes[Math.min(target, app.panes.length - 1)];

/** Opens the editor on another scenario, which is not right yet, with its error at the line. What is flown goes on. */
export function editText(draft, label) {
  showTab("edit");
  drafts.set(pane(), { text: draft, label });
  text.open(draft);
  check();
  showHandles();
  text.area.focus();
}

/** A scenario in the editor whose map was missing: `{text, label}`; null = there is none. */
export function waitingForMap() {
  const draft = drafts.get(pane());
  return draft?.label && namesMap(draft.text) ? draft : null;
}

/** Edits the text of this pane from now on. */
export function editPane(index) {
  target = index;
  load();
  panesChanged();
}

/** Sets a key in the text, as if typed. */
export function put(path, value) {
  const change = setting(text.text, path, value);
  text.edit([change]);
  const at = change.from + change.text.length - value.length;
  text.goTo(Math.max(0, Math.min(at, text.text.length)), Math.min(at + value.length, text.text.length));
}

function opened(flown) {
  if (flown !== pane()) return;
  load();
}

/** Shows the target's text; where it is just what is there, Ctrl+Z goes on working. */
function load() {
  const of = pane();
  if (!of) return;
  const wanted = drafts.get(of)?.text ?? of.scene.text ?? "";
  if (text.text !== wanted) text.open(wanted);
  seed.value = String(of.scene.seed ?? 1);
  showInputs();
  showHandles();
  check();
}

/** Corners can be dragged while the text is edited, and nobody steers. */
function showHandles() {
  const isHere = !panel.hidden && app.mode === "watch" && pane() && !drafts.get(pane())?.label;
  handles.shown(isHere ? pane() : null);
}

function panesChanged() {
  target = Math.min(target, Math.max(0, app.panes.length - 1));
  which.hidden = app.panes.length < 2;
  which.replaceChildren(...app.panes.map((_, i) => element("button", { type: "button", "aria-pressed": String(i === target), onclick: () => editPane(i) }, `Flight ${"AB"[i]}`)));
}

function showInputs() {
  const has = !drafts.get(pane())?.label && (app.mode === "fly" || inputsOf(pane()).length > 0);
  panel.querySelector(".edit-same").hidden = !has;
}

function inputsOf(of) {
  try {
    return of && !of.explores ? of.engine.do("inputs") : [];
  } catch {
    return [];
  }
}

function typed() {
  drafts.set(pane(), { text: text.text, label: drafts.get(pane())?.label ?? null });
  clearTimeout(timer);
  timer = setTimeout(check, CHECK_MS);
  flyButton.classList.toggle("is-due", text.text !== pane()?.scene.text);
}

function moved() {
  cards.show(keyAt(text.text, text.caret));
}

/** Asks the engine whether the text is right, and says what is not, at its line. True = it is. */
function check() {
  clearTimeout(timer);
  const of = pane();
  if (!of) return false;
  flyButton.classList.toggle("is-due", text.text !== of.scene.text);
  panel.querySelector(".edit-corners").hidden = !statements(text.text).some((one) => one.path === "map.corridor.centre_line_m");
  handles.place();
  if (text.text === "" && of.scene.recorded) {
    return verdictIs("none", "This recording does not hold its scenario: there is no text to edit.");
  }
  if (text.text.length > MOST_LETTERS) return verdictIs("error", "This text is longer than any scenario: 4 million letters are read.");
  try {
    const ok = looked(of);
    lastError = null;
    text.mark(null);
    if (!ok) return verdictIs("ok", "Nothing wrong so far; in a map as large as this one the rest is looked at with Ctrl+Enter.") || true;
    const notes = (ok.notes ?? []).join("; ");
    const crew = Number.isFinite(ok.crew) ? `${ok.crew} ${ok.mission === "exploration" ? "robots" : "UAVs"}, ` : "";
    const due = text.text === of.scene.text ? "" : " Ctrl+Enter flies it.";
    return verdictIs("ok", `Right: ${crew}${ok.duration_s} s.${notes && ` Note: ${notes}.`}${due}`) || true;
  } catch (error) {
    fail(error);
    return false;
  }
}

function fail(error) {
  lastError = error;
  error.line ??= lineOfKey(error.key);
  text.mark(error.line);
  const where = error.line ? `Line ${error.line}: ` : "";
  verdictIs("error", `${where}${plainly(error, labelOf(pane()))}${error.hint ? `\n${error.hint}` : ""}`);
}

/** Where an error names a key and no line. */
function lineOfKey(path) {
  const at = path ? statements(text.text).find((one) => one.path === path) : null;
  return at ? lineOf(text.text, at.from).line : null;
}

function verdictIs(kind, words) {
  verdict.className = `edit-verdict ${kind}`;
  verdict.textContent = words;
  return false;
}

/** What the engine makes of the text. In walls of a map file it is laid out in an engine beside, which flies nothing. */
function looked(of) {
  // What flies is right.
  if (text.text === of.scene.text) return of.scene;
  const walls = carried(of);
  if (!walls.walls_csv || !beside || walls.walls_csv.length > MOST_WALLS) return unlaid(of, Boolean(walls.walls_csv));
  return beside.do("open", { flight: { ...walls, kind: "scenario", label: labelOf(of), text: text.text, seed: 1 } });
}

/** The text alone; `hasWalls`: that its map is a file which is not there is no error, for its walls are here. */
function unlaid(of, hasWalls) {
  try {
    return of.engine.do("check", { text: text.text, label: labelOf(of) });
  } catch (error) {
    if (!hasWalls || !/^map\.\w+\.file$/.test(error.key ?? "")) throw error;
    return null;
  }
}

const labelOf = (of) => drafts.get(of)?.label ?? of.scene.label ?? `${of.scene.name}.toml`;

/** An error's words without the name and line before them. */
export function plainly(error, label) {
  const message = String(error.message);
  return [`${label}:${error.line}: `, `${label}: `].reduce((words, before) => (words.startsWith(before) ? words.slice(before.length) : words), message);
}

/** Whether a scenario's map is a file, so that its walls come from elsewhere. */
const namesMap = (toml) => statements(toml).some((one) => /^map\.\w+\.file$/.test(one.path));

/** What of a flight stays when its text changes: the walls of its map file. Walls that stand in the text are read from it. */
function carried(of) {
  if (drafts.get(of)?.label || !namesMap(text.text)) return {};
  const { walls_csv = null, map_offset_m = null } = wallsOf(of);
  return { walls_csv, map_offset_m };
}

function wallsOf(of) {
  if (of.flight.kind !== "recording") return of.flight;
  if (!known.has(of)) known.set(of, of.engine.do("flight"));
  return known.get(of);
}

/** Flies the text; where it is not right, what is flown goes on. */
async function fly() {
  const of = pane();
  if (!of) return;
  const number = seedOf(seed.value);
  if (number === null) {
    verdictIs("error", `The seed is ${SEEDS}.`);
    seed.focus();
    return;
  }
  const flown = text.text;
  const isOther = Boolean(drafts.get(of)?.label);
  const inputs = sameInputs.checked && !isOther ? inputsOf(of) : [];
  try {
    await openSaid({ ...carried(of), kind: "scenario", label: labelOf(of), text: flown, seed: number, inputs }, app.panes.indexOf(of));
    drafts.delete(of);
    app.play();
  } catch (error) {
    if (error.line === undefined) return app.fault(error);
    fail(error);
  }
}
