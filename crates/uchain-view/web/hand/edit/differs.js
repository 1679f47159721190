// Which keys two scenarios write otherwise.

import { statements } from "uchain/hand/edit/toml.js";

/** Values longer than this are not shown whole (letters). */
const MOST_LETTERS = 40;

/**
 * Keys that are not written alike, in the order of the second text; null = not written.
 * @returns {{path: string, one: string|null, other: string|null}[]}
 */
export function differingKeys(one, other) {
  const [a, b] = [written(one), written(other)];
  const paths = [...b.keys(), ...[...a.keys()].filter((path) => !b.has(path))];
  return paths.map((path) => ({ path, one: a.get(path) ?? null, other: b.get(path) ?? null })).filter((at) => at.one !== at.other);
}

/** Values by key, however they are laid out. */
function written(text) {
  const keys = statements(text).filter((entry) => entry.kind === "key");
  return new Map(keys.map((entry) => [entry.path, plain(text.slice(entry.valueFrom, entry.to))]));
}

/** A list over several lines is the same as in one; what stands in quotation marks stays. */
function plain(value) {
  if (!/^[[{]/.test(value)) return value;
  const parts = value.match(/"[^"\n]*"|'[^'\n]*'|#[^\n]*|[^"'#]+/g) ?? [];
  const packed = parts.map((part) => (part[0] === "#" ? "" : /^["']/.test(part) ? part : part.replace(/\s+/g, ""))).join("");
  return packed.replaceAll(",]", "]").replaceAll(",", ", ");
}

/** A value, cut where it is long. */
export function short(value) {
  return value.length > MOST_LETTERS ? `${value.slice(0, MOST_LETTERS - 1)}…` : value;
}
