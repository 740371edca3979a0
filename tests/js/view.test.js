// Units of the view that need no browser: node --test.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Camera } from "../../src/alphamesh/view/static/camera.js";
import { colouring } from "../../src/alphamesh/view/static/colours.js";
import { cofaceRanks, countUpTo, countsBelow, NEVER } from "../../src/alphamesh/view/static/complex.js";
import { bytesOfBase64, unpack } from "../../src/alphamesh/view/static/data.js";
import { readHash, writeHash } from "../../src/alphamesh/view/static/hash.js";
import { frameOf, sidesInFront } from "../../src/alphamesh/view/static/frame3.js";
import { movesOf } from "../../src/alphamesh/view/static/patch.js";
import { locate, PatchPicker, Picker } from "../../src/alphamesh/view/static/pick.js";
import { PlaneComplex } from "../../src/alphamesh/view/static/plane.js";
import { Scale } from "../../src/alphamesh/view/static/scale.js";
import {
  BettiCurve,
  changesOf,
  neighbouringChange,
  shownUpTo,
} from "../../src/alphamesh/view/static/steps.js";
import { svgOf } from "../../src/alphamesh/view/static/svg.js";
import { clipped } from "../../src/alphamesh/view/static/svg3.js";
import { count, counted, number, readRadius, ticks } from "../../src/alphamesh/view/static/text.js";
import { PALETTES, rgb } from "../../src/alphamesh/view/static/theme.js";
import { areaOf } from "../../src/alphamesh/view/static/veil.js";

/** Two triangles over a square from -1 to 1; the diagonal comes last. */
function square() {
  const meta = { ambient: 2, scale: 10, centre: [0, 0], extent: [1, 1] };
  return new PlaneComplex({
    meta,
    arrays: {
      positions: new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]),
      edges: new Uint32Array([0, 1, 1, 2, 2, 3, 0, 3, 0, 2]),
      edge_values: new Float64Array([10, 10, 10, 10, 14.1]),
      triangle_facets: new Uint32Array([1, 4, 0, 2, 3, 4]),
      triangle_values: new Float64Array([14.1, 14.2]),
      triangle_creators: new Uint32Array([4, 3]),
    },
  });
}

test("a count includes what is equal", () => {
  assert.equal(countUpTo([1, 2, 2, 3], 2), 3);
  assert.equal(countUpTo([1, 2, 2, 3], 0.5), 0);
  assert.equal(countUpTo([1, 2, 2, 3], Infinity), 4);
  assert.equal(countUpTo([], 1), 0);
});

test("ranks of cofaces tell when a face is entered and left", () => {
  const { first, last } = cofaceRanks(new Uint32Array([0, 1, 2, 1, 2, 3]), 3, 5);
  assert.deepEqual([...first], [0, 0, 0, 1, NEVER]);
  assert.deepEqual([...last], [NEVER, 1, 1, NEVER, NEVER]);
  assert.deepEqual([...countsBelow(first, 2)], [0, 3, 4]);
});

test("a square grows from four points over a ring to two triangles", () => {
  const complex = square();
  const seen = [0, 10, 14.1, 14.2].map((radius) => complex.at(radius));
  assert.deepEqual(seen.map((f) => f.betti), [[4, 0], [1, 1], [1, 1], [1, 0]]);
  assert.deepEqual(seen.map((f) => f.isolated), [4, 0, 0, 0]);
  assert.deepEqual(seen.map((f) => f.singularEdges), [0, 4, 2, 0]);
  assert.deepEqual(seen.map((f) => f.boundary), [0, 0, 3, 4]);
  assert.deepEqual(seen.map((f) => f.size), [0, 0, 200, 400]);
  assert.deepEqual(seen.map((f) => f.border), [0, 0, 40 + Math.hypot(20, 20), 80]);
});

test("changes of the topology are found in either direction", () => {
  const curves = square().diagrams.map((diagram) => new BettiCurve(diagram));
  const changes = changesOf(curves);
  assert.deepEqual([...changes], [10, 14.2]);
  assert.equal(neighbouringChange(changes, 0, 1), 10);
  assert.equal(neighbouringChange(changes, 10, 1), 14.2);
  assert.equal(neighbouringChange(changes, 14.2, 1), null);
  assert.equal(neighbouringChange(changes, 14.2, -1), 10);
  assert.equal(neighbouringChange(changes, 12, -1), 10);
  assert.equal(neighbouringChange(changes, 10, -1), null);
});

