// The picture as SVG: what is seen, as paths.

import { cellPieces, pieceSize } from "./cells.js";
import { NEVER } from "./complex.js";
import { VEIL, veilOf } from "./veil.js";
import { hiddenSize, lineWidth, pointSizes, showsEdges, spacingOf } from "./sizes.js";

/**
 * @typedef {import("./plane.js").PlaneComplex} PlaneComplex
 * @typedef {import("./filtered.js").Facts} Facts
 * @typedef {import("./camera.js").Camera} Camera
 */

/**
 * Return the picture as the text of an SVG file.
 * @param {PlaneComplex} complex
 * @param {{facts: Facts, camera: Camera, layers: Record<string, boolean>, palette: any,
 *          title: string}} state
 * @returns {string}
 */
export function svgOf(complex, { facts, camera, layers, palette, title }) {
  const { width, height } = camera;
  const draw = new Drawing(complex, camera);
  const spacing = spacingOf(complex) * camera.scale;
  const parts = [];
  if (layers.cells || layers.discs) parts.push(draw.cells(facts, layers, palette, spacing));
  if (layers.discs && complex.reach(facts.radius) > 0) {
    const style = `fill="none" stroke="${palette.circles}" stroke-width="0.8"`;
    parts.push(`<g ${style}>${draw.circles(draw.balls(facts.radius))}</g>`);
  }
  if (layers.triangles) {
    const opacity = layers.cells || layers.discs ? 0.72 : 1;
    const path = draw.triangles(facts.shown[2]);
    parts.push(`<path fill="${palette.triangles}" fill-opacity="${opacity}" d="${path}"/>`);
  }
  const wide = short(lineWidth(spacing));
  /** @type {[boolean, number, string, string][]} */
  const lines = [
    [layers.edges && showsEdges(spacing), 2, palette.interior, "0.8"],
    [layers.boundary, 1, palette.boundary, wide],
    [layers.singular, 0, palette.singular, wide],
  ];
  for (const [shown, kind, colour, width] of lines) {
    if (!shown) continue;
    const style = `fill="none" stroke-linecap="round" stroke="${colour}"`;
    parts.push(`<path ${style} stroke-width="${width}" d="${draw.edges(facts, kind)}"/>`);
  }
  if (layers.hidden) {
    const style = `fill="${palette.background}" stroke="${palette.quiet}"`;
    parts.push(`<g ${style}>${draw.rings(hiddenSize(spacing) / 2)}</g>`);
  }
  if (layers.points) {
    const [joined, isolated] = pointSizes(spacing);
    const dots = joined ? draw.dots(facts, joined / 2, false) : "";
    parts.push(`<g fill="${palette.points}">${dots}</g>`);
    parts.push(`<g fill="${palette.isolated}">${draw.dots(facts, isolated / 2, true)}</g>`);
  }
  if (complex.box) {
    const { veil, rest, frame } = veilOf(complex.box, camera);
    const fill = `fill="${palette.background}" fill-rule="evenodd"`;
    parts.push(`<path ${fill} fill-opacity="${VEIL}" d="${veil}"/>`, `<path ${fill} d="${rest}"/>`);
    parts.push(`<path fill="none" stroke="${palette.text}" d="${frame}"/>`);
  }
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${short(width)}" height="${short(height)}"`,
    ` viewBox="0 0 ${short(width)} ${short(height)}">`,
    `<title>${escaped(title)}</title>`,
    `<rect width="100%" height="100%" fill="${palette.background}"/>`,
    ...parts,
    "</svg>\n",
  ].join("\n");
}

/** Places on paper, and paths of what can be seen there. */
class Drawing {
  /**
   * @param {PlaneComplex} complex
   * @param {Camera} camera
   */
  constructor(complex, camera) {
    this.complex = complex;
    this.seen = complex.seen;
    this.camera = camera;
  }

  /** @param {number} v */
  place(v) {
    const p = this.seen.positions;
    return this.camera.toScreen(p[2 * v], p[2 * v + 1]);
  }

  /**
   * Return a path through vertices, or nothing if all of it is out of sight.
   * @param {number[]} vertices
   * @param {string} end
   */
  path(vertices, end) {
    const { width, height } = this.camera;
    const places = vertices.map((v) => this.place(v));
    const [xs, ys] = [places.map((q) => q[0]), places.map((q) => q[1])];
    if (Math.max(...xs) < 0 || Math.min(...xs) > width) return "";
    if (Math.max(...ys) < 0 || Math.min(...ys) > height) return "";
    return `M${places.map((q) => `${short(q[0])} ${short(q[1])}`).join("L")}${end}`;
  }

  /** @param {number} count */
  triangles(count) {
    const { triangles } = this.seen;
    let text = "";
    for (let t = 0; t < 3 * count; t += 3) {
      text += this.path([triangles[t], triangles[t + 1], triangles[t + 2]], "Z");
    }
    return text;
  }

