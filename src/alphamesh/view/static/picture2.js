// The picture in the plane: what is drawn, how it moves, what is under the pointer.

import { Camera } from "./camera.js";
import { PatchPicker, Picker } from "./pick.js";
import { Scene2 } from "./scene2.js";
import { svgOf } from "./svg.js";
import { count, counted, number } from "./text.js";
import { VEIL, veilOf } from "./veil.js";

/**
 * @typedef {{key: string, letter: string, name: string, on: boolean}} Layer
 * @typedef {import("./filtered.js").Facts} Facts
 */

const HIDDEN = "in no simplex: heavier points leave it no cell";
const NAMES = ["point", "edge", "triangle"];

/** A complex in the plane. */
export class Picture2 {
  /**
   * @param {import("./plane.js").PlaneComplex} complex
   * @param {number} limit the largest radius of the slider
   */
  constructor(complex, limit) {
    this.complex = complex;
    this.limit = limit;
    this.camera = new Camera(complex.meta.extent);
    this.picker = complex.box ? new PatchPicker(complex) : new Picker(complex);
    /** @type {Scene2 | null} */
    this.scene = null;
    const few = complex.vertexCount <= 3000;
    const kind = complex.weights ? "power" : "Voronoi";
    /** @type {Layer[]} */
    this.layers = [
      { key: "discs", letter: "d", name: "growing discs", on: few },
      { key: "cells", letter: "v", name: `${kind} cells in the discs`, on: false },
      { key: "triangles", letter: "t", name: "triangles", on: true },
      { key: "edges", letter: "e", name: "inner edges", on: true },
      { key: "boundary", letter: "b", name: "boundary edges", on: true },
      { key: "singular", letter: "s", name: "singular edges", on: true },
      { key: "points", letter: "p", name: "points", on: complex.vertexCount <= 200000 },
    ];
    if (complex.hidden.rows.length) {
      this.layers.push({ key: "hidden", letter: "h", name: "hidden points", on: true });
    }
    this.help = "Drag to move, wheel or + and − to zoom, 0 to see all.";
  }

  /** What the address keeps of the view. @returns {number[] | undefined} */
  get state() {
    return this.camera.moved ? this.camera.state : undefined;
  }

  /** @param {number[]} state */
  restore(state) {
    this.camera.restore(state);
  }

  /** Keys of its own: none. @param {string} _key @returns {(() => void) | null} */
  action(_key) {
    return null;
  }

  /** @param {import("./gl.js").GL} gl */
  begin(gl) {
    this.scene = new Scene2(gl, this.complex, this.limit / this.complex.meta.scale);
  }

  get drawn() {
    return this.scene?.drawn ?? {};
  }

  /** @param {{facts: Facts, layers: Record<string, boolean>, palette: any, ratio: number}} state */
  draw(state) {
    this.scene?.draw({ ...state, camera: this.camera });
  }

  /** @param {number} dx @param {number} dy */
  drag(dx, dy) {
    this.camera.pan(dx, dy);
  }

  /** @param {number} factor @param {number} [x] @param {number} [y] */
  zoom(factor, x, y) {
    this.camera.zoomAt(factor, x, y);
  }

  /**
   * Return the simplex under a pixel, and what to say of it.
   * @param {number} px
   * @param {number} py
   * @param {Facts} facts
   * @param {Record<string, boolean>} layers
   */
  hover(px, py, facts, layers) {
    const [x, y] = this.camera.toWorld(px, py);
    const hidden = layers.hidden ? hiddenAt(this.complex, x, y, 5 / this.camera.scale) : -1;
    if (hidden >= 0) return { simplex: null, lines: [`hidden point ${hidden}`, HIDDEN] };
    const simplex = this.picker.at(x, y, 5 / this.camera.scale);
    if (!simplex) return null;
    const rows = simplex.corners.map((v) => this.complex.rowOfDrawn(v)).join(", ");
    const what = `${NAMES[simplex.dimension]} ${rows}`;
    const since = `from radius ${number(simplex.value, 6)}`;
    const there = simplex.dimension ? "in" : "there";
    return { simplex, lines: [what, `${simplex.value <= facts.radius ? "" : "not yet "}${there}: ${since}`] };
  }

