// Which edges are on the boundary or singular at a radius, as lines with a width.

/**
 * @typedef {import("./plane.js").PlaneComplex} PlaneComplex
 * @typedef {import("./filtered.js").Facts} Facts
 */

/** How often both ends of a line stand in the array: for six corners of two triangles. */
export const CORNERS = 6;

/** Picks edges into an array that is used again and again. */
export class EdgePicker {
  /** @param {PlaneComplex | import("./patch.js").Patch} complex what is drawn */
  constructor(complex) {
    this.complex = complex;
    this.numbers = new Float32Array(1 << 12);
    this.length = 0;
    this.corners = CORNERS;
  }

  /**
   * Pick the singular edges, then those of the boundary.
   *
   * One pass over the edges that are there: an edge is on the boundary from the rank of
   * its first triangle up to, not including, that of its last one.
   * @param {Facts} facts
   * @param {boolean} thin lines as thin as a pixel need their ends alone
   * @returns {{singular: number, boundary: number}} how many
   */
  pick({ present: [, , triangles], shown: [, edges] }, thin) {
    const { first, last } = this.complex.cofaces;
    this.length = 0;
    this.corners = thin ? 1 : CORNERS;
    for (let e = 0; e < edges; e++) if (first[e] >= triangles) this._add(e);
    const singular = this.length / (4 * this.corners);
    for (let e = 0; e < edges; e++) {
      if (first[e] < triangles && last[e] >= triangles) this._add(e);
    }
    return { singular, boundary: this.length / (4 * this.corners) - singular };
  }

  /** @param {number} e */
  _add(e) {
    if (this.length + 4 * CORNERS > this.numbers.length) {
      const larger = new Float32Array(2 * this.numbers.length);
      larger.set(this.numbers);
      this.numbers = larger;
    }
    const { edges, positions: p } = this.complex;
    const a = 2 * edges[2 * e];
    const b = 2 * edges[2 * e + 1];
    for (let corner = 0; corner < this.corners; corner++) {
      this.numbers[this.length++] = p[a];
      this.numbers[this.length++] = p[a + 1];
      this.numbers[this.length++] = p[b];
      this.numbers[this.length++] = p[b + 1];
    }
  }
}
