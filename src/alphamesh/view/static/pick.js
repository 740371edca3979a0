// Which simplex is at a place in the plane.

import { NEVER } from "./complex.js";

/**
 * @typedef {import("./plane.js").PlaneComplex} PlaneComplex
 * @typedef {{dimension: 0 | 1 | 2, index: number, corners: number[], value: number}} Simplex
 */

/**
 * Twice the area of a triangle, negative if clockwise.
 * @param {Float32Array} p
 * @param {number} a
 * @param {number} b
 * @param {number} x
 * @param {number} y
 */
export function turn(p, a, b, x, y) {
  const [ax, ay] = [p[2 * a], p[2 * a + 1]];
  return (p[2 * b] - ax) * (y - ay) - (x - ax) * (p[2 * b + 1] - ay);
}

/**
 * Walk from a triangle to the one that holds a place.
 * @param {PlaneComplex} complex
 * @param {number} x
 * @param {number} y
 * @param {number} start
 * @returns {{triangle: number, exit: number}} `exit` is the hull edge that was crossed if
 * the place is outside, and `triangle` the last one before it
 */
export function locate(complex, x, y, start) {
  const { positions: p, triangles, triangleEdges, cofaces } = complex;
  let t = start < complex.triangleCount ? start : 0;
  // A walk in a Delaunay triangulation ends; this holds for one whose corners were rounded.
  for (let step = 0; step < 4 * complex.triangleCount + 8; step++) {
    let crossed = -1;
    for (let i = 0; i < 3 && crossed < 0; i++) {
      const k = (i + step) % 3;
      const own = triangles[3 * t + k];
      const a = triangles[3 * t + ((k + 1) % 3)];
      const b = triangles[3 * t + ((k + 2) % 3)];
      const inner = turn(p, a, b, p[2 * own], p[2 * own + 1]);
      const here = turn(p, a, b, x, y);
      if ((inner > 0 && here < 0) || (inner < 0 && here > 0)) crossed = triangleEdges[3 * t + k];
    }
    if (crossed < 0) return { triangle: t, exit: -1 };
    const other = cofaces.first[crossed] === t ? cofaces.last[crossed] : cofaces.first[crossed];
    if (other === NEVER) return { triangle: t, exit: crossed };
    t = other;
  }
  return { triangle: t, exit: -1 };
}

/**
 * Return how far a place is from an edge.
 * @param {PlaneComplex | import("./patch.js").Patch} complex
 * @param {number} e
 * @param {number} x
 * @param {number} y
 */
export function distanceToEdge(complex, e, x, y) {
  const { positions: p, edges } = complex;
  const [a, b] = [2 * edges[2 * e], 2 * edges[2 * e + 1]];
  const [dx, dy] = [p[b] - p[a], p[b + 1] - p[a + 1]];
  const along = ((x - p[a]) * dx + (y - p[a + 1]) * dy) / (dx * dx + dy * dy || 1);
  const t = Math.max(0, Math.min(1, along));
  return Math.hypot(x - p[a] - t * dx, y - p[a + 1] - t * dy);
}

/** Finds simplices under the pointer; remembers where it was, as pointers move little. */
export class Picker {
  /** @param {PlaneComplex} complex */
  constructor(complex) {
    this.complex = complex;
    this.last = 0;
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} reach how close a vertex or an edge must be
   * @returns {Simplex | null}
   */
  at(x, y, reach) {
    const { complex } = this;
    if (complex.triangleCount === 0) return this._nearest(allOf(complex), x, y, reach);
    const { triangle, exit } = locate(complex, x, y, this.last);
    this.last = triangle;
    const corners = [...complex.triangles.subarray(3 * triangle, 3 * triangle + 3)];
    const edges = [...complex.triangleEdges.subarray(3 * triangle, 3 * triangle + 3)];
    const near = this._nearest({ vertices: corners, edges }, x, y, reach);
    if (near || exit >= 0) return near;
    return { dimension: 2, index: triangle, corners, value: complex.values[2][triangle] };
  }

  /**
   * @param {{vertices: number[], edges: number[]}} among
   * @param {number} x
   * @param {number} y
   * @param {number} reach
   * @returns {Simplex | null}
   */
  _nearest({ vertices, edges }, x, y, reach) {
    const { complex } = this;
    const p = complex.positions;
    /** @param {number} v */
    const away = (v) => Math.hypot(x - p[2 * v], y - p[2 * v + 1]);
    const v = least(vertices, away);
    if (v >= 0 && away(v) <= 1.4 * reach) {
      return { dimension: 0, index: v, corners: [v], value: complex.values[0][v] };
    }
    const e = least(edges, (edge) => distanceToEdge(complex, edge, x, y));
    if (e < 0 || distanceToEdge(complex, e, x, y) > reach) return null;
    const corners = [complex.edges[2 * e], complex.edges[2 * e + 1]];
    return { dimension: 1, index: e, corners, value: complex.values[1][e] };
  }
}

/** Finds simplices under the pointer among all that are drawn in and around a box. */
export class PatchPicker {
  /** @param {PlaneComplex} complex */
  constructor(complex) {
    this.complex = complex;
    this.patch = /** @type {import("./patch.js").Patch} */ (complex.patch);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} reach how close a vertex or an edge must be
   * @returns {Simplex | null}
   */
  at(x, y, reach) {
    const { patch } = this;
    const { positions: p, edges, triangles } = patch;
    const v = nearest(patch.vertexCount, 1.4 * reach, (i) => Math.hypot(x - p[2 * i], y - p[2 * i + 1]));
    if (v >= 0) return this._simplex(0, v, [v]);
    const e = nearest(patch.edgeCount, reach, (i) => distanceToEdge(patch, i, x, y));
    if (e >= 0) return this._simplex(1, e, [edges[2 * e], edges[2 * e + 1]]);
    for (let t = 0; t < patch.triangleCount; t++) {
      const [a, b, c] = triangles.subarray(3 * t, 3 * t + 3);
      const turns = [turn(p, a, b, x, y), turn(p, b, c, x, y), turn(p, c, a, x, y)];
      if (turns.every((s) => s >= 0) || turns.every((s) => s <= 0)) {
        return this._simplex(2, t, [a, b, c]);
      }
    }
    return null;
  }

  /**
   * @param {0 | 1 | 2} dimension
   * @param {number} index
   * @param {number[]} corners
   * @returns {Simplex}
   */
  _simplex(dimension, index, corners) {
    const value = this.complex.values[dimension][this.patch.own[dimension][index]];
    return { dimension, index, corners, value };
  }
}

/**
 * Return the nearest of some things, -1 if none is within reach.
 * @param {number} count
 * @param {number} reach
 * @param {(i: number) => number} away
 */
function nearest(count, reach, away) {
  let [found, least] = [-1, reach];
  for (let i = 0; i < count; i++) {
    const far = away(i);
    if (far <= least) [found, least] = [i, far];
  }
  return found;
}

/**
 * @param {PlaneComplex} complex
 */
function allOf(complex) {
  return {
    vertices: Array.from({ length: complex.vertexCount }, (_, i) => i),
    edges: Array.from({ length: complex.edgeCount }, (_, i) => i),
  };
}

/**
 * @param {number[]} items
 * @param {(item: number) => number} size
 * @returns {number} -1 if there are none
 */
function least(items, size) {
  let [best, smallest] = [-1, Infinity];
  for (const item of items) {
    const value = size(item);
    if (value < smallest) [best, smallest] = [item, value];
  }
  return best;
}
