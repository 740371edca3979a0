// Copies of what a periodic box holds, as far as they are seen: simplices that cross its
// border are drawn on either side.

import { NEVER } from "./complex.js";

/**
 * @typedef {import("./filtered.js").FilteredComplex} FilteredComplex
 * @typedef {import("./filtered.js").Box} Box
 */

/** Copies of vertices, told by the vertex and by how many periods it was moved. */
class Ghosts {
  /** @param {FilteredComplex} complex */
  constructor({ positions, ambient, box }) {
    this.from = positions;
    this.ambient = ambient;
    this.periods = /** @type {Box} */ (box).periods.map((side) => side ?? 0);
    /** @type {Map<number, number>} */
    this.known = new Map();
    /** @type {number[]} */
    this.owner = [];
    /** @type {number[]} */
    this.places = [];
  }

  /**
   * @param {number} vertex
   * @param {number[]} shift -3 to 3 periods in each direction
   * @returns {number} the number of the copy
   */
  at(vertex, shift) {
    const key = shift.reduce((sum, s) => 7 * sum + s + 3, vertex);
    const known = this.known.get(key);
    if (known !== undefined) return known;
    const number = this.owner.push(vertex) - 1;
    this.known.set(key, number);
    for (let k = 0; k < this.ambient; k++) {
      this.places.push(this.from[this.ambient * vertex + k] + shift[k] * this.periods[k]);
    }
    return number;
  }
}

/**
 * Return all moves, in periods, that bring some of an extent into a window.
 * @param {number[]} low
 * @param {number[]} high
 * @param {Box} box
 * @param {number} margin of the window around the box, in periods
 * @returns {number[][]}
 */
export function movesOf(low, high, box, margin) {
  /** @type {number[][]} */
  let moves = [[]];
  box.periods.forEach((side, k) => {
    let [first, last] = [0, 0];
    if (side) {
      first = Math.ceil((box.low[k] - high[k]) / side - margin);
      last = Math.floor((box.high[k] - low[k]) / side + margin);
    }
    const steps = Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => first + i);
    moves = moves.flatMap((move) => steps.map((step) => [...move, step]));
  });
  return moves;
}

/** The moves of what stays where it is, in the plane and in space. */
const STAYS = [[[0, 0]], [[0, 0, 0]]];

/**
 * Whether what lies there is in the box, and none of its copies is seen.
 * @param {number[]} low
 * @param {number[]} high
 * @param {Box} box
 * @param {number} margin
 */
function isAlone(low, high, box, margin) {
  return box.periods.every((side, k) => {
    const room = (1 - margin) * (side ?? 0);
    return !side || (high[k] < box.low[k] + room && low[k] > box.high[k] - room);
  });
}

/** All that is seen of a complex in a box and around it. */
export class Patch {
  /**
   * @param {FilteredComplex} complex
   * @param {number} margin how far it reaches beyond the box, in periods
   */
  constructor(complex, margin) {
    this.complex = complex;
    this.margin = margin;
    const ghosts = new Ghosts(complex);
    /** For each dimension how many copies there are of the first so many simplices. */
    this.starts = /** @type {Uint32Array[]} */ ([]);
    const { vertexCount, edges, triangles, offsets } = complex;
    const one = Uint32Array.from({ length: vertexCount }, (_, v) => v);
    // Copies of vertices within the window stand first; corners beyond it follow.
    this.own = /** @type {Uint32Array[]} */ ([]);
    this.vertexCount = this._copy(ghosts, one, 1, new Uint8Array(0)).length;
    this.edges = this._copy(ghosts, edges, 2, offsets.edges);
    this.edgeCount = this.edges.length / 2;
    this.triangles = this._copy(ghosts, triangles, 3, offsets.triangles);
    this.triangleCount = this.triangles.length / 3;
    this.owner = Uint32Array.from(ghosts.owner);
    this.positions = Float32Array.from(ghosts.places);
    this.joined = this.owner.map((v) => complex.joined[v]);
    const { weights, cofaces } = complex;
    this.weights = weights && Float32Array.from(this.owner, (v) => weights[v]);
    /** Ranks of the cofaces of facets. */
    const facets = this.own[complex.ambient - 1];
    this.cofaces = {
      first: facets.map((f) => cofaces.first[f]),
      last: facets.map((f) => cofaces.last[f]),
    };
    /** @type {Uint32Array} */
    this.covered = this.own[1].map((e) => complex.covered[e]);
    /** @type {{first: Uint32Array, last: Uint32Array} | null} */
    this._around = null;
  }

