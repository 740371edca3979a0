// The whole view: one radius, and all that shows it.

import { Bar, button } from "./bar.js";
import { BettiChart, DiagramChart } from "./chart.js";
import { download, element } from "./dom.js";
import { complexOf, pictureOf } from "./models.js";
import { Panel } from "./panel.js";
import { Scale } from "./scale.js";
import { Stage } from "./stage.js";
import { BettiCurve, changesOf, neighbouringChange, shownUpTo } from "./steps.js";
import { counted } from "./text.js";
import { PALETTES } from "./theme.js";

/** Seconds from one end of the slider to the other. */
const PLAYING_TIME = 14;

/**
 * @typedef {import("./complex.js").Diagram} Diagram
 * @typedef {import("./picture2.js").Layer} Layer
 * @typedef {import("./hash.js").Saved} Saved
 * @typedef {{keys?: EventTarget, saved?: Saved, onradius?: (radius: number) => void,
 *            onchange?: (saved: Saved) => void}} Options
 */

/** A view of a complex in an element. */
export class View {
  /**
   * @param {HTMLElement} root
   * @param {import("./data.js").Payload} payload
   * @param {Options} [options]
   */
  constructor(root, payload, options = {}) {
    this.root = root;
    this.options = options;
    this.meta = payload.meta;
    this.complex = complexOf(payload);
    this.curves = this.complex.diagrams.map((/** @type {Diagram} */ d) => new BettiCurve(d));
    this.changes = changesOf(this.curves, this.complex.first);
    this.scale = scaleOf(this.complex, this.changes, this.meta.choice?.radius ?? 0);
    this.radius = options.saved?.radius ?? this.meta.radius ?? 0;
    this.facts = this.complex.at(this.radius);
    this.theme = options.saved?.theme ?? "auto";
    this.playing = false;
    this.frame = 0;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.later = undefined;

    this.picture = pictureOf(this.complex, this.scale.limit);
    /** @type {Record<string, boolean>} */
    this.layers = {};
    for (const { key, on } of this.picture.layers) this.layers[key] = on;
    const set = (/** @type {number} */ radius) => this.setRadius(radius, true);
    const { choice } = this.meta;
    const chartOptions = { scale: this.scale, choice, onradius: set };
    this.charts = {
      diagram: new DiagramChart(this.complex.diagrams, chartOptions),
      betti: new BettiChart(this.curves, chartOptions),
    };
    this.bar = new Bar(this.scale, choice, {
      radius: () => this.radius,
      set,
      play: () => this.togglePlay(),
      jump: (direction) => this.jump(direction),
      signed: this.complex.signed,
    });
    this.panel = new Panel(this.picture.layers, this.charts, {
      words: this.complex.words,
      reason: choice?.reason ?? null,
      toggle: (key) => this.toggle(key),
    });
    this.stage = new Stage(this.picture, {
      state: () => ({ facts: this.facts, layers: this.layers, palette: this.palette }),
      onmove: () => this._moved(),
      redraw: () => this.redraw(),
    });
    this.status = element("div", { class: "status", role: "status", "aria-live": "polite" });
    this.dark = window.matchMedia("(prefers-color-scheme: dark)");
    this.palette = PALETTES.light;
    this.observer = new ResizeObserver(() => this.redraw());
    this._onscheme = () => this._applyTheme();
    this._build();
    this._restore(options.saved ?? {});
    this._listen();
    this._applyTheme();
    this.stage.describe(this.picture.sentence(this.facts));
    this.drawNow();
  }

  _build() {
    const heading = element("h1", {}, this.meta.title);
    const size = element("p", { class: "size" }, sizeText(this.complex));
    this.root.classList.add("alphamesh-view");
    this.root.classList.toggle("space", this.complex.ambient === 3);
    this.root.replaceChildren(
      element("header", {}, heading, size, this._tools()),
      element("div", { class: "middle" }, this.stage.element, this.panel.element),
      this.bar.element,
      this.status,
    );
  }

  _tools() {
    const save = "Save the picture as";
    return element(
      "div",
      { class: "tools", role: "group", "aria-label": "Tools" },
      button("PNG", `${save} PNG`, () => this.savePng()),
      button("SVG", `${save} SVG`, () => this.saveSvg()),
      button("◐", "Light or dark (L)", () => this.toggleTheme()),
      button("?", "Help: keys", () => this.toggleHelp()),
    );
  }

