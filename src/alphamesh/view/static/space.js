// A filtration in space, and the facts at a radius.

import { cofaceRanks, cornersOf, countsBelow, sumsBefore } from "./complex.js";
import { FilteredComplex } from "./filtered.js";
import { Patch } from "./patch.js";

/** @typedef {import("./filtered.js").Facts} Facts */

/** All simplices of a cloud in space, sorted by filtration value. */
export class SpaceComplex extends FilteredComplex {
  /** @param {import("./data.js").Payload} payload */
  constructor(payload) {
    super(payload, 3);
    const { arrays } = payload;
    const triangleEdges = /** @type {Uint32Array} */ (arrays.triangle_facets);
    this.tetrahedronFacets = /** @type {Uint32Array} */ (arrays.tetrahedron_facets);
    this.triangleCount = triangleEdges.length / 3;
    this.tetrahedronCount = this.tetrahedronFacets.length / 4;
    const told = /** @type {Uint32Array | undefined} */ (arrays.triangle_corners);
    this.triangles = told ?? cornersOf(this.edges, triangleEdges);
    this.cofaces = cofaceRanks(this.tetrahedronFacets, 4, this.triangleCount);
    /** The rank of the first triangle of each edge. */
    this.covered = cofaceRanks(triangleEdges, 3, this.edgeCount).first;

    this._verticesJoined = countsBelow(this.joined, this.edgeCount);
    this._edgesCovered = countsBelow(this.covered, this.triangleCount);
    this._entered = countsBelow(this.cofaces.first, this.tetrahedronCount);
    this._left = countsBelow(this.cofaces.last, this.tetrahedronCount);
    const volumes = /** @type {Float32Array | undefined} */ (arrays.cell_sizes);
    this._volumes = sumsBefore(volumes ?? this._measure());
    const areas = /** @type {Float32Array | undefined} */ (arrays.facet_sizes);
    this._areas = sumsBefore(this.borders(this.tetrahedronFacets, areas ?? this._faceAreas()));
    // From here on triangles run counter-clockwise seen from outside.
    if (arrays.triangle_turned) turn(this.triangles, /** @type {Uint8Array} */ (arrays.triangle_turned));
    /** Where the walls of a box cut tetrahedra, and when: nine coordinates each. */
    this.caps = {
      corners: /** @type {Float32Array} */ (arrays.caps ?? new Float32Array(0)),
      ranks: /** @type {Uint32Array} */ (arrays.cap_ranks ?? new Uint32Array(0)),
    };
    /** @type {Patch | null} */
    this.patch = this.box ? new Patch(this, 0) : null;
  }

  /** What is drawn. @returns {SpaceComplex | Patch} */
  get seen() {
    return this.patch ?? this;
  }

  /** Return the volume of each tetrahedron. */
  _measure() {
    return Float64Array.from({ length: this.tetrahedronCount }, (_, t) => this._volume(t));
  }

  /** Return the area of each triangle. */
  _faceAreas() {
    return Float64Array.from({ length: this.triangleCount }, (_, f) => this.triangleArea(f));
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

  /**
   * Return the facts at a radius, in time that does not depend on the size of the cloud.
   * @param {number} radius
   * @returns {Facts}
   */
  at(radius) {
    const present = this.present(radius);
    const [vertices, edges, triangles, tetrahedra] = present;
    const entered = this._entered[tetrahedra];
    const interior = this._left[tetrahedra];
    const boundary = entered - interior;
    const { scale } = this.meta;
    return {
      radius,
      present,
      shown: this.shown(present),
      betti: this.betti(present),
      isolated: vertices - this._verticesJoined[edges],
      singularEdges: edges - this._edgesCovered[triangles],
      singularTriangles: triangles - entered,
      boundary,
      interior,
      size: this._volumes[tetrahedra] * scale ** 3,
      border: boundary ? this._areas[tetrahedra] * scale ** 2 : 0,
      full: this.isFull(present),
    };
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
