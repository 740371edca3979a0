// The picture in the plane, drawn by the GPU from arrays that never change.

import { cellPieces, pieceSize } from "./cells.js";
import { NEVER } from "./complex.js";
import { CORNERS, EdgePicker } from "./edges2.js";
import { FillCache } from "./fill.js";
import { bufferOf, compile, ROW, tableOf, vertexArray } from "./gl.js";
import * as shaders from "./shaders2.js";
import { hiddenSize, lineWidth, pointSizes, showsEdges, spacingOf } from "./sizes.js";
import { rgb } from "./theme.js";

/**
 * @typedef {import("./gl.js").GL} GL
 * @typedef {import("./plane.js").PlaneComplex} PlaneComplex
 * @typedef {import("./filtered.js").Facts} Facts
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {Record<string, boolean>} Layers
 * @typedef {PlaneComplex | import("./patch.js").Patch} Seen
 */

/** More circles than that are a grey mass. */
export const MOST_CIRCLES = 3000;

/** A place and a rank, one after the other. */
const POINT = [
  { place: 0, size: 2, offset: 0 },
  { place: 1, size: 1, offset: 8, whole: true },
];

const NOTHING = { triangles: 0, edges: 0, boundary: 0, singular: 0, points: 0, hidden: 0 };

/** Draws a complex in the plane. */
export class Scene2 {
  /**
   * @param {GL} gl
   * @param {PlaneComplex} complex
   * @param {number} reach the largest radius, in units of the picture
   */
  constructor(gl, complex, reach) {
    this.gl = gl;
    this.complex = complex;
    /** What is drawn: in a box copies, too. */
    this.seen = complex.seen;
    this.far = Math.max(64, 8 * reach);
    /** What the last picture was made of. */
    this.drawn = { ...NOTHING };
    this.fill = compile(gl, shaders.FILL_VERTEX, shaders.FILL_FRAGMENT);
    this.line = compile(gl, shaders.EDGE_VERTEX, shaders.EDGE_FRAGMENT);
    this.inner = compile(gl, shaders.INNER_VERTEX, shaders.EDGE_FRAGMENT);
    this.dot = compile(gl, shaders.POINT_VERTEX, shaders.POINT_FRAGMENT);
    this.cell = compile(gl, shaders.CELL_VERTEX, shaders.CELL_FRAGMENT);
    this.circle = compile(gl, shaders.CIRCLE_VERTEX, shaders.EDGE_FRAGMENT);
    this.points = vertexArray(gl, interleaved(this.seen.positions, [this.seen.joined]), 12, POINT);
    this.triangles = vertexArray(gl, this.seen.positions, 8, [POINT[0]]);
    gl.bindVertexArray(this.triangles);
    bufferOf(gl, gl.ELEMENT_ARRAY_BUFFER, this.seen.triangles);
    gl.bindVertexArray(null);
    this.edges = vertexArray(gl, endsOf(this.seen), 12, POINT);
    const record = [
      { place: 0, size: 2, offset: 0 },
      { place: 1, size: 2, offset: 8 },
    ];
    this.lines = vertexArray(gl, new Float32Array(0), 16, record);
    this.lineBuffer = /** @type {WebGLBuffer} */ (gl.getParameter(gl.ARRAY_BUFFER_BINDING));
    // The same numbers, read as two ends of a thin line.
    this.thinLines = gl.createVertexArray();
    gl.bindVertexArray(this.thinLines);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 8, 0);
    gl.bindVertexArray(null);
    /** @type {WebGLTexture | null} */
    this.sites = null;
    /** @type {{table: WebGLTexture | null, texels: number, count: number} | null} */
    this.cells = null;
    /** Only where edges are not smooth: there it is exact, and needed most. */
    this.cache = gl.getContextAttributes()?.antialias ? null : new FillCache(gl);
    this.picker = new EdgePicker(this.seen);
    /** @type {WebGLVertexArrayObject | null} */
    this.hidden = null;
    /** @type {{singular: number, boundary: number}} */
    this.picked = { singular: 0, boundary: 0 };
    this.pickedAt = "";
    this.spacing = spacingOf(complex);
  }

  /**
   * Draw the complex; sizes are in CSS pixels, `ratio` of the device to one of them.
   * @param {{facts: Facts, camera: Camera, layers: Layers, palette: any, ratio: number}} state
   */
  draw({ facts, camera, layers, palette, ratio }) {
    const { gl } = this;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    gl.viewport(0, 0, width, height);
    gl.clearColor(...rgb(palette.background), 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const view = { camera, width, height, scale: camera.scale * ratio, ratio };
    const reach = this.complex.reach(facts.radius);
    this.drawn = { ...NOTHING };
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    const grown = { reach, power: this.complex.power(facts.radius) };
    if ((layers.cells || layers.discs) && reach > 0) this._drawCells(view, grown, layers, palette);
    if (layers.discs && reach > 0) this._drawCircles(view, grown, palette);
    if (layers.triangles) {
      const over = layers.cells || layers.discs;
      this._drawTriangles(view, facts, palette, over ? 0.72 : 1);
    }
    this._drawEdges(view, facts, layers, palette);
    if (layers.hidden) this._drawHidden(view, palette);
    if (layers.points) this._drawPoints(view, facts, palette);
    gl.bindVertexArray(null);
  }

  /**
   * @param {import("./gl.js").Program} program
   * @param {any} view
   */
  _use({ program, at }, { camera, width, height, scale }) {
    this.gl.useProgram(program);
    this.gl.uniform2f(at.uCenter, camera.x, camera.y);
    this.gl.uniform2f(at.uScale, (2 * scale) / width, (2 * scale) / height);
    if (at.uSize) this.gl.uniform2f(at.uSize, width, height);
    if (at.uPixels) this.gl.uniform1f(at.uPixels, scale);
  }

  /** Spacing of the points in device pixels. @param {any} view */
  _spacing(view) {
    return this.spacing * view.scale;
  }

  /**
   * @param {any} view
   * @param {{power: number}} grown
   * @param {Layers} layers
   * @param {any} palette
   */
  _drawCells(view, { power }, layers, palette) {
    const { gl } = this;
    if (!this.cells) {
      const pieces = cellPieces(this.seen, this.far);
      const texels = pieceSize(this.seen) / 4;
      const table = tableOf(gl, pieces, texels * Math.floor(ROW / texels)); // whole pieces in a row
      this.cells = { table, texels, count: pieces.length / 4 / texels };
    }
    const { at } = this.cell;
    this._use(this.cell, view);
    gl.uniform1f(at.uPower, power);
    gl.uniform1i(at.uTexels, this.cells.texels);
    const palettes = layers.cells ? palette.cells : Array(7).fill(palette.union);
    gl.uniform3fv(at.uCells, palettes.flatMap(rgb));
    gl.uniform3fv(at.uRidge, rgb(palette.ridges));
    gl.uniform3fv(at.uArc, rgb(palette.arcs));
    const fine = Math.min(1.3 * view.ratio, 0.07 * this._spacing(view));
    gl.uniform2f(at.uWidths, layers.cells ? fine : 0, fine);
    gl.bindTexture(gl.TEXTURE_2D, this.cells.table);
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * this.cells.count);
  }

  /**
   * @param {any} view
   * @param {{power: number, reach: number}} grown
   * @param {any} palette
   */
  _drawCircles(view, { power, reach }, palette) {
    const { gl, seen } = this;
    if (this.complex.vertexCount > MOST_CIRCLES) return;
    this._use(this.circle, view);
    gl.uniform1f(this.circle.at.uPower, power);
    const corners = Math.round(Math.min(64, Math.max(12, 3.5 * Math.sqrt(reach * view.scale))));
    gl.uniform1i(this.circle.at.uCorners, corners);
    gl.uniform3fv(this.circle.at.uColour, rgb(palette.circles));
    this.sites ??= tableOf(gl, ballsOf(seen));
    gl.bindTexture(gl.TEXTURE_2D, this.sites);
    gl.bindVertexArray(null);
    gl.drawArrays(gl.LINES, 0, 2 * corners * seen.vertexCount);
  }

  /**
   * @param {any} view
   * @param {Facts} facts
   * @param {any} palette
   * @param {number} opacity
   */
  _drawTriangles(view, facts, palette, opacity) {
    const { gl } = this;
    const count = facts.shown[2];
    const { cache } = opacity === 1 ? this : { cache: null };
    const { x, y, zoom } = view.camera;
    const change = cache
      ? cache.begin([x, y, zoom].join(), count, palette)
      : { first: 0, count, colour: rgb(palette.triangles) };
    this._use(this.fill, view);
    gl.uniform4f(this.fill.at.uColour, ...change.colour, opacity);
    gl.bindVertexArray(this.triangles);
    if (change.count > 0 || !cache) {
      gl.drawElements(gl.TRIANGLES, 3 * change.count, gl.UNSIGNED_INT, 12 * change.first);
    }
    cache?.finish();
    this.drawn.triangles = count;
  }

  /**
   * @param {any} view
   * @param {Facts} facts
   * @param {Layers} layers
   * @param {any} palette
   */
  _drawEdges(view, facts, layers, palette) {
    const { gl } = this;
    const spacing = this._spacing(view) / view.ratio;
    const count = facts.shown[1];
    if (layers.edges && showsEdges(spacing)) {
      this._use(this.inner, view);
      gl.uniform1ui(this.inner.at.uTriangles, facts.present[2]);
      gl.uniform3fv(this.inner.at.uColour, rgb(palette.interior));
      gl.bindVertexArray(this.edges);
      gl.drawArrays(gl.LINES, 0, 2 * count);
    }
    this.drawn.edges = count;
    if (!layers.boundary && !layers.singular) return;
    const thin = !showsEdges(spacing); // where points are so close, more is too much
    const { singular, boundary } = this._pick(facts, thin);
    const program = thin ? this.fill : this.line;
    this._use(program, view);
    if (!thin) gl.uniform1f(program.at.uWidth, lineWidth(spacing) * view.ratio);
    gl.bindVertexArray(thin ? this.thinLines : this.lines);
    if (layers.boundary) this._drawLines(thin, singular, boundary, palette.boundary);
    if (layers.singular) this._drawLines(thin, 0, singular, palette.singular);
    this.drawn.boundary = layers.boundary ? boundary : 0;
    this.drawn.singular = layers.singular ? singular : 0;
  }

  /**
   * @param {boolean} thin
   * @param {number} first
   * @param {number} count
   * @param {string} colour
   */
  _drawLines(thin, first, count, colour) {
    const { gl } = this;
    if (thin) {
      gl.uniform4f(this.fill.at.uColour, ...rgb(colour), 1);
      gl.drawArrays(gl.LINES, 2 * first, 2 * count);
    } else {
      gl.uniform3fv(this.line.at.uColour, rgb(colour));
      gl.drawArrays(gl.TRIANGLES, CORNERS * first, CORNERS * count);
    }
  }

  /**
   * Pick the edges with a width, unless they are those of the last time.
   * @param {Facts} facts
   * @param {boolean} thin
   */
  _pick(facts, thin) {
    const { gl } = this;
    const at = [...facts.present, thin].join();
    if (at !== this.pickedAt) {
      this.pickedAt = at;
      this.picked = this.picker.pick(facts, thin);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
      const used = this.picker.numbers.subarray(0, this.picker.length);
      gl.bufferData(gl.ARRAY_BUFFER, used, gl.DYNAMIC_DRAW);
    }
    return this.picked;
  }

  /**
   * @param {any} view
   * @param {Facts} facts
   * @param {any} palette
   */
  _drawPoints(view, facts, palette) {
    const { gl } = this;
    const { at } = this.dot;
    this._use(this.dot, view);
    const [joined, isolated] = pointSizes(this._spacing(view) / view.ratio);
    gl.uniform2f(at.uSizes, joined * view.ratio, isolated * view.ratio);
    gl.uniform1ui(at.uEdges, facts.present[1]);
    gl.uniform3fv(at.uColours, [palette.points, palette.isolated].flatMap(rgb));
    gl.bindVertexArray(this.points);
    gl.drawArrays(gl.POINTS, 0, facts.shown[0]);
    this.drawn.points = facts.shown[0];
  }

  /**
   * Draw points that are hidden as rings.
   * @param {any} view
   * @param {any} palette
   */
  _drawHidden(view, palette) {
    const { gl } = this;
    const { positions, rows } = this.complex.hidden;
    this.hidden ??= vertexArray(
      gl,
      interleaved(positions, [new Uint32Array(rows.length).fill(NEVER)]),
      12,
      POINT,
    );
    const { at } = this.dot;
    this._use(this.dot, view);
    gl.uniform1ui(at.uEdges, 0);
    gl.bindVertexArray(this.hidden);
    const size = hiddenSize(this._spacing(view) / view.ratio) * view.ratio;
    for (const [diameter, colour] of [
      [size, palette.quiet],
      [0.6 * size, palette.background],
    ]) {
      gl.uniform2f(at.uSizes, 0, diameter);
      gl.uniform3fv(at.uColours, [colour, colour].flatMap(rgb));
      gl.drawArrays(gl.POINTS, 0, rows.length);
    }
    this.drawn.hidden = rows.length;
  }
}