  /**
   * Draw what lies over the picture: a simplex that is pointed at, and a scale.
   * @param {CanvasRenderingContext2D} c
   * @param {{palette: any, hovered: import("./pick.js").Simplex | null}} state
   */
  drawOver(c, { palette, hovered }) {
    if (this.complex.box) this._drawBox(c, this.complex.box, palette);
    if (hovered) this._drawSimplex(c, hovered, palette);
    this._drawScale(c, palette);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {import("./pick.js").Simplex} simplex
   * @param {any} palette
   */
  _drawSimplex(c, simplex, palette) {
    const p = this.complex.seen.positions;
    const places = simplex.corners.map((v) => this.camera.toScreen(p[2 * v], p[2 * v + 1]));
    c.strokeStyle = palette.radius;
    c.fillStyle = palette.radius;
    c.lineWidth = 2;
    c.beginPath();
    places.forEach(([x, y]) => c.lineTo(x, y));
    c.closePath();
    c.stroke();
    c.globalAlpha = 0.15;
    c.fill();
    c.globalAlpha = 1;
    for (const [x, y] of places) {
      c.beginPath();
      c.arc(x, y, 4, 0, 7);
      c.fill();
    }
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {import("./filtered.js").Box} box
   * @param {any} palette
   */
  _drawBox(c, box, palette) {
    const { veil, rest, frame } = veilOf(box, this.camera);
    c.fillStyle = palette.background;
    c.globalAlpha = VEIL;
    c.fill(new Path2D(veil), "evenodd");
    c.globalAlpha = 1;
    c.fill(new Path2D(rest), "evenodd");
    c.strokeStyle = palette.text;
    c.lineWidth = 1.2;
    c.stroke(new Path2D(frame));
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {any} palette
   */
  _drawScale(c, palette) {
    const pixels = this.camera.scale / this.complex.meta.scale;
    const power = 10 ** Math.floor(Math.log10(110 / pixels));
    const length = [5, 2, 1].map((k) => k * power).find((l) => l * pixels <= 110) ?? power;
    const [x, y, wide] = [16.5, this.camera.height - 16.5, length * pixels];
    c.strokeStyle = palette.quiet;
    c.fillStyle = palette.quiet;
    c.lineWidth = 1.2;
    c.beginPath();
    c.moveTo(x, y - 4);
    c.lineTo(x, y);
    c.lineTo(x + wide, y);
    c.lineTo(x + wide, y - 4);
    c.stroke();
    c.font = "11px system-ui, sans-serif";
    c.textBaseline = "bottom";
    c.textAlign = "left";
    c.fillText(number(length), x + 4, y - 3);
  }

  /**
   * @param {Facts} facts
   * @returns {[string, string][]} the key of a layer, or what it is, and how much
   */
  rows({ present, isolated, singularEdges, boundary, interior, size, border }) {
    const alone = isolated ? `${count(isolated)} alone of ${count(present[0])}` : count(present[0]);
    const hidden = this.complex.hidden.rows.length;
    /** @type {[string, string][]} */
    const besides = hidden ? [["hidden", count(hidden)]] : [];
    return [
      ["triangles", count(present[2])],
      ["edges", count(interior)],
      ["boundary", count(boundary)],
      ["singular", count(singularEdges)],
      ["points", alone],
      ["area", number(size)],
      ["perimeter", number(border)],
      ...besides,
    ];
  }

  /** @param {Facts} facts */
  sentence(facts) {
    const classes = facts.betti.map((value, k) => counted(value, this.complex.words[k]));
    return [
      `radius ${number(facts.radius)}: ${classes.join(", ")}`,
      ...(facts.full ? ["the whole box"] : []),
      counted(facts.present[2], "triangle"),
      counted(facts.isolated, "isolated point"),
    ].join(", ");
  }

  /** @param {{facts: Facts, layers: Record<string, boolean>, palette: any, title: string}} state */
  svg(state) {
    return svgOf(this.complex, { ...state, camera: this.camera });
  }

  /** Whether it is drawn in no time, however carefully. */
  get small() {
    return this.complex.vertexCount <= 3000;
  }
}

/**
 * Return the row of the hidden point at a place, -1 if there is none.
 * @param {import("./plane.js").PlaneComplex} complex
 * @param {number} x
 * @param {number} y
 * @param {number} reach
 */
export function hiddenAt({ hidden }, x, y, reach) {
  const p = hidden.positions;
  let [found, nearest] = [-1, reach];
  for (let i = 0; i < hidden.rows.length; i++) {
    const away = Math.hypot(p[2 * i] - x, p[2 * i + 1] - y);
    if (away <= nearest) [found, nearest] = [hidden.rows[i], away];
  }
  return found;
}
