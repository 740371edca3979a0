// Voronoi cells as triangles: each edge of the triangulation and its ridge, the stretch
// between the centres of its triangles, make one triangle in the cell of either end. So a
// pixel is drawn once, however large the discs; a shader cuts off what is beyond the radius.
//
// With weights cells are those of the power diagram, and a point may lie outside of its own
// cell: there triangles have their tip at some place in the cell instead.

import { NEVER } from "./complex.js";

/**
 * Numbers of a piece: both ends, both ends of the ridge, the colours of the ends, and their
 * weights; with weights, then the tips in the cells of both ends.
 */
export const PIECE = 12;
export const WEIGHTED_PIECE = 16;

/**
 * @typedef {import("./plane.js").PlaneComplex | import("./patch.js").Patch} Cells
 * @typedef {[number, number]} Place
 */

/** How many numbers a piece has. @param {Cells} complex */
export function pieceSize(complex) {
  return complex.weights ? WEIGHTED_PIECE : PIECE;
}

/**
 * Return how far the centre of a triangle, that of its circle or, with weights, the place of
 * equal power, is along the normal of an edge, counted from the place on its line that has
 * equal power, and on which side the third point is.
 * @param {number} px the third point, seen from that place
 * @param {number} py
 * @param {number} weight of the third point
 * @param {number} nx the unit normal
 * @param {number} ny
 * @param {number} power of that place with regard to either end
 * @param {number} far where to stop
 */
export function centreAlong(px, py, weight, nx, ny, power, far) {
  const height = px * nx + py * ny;
  const side = height < 0 ? -1 : 1;
  const along = (px * px + py * py - weight - power) / (2 * height || side * 1e-300);
  return { along: Math.max(-far, Math.min(far, along)), side };
}

/** Collects pieces in one array of floats. */
class Pieces {
  /**
   * @param {Cells} complex
   * @param {number} colours
   */
  constructor(complex, colours) {
    this.size = pieceSize(complex);
    this.weights = complex.weights;
    this.colours = complex.coloured(colours);
    this.numbers = new Float32Array(this.size << 8);
    this.length = 0;
    /** Sums of places in each cell, and how many there are. */
    this.inside = new Float64Array(this.weights ? (3 * complex.positions.length) / 2 : 0);
    /** @type {number[]} both ends of each piece */
    this.ends = [];
  }

  /**
   * @param {number} u
   * @param {number} v
   * @param {number[]} places coordinates of u, v and of the ends of the ridge
   */
  add(u, v, places) {
    if (this.length + this.size > this.numbers.length) {
      const larger = new Float32Array(2 * this.numbers.length);
      larger.set(this.numbers);
      this.numbers = larger;
    }
    this.numbers.set(places, this.length);
    this.numbers[this.length + 8] = this.colours[u];
    this.numbers[this.length + 9] = this.colours[v];
    if (this.weights) {
      this.numbers[this.length + 10] = this.weights[u];
      this.numbers[this.length + 11] = this.weights[v];
      this.ends.push(u, v);
    }
    this.length += this.size;
  }

  /**
   * Take note of a place in the cells of both ends of an edge.
   * @param {number} u
   * @param {number} v
   * @param {number} x
   * @param {number} y
   */
  holds(u, v, x, y) {
    if (!this.weights) return;
    for (const w of [u, v]) {
      this.inside[3 * w] += x;
      this.inside[3 * w + 1] += y;
      this.inside[3 * w + 2] += 1;
    }
  }

  /**
   * Return a place in the cell of a vertex: a cell is convex, and holds the mean of places.
   * @param {number} v
   * @param {ArrayLike<number>} positions
   * @returns {Place}
   */
  tip(v, positions) {
    const count = this.inside[3 * v + 2];
    if (!count) return [positions[2 * v], positions[2 * v + 1]];
    return [this.inside[3 * v] / count, this.inside[3 * v + 1] / count];
  }

  /** Write the tips of all pieces. @param {ArrayLike<number>} positions */
  finish(positions) {
    for (let i = 0; i < this.ends.length; i += 2) {
      const at = (this.size * i) / 2 + 12;
      this.numbers.set(this.tip(this.ends[i], positions), at);
      this.numbers.set(this.tip(this.ends[i + 1], positions), at + 2);
    }
    return this.numbers.slice(0, this.length);
  }
}

/**
 * Return the pieces of all cells, `pieceSize` floats each.
 * @param {Cells} complex
 * @param {number} far no disc reaches so far
 * @param {number} [colours]
 * @returns {Float32Array}
 */
export function cellPieces(complex, far, colours = 7) {
  const pieces = new Pieces(complex, colours);
  /** @type {Map<number, Place>} */
  const out = new Map();
  /** @type {[number, number, Place][]} */
  const into = [];
  for (let e = 0; e < complex.edgeCount; e++) {
    if (complex.isWhole(e)) addRidge(complex, e, far, pieces, out, into);
  }
  addSectors(complex, far, pieces, out, into);
  return pieces.finish(complex.positions);
}

