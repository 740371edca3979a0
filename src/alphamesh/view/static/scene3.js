// The picture in space, drawn by the GPU.

import { countUpTo, NEVER } from "./complex.js";
import { ballsOf, frameOf, sidesInFront } from "./frame3.js";
import { compile, tableOf, vertexArray } from "./gl.js";
import * as shaders from "./shaders3.js";
import { spacingOf } from "./sizes.js";
import { SurfacePicker } from "./surface3.js";
import { rgb } from "./theme.js";

/**
 * @typedef {import("./gl.js").GL} GL
 * @typedef {import("./gl.js").Program} Program
 * @typedef {import("./space.js").SpaceComplex} SpaceComplex
 * @typedef {import("./filtered.js").Facts} Facts
 * @typedef {import("./camera3.js").Camera3} Camera3
 * @typedef {{normal: number[], offset: number}} Cut
 * @typedef {{facts: Facts, camera: Camera3, layers: Record<string, boolean>, palette: any,
 *            ratio: number, cut: Cut | null}} State
 */

/** Where light comes from: right, up, towards the viewer. */
const LIGHT = [-0.35, 0.5, 0.79];

const NOTHING = { triangles: 0, singular: 0, lone: 0, points: 0, hidden: 0, balls: 0, caps: 0 };

/** What lies on a wall of a box is in the box, whatever is rounded. */
const SLACK = 1e-4;

/** Draws a complex in space. */
export class Scene3 {
  /**
   * @param {GL} gl
   * @param {SpaceComplex} complex
   */
  constructor(gl, complex) {
    this.gl = gl;
    this.complex = complex;
    this.spacing = spacingOf(complex);
    this.surface = compile(gl, shaders.SURFACE_VERTEX, shaders.SURFACE_FRAGMENT);
    this.line = compile(gl, shaders.LINE_VERTEX, shaders.LINE_FRAGMENT);
    this.ball = compile(gl, shaders.BALL_VERTEX, shaders.BALL_FRAGMENT);
    this.grown = compile(gl, shaders.GROWN_VERTEX, shaders.GROWN_FRAGMENT);
    /** @type {{table: WebGLTexture | null, count: number} | null} */
    this.sites = null;
    this.picker = new SurfacePicker(complex.seen);
    this.pickedAt = "";
    /** What the last picture was made of. */
    this.drawn = { ...NOTHING };
    const place = { place: 0, size: 3, offset: 0 };
    this.triangles = vertexArray(gl, new Float32Array(0), 12, [place]);
    this.triangleBuffer = gl.getParameter(gl.ARRAY_BUFFER_BINDING);
    this.lines = vertexArray(gl, new Float32Array(0), 12, [place]);
    this.lineBuffer = gl.getParameter(gl.ARRAY_BUFFER_BINDING);
    const joined = { place: 1, size: 1, offset: 12, whole: true };
    const { hidden } = complex;
    const never = new Uint32Array(hidden.rows.length).fill(NEVER);
    const { positions, joined: ranks } = complex.seen;
    this.points = vertexArray(gl, fours(positions, ranks), 16, [place, joined]);
    this.caps = vertexArray(gl, complex.caps.corners, 12, [place]);
    this.frame = vertexArray(gl, frameOf(complex.box), 12, [place]);
    /** Corners of the box, or of all there is. */
    this.low = [0, 1, 2].map((k) => (complex.box?.periods[k] ? complex.box.low[k] - SLACK : -1e9));
    this.high = [0, 1, 2].map((k) => (complex.box?.periods[k] ? complex.box.high[k] + SLACK : 1e9));
    this.hidden = vertexArray(gl, fours(hidden.positions, never), 16, [place, joined]);
  }

  /** Pick what is there, unless it is what was there the last time. @param {Facts} facts */
  pick(facts) {
    const { gl, picker } = this;
    const at = facts.present.join();
    if (at === this.pickedAt) return;
    this.pickedAt = at;
    picker.pick(facts);
    for (const [buffer, data] of [
      [this.triangleBuffer, picker.corners],
      [this.lineBuffer, picker.ends],
    ]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    }
  }