test("the slider ends behind the last change, not at the largest circle", () => {
  assert.equal(shownUpTo(10, 1e9, 0), 12);
  assert.equal(shownUpTo(10, 15, 0), 15.75);
  assert.equal(shownUpTo(1, 1e9, 40), 60);
  assert.equal(shownUpTo(0, 0, 0), 1);
});

test("every place finds the triangle that holds it, from any other one", () => {
  const complex = square();
  for (const start of [0, 1]) {
    assert.deepEqual(locate(complex, 0.5, -0.5, start), { triangle: 0, exit: -1 });
    assert.deepEqual(locate(complex, -0.5, 0.5, start), { triangle: 1, exit: -1 });
    assert.equal(locate(complex, 0, 3, start).exit, 2);
  }
});

test("pointing prefers a vertex, then an edge", () => {
  const picker = new Picker(square());
  assert.deepEqual(picker.at(0.99, 0.98, 0.05)?.corners, [2]);
  assert.deepEqual(picker.at(0.5, 0.52, 0.05)?.corners, [0, 2]);
  assert.deepEqual(picker.at(0.5, -0.3, 0.05)?.corners, [0, 1, 2]);
  assert.equal(picker.at(0.5, -0.3, 0.05)?.value, 14.1);
  assert.equal(picker.at(0, 1.02, 0.05)?.value, 10);
  assert.equal(picker.at(0, 2, 0.05), null);
});

/** Two points in a strip of width 2, and an edge between them across its border. */
function box() {
  const periods = [2, null];
  const low = [-1, -1];
  const meta = { ambient: 2, scale: 1, centre: [0, 0], extent: [1, 1], box: { periods, low, high: [1, 1] } };
  return new PlaneComplex({
    meta,
    arrays: {
      positions: new Float32Array([-0.8, 0, 0.8, 0]),
      edges: new Uint32Array([0, 1]),
      edge_offsets: new Uint8Array([0, 1]),
      edge_values: new Float64Array([0.2]),
      edge_creators: new Uint32Array([1]),
      triangle_facets: new Uint32Array(0),
      triangle_corners: new Uint32Array(0),
      triangle_offsets: new Uint8Array(0),
      triangle_values: new Float64Array(0),
      triangle_creators: new Uint32Array(0),
      cell_sizes: new Float32Array(0),
      facet_sizes: new Float32Array([0.4]),
    },
  });
}

test("an edge across the border of a box is drawn on either side", () => {
  const complex = box();
  assert.ok(Math.abs(complex.edgeLength(0) - 0.4) < 1e-6);
  const patch = complex.patch;
  assert.ok(patch);
  const spans = [];
  for (let e = 0; e < patch.edgeCount; e++) {
    const [a, b] = [2 * patch.edges[2 * e], 2 * patch.edges[2 * e + 1]];
    spans.push([patch.positions[b], patch.positions[a]].map((x) => Math.round(10 * x) / 10));
  }
  // Half a period is shown on all sides.
  assert.deepEqual(spans, [[-1.2, -0.8], [0.8, 1.2]]);
  assert.deepEqual(complex.at(0.1).shown, [4, 0, 0]);
  assert.deepEqual(complex.at(0.2).shown, [4, 2, 0]);
  assert.deepEqual(complex.at(0.2).betti, [1, 0]);
  assert.equal(complex.at(0.2).full, false);
  const found = new PatchPicker(complex).at(-1, 0.01, 0.05);
  assert.equal(found?.dimension, 1);
  assert.equal(found?.value, 0.2);
  assert.deepEqual(found?.corners.map((v) => complex.rowOfDrawn(v)).sort(), [0, 1]);
});

test("moves bring into a window what can be seen there", () => {
  const cube = { periods: [2, null], low: [-1, -9], high: [1, 9] };
  assert.deepEqual(movesOf([-0.5, 50], [0.5, 60], cube, 0), [[0, 0]]);
  assert.deepEqual(movesOf([0.5, 0], [1.5, 0], cube, 0), [[-1, 0], [0, 0]]);
  assert.deepEqual(movesOf([0, 0], [0, 0], cube, 0.5), [[-1, 0], [0, 0], [1, 0]]);
});

