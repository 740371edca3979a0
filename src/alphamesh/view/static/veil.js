// What lies beyond a periodic box repeats what is inside: a veil says so, and a frame.

/** How far beyond the box the picture goes on, in periods. */
export const SEEN = 0.15;

/** How much of what lies beyond the box the veil hides. */
export const VEIL = 0.6;

/**
 * @typedef {import("./filtered.js").Box} Box
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {{left: number, top: number, right: number, bottom: number}} Area
 */

/**
 * Return where a box is on the screen, larger by some periods; in open directions all of it.
 * @param {Box} box
 * @param {Camera} camera
 * @param {number} margin
 * @returns {Area}
 */
export function areaOf({ periods, low, high }, camera, margin) {
  const [x, y] = periods.map((side) => (side ?? 0) * margin);
  const [left, bottom] = camera.toScreen(low[0] - x, low[1] - y);
  const [right, top] = camera.toScreen(high[0] + x, high[1] + y);
  const [wide, tall] = [camera.width, camera.height];
  return {
    left: periods[0] ? left : Math.min(left, 0) - 2,
    right: periods[0] ? right : Math.max(right, wide) + 2,
    top: periods[1] ? top : Math.min(top, 0) - 2,
    bottom: periods[1] ? bottom : Math.max(bottom, tall) + 2,
  };
}

/** @param {Area} area @returns {string} a path */
function around({ left, top, right, bottom }) {
  const [l, t, r, b] = [left, top, right, bottom].map((v) => Math.round(v * 100) / 100);
  return `M${l} ${t}H${r}V${b}H${l}Z`;
}

/**
 * Return the paths of the veil, of what hides all beyond it, and of the frame.
 * @param {Box} box
 * @param {Camera} camera
 */
export function veilOf(box, camera) {
  const sheet = { left: -2, top: -2, right: camera.width + 2, bottom: camera.height + 2 };
  const inner = around(areaOf(box, camera, 0));
  const outer = around(areaOf(box, camera, SEEN));
  return { veil: around(sheet) + inner, rest: around(sheet) + outer, frame: inner };
}
