// Files: dropped anywhere on the page or picked, and what is saved. What they are is found out in files/kinds.js, what is
// in them the engine judges; where it refuses, what was flown goes on.

import { app } from "uchain/app.js";
import { element } from "uchain/hand/element.js";
import { editText, plainly, waitingForMap } from "uchain/hand/edit.js";
import { bytesOf, FileError, flightOf, kindOf, READS, sorted, textOf } from "uchain/hand/files/kinds.js";
import { menu } from "uchain/hand/files/menu.js";
import { openSaid } from "uchain/hand/files/open.js";
import { saveFlight, saveRecording, saveToml, stem } from "uchain/hand/files/save.js";
import { askForLink } from "uchain/hand/share.js";
import { key } from "uchain/panel/keys.js";

let picker;
let veil;

export function start() {
  picker = element("input", { type: "file", id: "file-picker", multiple: true, hidden: true, "aria-label": "files to open", onchange: () => takePicked() });
  veil = element("div", { className: "drop-veil", hidden: true }, element("p", {}, "Drop it: a scenario, a recording, a flight, or a map with its picture"));
  document.body.append(picker, veil);
  menu(document.getElementById("open"), () => [
    { words: "Files …", more: "scenario .toml, recording .mcap, .uchain.json, ROS map .yaml with its picture; or drop them on the page", run: () => picker.click() },
    { words: "A link …", more: "paste what somebody shared", run: askForLink },
    { words: "A new scenario …", more: "the text that is flown now, in the editor", run: () => document.getElementById("tab-edit")?.click() },
  ], failed);
  menu(document.getElementById("save"), saves, failed);
  key(["o", "O"], "o", "open files", () => picker.click());
  app.on("scene", endsEarly);
  app.on("grown", endsEarly);
  addEventListener("dragover", over);
  addEventListener("dragleave", (event) => event.relatedTarget === null && (veil.hidden = true));
  addEventListener("drop", dropped);
}

/** Ways to save what is flown. */
function saves() {
  if (app.panes.length === 0) return [{ words: "Nothing to save yet", off: "no flight is open", run: () => {} }];
  return app.panes.flatMap((pane, i) => savesOf(pane, app.panes.length > 1 ? `${"AB"[i]}: ` : ""));
}

function savesOf(pane, which) {
  const lost = pane.scene.recorded && !pane.scene.flies_again ? "not of a recording that cannot be flown again" : null;
  const hasInputs = !pane.explores && !lost && pane.engine.do("inputs").length > 0;
  return [
    hasInputs
      ? { words: `${which}Scenario with your inputs`, more: `${stem(pane)}-by-hand.toml: they are its script, the command line flies it bit for bit`, run: () => saveToml(pane, true), off: lost }
      : null,
    { words: `${which}Scenario`, more: `${stem(pane)}.toml${hasInputs ? ": with the script it had, without your inputs" : ""}`, run: () => saveToml(pane, false), off: lost },
    { words: `${which}Recording`, more: `${stem(pane)}.mcap: for uchain inspect and verify, for Rerun and Foxglove`, run: () => saveRecording(pane) },
    { words: `${which}Flight`, more: `${stem(pane)}.uchain.json: scenario, seed, inputs, map; to be dropped on this page`, run: () => saveFlight(pane), off: lost },
  ].filter(Boolean);
}

function over(event) {
  if (!event.dataTransfer?.types.includes("Files")) return;
  event.preventDefault();
  event.dataTransfer.dropEffect = "copy";
  veil.hidden = false;
}

function dropped(event) {
  veil.hidden = true;
  if (!event.dataTransfer?.types.includes("Files")) return;
  event.preventDefault();
  take([...event.dataTransfer.files]).catch(failed);
}

function takePicked() {
  const files = [...picker.files];
  picker.value = "";
  if (files.length) take(files).catch(failed);
}

function failed(fault) {
  if (fault instanceof FileError) app.say("error", fault.message);
  else app.fault(fault);
}

/** Flights of which it has been said. */
const saidOf = new WeakSet();

/** Says where a recording ends that does not end as one does, wherever it came from. */
function endsEarly(pane) {
  if (saidOf.has(pane) || !["damaged", "cut-short"].includes(pane.stopped?.why)) return;
  saidOf.add(pane);
  app.say("error", `${pane.flight.label}: ${pane.stopped.words}. Up to there it can be looked at.`);
}

