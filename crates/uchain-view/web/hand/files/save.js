// Takes things home: a scenario, a recording, a flight. Names of files say scenario and seed.

import { app } from "uchain/app.js";
import { element } from "uchain/hand/element.js";

/** Why there is neither link nor file of some flights. */
export const CANNOT = "A recording that cannot be flown again here has no link and no flight file: send the recording, run.mcap.";

/** Longest that a slice of recording should take (ms). */
const SLICE_MS = 8;

/** What a file of this flight is called, without its ending: circuit-s1. */
export function stem(pane) {
  const name = String(pane.scene.label ?? pane.scene.name ?? "flight").split(/[\\/]/).at(-1).replace(/, scenario$/, "").replace(/(\.uchain)?\.(toml|mcap|json|yaml|map|csv)$/i, "");
  const plain = name.replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^[-.]+|-+$/g, "").slice(0, 80) || "flight";
  const seed = pane.scene.seed ?? "";
  const ending = `-s${seed}`;
  if (app.panes.length > 1 && pane === app.panes[1]) return `${plain.replace(new RegExp(`${ending}$`), "")}-b${ending}`;
  return seed === "" || plain.endsWith(ending) ? plain : `${plain}${ending}`;
}

/** Gives a file to the browser's downloads. */
export function download(name, parts, type) {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  const link = element("a", { href: url, download: name, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** The text in the editor, as it stands. */
export function saveText(pane, text) {
  download(`${stem(pane)}.toml`, [text], "application/toml");
}

/** The scenario that is flown; `byHand`: its inputs as its script, so that the command line flies the same. */
export function saveToml(pane, byHand) {
  const { text } = pane.engine.do("toml", { by_hand: byHand });
  const name = `${stem(pane)}${byHand ? "-by-hand" : ""}.toml`;
  download(name, [text], "application/toml");
  app.say("note", `${name} saved. It flies the same, bit for bit: uchain run ./${name} --seed ${pane.scene.seed ?? 1}`);
}

/** The flight for others, as JSON; null where it can only be looked at. */
export function flightJson(pane) {
  if (pane.scene.recorded && !pane.scene.flies_again) return null;
  return JSON.stringify(pane.engine.do("flight"));
}

export function saveFlight(pane) {
  const json = flightJson(pane);
  if (json === null) return app.say("note", CANNOT);
  const name = `${stem(pane)}.uchain.json`;
  download(name, [json], "application/json");
  app.say("note", `${name} saved. Drop it on this page, and the flight is there again.`);
}

/**
 * Flies once more into a recording, a slice per animation frame, with its progress on the page.
 * Returns its bytes; null = it was cancelled.
 */
export function record(pane) {
  return new Promise((resolve, reject) => {
    const last = Math.max(1, pane.end);
    let ticks = 20;
    let isOff = false;
    const bar = element("progress", { max: last, value: 0, "aria-label": "recording" });
    const share = element("span", {}, "0 %");
    const dialog = element("dialog", { className: "hand-dialog", "aria-label": "Recording", oncancel: () => (isOff = true) },
      element("h2", {}, "Flying it again into a recording"), element("p", {}, bar, " ", share),
      element("button", { type: "button", onclick: () => (isOff = true) }, "Cancel"));
    document.body.append(dialog);
    dialog.showModal();
    const end = (how) => {
      dialog.close();
      dialog.remove();
      how();
    };
    const slice = () => {
      if (isOff) return end(() => resolve(null));
      try {
        const until = performance.now() + SLICE_MS;
        let now = performance.now();
        do {
          const answer = pane.engine.do("record", { ticks });
          if (answer.done) {
            const bytes = pane.engine.payload();
            return end(() => resolve(bytes));
          }
          const took_ms = performance.now() - now;
          ticks = Math.max(1, Math.min(20_000, Math.round(ticks * Math.min(2, SLICE_MS / 2 / Math.max(took_ms, 0.05)))));
          now += took_ms;
          bar.value = answer.tick;
          share.textContent = `${Math.round((100 * answer.tick) / last)} %`;
        } while (now + SLICE_MS / 2 < until);
        requestAnimationFrame(slice);
      } catch (fault) {
        end(() => reject(fault));
      }
    };
    requestAnimationFrame(slice);
  });
}

export async function saveRecording(pane) {
  const wasPlaying = app.playing;
  app.pause();
  const bytes = pane.scene.recorded && pane.flight.kind === "recording" ? pane.flight.bytes : await record(pane);
  if (wasPlaying) app.play();
  if (bytes === null) return app.say("note", "Recording cancelled; nothing was saved.");
  const name = `${stem(pane)}.mcap`;
  download(name, [bytes], "application/octet-stream");
  app.say("note", `${name} saved. To fly it again and compare every bit: uchain verify ${name}`);
}
