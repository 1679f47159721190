// What is known of a robot of an exploration at the cursor: where it goes and what for.

import { element, shown } from "uchain/hand/element.js";

/** What a purpose means. */
const PURPOSES = {
  explore: "It flies along a frontier, to see what is behind it",
  backtrack: "It flies back along the graph, to a node that has a frontier left",
  home: "It flies home along the graph",
  park: "It is home and stays: it knows of no frontier that it can reach",
  wait: "It waits: it has not looked round yet, or knows no way",
};

export function robotWhy(robot, number, scene) {
  if (!robot) return [element("p", { className: "quiet" }, "Nothing is known of it at this instant.")];
  const purpose = PURPOSES[robot.purpose] ?? String(robot.purpose);
  const held = robot.holds ? ", and holds now to let another one pass" : "";
  const rows = [
    ["at", `${shown(robot.x_m, 2)}, ${shown(robot.y_m, 2)} m`],
    ["target", Array.isArray(robot.to_m) ? `${shown(robot.to_m[0], 2)}, ${shown(robot.to_m[1], 2)} m` : null],
    ["height", Number.isFinite(robot.z_m) ? shown(robot.z_m, 2, "m") : null],
    ["level", Number.isInteger(robot.level) && scene.exploration?.level_z_m?.length > 1 ? robot.level : null],
    ["contacts with walls", robot.wall_contacts],
    ["contacts with robots", robot.robot_contacts],
  ];
  const known = rows.filter(([, value]) => value !== null && value !== undefined);
  return [
    element("p", { className: "why-role" }, `${scene.robot} ${number}`),
    element("p", { className: "why-first" }, `${purpose}${held}.`),
    element("dl", {}, ...known.flatMap(([word, value]) => [element("dt", {}, word), element("dd", {}, String(value))])),
  ];
}
