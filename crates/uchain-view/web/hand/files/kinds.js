// What files are, by their names and first bytes, before anything big of them is read.

import { SEEDS, seedOf } from "uchain/hand/seed.js";

/** More than this is not read at all (bytes). */
export const MOST_BYTES = 64 * 1024 * 1024;
/** Texts are short. */
const MOST_TEXT_BYTES = 8 * 1024 * 1024;

/** Pictures that are read, and some that are not but are easily made into such. */
const PICTURES = ["pgm", "png"];
const OTHER_PICTURES = ["pbm", "ppm", "bmp", "jpg", "jpeg", "gif", "tif", "tiff", "webp", "svg"];

/** What the page reads, for people. */
export const READS = "a scenario (.toml), a recording (run.mcap), a flight that was shared (.uchain.json), or a ROS map: its .yaml together with its picture (.pgm, .png)";

/** Something that is wrong with a file, in words for the person who chose it. */
export class FileError extends Error {}

/** "recording", "flight", "scenario", "yaml", "picture"; null = nothing that is read here. */
export function kindOf(name) {
  const lower = name.toLowerCase();
  if (lower.endsWith(".mcap")) return "recording";
  if (lower.endsWith(".json")) return "flight";
  const ending = lower.slice(lower.lastIndexOf(".") + 1);
  if (ending === "toml") return "scenario";
  if (ending === "yaml" || ending === "yml") return "yaml";
  if (PICTURES.includes(ending)) return "picture";
  return null;
}

export function size(bytes) {
  if (bytes < 1024) return `${bytes} bytes`;
  return bytes < 1024 * 1024 ? `${(bytes / 1024).toFixed(0)} KB` : `${(bytes / 1024 / 1024).toFixed(1)} MB`;
}

/** Throws in words where files are too large, before a byte of them is read; returns them by kind. */
export function sorted(files) {
  const kinds = new Map();
  const whole = files.reduce((sum, file) => sum + file.size, 0);
  const largest = [...files].sort((a, b) => b.size - a.size)[0];
  if (whole > MOST_BYTES) {
    const remedy = kindOf(largest.name) === "recording" ? "Open its scenario and fly it here, or look into the file with `uchain inspect`." : "Cut the map down to the part that is flown, or give it larger cells.";
    throw new FileError(`${largest.name} is ${size(largest.size)}; this page reads up to 64 MB. ${remedy}`);
  }
  for (const file of files) {
    const kind = kindOf(file.name);
    if (OTHER_PICTURES.some((ending) => file.name.toLowerCase().endsWith(`.${ending}`))) throw new FileError(`${file.name}: pictures of maps are read as .pgm or .png; save it as one of these.`);
    if (/\.(map|csv)$/i.test(file.name)) throw new FileError(`${file.name}: this kind of map is opened by the command line: uchain view, with a scenario that names it or with the map itself.`);
    if (kind === null) throw new FileError(`${file.name} is nothing that this page reads: ${READS}.`);
    if (file.size === 0) throw new FileError(`${file.name} is empty. The page reads ${READS}.`);
    if (["scenario", "flight", "yaml"].includes(kind) && file.size > MOST_TEXT_BYTES) throw new FileError(`${file.name} is ${size(file.size)}: no ${kind} is that long.`);
    kinds.set(kind, [...(kinds.get(kind) ?? []), file]);
  }
  return kinds;
}

/** The text of a file; throws in words where it is none. */
export async function textOf(file) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
  } catch (fault) {
    if (fault instanceof TypeError) throw new FileError(`${file.name} is no text (UTF-8), although its name says so.`);
    throw new FileError(`${file.name} could not be read: ${fault.message}`);
  }
}

export async function bytesOf(file) {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch (fault) {
    throw new FileError(`${file.name} could not be read: ${fault.message}`);
  }
}

function recordingOf(base64, name) {
  if (typeof base64 !== "string") throw new FileError(`${name} is no flight of this page: it has no "base64", the recording.`);
  try {
    const letters = atob(base64);
    const bytes = new Uint8Array(letters.length);
    for (let at = 0; at < letters.length; at += 1) bytes[at] = letters.charCodeAt(at);
    return bytes;
  } catch {
    throw new FileError(`${name}: the recording in it is damaged, it is no base64.`);
  }
}

/** A flight as JSON, looked at before it goes to the engine; what is in it the engine judges. */
export function flightOf(text, name) {
  let flight;
  try {
    flight = JSON.parse(text);
  } catch (fault) {
    throw new FileError(`${name} is no flight: it is not JSON (${fault.message}).`);
  }
  if (typeof flight !== "object" || flight === null || !["scenario", "recording"].includes(flight.kind)) {
    throw new FileError(`${name} is no flight of this page: it lacks "kind": "scenario" or "recording". Save > Flight writes one.`);
  }
  if (flight.kind === "scenario" && typeof flight.text !== "string") throw new FileError(`${name} is no flight of this page: it has no "text", the scenario.`);
  const label = typeof flight.label === "string" ? flight.label : name;
  if (flight.kind === "recording") return { kind: "recording", label, bytes: recordingOf(flight.base64, name) };
  if (flight.seed !== undefined && seedOf(flight.seed) === null) throw new FileError(`${name}: its seed ${flight.seed} is none: expected ${SEEDS}, in quotes beyond ${Number.MAX_SAFE_INTEGER}.`);
  return { ...flight, label };
}
