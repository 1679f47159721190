// Sharing: a link with the whole flight in it, or the flight as a file. Nothing goes over a network: the link is the
// flight.

import { app } from "uchain/app.js";
import { element } from "uchain/hand/element.js";
import { fromLink, MOST_LINK, toHash } from "uchain/hand/files/link.js";
import { openSaid } from "uchain/hand/files/open.js";
import { FileError } from "uchain/hand/files/kinds.js";
import { CANNOT, flightJson, saveFlight } from "uchain/hand/files/save.js";

export function start() {
  document.getElementById("share").addEventListener("click", () => share().catch(failed));
  addEventListener("hashchange", () => location.hash.startsWith("#flight=") && open(location.hash).catch(failed));
}

/** The flight in this page's address; null where there is none, or it is damaged, which is said. */
export async function linked() {
  if (!location.hash.startsWith("#flight=")) return null;
  try {
    return await fromLink(location.hash);
  } catch (fault) {
    failed(fault);
    return null;
  }
}

async function open(link) {
  const flight = await fromLink(link);
  await openSaid(flight);
  app.play();
}

function failed(fault) {
  if (fault instanceof FileError) app.say("error", fault.message);
  else app.fault(fault);
}

async function share(index = 0) {
  const pane = app.panes[index];
  if (!pane) return;
  const json = flightJson(pane);
  if (json === null) {
    app.say("note", CANNOT);
    return;
  }
  const hash = await toHash(json);
  const link = location.href.split("#")[0] + hash;
  const letters = link.length.toLocaleString("en");
  if (link.length > MOST_LINK) {
    shown("Too long for a link", [
      element("p", {}, `The link would have ${letters} letters; beyond ${MOST_LINK.toLocaleString("en")} they are cut on their way. Send the flight as a file: it is dropped on the page.`),
    ], [["Save the file", () => saveFlight(pane)]]);
    return;
  }
  const isFile = location.protocol === "file:";
  const field = element("textarea", { readOnly: true, rows: 4, value: link, "aria-label": "link to this flight", onfocus: () => field.select() });
  const told = element("p", { role: "status", className: "quiet" }, `${letters} letters: scenario, seed and inputs, all in the link. It flies the same, bit for bit.`);
  const hint = isFile ? element("p", { className: "quiet" }, "This page is a file on your machine. Somebody else opens the same page and pastes the link under Open > A link.") : null;
  shown(app.panes.length > 1 ? `Share flight ${"AB"[index]}` : "Share this flight", [field, told, hint], [
    ["Copy the link", async () => (told.textContent = (await copied(link, field)) ? "Copied." : "The browser does not let a page copy here: press Ctrl+C, the link is selected."), true],
    ["Save as a file", () => saveFlight(pane)],
    ...(app.panes.length > 1 ? [[`Share flight ${"BA"[index]} instead`, () => share(1 - index).catch(failed)]] : []),
  ]);
  field.focus();
}

async function copied(link, field) {
  try {
    await navigator.clipboard.writeText(link);
    return true;
  } catch {
    field.focus();
    field.select();
    return document.execCommand("copy");
  }
}

/** Asks for a link that somebody shared. */
export function askForLink() {
  const field = element("textarea", { rows: 4, placeholder: "…#flight=…", "aria-label": "link to a flight" });
  const wrong = element("p", { role: "alert", className: "hand-wrong" });
  shown("Open a link", [element("p", {}, "Paste the link, or its end from #flight= on."), field, wrong], [
    ["Open", async (close) => {
      try {
        await open(field.value);
        close();
      } catch (fault) {
        wrong.textContent = fault.words ?? fault.message;
      }
    }, true],
  ]);
  field.focus();
}

/** A dialog; a way that is to stay open has `true` behind it. */
function shown(title, content, ways) {
  const close = () => dialog.close();
  const dialog = element("dialog", { className: "hand-dialog", "aria-label": title, onclose: () => dialog.remove() },
    element("h2", {}, title), ...content.filter(Boolean),
    element("div", { className: "hand-ways" },
      ...ways.map(([words, run, stays], i) => element("button", { type: "button", className: i === 0 ? "main" : "", onclick: () => (run(close), stays || close()) }, words)),
      element("button", { type: "button", onclick: close }, "Close")));
  document.body.append(dialog);
  dialog.showModal();
}
