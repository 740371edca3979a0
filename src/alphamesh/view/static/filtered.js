// What is the same in the plane and in space: values, classes, and counts at a radius.

import { colouring } from "./colours.js";
import { countUpTo, diagramOf, firstEdges, joiners, NEVER, sumsBefore } from "./complex.js";

/**
 * What is in the complex at a radius.
 * @typedef {object} Facts
 * @property {number} radius
 * @property {number[]} present simplices of each dimension
 * @property {number[]} shown how many of them are drawn: in a periodic box copies, too
 * @property {number[]} betti
 * @property {number} isolated vertices without an edge
 * @property {number} singularEdges
 * @property {number} [singularTriangles]
 * @property {number} boundary facets on the boundary
 * @property {number} interior facets inside
 * @property {number} size area, or volume
 * @property {number} border perimeter, or area of the surface
 * @property {boolean} full whether a periodic box is full
 */

/**
 * A periodic box, in units of the picture.
 * @typedef {{periods: (number | null)[], low: number[], high: number[]}} Box
 */

const NAMES = ["vertex", "edge", "triangle", "tetrahedron"];

/** All simplices of a cloud, sorted by filtration value. */
export class FilteredComplex {
  /**
   * @param {import("./data.js").Payload} payload
   * @param {2 | 3} ambient
   */
  constructor({ meta, arrays }, ambient) {
    this.ambient = ambient;
    this.meta = meta;
    this.positions = /** @type {Float32Array} */ (arrays.positions);
    this.vertexCount = this.positions.length / ambient;
    /** Rows of the cloud, if vertices have other numbers. */
    this.rows = /** @type {Uint32Array | undefined} */ (arrays.rows);
    this.edges = /** @type {Uint32Array} */ (arrays.edges);
    this.edgeCount = this.edges.length / 2;
    /** Whether radii are signed roots of power values. */
    this.signed = Boolean(meta.signed);
    /** Squared radii of the balls at radius 0, in squared units of the picture. */
    this.weights = /** @type {Float32Array | undefined} */ (arrays.weights);
    this.heaviest = this.weights ? this.weights.reduce((a, b) => Math.max(a, b), -Infinity) : 0;
    /** @type {Box | null} */
    this.box = meta.box ?? null;
    /** How many periods corners but the first lie from the box, by one larger. */
    this.offsets = {
      edges: /** @type {Uint8Array} */ (arrays.edge_offsets),
      triangles: /** @type {Uint8Array} */ (arrays.triangle_offsets),
    };
    this.joined = firstEdges(this.edges, this.vertexCount);
    this.hidden = {
      rows: /** @type {Uint32Array} */ (arrays.hidden ?? new Uint32Array(0)),
      positions: /** @type {Float32Array} */ (arrays.hidden_positions ?? new Float32Array(0)),
    };

    const names = NAMES.slice(0, ambient + 1);
    /** Filtration values by dimension. @type {Float64Array[]} */
    this.values = names.map((name) => /** @type {Float64Array} */ (arrays[`${name}_values`]));
    this.values[0] ??= new Float64Array(this.vertexCount); // all of them come at 0
    const enders = names.map((name) => /** @type {Uint32Array} */ (arrays[`${name}_creators`]));
    enders[1] ??= joiners(enders[2], this.edgeCount);
    /** Births and deaths by dimension. */
    this.diagrams = names
      .slice(0, ambient)
      .map((_, k) => diagramOf(this.values[k], this.values[k + 1], enders[k + 1], enders[k]));
    /** How many of the first simplices of each dimension end a class. */
    this._ended = enders.map((own) => own && sumsBefore(own.map((c) => (c === NEVER ? 0 : 1))));
  }

  // What an ambient dimension knows of its own

