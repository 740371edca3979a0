// The surface as SVG: triangles one over the other, the farthest first.

import { dot } from "./camera3.js";
import { rgb } from "./theme.js";

/**
 * Return the surface as the text of an SVG file.
 * @param {import("./surface3.js").SurfacePicker} picker
 * @param {import("./camera3.js").Camera3} camera
 * @param {(place: ArrayLike<number>) => boolean} kept what the cut leaves
 * @param {{layers: Record<string, boolean>, palette: any, title: string,
 *          balls: {place: Float32Array, radius: number}[]}} state
 * @returns {string}
 */
export function svgOfSurface(picker, camera, kept, { layers, palette, title, balls }) {
  const back = camera.axes[2];
  /** @type {{away: number, text: string}[]} */
  const shapes = [];
  const from = layers.boundary ? 0 : picker.boundary;
  const end = picker.boundary + (layers.singular ? picker.singular : 0);
  for (let i = from; i < end; i++) {
    const corners = [0, 3, 6].map((k) => picker.corners.subarray(9 * i + k, 9 * i + k + 3));
    const middle = [0, 1, 2].map((k) => corners.reduce((sum, p) => sum + p[k], 0) / 3);
    if (!kept(middle)) continue;
    const facing = dot(normalOf(corners), back);
    const singular = i >= picker.boundary;
    const shade = 0.5 + 0.5 * Math.abs(facing);
    const lit = rgb(singular ? palette.sheet : palette.surface).map((v) => v * shade);
    const inside = !singular && facing < 0;
    const colour = inside ? palette.inside : hex(lit);
    const path = corners.map((p) => camera.toScreen(p).map(short).join(" ")).join("L");
    const line = layers.wire ? palette.boundary : colour;
    const text = `<path d="M${path}Z" fill="${colour}" stroke="${line}" stroke-width="0.4"/>`;
    shapes.push({ away: -dot(back, middle), text });
  }
  for (let i = 0; layers.lone && i < picker.lone; i++) {
    const ends = [0, 3].map((k) => picker.ends.subarray(6 * i + k, 6 * i + k + 3));
    if (!ends.every(kept)) continue;
    const path = ends.map((p) => camera.toScreen(p).map(short).join(" ")).join("L");
    const text = `<path d="M${path}" stroke="${palette.isolated}" fill="none"/>`;
    shapes.push({ away: -dot(back, ends[0]), text });
  }
  for (const { place, radius } of balls) {
    if (radius === 0 || !kept(place)) continue;
    const [x, y] = camera.toScreen(place).map(short);
    const wide = short(radius * camera.pixelsAt(camera.seen(place)[2]));
    const look = `fill="${palette.circles}" fill-opacity="0.35" stroke="${palette.arcs}"`;
    const text = `<circle cx="${x}" cy="${y}" r="${wide}" ${look} stroke-width="0.4"/>`;
    shapes.push({ away: -dot(back, place), text });
  }
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
