// What a recording holds of a UAV, where nobody can say why: it cannot be flown again here.

import { element, shown } from "uchain/hand/element.js";
import { pairs, wallsPart } from "uchain/hand/why/walls.js";

export function recordedPart(frame, uav, scene) {
  const lines = [element("p", { className: "quiet" }, "This recording cannot be flown again here, so nobody can say why: it holds what was seen and done, not what was thought.")];
  const body = frame?.uavs?.[uav];
  if (!body) return lines;
  const link = frame.links.find((one) => one.uav === uav);
  const doing = body.doing ?? null;
  lines.push(element("h4", {}, "What it holds"), element("dl", {}, ...pairs([
    ["in the air", body.airborne ? "yes" : "no, on the ground"],
    ["forward speed", shown(body.forward_mps, 2, "m/s", true)],
    ["link to", link ? (link.behind === null ? "the base" : `UAV ${link.behind}`) : null],
    ["its loss, filtered", link && Number.isFinite(link.filtered_db) ? shown(link.filtered_db, 1, "dB") : null],
    ["raw", link && Number.isFinite(link.raw_db) ? shown(link.raw_db, 1, "dB") : null],
    ["overridden by", doing?.overridden ? doing.overridden.replaceAll("-", " ") : null],
    ["its launch", doing?.launch ?? null],
  ])));
  if (body.tof) lines.push(...wallsPart({ tof: body.tof, follow: doing?.follow ?? null, walls: doing ? doing.walls : undefined, pushed_by: doing?.pushed_by }, scene.chain, uav));
  return lines;
}
