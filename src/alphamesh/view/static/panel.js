// The panel beside the picture: layers, facts, charts, and why this radius was chosen.

import { CLASS_NAMES } from "./chart.js";
import { element } from "./dom.js";
import { counted } from "./text.js";

/**
 * @typedef {import("./picture2.js").Layer} Layer
 */

/** The panel beside the picture. */
export class Panel {
  /**
   * @param {Layer[]} layers
   * @param {any} charts
   * @param {{words: string[], reason: string | null, toggle: (key: string) => void}} app
   */
  constructor(layers, charts, { words, reason, toggle }) {
    /** @type {Map<string, HTMLInputElement>} */
    this.boxes = new Map();
    /** @type {Map<string, HTMLElement>} */
    this.values = new Map();
    this.facts = element("dl", { class: "facts" });
    const shown = element(
      "fieldset",
      { class: "layers" },
      element("legend", {}, "At this radius"),
      ...layers.map((layer) => this._layer(layer, toggle)),
    );
    this.words = words;
    /** @type {HTMLElement[]} */
    this.numbers = [];
    this.element = element(
      "aside",
      { class: "panel", "aria-label": "Facts and charts" },
      element("section", {}, shown, this.facts),
      chart("Topology", charts.betti.canvas, this._legend(this.words)),
      chart("Persistence", charts.diagram.canvas),
    );
    if (reason) {
      const heading = element("h2", {}, "The chosen radius");
      this.element.append(element("section", {}, heading, element("p", {}, reason)));
    }
  }

  /**
   * @param {Layer} layer
   * @param {(key: string) => void} toggle
   */
  _layer({ key, letter, name, on }, toggle) {
    const box = element("input", { type: "checkbox", change: () => toggle(key) });
    box.checked = on;
    this.boxes.set(key, box);
    return element(
      "label",
      { title: `Key: ${letter.toUpperCase()}` },
      box,
      element("span", { class: `swatch ${key}` }),
      name,
      this._value(key),
    );
  }

  /** @param {string} name */
  _value(name) {
    const value = /** @type {HTMLElement} */ (element("span", { class: "value" }));
    this.values.set(name, value);
    return value;
  }

  /** @param {string[]} words */
  _legend(words) {
    const items = words.map((word, k) => {
      const number = /** @type {HTMLElement} */ (element("span", {}, word));
      this.numbers.push(number);
      const dot = element("span", { class: `dot ${CLASS_NAMES[k]}` });
      return element("span", { class: "item" }, dot, number);
    });
    return element("span", { class: "legend" }, ...items);
  }

  /**
   * @param {Record<string, boolean>} layers
   */
  showLayers(layers) {
    for (const [key, box] of this.boxes) box.checked = layers[key];
  }

  /**
   * @param {number[]} betti
   * @param {[string, string][]} rows the key of a layer, or what it is, and how much
   */
  showFacts(betti, rows) {
    betti.forEach((value, k) => (this.numbers[k].textContent = counted(value, this.words[k])));
    for (const [what, text] of rows) {
      if (!this.values.has(what)) {
        this.facts.append(element("dt", {}, what), element("dd", {}, this._value(what)));
      }
      /** @type {HTMLElement} */ (this.values.get(what)).textContent = text;
    }
  }
}

/**
 * @param {string} title
 * @param {HTMLCanvasElement} canvas
 * @param {...Node} more
 */
function chart(title, canvas, ...more) {
  const kind = title.split(" ")[0].toLowerCase();
  const heading = element("h2", {}, title, ...more);
  return element("section", { class: `chart ${kind}` }, heading, canvas);
}