  _listen() {
    const keys = this.options.keys ?? this.root;
    keys.addEventListener("keydown", (event) => this._key(/** @type {KeyboardEvent} */ (event)));
    this.observer.observe(this.stage.element);
    this.dark.addEventListener("change", this._onscheme);
  }

  // The radius

  /**
   * @param {number} radius
   * @param {boolean} [byUser] then a film stops
   */
  setRadius(radius, byUser = false) {
    if (byUser && this.playing) this.togglePlay();
    this.radius = this.complex.signed ? radius : Math.max(0, radius);
    this.facts = this.complex.at(this.radius);
    this.options.onradius?.(this.radius);
    this.redraw();
    this._changed();
  }

  /** Go to the next or the last radius at which the Betti numbers change. @param {1 | -1} way */
  jump(way) {
    const radius = neighbouringChange(this.changes, this.radius, way);
    if (radius !== null) this.setRadius(radius, true);
    else if (way < 0) this.setRadius(this.scale.low, true);
  }

  togglePlay() {
    this.playing = !this.playing;
    this.bar.showPlaying(this.playing);
    if (!this.playing) return;
    const { scale } = this;
    const start = this.radius >= scale.limit ? 0 : scale.share(this.radius);
    const begun = performance.now();
    const step = (/** @type {number} */ now) => {
      if (!this.playing) return;
      const share = start + Math.max(0, now - begun) / 1000 / PLAYING_TIME;
      this.setRadius(scale.radius(share));
      if (share >= 1) this.togglePlay();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  // What is shown

  /** @param {string} key */
  toggle(key) {
    this.layers[key] = !this.layers[key];
    this.redraw();
    this._changed();
  }

  toggleTheme() {
    this.theme = this.isDark ? "light" : "dark";
    this._applyTheme();
    this._changed();
  }

  get isDark() {
    return this.theme === "auto" ? this.dark.matches : this.theme === "dark";
  }

  _applyTheme() {
    const name = this.isDark ? "dark" : "light";
    this.palette = PALETTES[name];
    this.root.dataset.theme = name;
    for (const [role, colour] of Object.entries(this.palette)) {
      if (typeof colour === "string") this.root.style.setProperty(`--${role}`, colour);
    }
    this.redraw();
  }

  toggleHelp() {
    if (!this.help) {
      this.help = helpOf(this.picture);
      this.root.append(this.help);
    }
    if (this.help.open) this.help.close();
    else this.help.showModal();
  }

  redraw() {
    if (!this.frame) this.frame = requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const sentence = this.picture.sentence(this.facts);
    this.stage.draw();
    this.bar.show(this.radius, sentence);
    this.panel.showLayers(this.layers);
    this.panel.showFacts(this.facts.betti, this.picture.rows(this.facts));
    for (const chart of Object.values(this.charts)) {
      chart.draw(this.radius, this.facts.betti, this.palette, this.root.dataset.theme ?? "");
    }
  }

  // Saving

  async savePng() {
    const blob = await this.stage.png();
    if (blob) download(blob, `${fileName(this.meta.title)}.png`);
  }

  saveSvg() {
    const { facts, layers, palette } = this;
    const title = `${this.meta.title}: ${this.picture.sentence(facts)}`;
    const text = this.picture.svg({ facts, layers, palette, title });
    download(new Blob([text], { type: "image/svg+xml" }), `${fileName(this.meta.title)}.svg`);
  }

  /** @returns {Saved} */
  get saved() {
    /** @type {Layer[]} */
    const layers = this.picture.layers;
    const shown = layers.filter(({ key }) => this.layers[key]);
    return {
      radius: this.radius,
      layers: shown.map(({ letter }) => letter).join(""),
      view: this.picture.state,
      theme: this.theme,
    };
  }

  /** @param {Saved} saved */
  _restore({ radius, layers, view, theme }) {
    if (radius !== undefined) this.radius = radius;
    if (layers !== undefined) {
      for (const { key, letter } of this.picture.layers) this.layers[key] = layers.includes(letter);
    }
    if (view) this.picture.restore(view);
    if (theme) this.theme = theme;
    this.facts = this.complex.at(this.radius);
  }

  _moved() {
    this.stage.unpoint();
    this.redraw();
    this._changed();
  }

  _changed() {
    clearTimeout(this.later);
    this.later = setTimeout(() => {
      this.status.textContent = this.picture.sentence(this.facts);
      this.stage.describe(this.status.textContent ?? "");
      this.options.onchange?.(this.saved);
    }, 300);
  }

  // Keys

  /** @param {KeyboardEvent} event */
  _key(event) {
    const target = /** @type {HTMLElement} */ (event.composedPath()[0]);
    const writing = target.matches?.("input[type=text]");
    if (writing || event.altKey || event.ctrlKey || event.metaKey) return;
    const act = this._action(event.key, target);
    if (!act) return;
    event.preventDefault();
    event.stopPropagation(); // a notebook has keys of its own
    act();
  }

  /**
   * @param {string} key
   * @param {HTMLElement} target
   * @returns {(() => void) | null}
   */
  _action(key, target) {
    /** @type {Layer[]} */
    const layers = this.picture.layers;
    const layer = layers.find(({ letter }) => letter === key.toLowerCase());
    if (layer) return () => this.toggle(layer.key);
    if (key === " ") return target.matches?.("button, input") ? null : () => this.togglePlay();
    const moving = target === this.stage.element;
    const move = (/** @type {number} */ dx, /** @type {number} */ dy) => () => {
      this.picture.drag(dx, dy);
      this._moved();
    };
    const zoom = (/** @type {number} */ factor) => () => {
      this.picture.zoom(factor);
      this._moved();
    };
    const { choice } = this.meta;
    /** @type {Record<string, (() => void) | null>} */
    const actions = {
      ArrowLeft: moving ? move(40, 0) : null,
      ArrowRight: moving ? move(-40, 0) : null,
      ArrowUp: moving ? move(0, 40) : null,
      ArrowDown: moving ? move(0, -40) : null,
      "+": zoom(1.25),
      "-": zoom(0.8),
      0: () => {
        this.picture.camera.reset();
        this._moved();
      },
      PageUp: () => this.jump(1),
      PageDown: () => this.jump(-1),
      c: choice ? () => this.setRadius(choice.radius, true) : null,
      l: () => this.toggleTheme(),
      "?": () => this.toggleHelp(),
    };
    return actions[key] ?? this.picture.action(key);
  }

  /** Let go of all that lives outside the element. */
  destroy() {
    this.playing = false;
    cancelAnimationFrame(this.frame);
    clearTimeout(this.later);
    this.observer.disconnect();
    this.dark.removeEventListener("change", this._onscheme);
    this.stage.gl?.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

/**
 * Return a scale on which all changes of the topology can be seen.
 * @param {any} complex
 * @param {Float64Array} changes
 * @param {number} chosen
 */
function scaleOf(complex, changes, chosen) {
  const lasts = complex.values.map((/** @type {Float64Array} */ v) => v[v.length - 1] ?? 0);
  const low = complex.first;
  const last = changes.length ? changes[changes.length - 1] : low;
  const end = shownUpTo(last - low, Math.max(low, ...lasts) - low, chosen - low);
  return new Scale(low + end, chosen, low);
}

/** How many points there are. @param {any} complex */
function sizeText({ vertexCount, hidden }) {
  const more = hidden.rows.length;
  const besides = more ? `, ${counted(more, "hidden point")} besides` : "";
  return `${counted(vertexCount, "point")}${besides}`;
}

/** @param {string} title */
function fileName(title) {
  return title.replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^-+|-+$/g, "") || "alphamesh";
}

/** @param {any} picture */
function helpOf(picture) {
  /** @type {[string, string][]} */
  const keys = [
    ["← →", "on the slider: the radius; with shift, ten times as far"],
    ["Page Up, Page Down", "to the next, the last change of the topology"],
    ["space", "play, pause"],
    ["C", "to the chosen radius"],
    ["arrows, + −, 0", "on the picture: move, zoom, see all"],
    ["L", "light or dark"],
    ...picture.layers.map((/** @type {any} */ l) => [l.letter.toUpperCase(), `show or hide: ${l.name}`]),
  ];
  const rows = keys.flatMap(([key, what]) => [
    element("dt", {}, element("kbd", {}, key)),
    element("dd", {}, what),
  ]);
  const close = element("button", { type: "submit", class: "wide" }, "Close");
  return element(
    "dialog",
    { "aria-label": "Help" },
    element("h2", {}, "Keys"),
    element("dl", {}, ...rows),
    element("p", {}, picture.help),
    element("form", { method: "dialog" }, close),
  );
}