/**
 * Return the place and the weight of each vertex.
 * @param {Seen} seen
 */
function ballsOf({ positions, weights, vertexCount }) {
  const balls = new Float32Array(4 * vertexCount);
  for (let v = 0; v < vertexCount; v++) {
    balls[4 * v] = positions[2 * v];
    balls[4 * v + 1] = positions[2 * v + 1];
    balls[4 * v + 2] = weights ? weights[v] : 0;
  }
  return balls;
}

/**
 * Put floats and whole numbers side by side: `each` floats, then one of each column.
 * @param {Float32Array} floats
 * @param {Uint32Array[]} columns
 * @param {number} [each]
 */
function interleaved(floats, columns, each = 2) {
  const stride = each + columns.length;
  const count = floats.length / each;
  const out = new Uint32Array(stride * count);
  const bits = new Uint32Array(floats.buffer, floats.byteOffset, floats.length);
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < each; k++) out[stride * i + k] = bits[each * i + k];
    for (let k = 0; k < columns.length; k++) out[stride * i + each + k] = columns[k][i];
  }
  return out;
}

/**
 * Return both ends of each edge, each with the rank of the last triangle of the edge.
 * @param {Seen} seen
 */
function endsOf({ edges, positions, cofaces }) {
  const ends = new Float32Array(2 * edges.length);
  const lasts = new Uint32Array(edges.length);
  for (let i = 0; i < edges.length; i++) {
    ends[2 * i] = positions[2 * edges[i]];
    ends[2 * i + 1] = positions[2 * edges[i] + 1];
    lasts[i] = cofaces.last[i >> 1];
  }
  return interleaved(ends, [lasts]);
}
