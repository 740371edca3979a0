// The picture in space: what is drawn, how it turns, what is under the pointer.

import { Camera3, dot } from "./camera3.js";
import { countUpTo } from "./complex.js";
import { element } from "./dom.js";
import { ballsOf, frameOf, sidesInFront } from "./frame3.js";
import { Scene3 } from "./scene3.js";
import { svgOfSurface } from "./svg3.js";
import { count, counted, number } from "./text.js";

/**
 * @typedef {import("./filtered.js").Facts} Facts
 * @typedef {import("./picture2.js").Layer} Layer
 */

/** A complex in space. */
export class Picture3 {
  /**
   * @param {import("./space.js").SpaceComplex} complex
   * @param {number} limit the largest radius of the slider
   */
  constructor(complex, limit) {
    this.complex = complex;
    this.limit = limit;
    const overhang = Math.min(0.4, complex.reach(0));
    const [low, high] = complex.box ? [complex.box.low, complex.box.high] : [[], []];
    const corners = complex.box ? [...low, ...high] : complex.positions;
    this.camera = new Camera3(farthest(corners) + overhang);
    /** @type {Scene3 | null} */
    this.scene = null;
    const weighted = Boolean(complex.weights) && complex.vertexCount <= 3000;
    /** @type {Layer[]} */
    this.layers = [
      { key: "boundary", letter: "b", name: "surface", on: true },
      { key: "wire", letter: "e", name: "edges of the surface", on: complex.vertexCount <= 5000 },
      { key: "singular", letter: "s", name: "singular triangles", on: true },
      { key: "lone", letter: "n", name: "edges alone", on: true },
      { key: "points", letter: "p", name: "points", on: true },
      { key: "balls", letter: "o", name: "growing balls", on: weighted },
      { key: "cut", letter: "x", name: "cut open", on: false },
    ];
    if (complex.hidden.rows.length) {
      this.layers.push({ key: "hidden", letter: "h", name: "hidden points", on: true });
    }
    this.help =
      "Drag to turn, shift-drag to move, wheel or + and − to zoom, 0 for the first view. " +
      "The cut faces you when you switch it on; its slider, or [ and ], move it.";
    /** Of the cut: its direction, and how deep it is, from 0 to 1. */
    this.cut = { normal: [0, 0, 1], depth: 0.5 };
    this.wasCut = false;
  }

  /** @param {import("./gl.js").GL} gl */
  begin(gl) {
    this.scene = new Scene3(gl, this.complex);
  }

  get drawn() {
    return this.scene?.drawn ?? {};
  }

  /** Whether it is drawn in no time, however carefully. */
  get small() {
    return this.complex.vertexCount <= 3000;
  }

  /**
   * A slider for the cut.
   * @param {() => void} onmove
   */
  controls(onmove) {
    this.onmove = onmove;
    this.depth = element("input", {
      type: "range",
      min: 0,
      max: 1000,
      "aria-label": "Depth of the cut",
      input: () => this.cutTo(Number(this.depth.value) / 1000),
      pointerdown: (/** @type {Event} */ event) => event.stopPropagation(),
    });
    this.depthLabel = element("label", { class: "cut-depth", hidden: "" }, "cut ", this.depth);
    return this.depthLabel;
  }

  /** @param {number} depth */
  cutTo(depth) {
    this.cut.depth = Math.max(0, Math.min(1, depth));
    this.onmove?.();
  }

  /** @param {Record<string, boolean>} layers */
  _cut(layers) {
    if (layers.cut && !this.wasCut && !this.restored) this.cut.normal = [...this.camera.axes[2]];
    this.restored = false;
    this.wasCut = layers.cut;
    if (this.depth) {
      this.depthLabel.hidden = !layers.cut;
      this.depth.value = String(Math.round(1000 * this.cut.depth));
    }
    if (!layers.cut) return null;
    const { extent } = this.complex.meta;
    const reach = this.cut.normal.reduce((sum, n, i) => sum + Math.abs(n) * extent[i], 0);
    return { normal: this.cut.normal, offset: 1.001 * reach * (1 - 2 * this.cut.depth) };
  }

  /** @param {{facts: Facts, layers: Record<string, boolean>, palette: any, ratio: number}} state */
  draw(state) {
    this.shown = this._cut(state.layers);
    this.scene?.draw({ ...state, camera: this.camera, cut: this.shown });
  }

  /** @param {number} dx @param {number} dy @param {PointerEvent} [event] */
  drag(dx, dy, event) {
    if (event && (event.shiftKey || event.buttons & 6)) this.camera.pan(dx, dy);
    else this.camera.orbit(dx, dy);
  }

  /** @param {number} factor */
  zoom(factor) {
    this.camera.zoomBy(factor);
  }

  /** @param {string} key @returns {(() => void) | null} */
  action(key) {
    if (key === "[") return () => this.cutTo(this.cut.depth - 0.02);
    if (key === "]") return () => this.cutTo(this.cut.depth + 0.02);
    return null;
  }

  /** What the address keeps of the view. @returns {number[] | undefined} */
  get state() {
    if (!this.camera.moved && !this.wasCut) return undefined;
    return [...this.camera.state, ...(this.wasCut ? [...this.cut.normal, this.cut.depth] : [])];
  }

  /** @param {number[]} state */
  restore(state) {
    this.camera.restore(state);
    const [x, y, z, depth] = state.slice(5, 9);
    const length = Math.hypot(x, y, z);
    if (!(length > 0) || !(depth >= 0 && depth <= 1)) return;
    this.cut = { normal: [x / length, y / length, z / length], depth };
    this.restored = true;
  }

