// How a cloud in space is seen: turned around its middle, in perspective.

import { clamp } from "./camera.js";

/** Half of the angle of view. */
const HALF = 0.28;

/** The first view: yaw, pitch, zoom, and where the middle is. */
const FIRST = [0.6, 0.45, 1, 0, 0];

/** @typedef {[number, number, number]} Vector */

/** Orbit, pan and zoom around a cube from -1 to 1. */
export class Camera3 {
  /** @param {number} reach the radius of a ball around the middle that holds the cloud */
  constructor(reach) {
    this.reach = Math.max(0.05, reach);
    this.width = 1;
    this.height = 1;
    this.yaw = FIRST[0];
    this.pitch = FIRST[1];
    this.zoom = FIRST[2];
    this.x = FIRST[3];
    this.y = FIRST[4];
  }

  reset() {
    this.restore(FIRST);
  }

  /** @param {number} width @param {number} height */
  resize(width, height) {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }

  get moved() {
    return this.state.some((value, i) => value !== FIRST[i]);
  }

  get state() {
    return [this.yaw, this.pitch, this.zoom, this.x, this.y];
  }

  /** @param {number[]} state */
  restore(state) {
    if (state.length < 5 || !state.slice(0, 5).every(Number.isFinite) || state[2] <= 0) return;
    this.yaw = state[0];
    this.pitch = clamp(state[1], -1.57, 1.57);
    this.zoom = clamp(state[2], 0.2, 200);
    [this.x, this.y] = [clamp(state[3], -9, 9), clamp(state[4], -9, 9)];
  }

  /** @param {number} dx @param {number} dy pixels */
  orbit(dx, dy) {
    this.yaw -= dx * 0.008;
    this.pitch = clamp(this.pitch + dy * 0.008, -1.57, 1.57);
  }

  /** @param {number} dx @param {number} dy pixels */
  pan(dx, dy) {
    const step = (2 * this.distance * Math.tan(HALF)) / Math.min(this.width, this.height);
    this.x = clamp(this.x - dx * step, -9, 9);
    this.y = clamp(this.y + dy * step, -9, 9);
  }

  /** @param {number} factor */
  zoomBy(factor) {
    this.zoom = clamp(this.zoom * factor, 0.2, 200);
  }

  get distance() {
    return (1.08 * this.reach) / Math.sin(HALF) / this.zoom;
  }

  /** Where the viewer is. @returns {number[]} */
  get eye() {
    const [right, up, back] = this.axes;
    return [0, 1, 2].map((i) => right[i] * this.x + up[i] * this.y + back[i] * this.distance);
  }

  /** Right, up and towards the viewer. @returns {[Vector, Vector, Vector]} */
  get axes() {
    const [cy, sy] = [Math.cos(this.yaw), Math.sin(this.yaw)];
    const [cp, sp] = [Math.cos(this.pitch), Math.sin(this.pitch)];
    return [
      [cy, sy, 0],
      [-sy * sp, cy * sp, cp],
      [sy * cp, -cy * cp, sp],
    ];
  }

  /** What turns places into places seen: right, up, away. @param {ArrayLike<number>} p */
  seen(p) {
    const [right, up, back] = this.axes;
    return [
      dot(right, p) - this.x,
      dot(up, p) - this.y,
      this.distance - dot(back, p),
    ];
  }

  /** Pixels of a unit at a distance. @param {number} away */
  pixelsAt(away) {
    return Math.min(this.width, this.height) / 2 / Math.tan(HALF) / away;
  }

  /** @param {ArrayLike<number>} p @returns {[number, number]} */
  toScreen(p) {
    const [x, y, away] = this.seen(p);
    const pixels = this.pixelsAt(Math.max(away, 1e-6));
    return [this.width / 2 + x * pixels, this.height / 2 - y * pixels];
  }

  /** The way of a ray through a pixel. @param {number} px @param {number} py */
  ray(px, py) {
    const [right, up, back] = this.axes;
    const pixels = this.pixelsAt(1);
    const [x, y] = [(px - this.width / 2) / pixels, (this.height / 2 - py) / pixels];
    /** @param {number} i */
    const way = (i) => right[i] * x + up[i] * y - back[i];
    return { from: this.eye, way: [0, 1, 2].map(way) };
  }

  /** The matrix for the GPU, column by column. @returns {Float32Array} */
  get matrix() {
    const [right, up, back] = this.axes;
    const smaller = Math.min(this.width, this.height);
    const fx = smaller / this.width / Math.tan(HALF);
    const fy = smaller / this.height / Math.tan(HALF);
    const { distance } = this;
    const near = Math.max(distance - 3 * this.reach, 0.01 * distance);
    const far = distance + 3 * this.reach;
    const [a, b] = [(far + near) / (far - near), (2 * far * near) / (far - near)];
    // Rows: x, y, depth and distance of what is seen.
    const rows = [
      [...right.map((v) => v * fx), -this.x * fx],
      [...up.map((v) => v * fy), -this.y * fy],
      [...back.map((v) => -v * a), a * distance - b],
      [...back.map((v) => -v), distance],
    ];
    return new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
  }
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
