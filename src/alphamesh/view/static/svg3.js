// The surface as SVG: triangles one over the other, the farthest first.

import { dot } from "./camera3.js";
import { rgb } from "./theme.js";

/**
 * @typedef {{away: number, text: string}} Shape
 * @typedef {{layers: Record<string, boolean>, palette: any, title: string,
 *            balls: {place: Float32Array, radius: number}[],
 *            walls: import("./scene3.js").Cut[], caps: Float32Array, frame: Float32Array, inFront: boolean[]}} State
 */

/**
 * Return the surface as the text of an SVG file.
 * @param {import("./surface3.js").SurfacePicker} picker
 * @param {import("./camera3.js").Camera3} camera
 * @param {(place: ArrayLike<number>) => boolean} kept what the cut leaves
 * @param {State} state
 * @returns {string}
 */
export function svgOfSurface(picker, camera, kept, state) {
  const { palette, title } = state;
  const shapes = [
    ...surfaces(picker, camera, kept, state),
    ...lines(picker, camera, kept, state),
    ...balls(camera, kept, state),
  ];
  shapes.sort((a, b) => b.away - a.away);
  const [width, height] = [short(camera.width), short(camera.height)];
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}"`,
    ` viewBox="0 0 ${width} ${height}" stroke-linejoin="round">`,
    `<title>${title.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`)}</title>`,
    `<rect width="100%" height="100%" fill="${palette.background}"/>`,
    ...shapes.map(({ text }) => text),
    "</svg>\n",
  ].join("\n");
}

/**
 * @param {import("./surface3.js").SurfacePicker} picker
 * @param {import("./camera3.js").Camera3} camera
 * @param {(place: ArrayLike<number>) => boolean} kept
 * @param {State} state
 * @returns {Shape[]}
 */
function surfaces(picker, camera, kept, { layers, palette, walls, caps }) {
  const back = camera.axes[2];
  /** @type {Shape[]} */
  const shapes = [];
  /** @param {Float32Array} from @param {number} i @param {(shade: number, facing: number) => string} look @param {string} [line] */
  const add = (from, i, look, line) => {
    const corners = [0, 3, 6].map((k) => from.subarray(9 * i + k, 9 * i + k + 3));
    const facing = dot(normalOf(corners), back);
    const left = clipped(corners.map((p) => [...p]), walls, true);
    if (left.length === 0) return;
    const middle = [0, 1, 2].map((k) => left.reduce((sum, p) => sum + p[k], 0) / left.length);
    if (!kept(middle)) return;
    const colour = look(0.5 + 0.5 * Math.abs(facing), facing);
    const path = left.map((p) => camera.toScreen(p).map(short).join(" ")).join("L");
    const stroke = line ?? colour;
    const text = `<path d="M${path}Z" fill="${colour}" stroke="${stroke}" stroke-width="0.4"/>`;
    shapes.push({ away: -dot(back, middle), text });
  };
  /** @param {string} colour @param {number} shade */
  const lit = (colour, shade) => hex(rgb(colour).map((v) => v * shade));
  const first = layers.boundary ? 0 : picker.boundary;
  const end = picker.boundary + (layers.singular ? picker.singular : 0);
  const line = layers.wire ? palette.boundary : undefined;
  for (let i = first; i < end; i++) {
    const outside = i >= picker.boundary ? palette.sheet : palette.surface;
    add(picker.corners, i, (shade, facing) => {
      return outside === palette.surface && facing < 0 ? palette.inside : lit(outside, shade);
    }, line);
  }
  for (let i = 0; layers.boundary && i < caps.length / 9; i++) {
    add(caps, i, (shade) => lit(palette.inside, shade));
  }
  return shapes;
}

/**
 * @param {import("./surface3.js").SurfacePicker} picker
 * @param {import("./camera3.js").Camera3} camera
 * @param {(place: ArrayLike<number>) => boolean} kept
 * @param {State} state
 * @returns {Shape[]}
 */
function lines(picker, camera, kept, { layers, palette, walls, frame, inFront }) {
  /** @type {Shape[]} */
  const shapes = [];
  /** @param {number[][]} ends @param {string} colour @param {number} [away] */
  const add = (ends, colour, away = -dot(camera.axes[2], ends[0])) => {
    const path = ends.map((p) => camera.toScreen(p).map(short).join(" ")).join("L");
    const text = `<path d="M${path}" stroke="${colour}" fill="none"/>`;
    shapes.push({ away, text });
  };
  for (let i = 0; layers.lone && i < picker.lone; i++) {
    const ends = [0, 3].map((k) => [...picker.ends.subarray(6 * i + k, 6 * i + k + 3)]);
    const left = clipped(ends, walls, false);
    if (left.length && left.every(kept)) add(left, palette.isolated);
  }
  inFront.forEach((front, i) => {
    const ends = [0, 3].map((k) => [...frame.subarray(6 * i + k, 6 * i + k + 3)]);
    add(ends, palette.text, front ? -Infinity : Infinity);
  });
  return shapes;
}

/**
 * @param {import("./camera3.js").Camera3} camera
 * @param {(place: ArrayLike<number>) => boolean} kept
 * @param {State} state
 * @returns {Shape[]}
 */
function balls(camera, kept, { palette, balls, walls }) {
  /** @type {Shape[]} */
  const shapes = [];
  for (const { place, radius } of balls) {
    const inside = clipped([[...place]], walls, false).length > 0;
    if (radius === 0 || !inside || !kept(place)) continue;
    const [x, y] = camera.toScreen(place).map(short);
    const wide = short(radius * camera.pixelsAt(camera.seen(place)[2]));
    const look = `fill="${palette.circles}" fill-opacity="0.35" stroke="${palette.arcs}"`;
    const text = `<circle cx="${x}" cy="${y}" r="${wide}" ${look} stroke-width="0.4"/>`;
    shapes.push({ away: -dot(camera.axes[2], place), text });
  }
  return shapes;
}

/**
 * Return what the walls of a box leave of a polygon, or of a line.
 * @param {number[][]} corners
 * @param {import("./scene3.js").Cut[]} walls
 * @param {boolean} closed
 * @returns {number[][]}
 */
export function clipped(corners, walls, closed) {
  for (const { normal, offset } of walls) {
    /** @type {number[][]} */
    const left = [];
    corners.forEach((p, i) => {
      const q = corners[(i + 1) % corners.length];
      const [here, there] = [p, q].map((place) => dot(normal, place) - offset - 1e-6);
      if (here <= 0) left.push(p);
      if (here > 0 === there > 0 || (!closed && i === corners.length - 1)) return;
      const share = here / (here - there);
      left.push(p.map((x, k) => x + share * (q[k] - x)));
    });
    corners = left;
  }
  return corners;
}

/** @param {Float32Array[]} corners @returns {number[]} */
function normalOf([a, b, c]) {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const length = Math.hypot(...normal) || 1;
  return normal.map((v) => v / length);
}

/** @param {number[]} colour */
function hex(colour) {
  return `#${colour.map((v) => Math.round(255 * Math.min(1, v)).toString(16).padStart(2, "0")).join("")}`;
}

/** @param {number} value */
function short(value) {
  return Math.round(value * 100) / 100;
}
