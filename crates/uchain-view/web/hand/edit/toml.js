// Where things stand in the text of a scenario: keys, values, corners. It finds places, it judges nothing: what a
// scenario may say is for the engine alone. Text that is no TOML is skipped line by line.

/**
 * @typedef {{path: string, kind: "key"|"table"|"list", table: string, from: number, valueFrom: number, to: number}} Entry
 * `path` names arrays of tables by their index (pilot.1.speed_mps); `from`..`to` is the whole statement, without a
 * comment behind it; `kind` "list" is a header in double brackets.
 */

/** All statements of a text, in order. @returns {Entry[]} */
export function statements(text) {
  const found = [];
  const counts = new Map();
  let table = "";
  let at = 0;
  while (at < text.length) {
    at = pastBlank(text, at);
    if (at >= text.length) break;
    const lineEnd = endOfLine(text, at);
    if (text[at] === "[") {
      const header = /^(\[\[?)([^\]\n]*)\]\]?/.exec(text.slice(at, lineEnd));
      if (header) {
        const name = parts(header[2]).join(".");
        const isList = header[1] === "[[";
        const index = isList ? (counts.get(name) ?? -1) + 1 : null;
        if (isList) counts.set(name, index);
        table = isList ? `${name}.${index}` : name;
        const to = at + header[0].length;
        found.push({ path: table, kind: isList ? "list" : "table", table, from: at, valueFrom: to, to });
      }
      at = lineEnd;
      continue;
    }
    const equals = indexOutside(text, "=", at, lineEnd);
    if (equals < 0) {
      at = lineEnd;
      continue;
    }
    const keys = parts(text.slice(at, equals));
    const valueFrom = equals + 1 + /^[ \t]*/.exec(text.slice(equals + 1, lineEnd))[0].length;
    const to = pastValue(text, valueFrom);
    const path = [table, ...keys].filter((part) => part !== "").join(".");
    found.push({ path, kind: "key", table, from: at, valueFrom, to });
    at = Math.max(endOfLine(text, to), at + 1);
  }
  return found;
}

/** The key that the caret stands in, or the table; "" at the top or in a comment before everything. */
export function keyAt(text, caret) {
  let last = "";
  for (const entry of statements(text)) {
    if (entry.from > caret) break;
    const within = caret <= Math.max(entry.to, endOfLine(text, entry.to));
    if (entry.kind === "key") {
      if (within) return inlineKey(text, entry, caret);
      last = entry.table;
    } else {
      last = entry.path;
    }
  }
  return last;
}

