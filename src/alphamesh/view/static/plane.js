// A filtration in the plane, and the facts at a radius.

import { cofaceRanks, cornersOf, countsBelow, firstEdges, sumsBefore } from "./complex.js";
import { FilteredComplex } from "./filtered.js";

/** @typedef {import("./filtered.js").Facts} Facts */

/** All simplices of a cloud in the plane, sorted by filtration value. */
export class PlaneComplex extends FilteredComplex {
  /** @param {import("./data.js").Payload} payload */
  constructor(payload) {
    super(payload, 2);
    const { arrays } = payload;
    this.triangleEdges = /** @type {Uint32Array} */ (arrays.triangle_facets);
    this.triangleCount = this.triangleEdges.length / 3;
    this.triangles = cornersOf(this.edges, this.triangleEdges);
    /** Ranks of the cofaces of each edge. */
    this.cofaces = cofaceRanks(this.triangleEdges, 3, this.edgeCount);
    this.joined = firstEdges(this.edges, this.vertexCount);

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
    const present = this.present(radius);
    const [vertices, edges, triangles] = present;
    const entered = this._edgesEntered[triangles];
    const interior = this._edgesLeft[triangles];
    const boundary = entered - interior;
    const { scale } = this.meta;
    return {
      radius,
      present,
      betti: this.betti(present),
      isolated: vertices - this._verticesJoined[edges],
      singularEdges: edges - entered,
      boundary,
      interior,
      size: this._areas[triangles] * scale * scale,
      border: boundary ? this._lengths[triangles] * scale : 0,
    };
  }
}