test("a veil lies around the box, and nowhere in open directions", () => {
  const camera = new Camera([1, 1]);
  camera.resize(400, 400);
  const cube = { periods: [2, null], low: [-1, -1], high: [1, 1] };
  const area = areaOf(cube, camera, 0);
  assert.ok(Math.abs(area.right - area.left - 2 * camera.scale) < 1e-9);
  assert.ok(area.top < 0 && area.bottom > 400);
  const wider = areaOf(cube, camera, 0.15);
  assert.ok(Math.abs(wider.right - area.right - 0.3 * camera.scale) < 1e-9);
});

test("the sides of a box in front are those with a face to the eye", () => {
  const cube = { periods: [2, 2, 2], low: [-1, -1, -1], high: [1, 1, 1] };
  // Above it all, only what is at the bottom is behind.
  const front = sidesInFront(cube, [0, 0, 9]);
  assert.equal(front.filter((side) => side).length, 4);
  assert.equal(sidesInFront(cube, [9, 9, 9]).filter((side) => !side).length, 3);
  const places = frameOf(cube);
  for (let i = 0; i < 72; i += 6) {
    const step = [0, 1, 2].map((k) => Math.abs(places[i + k] - places[i + 3 + k]));
    assert.deepEqual(step.sort(), [0, 0, 2]);
  }
});

test("walls cut polygons and lines", () => {
  const walls = [
    { normal: [1, 0, 0], offset: 1 },
    { normal: [-1, 0, 0], offset: 1 },
  ];
  const line = clipped([[-3, 0, 0], [3, 0, 0]], walls, false).map((p) => p.map(Math.round));
  assert.deepEqual(line, [[-1, 0, 0], [1, 0, 0]]);
  assert.equal(clipped([[0, 0, 0], [2, 0, 0], [0, 2, 0]], walls, true).length, 4);
  assert.equal(clipped([[2, 0, 0], [3, 0, 0], [2, 2, 0]], walls, true).length, 0);
});

test("neighbours have different colours", () => {
  const side = 30;
  const edges = [];
  for (let i = 0; i < side * side; i++) {
    if (i % side) edges.push(i - 1, i);
    if (i >= side) edges.push(i - side, i);
    if (i % side && i >= side) edges.push(i - side - 1, i);
  }
  const colours = colouring(new Uint32Array(edges), side * side, 7);
  for (let i = 0; i < edges.length; i += 2) {
    assert.notEqual(colours[edges[i]], colours[edges[i + 1]]);
  }
  assert.equal(new Set(colours).size, 7);
});

test("a camera keeps the place under the pointer", () => {
  const camera = new Camera([1, 0.5]);
  camera.resize(800, 600);
  const before = camera.toWorld(200, 150);
  camera.zoomAt(3, 200, 150);
  const after = camera.toWorld(200, 150);
  assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 1e-12);
  const [x, y] = camera.toScreen(...after);
  assert.ok(Math.hypot(x - 200, y - 150) < 1e-9);
  const copy = new Camera([1, 0.5]);
  copy.restore(camera.state);
  assert.deepEqual(copy.state, camera.state);
  copy.restore([NaN, 0, 1]);
  assert.deepEqual(copy.state, camera.state);
});

test("a scale gives back what it takes, and makes room for small radii", () => {
  for (const chosen of [1, 0.1, 0.001]) {
    const scale = new Scale(7, 7 * chosen);
    for (const share of [0, 0.1, 0.5, 1]) {
      assert.ok(Math.abs(scale.share(scale.radius(share)) - share) < 1e-12);
    }
    const marks = scale.ticks(4);
    assert.ok(marks.length >= 3 && marks.length <= 8, String(marks));
    assert.deepEqual(marks, [...marks].sort((a, b) => a - b));
  }
  assert.equal(new Scale(1, 0.5).power, 1);
  assert.equal(new Scale(1, 0.05).power, 2);
  assert.equal(new Scale(1, 1e-6).power, 3);
  assert.equal(new Scale(1, 0).power, 1);
});