  /** Corners of triangles. @type {Uint32Array} */
  triangles = new Uint32Array(0);
  /** Ranks of the cofaces of each facet. @type {{first: Uint32Array, last: Uint32Array}} */
  cofaces = { first: new Uint32Array(0), last: new Uint32Array(0) };
  /** The rank of the first triangle of each edge. @type {Uint32Array} */
  covered = new Uint32Array(0);
  /** What is drawn around a periodic box. @type {import("./patch.js").Patch | null} */
  patch = null;

  /** Whether all around an edge is known. @param {number} _e */
  isWhole(_e) {
    return true;
  }

  /** Numbers of the cofaces of each facet. */
  get around() {
    return this.cofaces;
  }

  /** Return what is drawn at radii. @param {number[]} present */
  shown(present) {
    return this.patch ? this.patch.shown(present) : present;
  }

  /** Whether the classes of a full box are there. @param {number[]} present */
  isFull(present) {
    const [cells, ended] = [present[this.ambient], this._ended[this.ambient]];
    return this.box !== null && cells > ended[cells];
  }

  /** Return a colour for each vertex. @param {number} colours */
  coloured(colours) {
    return colouring(this.edges, this.vertexCount, colours);
  }

  /**
   * @param {number} e
   * @returns {number} in units of the picture
   */
  edgeLength(e) {
    const [d, p] = [this.ambient, this.positions];
    const [a, b] = [d * this.edges[2 * e], d * this.edges[2 * e + 1]];
    let sum = 0;
    for (let k = 0; k < d; k++) {
      const side = this.box?.periods[k];
      const moved = side ? (this.offsets.edges[d * e + k] - 1) * side : 0;
      sum += (p[b + k] + moved - p[a + k]) ** 2;
    }
    return Math.sqrt(sum);
  }

  /**
   * Return how the border changes when each cell comes.
   * @param {Uint32Array} faces of one cell after the other
   * @param {ArrayLike<number>} sizes of the faces
   */
  borders(faces, sizes) {
    const each = this.ambient + 1;
    const changes = new Float64Array(faces.length / each);
    const entered = new Uint8Array(sizes.length);
    for (let i = 0; i < faces.length; i++) {
      const size = sizes[faces[i]];
      changes[Math.floor(i / each)] += entered[faces[i]] ? -size : size;
      entered[faces[i]] = 1;
    }
    return changes;
  }

  /** The radius at which the first vertex comes. */
  get first() {
    return this.values[0][0] ?? 0;
  }

  /**
   * Return how many simplices of each dimension are there.
   * @param {number} radius
   * @returns {number[]}
   */
  present(radius) {
    return this.values.map((values) => countUpTo(values, radius));
  }

  /** @param {number[]} present @returns {number[]} */
  betti(present) {
    return this.diagrams.map((_, k) => {
      const begun = present[k] - (k ? this._ended[k][present[k]] : 0);
      return begun - this._ended[k + 1][present[k + 1]];
    });
  }

  /** The power value of a radius, in squared units of the picture. @param {number} radius */
  power(radius) {
    const scaled = radius / this.meta.scale;
    return scaled * Math.abs(scaled);
  }

  /** The radius of the largest ball, in units of the picture. @param {number} radius */
  reach(radius) {
    if (!this.weights) return radius / this.meta.scale;
    return Math.sqrt(Math.max(0, this.heaviest + this.power(radius)));
  }

  /** What classes are called, by dimension. */
  get words() {
    const hole = this.box ? "loop" : this.ambient === 2 ? "hole" : "tunnel";
    return ["component", hole, "void"].slice(0, this.ambient);
  }

  /**
   * Return the row of the cloud that something drawn as a vertex is.
   * @param {number} drawn
   */
  rowOfDrawn(drawn) {
    return this.rowOf(this.patch ? this.patch.owner[drawn] : drawn);
  }

  /**
   * Return the row of the cloud that a vertex is.
   * @param {number} vertex
   */
  rowOf(vertex) {
    return this.rows ? this.rows[vertex] : vertex;
  }
}
