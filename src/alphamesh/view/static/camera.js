// What part of the plane is seen: a centre, and pixels per unit.

/** Pan and zoom over the square from -1 to 1 that holds the cloud. */
export class Camera {
  /** @param {[number, number]} extent half width and half height of the cloud */
  constructor(extent) {
    this.extent = extent;
    this.x = 0;
    this.y = 0;
    this.zoom = 1;
    this.width = 1;
    this.height = 1;
  }

  /**
   * @param {number} width
   * @param {number} height
   */
  resize(width, height) {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }

  /** CSS pixels per unit. */
  get scale() {
    const room = 0.86;
    const [w, h] = this.extent.map((side) => Math.max(side, 0.02));
    return (this.zoom * room * Math.min(this.width / w, this.height / h)) / 2;
  }

  /**
   * @param {number} px
   * @param {number} py pixels from the upper left corner
   * @returns {[number, number]}
   */
  toWorld(px, py) {
    const { scale } = this;
    return [this.x + (px - this.width / 2) / scale, this.y - (py - this.height / 2) / scale];
  }

  /**
   * @param {number} x
   * @param {number} y
   * @returns {[number, number]}
   */
  toScreen(x, y) {
    const { scale } = this;
    return [(x - this.x) * scale + this.width / 2, this.height / 2 - (y - this.y) * scale];
  }

  /**
   * @param {number} dx
   * @param {number} dy pixels
   */
  pan(dx, dy) {
    const { scale } = this;
    this.x = clamp(this.x - dx / scale, -3, 3);
    this.y = clamp(this.y + dy / scale, -3, 3);
  }

  /**
   * Zoom, and keep the place under a pixel where it is.
   * @param {number} factor
   * @param {number} px
   * @param {number} py
   */
  zoomAt(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toWorld(px, py);
    this.zoom = clamp(this.zoom * factor, 0.2, 20000);
    const [nx, ny] = this.toWorld(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  reset() {
    [this.x, this.y, this.zoom] = [0, 0, 1];
  }

  /** @returns {number[]} what {@link restore} takes */
  get state() {
    return [this.x, this.y, this.zoom];
  }

  /** @param {number[]} state */
  restore(state) {
    if (state.length !== 3 || !state.every(Number.isFinite) || state[2] <= 0) return;
    this.x = clamp(state[0], -3, 3);
    this.y = clamp(state[1], -3, 3);
    this.zoom = clamp(state[2], 0.2, 20000);
  }

  get moved() {
    return this.x !== 0 || this.y !== 0 || this.zoom !== 1;
  }
}

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}
