// Makes elements. Text from outside goes in as text nodes, never as markup.

const SVG = "http://www.w3.org/2000/svg";

/**
 * An HTML element. Properties that begin with "on" are listeners, those with a dash, `role`, `for` and the like are
 * attributes, the rest are properties of the element; children that are null are left out.
 * @param {string} tag
 * @param {Record<string, any>} [props]
 * @param {...(Node|string|null|undefined|false)} children
 * @returns {any}
 */
export function element(tag, props = {}, ...children) {
  return filled(document.createElement(tag), props, children);
}

/** An SVG element: all properties are attributes. */
export function drawn(tag, props = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), props, children);
}

function filled(node, props, children) {
  const isDrawn = node.namespaceURI === SVG;
  for (const [name, value] of Object.entries(props)) {
    if (value === null || value === undefined) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (isDrawn || name.includes("-") || name === "list" || !(name in node)) node.setAttribute(name, String(value));
    else node[name] = value;
  }
  for (const child of children) if (child !== null && child !== undefined && child !== false) node.append(child);
  return node;
}

/** A number as people read it: with its sign where that matters, "–" where there is none. */
export function shown(value, digits, unit = "", signed = false) {
  if (typeof value !== "number" || !Number.isFinite(value)) return "–";
  const rounded = value.toFixed(digits);
  const plain = Number(rounded) === 0 ? (0).toFixed(digits) : rounded;
  const sign = signed && Number(plain) > 0 ? "+" : "";
  return `${sign}${plain.replace("-", "−")}${unit && ` ${unit}`}`;
}
