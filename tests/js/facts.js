// Print what the view says of a packed complex: node facts.js FILE RADIUS...

import { readFileSync } from "node:fs";

import { cellPieces, pieceSize } from "../../src/alphamesh/view/static/cells.js";
import { inflate, unpack } from "../../src/alphamesh/view/static/data.js";
import { complexOf } from "../../src/alphamesh/view/static/models.js";
import { BettiCurve, changesOf } from "../../src/alphamesh/view/static/steps.js";

const [file, ...radii] = process.argv.slice(2);
const payload = unpack(await inflate(new Uint8Array(readFileSync(file))));
const complex = complexOf(payload);
const curves = complex.diagrams.map((diagram) => new BettiCurve(diagram));

const told = {
  meta: payload.meta,
  positions: [...complex.positions],
  words: complex.words,
  drawn: {
    positions: [...complex.seen.positions],
    edges: [...complex.seen.edges],
    triangles: [...complex.seen.triangles],
  },
  hidden: [...complex.hidden.rows],
  rows: Array.from({ length: complex.vertexCount }, (_, v) => complex.rowOf(v)),
  triangles: [...complex.triangles],
  facts: radii.map((text) => {
    const radius = Number(text);
    return { ...complex.at(radius), curves: curves.map((curve) => curve.at(radius)) };
  }),
  changes: [...changesOf(curves, complex.first)],
  cells: payload.meta.ambient === 2 ? areas() : null,
};
console.log(JSON.stringify(told));

/** Areas of the Voronoi cells, those that go on for ever cut off somewhere. */
function areas() {
  const { seen } = complex;
  const pieces = cellPieces(seen, 64);
  const size = pieceSize(seen);
  // In a box, the copies of vertices that lie in it.
  const own = complex.patch ? (v) => inside(seen.positions, v) && complex.patch.owner[v] : (v) => v;
  const places = new Map();
  for (let v = 0; v < seen.vertexCount; v++) {
    if (own(v) === false) continue;
    places.set(`${seen.positions[2 * v]},${seen.positions[2 * v + 1]}`, own(v));
  }
  const found = new Array(complex.vertexCount).fill(0);
  for (let i = 0; i < pieces.length; i += size) {
    const [ux, uy, vx, vy, ax, ay, bx, by] = pieces.subarray(i, i + 8);
    const tips = complex.weights ? pieces.subarray(i + 12, i + 16) : [ux, uy, vx, vy];
    const alone = ux === vx && uy === vy;
    for (const [x, y, k] of alone ? [[ux, uy, 0]] : [[ux, uy, 0], [vx, vy, 2]]) {
      const [tx, ty] = [tips[k], tips[k + 1]];
      const area = Math.abs((ax - tx) * (by - ty) - (bx - tx) * (ay - ty)) / 2;
      const cell = places.get(`${x},${y}`);
      if (cell !== undefined) found[cell] += area;
    }
  }
  return found;
}

function inside(p, v) {
  const { low, high, periods } = complex.box;
  return periods.every((side, k) => !side || (p[2 * v + k] >= low[k] && p[2 * v + k] <= high[k]));
}
