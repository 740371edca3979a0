// Voronoi cells as triangles: each edge of the triangulation and its ridge, the stretch
// between the centres of its triangles, make one triangle in the cell of either end. So a
// pixel is drawn once, however large the discs; a shader cuts off what is beyond the radius.

import { NEVER } from "./complex.js";

/** Numbers of a piece: both ends, both ends of the ridge, the colours of the ends, no more. */
export const PIECE = 12;

/**
 * @typedef {import("./plane.js").PlaneComplex} PlaneComplex
 * @typedef {[number, number]} Place
 */

/**
 * Return how far the centre of the circle through an edge and a third point is along the
 * normal of the edge, counted from its middle, and on which side the point is.
 * @param {number} px the point, seen from the middle of the edge
 * @param {number} py
 * @param {number} nx the unit normal
 * @param {number} ny
 * @param {number} half half the length of the edge
 * @param {number} far where to stop
 */
export function centreAlong(px, py, nx, ny, half, far) {
  const height = px * nx + py * ny;
  const side = height < 0 ? -1 : 1;
  const along = (px * px + py * py - half * half) / (2 * height || side * 1e-300);
  return { along: Math.max(-far, Math.min(far, along)), side };
}

/**
 * Return one of seven numbers for each vertex, different for neighbours where possible.
 * @param {Uint32Array} edges
 * @param {number} vertices
 * @param {number} colours
 * @returns {Uint8Array}
 */
export function colouring(edges, vertices, colours) {
  const start = new Uint32Array(vertices + 1);
  for (const vertex of edges) start[vertex + 1]++;
  for (let v = 0; v < vertices; v++) start[v + 1] += start[v];
  const fill = start.slice(0, vertices);
  const neighbours = new Uint32Array(edges.length);
  for (let i = 0; i < edges.length; i += 2) {
    neighbours[fill[edges[i]]++] = edges[i + 1];
    neighbours[fill[edges[i + 1]]++] = edges[i];
  }
  const found = new Uint8Array(vertices).fill(255);
  const used = new Uint32Array(colours).fill(NEVER);
  for (let v = 0; v < vertices; v++) {
    for (let i = start[v]; i < start[v + 1]; i++) {
      if (found[neighbours[i]] !== 255) used[found[neighbours[i]]] = v;
    }
    // Begin at a place that depends on the vertex, so that all colours are used alike.
    const first = Math.imul(v, 2654435761) >>> 16;
    found[v] = first % colours;
    for (let k = 0; k < colours; k++) {
      const colour = (first + k) % colours;
      if (used[colour] !== v) {
        found[v] = colour;
        break;
      }
    }
  }
  return found;
}

/** Collects pieces in one array of floats. */
class Pieces {
  /** @param {Uint8Array} colours */
  constructor(colours) {
    this.colours = colours;
    this.numbers = new Float32Array(1 << 12);
    this.length = 0;
  }

  /**
   * @param {number} u
   * @param {number} v
   * @param {number[]} places coordinates of u, v and of the ends of the ridge
   */
  add(u, v, places) {
    if (this.length + PIECE > this.numbers.length) {
      const larger = new Float32Array(2 * this.numbers.length);
      larger.set(this.numbers);
      this.numbers = larger;
    }
    this.numbers.set(places, this.length);
    this.numbers[this.length + 8] = this.colours[u];
    this.numbers[this.length + 9] = this.colours[v];
    this.length += PIECE;
  }
}

/**
 * Return the pieces of all cells, `PIECE` floats each.
 * @param {PlaneComplex} complex
 * @param {number} far no disc reaches so far
 * @param {number} [colours]
 * @returns {Float32Array}
 */
export function cellPieces(complex, far, colours = 7) {
  const pieces = new Pieces(colouring(complex.edges, complex.vertexCount, colours));
  /** @type {Map<number, Place>} */
  const out = new Map();
  /** @type {[number, number, Place][]} */
  const into = [];
  for (let e = 0; e < complex.edgeCount; e++) addRidge(complex, e, far, pieces, out, into);
  addSectors(complex, far, pieces, out, into);
  return pieces.numbers.slice(0, pieces.length);
}

/**
 * Add the piece of an edge; note where unbounded cells end.
 * @param {PlaneComplex} complex
 * @param {number} e
 * @param {number} far
 * @param {Pieces} pieces
 * @param {Map<number, Place>} out by start * 2^32 + end
 * @param {[number, number, Place][]} into
 */
function addRidge(complex, e, far, pieces, out, into) {
  const { positions: p, edges, triangles, cofaces } = complex;
  const [u, v] = [edges[2 * e], edges[2 * e + 1]];
  const [ux, uy, vx, vy] = [p[2 * u], p[2 * u + 1], p[2 * v], p[2 * v + 1]];
  const [mx, my] = [(ux + vx) / 2, (uy + vy) / 2];
  const length = Math.hypot(vx - ux, vy - uy);
  if (length === 0) return; // closer than a picture can tell
  // The normal points to the right of the way from u to v.
  const [nx, ny] = [(vy - uy) / length, (ux - vx) / length];
  /** @type {number[]} */
  const ends = [];
  let open = 0;
  for (const t of [cofaces.first[e], cofaces.last[e]]) {
    if (t === NEVER) continue;
    const w = triangles[3 * t] + triangles[3 * t + 1] + triangles[3 * t + 2] - u - v;
    const found = centreAlong(p[2 * w] - mx, p[2 * w + 1] - my, nx, ny, length / 2, far);
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
}

/**
 * Add what unbounded cells have between their two rays.
 * @param {PlaneComplex} complex
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
    if (target) addSector(v, p[2 * v], p[2 * v + 1], place, target, far, pieces);
  }
  if (complex.edgeCount === 0 && complex.vertexCount === 1) {
    addSector(0, p[0], p[1], [p[0] + far, p[1]], [p[0] + far, p[1]], far, pieces);
  }
}

/**
 * Add the sector counter-clockwise from one far place to another.
 * @param {number} v
 * @param {number} x
 * @param {number} y
 * @param {Place} from
 * @param {Place} to
 * @param {number} far
 * @param {Pieces} pieces
 */
function addSector(v, x, y, from, to, far, pieces) {
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
    pieces.add(v, v, [x, y, x, y, ...last, ...place]);
    last = place;
  }
}
