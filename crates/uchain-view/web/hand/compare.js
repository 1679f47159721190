// Two flights side by side under one cursor: the second begins as the first, with one thing changed.

import { app } from "uchain/app.js";
import { element } from "uchain/hand/element.js";
import { differingKeys, short } from "uchain/hand/edit/differs.js";
import { setting } from "uchain/hand/edit/toml.js";
import { openSaid } from "uchain/hand/files/open.js";
import { SEEDS, seedOf } from "uchain/hand/seed.js";
import { editPane } from "uchain/hand/edit.js";
import { views } from "uchain/draw/stage.js";
import { show as showTab } from "uchain/panel/tabs.js";

/** More keys that differ than these are counted, not named. */
const MOST_NAMED = 3;
/** Things worth changing, to begin with: a key, what it becomes, and words. */
const IDEAS = [
  ["equalize.law", '"bang-bang"', "relays jump instead of creeping"],
  ["link.signal", '"raw"', "relays believe every packet"],
  ["center.law", '"paper"', "walls are kept as printed in the paper"],
  ["radio.sigma_db", "0", "radio without noise"],
  ["chain.uavs", "3", "one UAV fewer"],
];

let keys = null;

export function start() {
  const button = document.getElementById("compare");
  button.addEventListener("click", () => (app.panes.length > 1 ? close() : ask()));
  for (const name of ["panes", "scene", "mode"]) app.on(name, shown);
  app.on("grown", outcomes);
  app.on("cursor", outcomes);
}

function close() {
  editPane(0);
  app.close();
}

function shown() {
  const two = app.panes.length > 1;
  const button = document.getElementById("compare");
  button.textContent = two ? "Close B" : "Compare";
  button.setAttribute("aria-pressed", String(two));
  app.panes.forEach((_, i) => {
    const section = views[i]?.section;
    section?.querySelector(".compare-line")?.remove();
    if (!section) return;
    if (two) section.dataset.letter = "AB"[i];
    else delete section.dataset.letter;
    if (!two) return;
    section.querySelector("header").append(element("div", { className: "compare-line" },
      element("p", { className: "compare-differs" }, i === 0 ? "As it is" : difference()),
      i === 1 && element("button", { type: "button", className: "small", onclick: close, "aria-label": "Close flight B" }, "✕"),
      element("p", { className: "compare-outcome", role: "status" })));
  });
  outcomes();
}

/** What B has otherwise than A, in words. */
function difference() {
  const [a, b] = app.panes;
  const said = [];
  if (a.scene.seed !== b.scene.seed) said.push(`seed ${b.scene.seed} instead of ${a.scene.seed}`);
  const keys = differingKeys(a.scene.text ?? "", b.scene.text ?? "");
  for (const { path, one, other } of keys.slice(0, MOST_NAMED)) {
    if (other === null) said.push(`without ${path} = ${short(one)}`);
    else said.push(`${path} = ${short(other)}${one === null ? "" : ` instead of ${short(one)}`}`);
  }
  if (keys.length > MOST_NAMED) said.push(`and ${keys.length - MOST_NAMED} keys more`);
  const [ia, ib] = [a, b].map((pane) => JSON.stringify(pane.explores ? [] : pane.engine.do("inputs")));
  if (ia !== ib) said.push("other inputs by hand");
  return said.length ? said.join("; ") : "the same as A so far: change something under Edit";
}

/** How each came out, once it is over. */
function outcomes() {
  if (app.panes.length < 2) return;
  app.panes.forEach((pane, i) => {
    const line = views[i]?.section.querySelector(".compare-outcome");
    if (!line) return;
    const words = outcome(pane);
    if (line.textContent !== words) line.textContent = words;
  });
}

const told = new WeakMap();

function outcome(pane) {
  if (!pane.stopped) return "still flying …";
  let known = told.get(pane);
  if (known?.tick !== pane.tick) {
    let words = pane.stopped.words;
    try {
      words = pane.engine.do("summary").verdict ?? words;
    } catch {
      // A recording that holds no summary: how it stopped is all there is to say.
    }
    known = { tick: pane.tick, words };
    told.set(pane, known);
  }
  return known.words;
}