/** Within `a = { b = 1, c = 2 }`: the key in the braces that the caret stands in. */
function inlineKey(text, entry, caret) {
  if (text[entry.valueFrom] !== "{" || caret <= entry.valueFrom) return entry.path;
  const before = text.slice(entry.valueFrom + 1, Math.max(caret, entry.valueFrom + 1));
  const behind = /^[\w.\- \t]*=?/.exec(text.slice(caret, entry.to))?.[0] ?? "";
  const pairs = [...`${before}${behind}`.matchAll(/(?:^|[,{])\s*([\w.-]+)\s*=/g)];
  const inner = pairs.at(-1)?.[1];
  return inner ? `${entry.path}.${inner}` : entry.path;
}

/**
 * Corners of a list of points, `[[x, y], [x, y, r]]`: where the numbers of x and y stand.
 * @returns {{x: number, y: number, r: number|null, xAt: [number, number], yAt: [number, number]}[]}
 */
export function corners(text, path) {
  const entry = statements(text).find((entry) => entry.kind === "key" && entry.path === path);
  if (!entry) return [];
  const found = [];
  let depth = 0;
  let numbers = [];
  let at = entry.valueFrom;
  while (at < entry.to) {
    const here = text[at];
    if (here === "#") {
      at = endOfLine(text, at);
    } else if (here === "[") {
      depth += 1;
      numbers = [];
      at += 1;
    } else if (here === "]") {
      if (depth === 2 && (numbers.length === 2 || numbers.length === 3)) {
        const [x, y, r] = numbers;
        found.push({ x: x.value, y: y.value, r: r ? r.value : null, xAt: x.at, yAt: y.at });
      }
      depth -= 1;
      at += 1;
    } else {
      const number = /^[+-]?[\d_]+(?:\.[\d_]+)?(?:[eE][+-]?\d+)?/.exec(text.slice(at, at + 40));
      if (number) {
        numbers.push({ value: Number(number[0].replaceAll("_", "")), at: [at, at + number[0].length] });
        at += number[0].length;
      } else {
        at += 1;
      }
    }
  }
  return found;
}

/** The value of a key as it is written; null = it is not. */
export function valueOf(text, path) {
  const entry = statements(text).find((entry) => entry.kind === "key" && entry.path === path);
  return entry ? text.slice(entry.valueFrom, entry.to) : null;
}

/** What to write where, so that a key has a value: the least that does it. `value` is TOML already. */
export function setting(text, path, value) {
  const all = statements(text);
  const there = all.find((entry) => entry.kind === "key" && entry.path === path);
  if (there) return { from: there.valueFrom, to: there.to, text: value };
  const dot = path.lastIndexOf(".");
  const table = dot < 0 ? "" : path.slice(0, dot);
  const line = `${path.slice(dot + 1)} = ${value}`;
  const siblings = all.filter((entry) => entry.table === table);
  if (siblings.length > 0) {
    const end = endOfLine(text, siblings.at(-1).to);
    return { from: end, to: end, text: `\n${line}` };
  }
  if (table === "") {
    const first = all[0]?.from ?? text.length;
    return { from: first, to: first, text: `${line}\n` };
  }
  const gap = text === "" || text.endsWith("\n\n") ? "" : text.endsWith("\n") ? "\n" : "\n\n";
  return { from: text.length, to: text.length, text: `${gap}[${table}]\n${line}\n` };
}

/** Line (from 1) and column (from 1) of a place. */
export function lineOf(text, at) {
  const before = text.slice(0, at);
  return { line: before.split("\n").length, column: at - before.lastIndexOf("\n") };
}

/** Where a line (from 1) begins and ends. */
export function rangeOfLine(text, line) {
  let from = 0;
  for (let i = 1; i < line; i += 1) {
    const next = text.indexOf("\n", from);
    if (next < 0) break;
    from = next + 1;
  }
  return { from, to: endOfLine(text, from) };
}

function parts(name) {
  return [...name.matchAll(/"([^"]*)"|'([^']*)'|([^."'\s]+)/g)].map(([, a, b, c]) => a ?? b ?? c);
}

function endOfLine(text, at) {
  const end = text.indexOf("\n", at);
  return end < 0 ? text.length : end;
}

function pastBlank(text, from) {
  let at = from;
  while (at < text.length) {
    if (text[at] === "#") at = endOfLine(text, at);
    else if (/\s/.test(text[at])) at += 1;
    else break;
  }
  return at;
}

/** Past a string that begins here; an open one ends with its line, or with the text if it has three quotes. */
function pastString(text, at) {
  const quote = text[at];
  if (text.startsWith(quote.repeat(3), at)) {
    const end = text.indexOf(quote.repeat(3), at + 3);
    return end < 0 ? text.length : end + 3;
  }
  const lineEnd = endOfLine(text, at);
  for (let i = at + 1; i < lineEnd; i += 1) {
    if (quote === '"' && text[i] === "\\") i += 1;
    else if (text[i] === quote) return i + 1;
  }
  return lineEnd;
}

function indexOutside(text, wanted, from, to) {
  for (let at = from; at < to; at += 1) {
    if (text[at] === wanted) return at;
    if (text[at] === "#") return -1;
    if (text[at] === '"' || text[at] === "'") at = pastString(text, at) - 1;
  }
  return -1;
}

/** Past a value: brackets may span lines, everything else ends with its line or at a comment. */
function pastValue(text, from) {
  let depth = 0;
  let at = from;
  let end = from;
  while (at < text.length) {
    const here = text[at];
    if (here === '"' || here === "'") {
      at = pastString(text, at);
      end = at;
      continue;
    }
    if (here === "#") {
      if (depth === 0) break;
      at = endOfLine(text, at);
      continue;
    }
    if (here === "\n" && depth === 0) break;
    // A header in the middle of an open list: the list was never closed.
    if (depth > 0 && here === "\n" && /^\n[ \t]*\[{1,2}[A-Za-z_][\w.]*\]{1,2}[ \t]*(?:#|\n|$)/.test(text.slice(at, at + 200))) break;
    if (here === "[" || here === "{") depth += 1;
    if (here === "]" || here === "}") depth -= 1;
    if (!/\s/.test(here)) end = at + 1;
    at += 1;
    if (depth < 0) break;
  }
  return end;
}