/** Opens what files are. @param {File[]} files */
export async function take(files) {
  if (files.length === 0) throw new FileError(`Nothing was dropped that is a file. The page reads ${READS}.`);
  const kinds = sorted(files);
  const one = (kind) => kinds.get(kind)?.[0];
  if (files.length > 1 && (kinds.has("recording") || kinds.has("flight"))) throw new FileError("One flight at a time: drop one recording or one .uchain.json.");
  if (kinds.has("recording")) return takeRecording(one("recording"));
  if (kinds.has("flight")) return flown(flightOf(await textOf(one("flight")), one("flight").name));
  const ofMap = [...kinds.entries()].filter(([kind]) => kind !== "scenario").flatMap(([, files]) => files);
  if (ofMap.length === 0 && (kinds.get("scenario")?.length ?? 0) > 1) throw new FileError("One scenario at a time; Compare shows two side by side.");
  const scenario = one("scenario");
  if (scenario && ofMap.length === 0) return takeScenario(scenario.name, await textOf(scenario));
  return takeMap(ofMap, scenario);
}

async function flown(flight) {
  await openSaid(flight);
  app.play();
}

async function takeRecording(file) {
  const bytes = await bytesOf(file);
  await flown({ kind: "recording", label: file.name, bytes });
}

/** A scenario that is not right goes to the editor, with its error at the line. */
async function takeScenario(name, text) {
  try {
    await flown({ kind: "scenario", label: name, text, seed: 1, inputs: [] });
  } catch (error) {
    if (error.line === undefined || app.panes.length === 0) throw error;
    const hint = error.hint ? ` (${error.hint})` : "";
    app.say("error", `${name}${error.line ? `, line ${error.line}` : ""}: ${plainly(error, name)}${hint}. It is in the editor; what was flown goes on.`);
    editText(text, name);
  }
}

/** A map: with a scenario beside it that scenario is flown in it, without one robots explore it. */
async function takeMap(files, scenario, cell_m = null) {
  const isYaml = (file) => kindOf(file.name) === "yaml";
  if (files.length === 1 && isYaml(files[0])) return askForPicture(files[0], scenario);
  if (!files.some(isYaml) && cell_m === null) return askForCell(files, scenario);
  const all = await Promise.all(files.map(bytesOf));
  const whole = new Uint8Array(all.reduce((sum, bytes) => sum + bytes.length, 0));
  all.reduce((at, bytes) => (whole.set(bytes, at), at + bytes.length), 0);
  const args = { files: files.map((file, i) => ({ name: file.name, bytes: all[i].length })), cell_m };
  const waiting = waitingForMap();
  if (scenario) Object.assign(args, { text: await textOf(scenario), label: scenario.name });
  else if (waiting) Object.assign(args, waiting);
  await flown({ kind: "map", label: files[0].name, asked: args, bytes: whole });
}

/** A ROS map's yaml came without its picture. */
async function askForPicture(yaml, scenario) {
  const named = /^\s*image\s*:\s*["']?([^"'#\n]+?)["']?\s*(?:#.*)?$/m.exec(await textOf(yaml))?.[1] ?? "a .pgm or .png";
  ask(`${yaml.name} describes a map; its picture is missing`, [element("p", {}, "It names ", element("strong", {}, named.split(/[\\/]/).at(-1)), ". A page may not fetch it by itself: choose it, or drop both files together.")],
    [["Choose the picture …", () => pick((file) => takeMap([yaml, ...file], scenario))]]);
}

/** A picture does not say how large its cells are. */
function askForCell(files, scenario) {
  const cell = element("input", { type: "number", min: "0.001", max: "100", step: "any", value: "0.05", id: "cell-m" });
  const read = () => {
    const cell_m = Number(cell.value);
    if (!(cell_m > 0)) throw new FileError("The side of a cell is a number of metres above 0, 0.05 for instance.");
    return takeMap(files, scenario, cell_m);
  };
  ask(`How large is a cell of ${files[0].name}?`, [element("p", {}, "A picture does not say. Side of a cell, one pixel (m): ", cell)],
    [["Read it", read], ["Choose its .yaml …", () => pick((chosen) => takeMap([...files, ...chosen], scenario))]]);
}

function pick(then) {
  const input = element("input", { type: "file", multiple: true, className: "unseen", onchange: () => then([...input.files]).catch(failed) });
  document.body.append(input);
  input.click();
  setTimeout(() => input.remove(), 600_000);
}

/** A question with its answers as buttons. */
function ask(title, content, ways) {
  const close = () => (dialog.close(), dialog.remove());
  const button = ([words, run], i) => element("button", { type: i === 0 ? "submit" : "button", className: i === 0 ? "main" : "", onclick: i === 0 ? null : () => answer(run) }, words);
  const answer = async (run) => {
    try {
      const done = run();
      close();
      await done;
    } catch (fault) {
      failed(fault);
    }
  };
  const form = element("form", { method: "dialog", onsubmit: (event) => (event.preventDefault(), answer(ways[0][1])) }, ...content, element("div", { className: "hand-ways" }, ...ways.map(button), element("button", { type: "button", onclick: close }, "Cancel")));
  const dialog = element("dialog", { className: "hand-dialog", "aria-label": title, onclose: () => dialog.remove() }, element("h2", {}, title), form);
  document.body.append(dialog);
  dialog.showModal();
}
