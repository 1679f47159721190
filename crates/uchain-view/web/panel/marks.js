// @ts-check
// How events look: which row of the time line they are in, and their sign.

/** Rows of the time line, top to bottom. */
export const ROWS = [
  { name: "launches", words: "launches" },
  { name: "overrides", words: "overrides" },
  { name: "links", words: "links" },
  { name: "contacts", words: "contacts" },
];

const KINDS = [
  [/took-off|launch/, "launches", "▲"],
  [/failed/, "launches", "✕"],
  [/link-lost/, "links", "✕"],
  [/link/, "links", "●"],
  [/contact|level-pass/, "contacts", "◆"],
  [/override|wall|holds|keeps-clear|head-stop|retreat|spacing|push/, "overrides", "■"],
  [/purpose|over/, "launches", "▲"],
];

/** The row and sign of an event. @param {{kind: string}} event */
export function lookOf(event) {
  const found = KINDS.find(([pattern]) => /** @type {RegExp} */ (pattern).test(event.kind));
  return found ? { row: /** @type {string} */ (found[1]), sign: /** @type {string} */ (found[2]) } : { row: "overrides", sign: "•" };
}