  /** @param {State} state */
  draw(state) {
    const { gl, picker } = this;
    const { facts, layers, palette } = state;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(...rgb(palette.background), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
    this.pick(facts);
    this.drawn = { ...NOTHING };
    if (this.complex.box) this._drawFrame(state, false);
    // Lines and points lie on the surface: it is moved back by a hair.
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    this._drawSurface(state);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (layers.lone) {
      this._use(this.line, state);
      gl.uniform3fv(this.line.at.uColour, rgb(palette.isolated));
      gl.bindVertexArray(this.lines);
      gl.drawArrays(gl.LINES, 0, 2 * picker.lone);
      this.drawn.lone = picker.lone;
    }
    if (layers.points) this._drawPoints(state);
    if (layers.hidden) this._drawHidden(state);
    if (layers.balls && this.complex.reach(facts.radius) > 0) this._drawBalls(state);
    if (this.complex.box) this._drawFrame(state, true);
    gl.bindVertexArray(null);
  }

  /**
   * @param {Program} program
   * @param {State} state
   */
  _use({ program, at }, { camera, cut }) {
    const { gl } = this;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.uMatrix, false, camera.matrix);
    if (cut) gl.uniform4f(at.uCut, cut.normal[0], cut.normal[1], cut.normal[2], cut.offset);
    else gl.uniform4f(at.uCut, 0, 0, 0, 1);
    gl.uniform3fv(at.uLow, this.low);
    gl.uniform3fv(at.uHigh, this.high);
  }

  /** @param {State} state */
  _drawSurface(state) {
    const { gl, picker, surface } = this;
    const { camera, layers, palette, ratio } = state;
    this._use(surface, state);
    gl.uniform3fv(surface.at.uLight, lightOf(camera));
    gl.uniform3fv(surface.at.uBack, camera.axes[2]);
    gl.uniform3fv(surface.at.uInside, rgb(palette.inside));
    gl.uniform3fv(surface.at.uWire, rgb(palette.boundary));
    const apart = this.spacing * camera.pixelsAt(camera.distance);
    gl.uniform1f(surface.at.uWidth, layers.wire && apart > 4 ? Math.min(1, apart / 14) * ratio : 0);
    gl.uniform1f(surface.at.uFlat, 0);
    if (layers.boundary) this._drawCaps(state);
    gl.bindVertexArray(this.triangles);
    if (layers.boundary) {
      // What is closed shows its inside only where it is cut; thin parts would shine through.
      if (!state.cut) gl.enable(gl.CULL_FACE);
      gl.uniform3fv(surface.at.uOutside, rgb(palette.surface));
      gl.uniform1i(surface.at.uBothSides, 0);
      gl.drawArrays(gl.TRIANGLES, 0, 3 * picker.boundary);
      gl.disable(gl.CULL_FACE);
      this.drawn.triangles = picker.boundary;
    }
    if (layers.singular) {
      gl.uniform3fv(surface.at.uOutside, rgb(palette.sheet));
      gl.uniform1i(surface.at.uBothSides, 1);
      gl.drawArrays(gl.TRIANGLES, 3 * picker.boundary, 3 * picker.singular);
      this.drawn.singular = picker.singular;
    }
  }