/** Asks for the one thing that is to be different. */
function ask() {
  const pane = app.panes[0];
  if (!pane) return;
  if (pane.scene.recorded && !pane.scene.text) {
    app.say("note", "This recording does not hold its scenario, so nothing in it can be changed to compare.");
    return;
  }
  const key = element("input", { type: "text", list: "compare-keys", id: "compare-key", placeholder: "equalize.law", autocomplete: "off", spellcheck: false, oninput: () => explained() });
  const value = element("input", { type: "text", id: "compare-value", placeholder: '"bang-bang"', autocomplete: "off", spellcheck: false });
  const seed = element("input", { type: "text", inputMode: "numeric", id: "compare-seed", value: String(pane.scene.seed ?? 1) });
  const card = element("p", { className: "quiet" });
  const wrong = element("p", { className: "hand-wrong", role: "alert" });
  keys ??= listed(pane);
  const explained = () => (card.textContent = keys.find((one) => one.key === key.value)?.meaning ?? "");
  const idea = ([path, toml, words]) => element("button", { type: "button", className: "small", title: words, onclick: () => {
    [key.value, value.value] = [path, toml];
    explained();
  } }, `${path} = ${toml}`);
  const ideas = pane.explores ? [] : IDEAS;
  const form = element("form", { onsubmit: (event) => (event.preventDefault(), go()) },
    element("p", {}, "B flies the same scenario with the same seed: the same noise. What shall be different?"),
    element("div", { className: "compare-fields" }, element("label", {}, "key ", key), element("label", {}, "= ", value), element("label", {}, "seed ", seed)),
    element("datalist", { id: "compare-keys" }, ...keys.map((one) => element("option", { value: one.key }))),
    card,
    ideas.length > 0 && element("p", { className: "compare-ideas" }, "for instance ", ...ideas.map(idea)),
    wrong,
    element("div", { className: "hand-ways" },
      element("button", { type: "submit", className: "main" }, "Fly both"),
      element("button", { type: "button", onclick: () => go(true) }, "Nothing yet: I edit B"),
      element("button", { type: "button", onclick: () => dialog.close() }, "Cancel")));
  const dialog = element("dialog", { className: "hand-dialog", "aria-label": "Compare with another flight", onclose: () => dialog.remove() }, element("h2", {}, "Compare with …"), form);
  const go = async (isSame = false) => {
    wrong.textContent = "";
    try {
      await open(pane, isSame ? null : { path: key.value.trim(), value: value.value.trim(), seed: seedOf(seed.value) });
      dialog.close();
    } catch (fault) {
      wrong.textContent = fault.words ?? fault.message;
    }
  };
  document.body.append(dialog);
  dialog.showModal();
  key.focus();
}

function listed(pane) {
  return pane.engine.do("explain", { key: "" }).cards.filter((card) => !card.is_table);
}

/** Opens B; throws where it cannot be flown. `change` null: B is to be edited. */
async function open(pane, change) {
  const flight = pane.engine.do("flight");
  if (change) {
    if (change.path === "" && change.seed === pane.scene.seed) throw new Error("Name a key and its value, or another seed.");
    if (change.seed === null) throw new Error(`The seed is ${SEEDS}.`);
    flight.seed = change.seed;
    if (change.path !== "") {
      const place = setting(flight.text, change.path, asToml(change.value));
      flight.text = flight.text.slice(0, place.from) + place.text + flight.text.slice(place.to);
    }
  }
  const { cursor } = app;
  await openSaid(flight, 1);
  app.seek(cursor);
  if (change) app.play();
  else {
    editPane(1);
    showTab("edit");
  }
}

/** A word without its quotation marks gets them. */
function asToml(value) {
  if (value === "") throw new Error("The key needs a value.");
  if (/[\n\r]/.test(value)) throw new Error("A value is one line.");
  return /^[A-Za-z][\w-]*$/.test(value) && !["true", "false", "inf", "nan"].includes(value) ? `"${value}"` : value;
}
