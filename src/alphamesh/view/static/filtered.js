// What is the same in the plane and in space: values, classes, and counts at a radius.

import { countUpTo, diagramOf, joiners, NEVER, sumsBefore } from "./complex.js";

/**
 * What is in the complex at a radius.
 * @typedef {object} Facts
 * @property {number} radius
 * @property {number[]} present simplices of each dimension
 * @property {number[]} betti
 * @property {number} isolated vertices without an edge
 * @property {number} singularEdges
 * @property {number} [singularTriangles]
 * @property {number} boundary facets on the boundary
 * @property {number} interior facets inside
 * @property {number} size area, or volume
 * @property {number} border perimeter, or area of the surface
 */

const NAMES = ["vertex", "edge", "triangle", "tetrahedron"];

/** All simplices of a cloud, sorted by filtration value. */
export class FilteredComplex {
  /**
   * @param {import("./data.js").Payload} payload
   * @param {2 | 3} ambient
   */
  constructor({ meta, arrays }, ambient) {
    this.ambient = ambient;
    this.meta = meta;
    this.positions = /** @type {Float32Array} */ (arrays.positions);
    this.vertexCount = this.positions.length / ambient;
    /** Rows of the cloud, if vertices have other numbers. */
    this.rows = /** @type {Uint32Array | undefined} */ (arrays.rows);
    this.edges = /** @type {Uint32Array} */ (arrays.edges);
    this.edgeCount = this.edges.length / 2;
    /** Whether radii are signed roots of power values. */
    this.signed = Boolean(meta.signed);
    /** Squared radii of the balls at radius 0, in squared units of the picture. */
    this.weights = /** @type {Float32Array | undefined} */ (arrays.weights);
    this.heaviest = this.weights ? this.weights.reduce((a, b) => Math.max(a, b), -Infinity) : 0;
    this.hidden = {
      rows: /** @type {Uint32Array} */ (arrays.hidden ?? new Uint32Array(0)),
      positions: /** @type {Float32Array} */ (arrays.hidden_positions ?? new Float32Array(0)),
    };

    const names = NAMES.slice(0, ambient + 1);
    /** Filtration values by dimension. @type {Float64Array[]} */
    this.values = names.map((name) => /** @type {Float64Array} */ (arrays[`${name}_values`]));
    this.values[0] ??= new Float64Array(this.vertexCount); // all of them come at 0
    const enders = names.map((name) => /** @type {Uint32Array} */ (arrays[`${name}_creators`]));
    enders[1] ??= joiners(enders[2], this.edgeCount);
    /** Births and deaths by dimension. */
    this.diagrams = names
      .slice(0, ambient)
      .map((_, k) => diagramOf(this.values[k], this.values[k + 1], enders[k + 1], enders[k]));
    /** How many of the first simplices of each dimension end a class. */
    this._ended = enders.map((own) => own && sumsBefore(own.map((c) => (c === NEVER ? 0 : 1))));
  }

  /** The radius at which the first vertex comes. */
  get first() {
    return this.values[0][0] ?? 0;
  }

  /**
   * Return how many simplices of each dimension are there.
   * @param {number} radius
   * @returns {number[]}
   */
  present(radius) {
    return this.values.map((values) => countUpTo(values, radius));
  }

  /** @param {number[]} present @returns {number[]} */
  betti(present) {
    return this.diagrams.map((_, k) => {
      const begun = present[k] - (k ? this._ended[k][present[k]] : 0);
      return begun - this._ended[k + 1][present[k + 1]];
    });
  }

  /** The power value of a radius, in squared units of the picture. @param {number} radius */
  power(radius) {
    const scaled = radius / this.meta.scale;
    return scaled * Math.abs(scaled);
  }

  /** The radius of the largest ball, in units of the picture. @param {number} radius */
  reach(radius) {
    if (!this.weights) return radius / this.meta.scale;
    return Math.sqrt(Math.max(0, this.heaviest + this.power(radius)));
  }

  /**
   * Return the row of the cloud that a vertex is.
   * @param {number} vertex
   */
  rowOf(vertex) {
    return this.rows ? this.rows[vertex] : vertex;
  }
}
