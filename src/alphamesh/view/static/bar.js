// The bar of the radius: play, slider with its marks, number, and the chosen radius.

import { element } from "./dom.js";
import { number, readRadius } from "./text.js";

/** Steps of the slider: finer than any screen. */
const STEPS = 100000;

/** The controls of the radius. */
export class Bar {
  /**
   * @param {import("./scale.js").Scale} scale
   * @param {{low: number, high: number | null, radius: number} | null} choice
   * @param {{radius: () => number, set: (radius: number) => void, play: () => void,
   *          jump: (direction: 1 | -1) => void, signed: boolean}} app
   */
  constructor(scale, choice, app) {
    this.scale = scale;
    this.app = app;
    this.slider = element("input", {
      type: "range",
      min: 0,
      max: STEPS,
      step: 1,
      "aria-label": "Radius",
      input: () => app.set(scale.radius(Number(this.slider.value) / STEPS)),
      keydown: (/** @type {KeyboardEvent} */ event) => this._key(event),
    });
    this.play = button("▶", "Play", app.play, "play");
    this.entry = element("input", {
      type: "text",
      inputmode: "decimal",
      class: "radius",
      autocomplete: "off",
      "aria-label": "Radius, as a number",
      input: () => (this.typing = true),
      change: () => this._enter(),
      blur: () => (this.typing = false),
    });
    // Whether the number is being changed: what is shown meanwhile leaves it alone.
    this.typing = false;
    this.element = element(
      "div",
      { class: "bar", role: "group", "aria-label": "Radius" },
      this.play,
      button("‹", "Back to the last change of the topology (Page Down)", () => app.jump(-1)),
      button("›", "On to the next change of the topology (Page Up)", () => app.jump(1)),
      element("div", { class: "track" }, ...this._marks(choice), this.slider),
      element("label", { class: "entry" }, "r = ", this.entry),
    );
    if (choice) {
      const label = `Go to the chosen radius, ${number(choice.radius)} (C)`;
      this.element.append(button("chosen", label, () => app.set(choice.radius), "wide"));
    }
  }

  /** @param {{low: number, high: number | null, radius: number} | null} choice */
  _marks(choice) {
    if (!choice) return [];
    const { scale } = this;
    const [from, to] = [scale.share(choice.low), scale.share(choice.high ?? Infinity)];
    const band = element("div", {
      class: "band",
      title: "Over this range the shape keeps its components and holes",
    });
    band.style.setProperty("--from", String(from));
    band.style.setProperty("--to", String(to));
    const mark = element("div", { class: "mark" });
    mark.style.setProperty("--from", String(scale.share(choice.radius)));
    return [band, mark];
  }

  /** @param {KeyboardEvent} event */
  _key(event) {
    const step = (event.shiftKey ? 10 : 1) / 400;
    const share = this.scale.share(this.app.radius());
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowRight: () => this.app.set(this.scale.radius(share + step)),
      ArrowUp: () => this.app.set(this.scale.radius(share + step)),
      ArrowLeft: () => this.app.set(this.scale.radius(share - step)),
      ArrowDown: () => this.app.set(this.scale.radius(share - step)),
      PageUp: () => this.app.jump(1),
      PageDown: () => this.app.jump(-1),
      Home: () => this.app.set(this.scale.low),
      End: () => this.app.set(this.scale.limit),
    };
    if (!(event.key in keys) || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    keys[event.key]();
  }

  _enter() {
    const radius = readRadius(this.entry.value, this.app.signed);
    this.entry.setAttribute("aria-invalid", String(radius === null));
    if (radius === null) return;
    this.typing = false;
    this.app.set(radius);
  }

  /**
   * @param {number} radius
   * @param {string} sentence
   */
  show(radius, sentence) {
    const share = this.scale.share(radius);
    this.slider.value = String(Math.round(share * STEPS));
    this.slider.setAttribute("aria-valuetext", sentence);
    this.slider.style.setProperty("--share", String(share));
    const focused = this.entry.ownerDocument.activeElement === this.entry;
    if (!this.typing && !(focused && this._says(radius))) {
      this.entry.value = number(radius, 6);
      this.entry.setAttribute("aria-invalid", "false");
    }
  }

  /** @param {number} radius */
  _says(radius) {
    return readRadius(this.entry.value, this.app.signed) === radius;
  }

  /** @param {boolean} playing */
  showPlaying(playing) {
    this.play.textContent = playing ? "❚❚" : "▶";
    this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.play.title = playing ? "Pause (space)" : "Let the radius grow (space)";
  }
}

/**
 * @param {string} text
 * @param {string} label
 * @param {() => void} act
 * @param {string} [kind]
 */
export function button(text, label, act, kind = "") {
  return element(
    "button",
    { type: "button", class: kind, "aria-label": label, title: label, click: act },
    text,
  );
}
