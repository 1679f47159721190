// @ts-check
// The colours of the page on canvases: one visual language, colour-blind safe (Okabe and Ito), dark and light.

/** By id, the first six; id 0 is the head. */
const UAVS = ["#D55E00", "#0072B2", "#009E73", "#E69F00", "#CC79A7", "#56B4E9"];

/** A colour's three parts. @param {string} hex */
function parts(hex) {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

/** Between two colours. @param {string} a @param {string} b @param {number} share */
function mix(a, b, share) {
  const [from, to] = [parts(a), parts(b)];
  return `rgb(${from.map((part, i) => Math.round(part + (to[i] - part) * share)).join(" ")})`;
}

/** Loss below s_min from which a link is good, and above it from which it is bad (dB). */
const SPAN_DB = 20;

const LIGHT = {
  dark: false, page: "#ECEAE6", card: "#FAF9F7", line: "#D5D1CA", rock: "#D9D5CF", free: "#FFFFFF", wall: "#554D45", ink: "#222222", soft: "#66615A",
  plate: "#FFFFFFD8", at_s_min: "#C9B400", error: "#B3261E", warning: "#9A6700",
};
const DARK = {
  dark: true, page: "#0F0F0E", card: "#1B1A19", line: "#393733", rock: "#2B2A28", free: "#161616", wall: "#B8AFA4", ink: "#EEEEEE", soft: "#A8A29A",
  plate: "#1B1A19D8", at_s_min: "#F0E442", error: "#FF8A80", warning: "#E69F00",
};

/** The colours of the theme that is on. */
export function palette() {
  return document.documentElement.dataset.theme === "dark" ? DARK : LIGHT;
}

/** The colour of a UAV or robot. @param {number} id */
export function uavColour(id) {
  return UAVS[id % UAVS.length];
}

/** The same for words: darker on light ground, lighter on dark ground, so that thin letters are read. @param {number} id */
export function uavInk(id) {
  return palette().dark ? mix(UAVS[id % UAVS.length], "#FFFFFF", 0.35) : mix(UAVS[id % UAVS.length], "#000000", 0.32);
}

/** Ink that is read on that colour. @param {number} id */
export function onUav(id) {
  return id % UAVS.length === 1 || id % UAVS.length === 0 ? "#FFFFFF" : "#111111";
}

/** The colour of a link by its loss against s_min. @param {number} loss_db @param {number} s_min_db */
export function linkColour(loss_db, s_min_db) {
  const share = Math.max(-1, Math.min(1, (loss_db - s_min_db) / SPAN_DB));
  const middle = palette().at_s_min;
  return share < 0 ? mix(middle, UAVS[1], -share) : mix(middle, UAVS[0], share);
}