/**
 * Add the piece of an edge; note where unbounded cells end.
 * @param {Cells} complex
 * @param {number} e
 * @param {number} far
 * @param {Pieces} pieces
 * @param {Map<number, Place>} out by start * 2^32 + end
 * @param {[number, number, Place][]} into
 */
function addRidge(complex, e, far, pieces, out, into) {
  const { positions: p, edges, triangles, around, weights } = complex;
  const [u, v] = [edges[2 * e], edges[2 * e + 1]];
  const [ux, uy, vx, vy] = [p[2 * u], p[2 * u + 1], p[2 * v], p[2 * v + 1]];
  const length = Math.hypot(vx - ux, vy - uy);
  if (length === 0) return; // closer than a picture can tell
  // The normal points to the right of the way from u to v.
  const [nx, ny] = [(vy - uy) / length, (ux - vx) / length];
  // Where the line through both ends has equal power: without weights in the middle.
  const lean = weights ? (weights[u] - weights[v]) / (2 * length * length) : 0;
  const [mx, my] = [ux + (0.5 + lean) * (vx - ux), uy + (0.5 + lean) * (vy - uy)];
  const power = ((0.5 + lean) * length) ** 2 - (weights ? weights[u] : 0);
  /** @type {number[]} */
  const ends = [];
  let open = 0;
  for (const t of [around.first[e], around.last[e]]) {
    if (t === NEVER) continue;
    const w = triangles[3 * t] + triangles[3 * t + 1] + triangles[3 * t + 2] - u - v;
    const weight = weights ? weights[w] : 0;
    const found = centreAlong(p[2 * w] - mx, p[2 * w + 1] - my, weight, nx, ny, power, far);
    ends.push(found.along);
    open = -found.side;
  }
  /** @param {number} side */
  const leave = (side) => {
    /** @type {Place} */
    const place = [mx + side * far * nx, my + side * far * ny];
    // Walking with the outside on the right.
    const [from, to] = side > 0 ? [u, v] : [v, u];
    out.set(from * 4294967296 + to, place);
    into.push([from, to, place]);
    ends.push(side * far);
  };
  if (ends.length === 1) leave(open);
  else if (ends.length === 0) [1, -1].forEach(leave);
  const ridge = ends.flatMap((along) => [mx + along * nx, my + along * ny]);
  pieces.add(u, v, [ux, uy, vx, vy, ...ridge]);
  // The place of the ridge that is nearest to the points.
  const near = Math.max(Math.min(...ends), Math.min(Math.max(...ends), 0));
  pieces.holds(u, v, mx + near * nx, my + near * ny);
}

/**
 * Add what unbounded cells have between their two rays.
 * @param {Cells} complex
 * @param {number} far
 * @param {Pieces} pieces
 * @param {Map<number, Place>} out
 * @param {[number, number, Place][]} into
 */
function addSectors(complex, far, pieces, out, into) {
  const p = complex.positions;
  /** @type {Map<number, number[]>} */
  const next = new Map();
  for (const [from, to] of into) next.set(from, [...(next.get(from) ?? []), to]);
  for (const [from, v, place] of into) {
    // On a line there are two ways; turn back only where there is no other.
    const ways = next.get(v) ?? [];
    const to = ways.find((way) => way !== from) ?? ways[0];
    const target = out.get(v * 4294967296 + to);
    if (target) addSector(complex, v, place, target, far, pieces);
  }
  if (complex.edgeCount === 0 && complex.vertexCount === 1) {
    addSector(complex, 0, [p[0] + far, p[1]], [p[0] + far, p[1]], far, pieces);
  }
}

/**
 * Add the sector counter-clockwise from one far place to another.
 * @param {Cells} complex
 * @param {number} v
 * @param {Place} from
 * @param {Place} to
 * @param {number} far
 * @param {Pieces} pieces
 */
function addSector({ positions }, v, from, to, far, pieces) {
  const [px, py] = [positions[2 * v], positions[2 * v + 1]];
  const [x, y] = pieces.tip(v, positions);
  const start = Math.atan2(from[1] - y, from[0] - x);
  let turn = Math.atan2(to[1] - y, to[0] - x) - start;
  if (turn <= 0) turn += 2 * Math.PI;
  const parts = Math.ceil(turn / (Math.PI / 3));
  let last = from;
  for (let k = 1; k <= parts; k++) {
    const angle = start + (turn * k) / parts;
    /** @type {Place} */
    const place =
      k === parts ? to : [x + 1.2 * far * Math.cos(angle), y + 1.2 * far * Math.sin(angle)];
    pieces.add(v, v, [px, py, px, py, ...last, ...place]);
    last = place;
  }
}