test("a scale may begin below zero", () => {
  const scale = new Scale(3, 0, -2);
  assert.equal(scale.share(-2), 0);
  assert.equal(scale.share(-5), 0);
  assert.equal(scale.radius(0), -2);
  assert.equal(scale.radius(1), 3);
  assert.deepEqual(scale.ticks(4), [-2, 0, 2]);
  assert.equal(number(-1.5), "−1.5");
  assert.deepEqual(readHash("#r=-1.5", true), { radius: -1.5 });
});

test("numbers are short", () => {
  assert.deepEqual(
    [0, 1, 0.1234567, 12345.6, 1.5e7, 2e-7, Infinity].map((x) => number(x)),
    ["0", "1", "0.1235", "12,346", "1.5e7", "2e-7", "∞"],
  );
  assert.equal(count(1234567), "1,234,567");
  assert.equal(counted(1, "hole"), "1 hole");
  assert.equal(counted(2, "hole"), "2 holes");
  assert.deepEqual(ticks(10, 4), [0, 5, 10]);
  assert.deepEqual(ticks(0, 4), [0]);
});

test("a radius is a number of at least 0", () => {
  const texts = ["1.5", "1,5", " 2e-3 ", "inf", "∞", "0", "-1", "", "wide", "NaN"];
  const read = [1.5, 1.5, 0.002, Infinity, Infinity, 0, null, null, null, null];
  assert.deepEqual(texts.map((text) => readRadius(text)), read);
  assert.deepEqual(["-1", "−0,5", "-inf"].map((text) => readRadius(text, true)), [-1, -0.5, null]);
});

test("an address gives back the state, and nonsense is left out", () => {
  const state = { radius: 0.1 + 0.2, layers: "tb", view: [0.25, -1, 3], theme: "dark" };
  assert.deepEqual(readHash(`#${writeHash(state)}`), state);
  assert.deepEqual(readHash("#r=-1&view=1,x&theme=pink&show=A&=&r"), {});
  assert.equal(writeHash({ theme: "auto" }), "");
});

test("data that end too soon are refused", () => {
  const header = JSON.stringify({ meta: {}, arrays: [{ name: "a", type: "u32", length: 2 }] });
  const bytes = new Uint8Array(4 + header.length + 8);
  new DataView(bytes.buffer).setUint32(0, header.length, true);
  bytes.set(new TextEncoder().encode(header), 4);
  bytes.set([1, 2, 0, 1, 0, 0, 0, 0], 4 + header.length);
  assert.deepEqual([...unpack(bytes).arrays.a], [1, 258]);
  assert.throws(() => unpack(bytes.subarray(0, bytes.length - 1)), /bytes/);
  assert.deepEqual([...bytesOfBase64("AQI=\n")], [1, 2]);
});

test("an SVG holds what is seen, and no more", () => {
  const complex = square();
  const camera = new Camera([1, 1]);
  camera.resize(400, 300);
  const layers = { discs: false, cells: true, triangles: true, edges: true, boundary: true, singular: true, points: true };
  const state = { facts: complex.at(14.1), camera, layers, palette: PALETTES.light, title: "a < b" };
  const text = svgOf(complex, state);
  assert.ok(text.includes("<title>a &#60; b</title>"));
  assert.equal(text.match(/<clipPath /g)?.length, 4);
  assert.equal(text.match(/<circle [^>]*clip-path/g)?.length, 4);
  const triangles = text.match(new RegExp(`<path fill="${PALETTES.light.triangles}"[^>]*d="([^"]*)"`));
  assert.equal(triangles?.[1].match(/M/g)?.length, 1);
  const lines = text.match(new RegExp(`stroke="${PALETTES.light.boundary}"[^>]*d="([^"]*)"`));
  assert.equal(lines?.[1].match(/M/g)?.length, 3);
  camera.restore([2.9, 2.9, 30]);
  assert.ok(!/M\d/.test(svgOf(complex, state)));
});

test("both palettes have the same colours, all of them hexadecimal", () => {
  const { light, dark } = PALETTES;
  assert.deepEqual(Object.keys(light), Object.keys(dark));
  for (const palette of [light, dark]) {
    for (const colour of Object.values(palette).flat()) assert.match(colour, /^#[0-9a-f]{6}$/);
    assert.equal(palette.cells.length, 7);
  }
  assert.deepEqual(rgb("#ff8000"), [1, 128 / 255, 0]);
});
