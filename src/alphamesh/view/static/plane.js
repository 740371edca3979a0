// A filtration in the plane, and the facts at a radius.

import {
  cofaceRanks,
  cornersOf,
  countUpTo,
  countsBelow,
  diagramsOf,
  firstEdges,
  marked,
  sumsBefore,
} from "./complex.js";

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

/** All simplices of a cloud in the plane, sorted by filtration value. */
export class PlaneComplex {
  /** @param {import("./data.js").Payload} payload */
  constructor({ meta, arrays }) {
    this.ambient = 2;
    this.meta = meta;
    this.positions = /** @type {Float32Array} */ (arrays.positions);
    this.rows = /** @type {Uint32Array | undefined} */ (arrays.rows);
    this.edges = /** @type {Uint32Array} */ (arrays.edges);
    this.edgeValues = /** @type {Float64Array} */ (arrays.edge_values);
    this.triangleEdges = /** @type {Uint32Array} */ (arrays.triangle_facets);
    this.triangleValues = /** @type {Float64Array} */ (arrays.triangle_values);
    const loops = /** @type {Uint32Array} */ (arrays.triangle_creators);

    this.vertexCount = this.positions.length / 2;
    this.edgeCount = this.edgeValues.length;
    this.triangleCount = this.triangleValues.length;
    this.triangles = cornersOf(this.edges, this.triangleEdges);
    /** Ranks of the cofaces of each edge. */
    this.cofaces = cofaceRanks(this.triangleEdges, 3, this.edgeCount);
    this.joined = firstEdges(this.edges, this.vertexCount);

    this.values = [this.edgeValues, this.triangleValues];
    this.diagrams = diagramsOf(this.vertexCount, this.values, [loops]);
    this._loopsBegun = sumsBefore(marked(loops, this.edgeCount));
    this._verticesJoined = countsBelow(this.joined, this.edgeCount);
    this._edgesEntered = countsBelow(this.cofaces.first, this.triangleCount);
    this._edgesLeft = countsBelow(this.cofaces.last, this.triangleCount);
    const { areas, lengths } = this._measure();
    this._areas = sumsBefore(areas);
    this._lengths = sumsBefore(lengths);
  }

  /** Return how the area and the length of the border change with each triangle. */
  _measure() {
    const areas = new Float64Array(this.triangleCount);
    const p = this.positions;
    for (let t = 0; t < areas.length; t++) {
      const a = 2 * this.triangles[3 * t];
      const b = 2 * this.triangles[3 * t + 1];
      const c = 2 * this.triangles[3 * t + 2];
      const cross =
        (p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[c] - p[a]) * (p[b + 1] - p[a + 1]);
      areas[t] = Math.abs(cross) / 2;
    }
    // How the length of the border changes when a triangle comes.
    const lengths = new Float64Array(this.triangleCount);
    for (let i = 0; i < this.triangleEdges.length; i++) {
      const e = this.triangleEdges[i];
      const t = Math.floor(i / 3);
      const length = this.edgeLength(e);
      lengths[t] += this.cofaces.first[e] === t ? length : -length;
    }
    return { areas, lengths };
  }

  /**
   * @param {number} e
   * @returns {number} in units of the picture
   */
  edgeLength(e) {
    const [a, b] = [2 * this.edges[2 * e], 2 * this.edges[2 * e + 1]];
    const p = this.positions;
    return Math.hypot(p[b] - p[a], p[b + 1] - p[a + 1]);
  }

  /**
   * Return the facts at a radius, in time that does not depend on the size of the cloud.
   * @param {number} radius
   * @returns {Facts}
   */
  at(radius) {
    const edges = countUpTo(this.edgeValues, radius);
    const triangles = countUpTo(this.triangleValues, radius);
    const begun = this._loopsBegun[edges];
    const entered = this._edgesEntered[triangles];
    const interior = this._edgesLeft[triangles];
    const boundary = entered - interior;
    const { scale } = this.meta;
    return {
      radius,
      present: [this.vertexCount, edges, triangles],
      betti: [this.vertexCount - (edges - begun), begun - triangles],
      isolated: this.vertexCount - this._verticesJoined[edges],
      singularEdges: edges - entered,
      boundary,
      interior,
      size: this._areas[triangles] * scale * scale,
      border: boundary ? this._lengths[triangles] * scale : 0,
    };
  }

  /**
   * Return the row of the cloud that a vertex is.
   * @param {number} vertex
   */
  rowOf(vertex) {
    return this.rows ? this.rows[vertex] : vertex;
  }
}
