// Triangles that stay where they are: only those that come or go are drawn.

import { rgb } from "./theme.js";

/**
 * @typedef {import("./gl.js").GL} GL
 * @typedef {{first: number, count: number, colour: [number, number, number]}} Change
 */

/**
 * Keeps a picture of the triangles between two radii.
 *
 * Without smooth edges each pixel belongs to one triangle at most, and always to the same:
 * a triangle that goes is painted over in the colour of the background, exactly.
 */
export class FillCache {
  /** @param {GL} gl */
  constructor(gl) {
    this.gl = gl;
    this.frame = gl.createFramebuffer();
    this.key = "";
    this.count = 0;
    this.size = [0, 0];
  }

  /**
   * Begin to paint; return what has to be drawn.
   * @param {string} view all that the picture depends on, apart from the count
   * @param {number} count
   * @param {any} palette
   * @returns {Change}
   */
  begin(view, count, palette) {
    const { gl } = this;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const key = [view, width, height, palette.background, palette.triangles].join();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    if (this.size[0] !== width || this.size[1] !== height) this._resize(width, height);
    if (key !== this.key) {
      this.key = key;
      this.count = 0;
      gl.clearColor(...rgb(palette.background), 1);
      gl.clear(gl.COLOR_BUFFER_BIT);
    }
    const [first, last] = [Math.min(count, this.count), Math.max(count, this.count)];
    const colour = rgb(count < this.count ? palette.background : palette.triangles);
    this.count = count;
    return { first, count: last - first, colour };
  }

  /** Copy the painting to the picture. */
  finish() {
    const { gl } = this;
    const [width, height] = this.size;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** @param {number} width @param {number} height */
  _resize(width, height) {
    const { gl } = this;
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
    const place = gl.COLOR_ATTACHMENT0;
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    gl.deleteRenderbuffer(this.buffer ?? null);
    this.buffer = buffer;
    this.size = [width, height];
    this.key = "";
  }
}
