// A filtration in space, and the facts at a radius.

import {
  cofaceRanks,
  cornersOf,
  countUpTo,
  countsBelow,
  diagramsOf,
  firstEdges,
  marked,
  NEVER,
  sumsBefore,
} from "./complex.js";

/** @typedef {import("./plane.js").Facts} Facts */

/** All simplices of a cloud in space, sorted by filtration value. */
export class SpaceComplex {
  /** @param {import("./data.js").Payload} payload */
  constructor({ meta, arrays }) {
    this.ambient = 3;
    this.meta = meta;
    this.positions = /** @type {Float32Array} */ (arrays.positions);
    this.rows = /** @type {Uint32Array | undefined} */ (arrays.rows);
    this.edges = /** @type {Uint32Array} */ (arrays.edges);
    this.edgeValues = /** @type {Float64Array} */ (arrays.edge_values);
    this.triangleValues = /** @type {Float64Array} */ (arrays.triangle_values);
    this.tetrahedronFacets = /** @type {Uint32Array} */ (arrays.tetrahedron_facets);
    this.tetrahedronValues = /** @type {Float64Array} */ (arrays.tetrahedron_values);
    const triangleEdges = /** @type {Uint32Array} */ (arrays.triangle_facets);
    const loops = /** @type {Uint32Array} */ (arrays.triangle_creators);
    const voids = /** @type {Uint32Array} */ (arrays.tetrahedron_creators);

    this.vertexCount = this.positions.length / 3;
    this.edgeCount = this.edgeValues.length;
    this.triangleCount = this.triangleValues.length;
    this.tetrahedronCount = this.tetrahedronValues.length;
    this.triangles = cornersOf(this.edges, triangleEdges);
    this.cofaces = cofaceRanks(this.tetrahedronFacets, 4, this.triangleCount);
    /** The rank of the first triangle of each edge. */
    this.covered = cofaceRanks(triangleEdges, 3, this.edgeCount).first;
    this.joined = firstEdges(this.edges, this.vertexCount);

    this.values = [this.edgeValues, this.triangleValues, this.tetrahedronValues];
    this.diagrams = diagramsOf(this.vertexCount, this.values, [loops, voids]);
    this._loopsBegun = sumsBefore(marked(loops, this.edgeCount));
    this._loopsEnded = sumsBefore(loops.map((creator) => (creator === NEVER ? 0 : 1)));
    this._verticesJoined = countsBelow(this.joined, this.edgeCount);
    this._edgesCovered = countsBelow(this.covered, this.triangleCount);
    this._entered = countsBelow(this.cofaces.first, this.tetrahedronCount);
    this._left = countsBelow(this.cofaces.last, this.tetrahedronCount);
    const { volumes, areas } = this._measure();
    this._volumes = sumsBefore(volumes);
    this._areas = sumsBefore(areas);
    // From here on triangles run counter-clockwise seen from outside.
    turn(this.triangles, /** @type {Uint8Array} */ (arrays.triangle_turned));
  }

  /** Return how the volume and the area of the surface change with each tetrahedron. */
  _measure() {
    const volumes = new Float64Array(this.tetrahedronCount);
    const areas = new Float64Array(this.tetrahedronCount);
    const single = new Float64Array(this.triangleCount);
    for (let f = 0; f < single.length; f++) single[f] = this.triangleArea(f);
    for (let i = 0; i < this.tetrahedronFacets.length; i++) {
      const f = this.tetrahedronFacets[i];
      areas[i >> 2] += this.cofaces.first[f] === i >> 2 ? single[f] : -single[f];
    }
    for (let t = 0; t < volumes.length; t++) volumes[t] = this._volume(t);
    return { volumes, areas };
  }

  /** @param {number} f @returns {number} in units of the picture */
  triangleArea(f) {
    const [ux, uy, uz] = this._step(this.triangles[3 * f], this.triangles[3 * f + 1]);
    const [vx, vy, vz] = this._step(this.triangles[3 * f], this.triangles[3 * f + 2]);
    return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }

  /** @param {number} t */
  _volume(t) {
    // The last facet has all corners but the last, the first one all but the first.
    const abc = 3 * this.tetrahedronFacets[4 * t + 3];
    const d = this.triangles[3 * this.tetrahedronFacets[4 * t] + 2];
    const a = this.triangles[abc];
    const [ux, uy, uz] = this._step(a, this.triangles[abc + 1]);
    const [vx, vy, vz] = this._step(a, this.triangles[abc + 2]);
    const [wx, wy, wz] = this._step(a, d);
    const cross = ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx);
    return Math.abs(cross) / 6;
  }

  /** @param {number} a @param {number} b */
  _step(a, b) {
    const p = this.positions;
    return [p[3 * b] - p[3 * a], p[3 * b + 1] - p[3 * a + 1], p[3 * b + 2] - p[3 * a + 2]];
  }

  /** @param {number} e @returns {number} in units of the picture */
  edgeLength(e) {
    return Math.hypot(...this._step(this.edges[2 * e], this.edges[2 * e + 1]));
  }

  /**
   * Return the facts at a radius, in time that does not depend on the size of the cloud.
   * @param {number} radius
   * @returns {Facts}
   */
  at(radius) {
    const edges = countUpTo(this.edgeValues, radius);
    const triangles = countUpTo(this.triangleValues, radius);
    const tetrahedra = countUpTo(this.tetrahedronValues, radius);
    const begun = this._loopsBegun[edges];
    const ended = this._loopsEnded[triangles];
    const entered = this._entered[tetrahedra];
    const interior = this._left[tetrahedra];
    const boundary = entered - interior;
    const { scale } = this.meta;
    return {
      radius,
      present: [this.vertexCount, edges, triangles, tetrahedra],
      betti: [this.vertexCount - (edges - begun), begun - ended, triangles - ended - tetrahedra],
      isolated: this.vertexCount - this._verticesJoined[edges],
      singularEdges: edges - this._edgesCovered[triangles],
      singularTriangles: triangles - entered,
      boundary,
      interior,
      size: this._volumes[tetrahedra] * scale ** 3,
      border: boundary ? this._areas[tetrahedra] * scale ** 2 : 0,
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

/**
 * Exchange the last two corners of the triangles that are marked.
 * @param {Uint32Array} triangles
 * @param {Uint8Array} turned
 */
function turn(triangles, turned) {
  for (let f = 0; f < turned.length; f++) {
    if (turned[f] === 0) continue;
    const second = triangles[3 * f + 1];
    triangles[3 * f + 1] = triangles[3 * f + 2];
    triangles[3 * f + 2] = second;
  }
}