  /**
   * @param {Facts} facts
   * @param {number} kind 0 singular, 1 boundary, 2 interior
   */
  edges(facts, kind) {
    const { edges, cofaces } = this.seen;
    const [count, triangles] = [facts.shown[1], facts.present[2]];
    let text = "";
    for (let e = 0; e < count; e++) {
      const entered = cofaces.first[e] < triangles ? 1 : 0;
      const inside = cofaces.last[e] !== NEVER && cofaces.last[e] < triangles ? 1 : 0;
      if (entered + inside === kind) text += this.path([edges[2 * e], edges[2 * e + 1]], "");
    }
    return text;
  }

  /**
   * @param {Facts} facts
   * @param {number} size
   * @param {boolean} isolated
   */
  dots(facts, size, isolated) {
    const { joined } = this.seen;
    const [vertices, edges] = [facts.shown[0], facts.present[1]];
    return this.circles((v) => (v < vertices && joined[v] >= edges === isolated ? size : 0));
  }

  /** Radii of balls on paper. @param {number} radius @returns {(v: number) => number} */
  balls(radius) {
    const { weights } = this.seen;
    const power = this.complex.power(radius);
    return (v) => Math.sqrt(Math.max(0, power + (weights ? weights[v] : 0))) * this.camera.scale;
  }

  /** Rings around hidden points. @param {number} radius */
  rings(radius) {
    const { positions: p, rows } = this.complex.hidden;
    return Array.from(rows, (_, i) => {
      const [x, y] = this.camera.toScreen(p[2 * i], p[2 * i + 1]);
      return `<circle cx="${short(x)}" cy="${short(y)}" r="${short(radius)}"/>`;
    }).join("");
  }

  /** @param {(v: number) => number} radiusOf 0 for none */
  circles(radiusOf) {
    const { width, height } = this.camera;
    let text = "";
    for (let v = 0; v < this.seen.vertexCount; v++) {
      const radius = radiusOf(v);
      if (radius === 0) continue;
      const [x, y] = this.place(v);
      if (x < -radius || y < -radius || x > width + radius || y > height + radius) continue;
      text += `<circle cx="${short(x)}" cy="${short(y)}" r="${short(radius)}"/>`;
    }
    return text;
  }

  /**
   * Return each disc cut by its Voronoi cell.
   * @param {Facts} facts
   * @param {Record<string, boolean>} layers
   * @param {any} palette
   * @param {number} spacing
   */
  cells(facts, layers, palette, spacing) {
    const { complex, camera } = this;
    const far = Math.max(64, 8 * complex.reach(facts.radius));
    const pieces = cellPieces(complex.seen, far);
    const power = complex.power(facts.radius);
    let [clips, discs] = ["", ""];
    let id = 0;
    for (const { colour, x, y, weight, tip, corners } of gathered(pieces, pieceSize(complex.seen))) {
      const shown = Math.sqrt(Math.max(0, power + weight)) * camera.scale;
      const [sx, sy] = camera.toScreen(x, y);
      if (shown === 0 || sx < -shown || sy < -shown) continue;
      if (sx > camera.width + shown || sy > camera.height + shown) continue;
      /** @param {number[]} p */
      const turn = (p) => Math.atan2(p[1] - tip[1], p[0] - tip[0]);
      corners.sort((a, b) => turn(a) - turn(b));
      const outline = corners.map(([cx, cy]) => camera.toScreen(cx, cy).map(short).join(","));
      clips += `<clipPath id="c${id}"><polygon points="${outline.join(" ")}"/></clipPath>`;
      const fill = layers.cells ? palette.cells[colour] : palette.union;
      const at = `cx="${short(sx)}" cy="${short(sy)}" r="${short(shown)}"`;
      discs += `<circle ${at} fill="${fill}" clip-path="url(#c${id++})"/>`;
    }
    const line = Math.min(1.3, 0.07 * spacing);
    const style = layers.cells ? `stroke="${palette.arcs}" stroke-width="${short(line)}"` : "";
    return `<defs>${clips}</defs><g ${style}>${discs}</g>`;
  }
}

/**
 * A cell: its site, a place inside, and its corners.
 * @typedef {{colour: number, x: number, y: number, weight: number, tip: number[],
 *            corners: number[][]}} Cell
 */

/**
 * Put the pieces of each cell together.
 * @param {Float32Array} pieces
 * @param {number} size
 * @returns {Iterable<Cell>}
 */
function gathered(pieces, size) {
  /** @type {Map<string, Cell>} */
  const cells = new Map();
  for (let i = 0; i < pieces.length; i += size) {
    for (const side of [0, 1]) {
      const [x, y] = [pieces[i + 2 * side], pieces[i + 2 * side + 1]];
      const key = `${x},${y}`;
      const colour = pieces[i + 8 + side];
      const weight = pieces[i + 10 + side];
      const tip = size > 12 ? [pieces[i + 12 + 2 * side], pieces[i + 13 + 2 * side]] : [x, y];
      const cell = cells.get(key) ?? { colour, x, y, weight, tip, corners: [] };
      cells.set(key, cell);
      cell.corners.push([pieces[i + 4], pieces[i + 5]], [pieces[i + 6], pieces[i + 7]]);
    }
  }
  return cells.values();
}

/** @param {number} value */
function short(value) {
  return String(Math.round(value * 100) / 100);
}

/** @param {string} text */
function escaped(text) {
  return text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
