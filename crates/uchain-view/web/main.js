// @ts-check
// The page begins: its parts are started, and the flight that came with it is opened.

import { app } from "uchain/app.js";
import { Engine } from "uchain/engine.js";
import * as stage from "uchain/draw/stage.js";
import * as compare from "uchain/hand/compare.js";
import * as edit from "uchain/hand/edit.js";
import * as files from "uchain/hand/files.js";
import * as fly from "uchain/hand/fly.js";
import { flightOf } from "uchain/hand/files/kinds.js";
import * as share from "uchain/hand/share.js";
import * as why from "uchain/hand/why.js";
import * as bar from "uchain/panel/bar.js";
import * as events from "uchain/panel/events.js";
import * as keys from "uchain/panel/keys.js";
import * as layers from "uchain/panel/layers.js";
import * as say from "uchain/panel/say.js";
import * as tabs from "uchain/panel/tabs.js";
import * as timeline from "uchain/panel/time/timeline.js";
import * as welcome from "uchain/panel/welcome.js";

/** The flight that was put into this page; null = it has none, or none that can be flown, which is said. */
function brought() {
  const text = document.getElementById("flight")?.textContent;
  if (!text) return null;
  try {
    return flightOf(text, "The flight in this page");
  } catch (fault) {
    app.say("error", /** @type {Error} */ (fault).message);
    return null;
  }
}

async function begin() {
  for (const part of [say, keys, stage, tabs, bar, layers, timeline, events, welcome, why, fly, edit, files, share, compare]) part.start();
  bar.list(await Engine.start());
  const flight = brought() ?? (await share.linked());
  if (flight) await app.open(flight).catch((fault) => app.fault(fault));
  if (!app.panes.length) {
    await bar.fly("circuit", 1);
    welcome.show();
  }
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) app.play();
}

Object.assign(window, { uchain: app });
app.start();
begin().catch((fault) => app.fault(fault));
