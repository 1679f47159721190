// A flight as the end of an address: deflated JSON in base64url, behind "#flight=".

import { FileError, flightOf } from "uchain/hand/files/kinds.js";

/** Longer links are cut by mail programs and messengers (letters). */
export const MOST_LINK = 30_000;
/** A link that holds more than this is not unpacked (bytes): a small one could hold gigabytes of zeros. */
const MOST_UNPACKED = 16 * 1024 * 1024;
const MARK = "#flight=";

/** Through a stream, given up past `most` bytes. */
async function through(bytes, transform, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(transform).getReader();
  const parts = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > most) {
      reader.cancel().catch(() => {});
      throw new FileError("This link holds far more than a flight can be; it was not unpacked.");
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** "#flight=..." of a flight as JSON. */
export async function toHash(json) {
  const packed = await through(new TextEncoder().encode(json), new CompressionStream("deflate-raw"), Infinity);
  let letters = "";
  for (let at = 0; at < packed.length; at += 32_768) letters += String.fromCharCode(...packed.subarray(at, at + 32_768));
  return MARK + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The flight of an address or of its end; throws in words where there is none in it. */
export async function fromLink(link) {
  const at = link.indexOf(MARK);
  if (at < 0) throw new FileError(`This is no link to a flight: it has no "${MARK}" in it. Share makes such links.`);
  const code = link.slice(at + MARK.length).trim();
  const cut = new FileError("This link is damaged or was cut off on its way: ask for the flight as a file.");
  let json;
  try {
    const letters = atob(code.replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const raw = await through(packed, new DecompressionStream("deflate-raw"), MOST_UNPACKED);
    json = new TextDecoder("utf-8", { fatal: true }).decode(raw);
  } catch (fault) {
    throw fault instanceof FileError ? fault : cut;
  }
  return flightOf(json, "this link");
}
