// What a key means, beside the text: the card of the key at the caret, and all keys to search through.

import { element } from "uchain/hand/element.js";

/** Words before the fields of a card, in this order; the engine says the rest. */
const FIELDS = [
  ["symbol", "Symbol", spoken],
  ["equation", "Equation", spoken],
  ["kind", "Value", spoken],
  ["unit", "Unit", spoken],
  ["range", "Range", ([low, high]) => `${low} to ${high}`],
  ["default", "Default", spoken],
  ["source", "Source", spoken],
];

export class Cards {
  /** @param {{ask: (key: string) => any, put: (key: string, value: string) => void}} via */
  constructor(via) {
    this.via = via;
    this.asked = null;
    this.all = null;
    this.card = element("div", { className: "card", "aria-live": "polite" });
    this.search = element("input", {
      type: "search",
      placeholder: "search all keys: radio, noise, speed …",
      "aria-label": "search all keys of a scenario",
      oninput: () => this.#list(),
      onkeydown: (event) => this.#down(event),
    });
    this.hits = element("ul", { className: "card-hits", "aria-label": "keys found" });
    this.node = element(
      "div",
      { className: "edit-cards" },
      element("h3", {}, "What the key means"),
      this.card,
      element("details", { ontoggle: (event) => event.target.open && this.#list() }, element("summary", {}, "All keys"), this.search, this.hits),
    );
  }

  /** Shows the card of a key, or the keys of a table. */
  show(key) {
    if (key === this.asked) return;
    this.asked = key;
    let cards;
    try {
      cards = key === "" ? [] : this.via.ask(key);
    } catch (error) {
      this.card.replaceChildren(element("p", { className: "quiet" }, error.message ?? String(error)));
      return;
    }
    if (cards.length === 0) {
      this.card.replaceChildren(element("p", { className: "quiet" }, "Put the caret on a key: its meaning, unit, range and default show here."));
    } else if (cards.length === 1 && !cards[0].is_table) {
      this.card.replaceChildren(...this.#whole(cards[0]));
    } else {
      this.card.replaceChildren(element("p", { className: "quiet" }, `Keys of [${key}]:`), this.#rows(cards.filter((card) => card.key !== key)));
    }
  }

  #whole(card) {
    const rows = [];
    for (const [field, word, said] of FIELDS) {
      const value = card[field];
      if (value !== null && value !== undefined && value !== "") rows.push(element("dt", {}, word), element("dd", {}, said(value)));
    }
    if (card.required) rows.push(element("dt", {}, "Default"), element("dd", {}, "none, it has to be written"));
    const value = written(card.default);
    return [
      element("h4", {}, element("code", {}, card.key)),
      element("p", {}, card.meaning ?? ""),
      this.#choices(card),
      element("dl", {}, ...rows),
      value !== null && element("button", { type: "button", className: "small", onclick: () => this.via.put(card.key, value) }, `Write ${card.key.split(".").at(-1)} = ${value}`),
    ].filter(Boolean);
  }

  /** Words that a key knows, each a button that writes it. */
  #choices(card) {
    const choices = Array.isArray(card.choices) ? card.choices : [];
    if (choices.length === 0) return null;
    return element(
      "ul",
      { className: "card-choices" },
      ...choices.map(([word, words]) =>
        element("li", {}, element("button", { type: "button", className: "small", title: `write ${card.key} = "${word}"`, onclick: () => this.via.put(card.key, JSON.stringify(word)) }, word), words && ` ${words}`)),
    );
  }

  #rows(cards) {
    return element(
      "ul",
      { className: "card-hits" },
      ...cards.slice(0, 400).map((card) =>
        element("li", {}, element("button", { type: "button", onclick: () => this.show(card.key) }, element("code", {}, card.key), element("span", {}, card.meaning ?? ""))),
      ),
    );
  }

  #list() {
    try {
      this.all ??= this.via.ask("");
    } catch (error) {
      this.hits.replaceChildren(element("li", {}, error.message));
      return;
    }
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.all.filter((card) => {
      const said = `${card.key} ${card.meaning ?? ""} ${card.symbol ?? ""} ${card.source ?? ""}`.toLowerCase();
      return words.every((word) => said.includes(word));
    });
    const none = element("li", { className: "quiet" }, "No key has these words.");
    this.hits.replaceChildren(...(found.length ? this.#rows(found).childNodes : [none]));
  }

  #down(event) {
    if (event.key === "ArrowDown") this.hits.querySelector("button")?.focus();
    if (event.key === "Enter") this.hits.querySelector("button")?.click();
  }
}

function spoken(value) {
  return String(value);
}

/** A default as TOML, where the engine gives one that can be written as it is. */
function written(value) {
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  if (typeof value !== "string") return null;
  return /^(-?[\d.]+(e-?\d+)?|true|false|"[^"\n]*"|\[.*\])$/.test(value) ? value : null;
}
