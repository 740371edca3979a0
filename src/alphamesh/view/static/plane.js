// A filtration in the plane, and the facts at a radius.

import { cofaceRanks, cornersOf, countsBelow, sumsBefore } from "./complex.js";
import { FilteredComplex } from "./filtered.js";
import { Patch } from "./patch.js";

/** @typedef {import("./filtered.js").Facts} Facts */

/** All simplices of a cloud in the plane, sorted by filtration value. */
export class PlaneComplex extends FilteredComplex {
  /** @param {import("./data.js").Payload} payload */
  constructor(payload) {
    super(payload, 2);
    const { arrays } = payload;
    this.triangleEdges = /** @type {Uint32Array} */ (arrays.triangle_facets);
    this.triangleCount = this.triangleEdges.length / 3;
    const told = /** @type {Uint32Array | undefined} */ (arrays.triangle_corners);
    this.triangles = told ?? cornersOf(this.edges, this.triangleEdges);
    /** Ranks of the cofaces of each edge. */
    this.cofaces = cofaceRanks(this.triangleEdges, 3, this.edgeCount);
    this.covered = this.cofaces.first;

    this._verticesJoined = countsBelow(this.joined, this.edgeCount);
    this._edgesEntered = countsBelow(this.cofaces.first, this.triangleCount);
    this._edgesLeft = countsBelow(this.cofaces.last, this.triangleCount);
    const areas = /** @type {Float32Array | undefined} */ (arrays.cell_sizes);
    this._areas = sumsBefore(areas ?? this._measure());
    const lengths = Float64Array.from({ length: this.edgeCount }, (_, e) => this.edgeLength(e));
    this._lengths = sumsBefore(this.borders(this.triangleEdges, lengths));
    // Of few points discs are drawn, which reach farther.
    /** @type {Patch | null} */
    this.patch = this.box ? new Patch(this, this.vertexCount <= 3000 ? 0.5 : 0.2) : null;
  }

  /** What is drawn. @returns {PlaneComplex | Patch} */
  get seen() {
    return this.patch ?? this;
  }

  /** Return the area of each triangle. */
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
    return areas;
  }

  /**
   * Return the facts at a radius, in time that does not depend on the size of the cloud.
   * @param {number} radius
   * @returns {Facts}
   */
  at(radius) {
    const present = this.present(radius);
    const [vertices, edges, triangles] = present;
    const entered = this._edgesEntered[triangles];
    const interior = this._edgesLeft[triangles];
    const boundary = entered - interior;
    const { scale } = this.meta;
    return {
      radius,
      present,
      shown: this.shown(present),
      betti: this.betti(present),
      isolated: vertices - this._verticesJoined[edges],
      singularEdges: edges - entered,
      boundary,
      interior,
      size: this._areas[triangles] * scale * scale,
      border: boundary ? this._lengths[triangles] * scale : 0,
      full: this.isFull(present),
    };
  }
}
