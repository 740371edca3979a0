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
  const pieces = cellPieces(complex, 64);
  const size = pieceSize(complex);
  const places = new Map();
  for (let v = 0; v < complex.vertexCount; v++) {
    places.set(`${complex.positions[2 * v]},${complex.positions[2 * v + 1]}`, v);
  }
  const found = new Array(complex.vertexCount).fill(0);
  for (let i = 0; i < pieces.length; i += size) {
    const [ux, uy, vx, vy, ax, ay, bx, by] = pieces.subarray(i, i + 8);
    const tips = complex.weights ? pieces.subarray(i + 12, i + 16) : [ux, uy, vx, vy];
    const alone = ux === vx && uy === vy;
    for (const [x, y, k] of alone ? [[ux, uy, 0]] : [[ux, uy, 0], [vx, vy, 2]]) {
      const [tx, ty] = [tips[k], tips[k + 1]];
      const area = Math.abs((ax - tx) * (by - ty) - (bx - tx) * (ay - ty)) / 2;
      found[places.get(`${x},${y}`)] += area;
    }
  }
  return found;
}