  /**
   * Return the triangle under a pixel, and what to say of it.
   * @param {number} px
   * @param {number} py
   * @param {Facts} facts
   * @param {Record<string, boolean>} layers
   */
  hover(px, py, facts, layers) {
    if (!this.scene) return null;
    this.scene.pick(facts);
    const { from, way } = this.camera.ray(px, py);
    const shown = { boundary: layers.boundary, singular: layers.singular };
    const index = this.scene.picker.hit(from, way, (place) => this._keeps(place), shown);
    if (index < 0) return null;
    const { seen, patch } = this.complex;
    const corners = [...seen.triangles.subarray(3 * index, 3 * index + 3)];
    const rows = corners.map((v) => this.complex.rowOfDrawn(v)).sort((a, b) => a - b);
    const value = this.complex.values[2][patch ? patch.own[2][index] : index];
    const alone = seen.cofaces.first[index] >= facts.present[3];
    return {
      simplex: { dimension: 2, index, corners, value },
      lines: [
        `${alone ? "singular" : "boundary"} triangle ${rows.join(", ")}`,
        `in: from radius ${number(value, 6)}`,
      ],
    };
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {{palette: any, hovered: {corners: number[]} | null}} state
   */
  drawOver(c, { palette, hovered }) {
    if (!hovered) return;
    const p = this.complex.seen.positions;
    c.strokeStyle = palette.radius;
    c.lineWidth = 2;
    c.beginPath();
    for (const v of hovered.corners) c.lineTo(...this.camera.toScreen(p.subarray(3 * v, 3 * v + 3)));
    c.closePath();
    c.stroke();
  }

  /**
   * @param {Facts} facts
   * @returns {[string, string][]} the key of a layer, or what it is, and how much
   */
  rows({ present, isolated, singularEdges, singularTriangles = 0, boundary, size, border }) {
    const alone = isolated ? `${count(isolated)} alone of ${count(present[0])}` : count(present[0]);
    const hidden = this.complex.hidden.rows.length;
    /** @type {[string, string][]} */
    const besides = hidden ? [["hidden", count(hidden)]] : [];
    return [
      ["boundary", count(boundary)],
      ["singular", count(singularTriangles)],
      ["lone", count(singularEdges)],
      ["points", alone],
      ["tetrahedra", count(present[3])],
      ["volume", number(size)],
      ["triangles", count(present[2])],
      ["surface", number(border)],
      ...besides,
    ];
  }

  /** @param {Facts} facts */
  sentence(facts) {
    const classes = facts.betti.map((value, k) => counted(value, this.complex.words[k]));
    return [
      `radius ${number(facts.radius)}: ${classes.join(", ")}`,
      ...(facts.full ? ["the whole box"] : []),
      counted(facts.present[3], "tetrahedron", "tetrahedra"),
      counted(facts.isolated, "isolated point"),
    ].join(", ");
  }

  /**
   * Return the balls that are shown: where, and how large.
   * @param {{facts: Facts, layers: Record<string, boolean>}} state
   */
  _balls({ facts, layers }) {
    const balls = layers.balls ? ballsOf(this.complex) : new Float32Array(0);
    const power = this.complex.power(facts.radius);
    return Array.from({ length: balls.length / 4 }, (_, i) => ({
      place: balls.subarray(4 * i, 4 * i + 3),
      radius: Math.sqrt(Math.max(0, power + balls[4 * i + 3])),
    }));
  }

  /** Whether a place is in the box, and on this side of the cut. @param {ArrayLike<number>} p */
  _keeps(p) {
    if (this.shown && dot(this.shown.normal, p) > this.shown.offset) return false;
    return this._walls().every(({ normal, offset }) => dot(normal, p) <= offset + 1e-4);
  }

  /** The planes where a box ends. @returns {import("./scene3.js").Cut[]} */
  _walls() {
    const { box } = this.complex;
    if (!box) return [];
    return [0, 1, 2].filter((k) => box.periods[k]).flatMap((k) => {
      const normal = [0, 0, 0].map((_, i) => (i === k ? 1 : 0));
      const back = normal.map((n) => -n);
      return [{ normal, offset: box.high[k] }, { normal: back, offset: -box.low[k] }];
    });
  }

  /** @param {{facts: Facts, layers: Record<string, boolean>, palette: any, title: string}} state */
  svg(state) {
    this.scene?.pick(state.facts);
    const picker = this.scene?.picker;
    if (!picker) return "";
    /** @param {ArrayLike<number>} p */
    const kept = (p) => !this.shown || dot(this.shown.normal, p) <= this.shown.offset;
    const { box, caps } = this.complex;
    const count = countUpTo(caps.ranks, state.facts.present[3] - 1);
    return svgOfSurface(picker, this.camera, kept, {
      ...state,
      balls: this._balls(state),
      walls: this._walls(),
      caps: caps.corners.subarray(0, 9 * count),
      frame: frameOf(box),
      inFront: box ? sidesInFront(box, this.camera.eye) : [],
    });
  }
}

/**
 * Return how far the farthest point is from the middle.
 * @param {ArrayLike<number>} p
 */
function farthest(p) {
  let most = 0;
  for (let i = 0; i < p.length; i += 3) most = Math.max(most, Math.hypot(p[i], p[i + 1], p[i + 2]));
  return most;
}