  /**
   * @param {Ghosts} ghosts
   * @param {Uint32Array} corners
   * @param {number} size corners of a simplex
   * @param {Uint8Array} offsets of all corners but the first, by one larger than they are
   */
  _copy(ghosts, corners, size, offsets) {
    const { ambient, positions, box } = this.complex;
    const count = corners.length / size;
    const starts = new Uint32Array(count + 1);
    /** @type {number[]} */
    const own = [];
    /** @type {number[]} */
    const copies = [];
    const shifts = Array.from({ length: size }, () => new Array(ambient).fill(0));
    const [low, high] = [new Array(ambient), new Array(ambient)];
    for (let i = 0; i < count; i++) {
      low.fill(Infinity);
      high.fill(-Infinity);
      for (let j = 0; j < size; j++) {
        const v = corners[size * i + j];
        for (let k = 0; k < ambient; k++) {
          if (j) shifts[j][k] = offsets[((size - 1) * i + j - 1) * ambient + k] - 1;
          const place = positions[ambient * v + k] + shifts[j][k] * ghosts.periods[k];
          low[k] = Math.min(low[k], place);
          high[k] = Math.max(high[k], place);
        }
      }
      const moves = isAlone(low, high, /** @type {Box} */ (box), this.margin)
        ? STAYS[ambient - 2]
        : movesOf(low, high, /** @type {Box} */ (box), this.margin);
      for (const move of moves) {
        own.push(i);
        for (let j = 0; j < size; j++) {
          copies.push(ghosts.at(corners[size * i + j], shifts[j].map((s, k) => s + move[k])));
        }
      }
      starts[i + 1] = own.length;
    }
    this.starts.push(starts);
    this.own.push(Uint32Array.from(own));
    return Uint32Array.from(copies);
  }

  /** How many copies are there. @param {number[]} present @returns {number[]} */
  shown(present) {
    return this.starts.map((starts, k) => starts[present[k]]);
  }

  /** Numbers of the triangles of the patch around its edges, in the plane. */
  get around() {
    if (this._around) return this._around;
    const size = this.owner.length;
    /** @type {Map<number, number>} */
    const known = new Map();
    /** @param {number} a @param {number} b */
    const key = (a, b) => Math.min(a, b) * size + Math.max(a, b);
    for (let e = 0; e < this.edgeCount; e++) {
      known.set(key(this.edges[2 * e], this.edges[2 * e + 1]), e);
    }
    const first = new Uint32Array(this.edgeCount).fill(NEVER);
    const last = new Uint32Array(this.edgeCount).fill(NEVER);
    for (let i = 0; i < this.triangles.length; i++) {
      const t = 3 * Math.floor(i / 3);
      const [a, b] = [this.triangles[t + ((i + 1) % 3)], this.triangles[t + ((i + 2) % 3)]];
      const e = known.get(key(a, b));
      if (e === undefined) continue;
      if (first[e] === NEVER) first[e] = t / 3;
      else last[e] = t / 3;
    }
    return (this._around = { first, last });
  }

  /** Whether all triangles around an edge are in the patch. @param {number} e */
  isWhole(e) {
    /** @param {{first: Uint32Array, last: Uint32Array}} of */
    const count = ({ first, last }) => (first[e] === NEVER ? 0 : last[e] === NEVER ? 1 : 2);
    return count(this.around) === count(this.cofaces);
  }

  /** @param {number} colours */
  coloured(colours) {
    const found = this.complex.coloured(colours);
    return Uint8Array.from(this.owner, (v) => found[v]);
  }
}