  /**
   * Draw where the walls of a box cut tetrahedra.
   * @param {State} state
   */
  _drawCaps({ facts, palette, cut }) {
    const { gl, surface } = this;
    this.drawn.caps = countUpTo(this.complex.caps.ranks, facts.present[3] - 1);
    gl.uniform3fv(surface.at.uOutside, rgb(palette.inside));
    gl.uniform1i(surface.at.uBothSides, 1);
    // Seen from inside, through a cut, a wall looks as if filled.
    gl.uniform1f(surface.at.uFlat, cut ? 1 : 0.55);
    const { uWidth } = surface.at;
    const width = /** @type {number} */ (gl.getUniform(surface.program, /** @type {WebGLUniformLocation} */ (uWidth)));
    gl.uniform1f(uWidth, 0);
    gl.bindVertexArray(this.caps);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * this.drawn.caps);
    gl.uniform1f(uWidth, width);
    gl.uniform1f(surface.at.uFlat, 0);
  }

  /**
   * Draw the sides of a box that are in front of all in it, or those behind.
   * @param {State} state
   * @param {boolean} inFront
   */
  _drawFrame(state, inFront) {
    const { gl, line } = this;
    const box = /** @type {import("./filtered.js").Box} */ (this.complex.box);
    this._use(line, { ...state, cut: null });
    gl.uniform3fv(line.at.uColour, rgb(state.palette.text));
    gl.bindVertexArray(this.frame);
    gl.disable(gl.DEPTH_TEST);
    sidesInFront(box, state.camera.eye).forEach((front, i) => {
      if (front === inFront) gl.drawArrays(gl.LINES, 2 * i, 2);
    });
    gl.enable(gl.DEPTH_TEST);
  }

  /** @param {State} state */
  _drawPoints(state) {
    const { gl, ball } = this;
    const { camera, palette, facts } = state;
    this._usePoints(state, [palette.points, palette.isolated]);
    gl.uniform1ui(ball.at.uEdges, facts.present[1]);
    const size = 0.22 * this.spacing;
    // Behind a cut, points inside would seem to stand in front of it.
    const seen = !state.cut && size * camera.pixelsAt(camera.distance) > 1.2;
    gl.uniform2f(ball.at.uSizes, seen ? size : 0, 1.4 * size);
    gl.bindVertexArray(this.points);
    gl.drawArrays(gl.POINTS, 0, facts.shown[0]);
    this.drawn.points = facts.shown[0];
  }

  /** @param {State} state */
  _drawHidden(state) {
    const { gl, ball } = this;
    this._usePoints(state, [state.palette.quiet, state.palette.quiet]);
    gl.uniform1ui(ball.at.uEdges, 0);
    gl.uniform2f(ball.at.uSizes, 0, 0.26 * this.spacing);
    gl.bindVertexArray(this.hidden);
    this.drawn.hidden = this.complex.hidden.rows.length;
    gl.drawArrays(gl.POINTS, 0, this.drawn.hidden);
  }

  /**
   * @param {State} state
   * @param {string[]} colours of points with an edge, and without
   */
  _usePoints(state, colours) {
    const { gl, ball } = this;
    this._use(ball, state);
    gl.uniform3fv(ball.at.uColours, colours.flatMap(rgb));
    gl.uniform3fv(ball.at.uLightSeen, LIGHT);
    gl.uniform1f(ball.at.uPixels, state.camera.pixelsAt(1) * state.ratio);
  }

  /**
   * Draw the outside of the union of balls, as a glass through which the complex is seen:
   * first how near it is, then its colour.
   * @param {State} state
   */
  _drawBalls(state) {
    const { gl, complex, grown } = this;
    const { camera, palette, facts } = state;
    if (!this.sites) {
      const balls = ballsOf(complex);
      this.sites = { table: tableOf(gl, balls), count: balls.length / 4 };
    }
    const corners = 6 * this.sites.count;
    this._use(grown, state);
    gl.bindTexture(gl.TEXTURE_2D, this.sites.table);
    gl.uniform1f(grown.at.uPower, complex.power(facts.radius));
    gl.uniform3fv(grown.at.uEye, camera.eye);
    gl.uniform3fv(grown.at.uLight, lightOf(camera));
    gl.uniform3fv(grown.at.uOutside, rgb(palette.circles));
    gl.uniform3fv(grown.at.uInside, rgb(palette.union));
    gl.uniform1f(grown.at.uOpacity, 0.5);
    gl.bindVertexArray(null);
    gl.colorMask(false, false, false, false);
    gl.drawArrays(gl.TRIANGLES, 0, corners);
    gl.colorMask(true, true, true, true);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    // Each pixel once: on a cut many balls are equally near.
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 1);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    gl.drawArrays(gl.TRIANGLES, 0, corners);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.BLEND);
    this.drawn.balls = this.sites.count;
  }
}

/** Where light comes from in the picture. @param {Camera3} camera */
function lightOf({ axes: [right, up, back] }) {
  return [0, 1, 2].map((i) => LIGHT[0] * right[i] + LIGHT[1] * up[i] + LIGHT[2] * back[i]);
}

/**
 * Put places and whole numbers side by side.
 * @param {Float32Array} places
 * @param {Uint32Array} column
 */
function fours(places, column) {
  const records = new Uint32Array(4 * column.length);
  const floats = new Float32Array(records.buffer);
  for (let v = 0; v < column.length; v++) {
    floats.set(places.subarray(3 * v, 3 * v + 3), 4 * v);
    records[4 * v + 3] = column[v];
  }
  return records;
}
