// The frame of a periodic box in space, and balls that reach into it.

import { movesOf } from "./patch.js";

/**
 * @typedef {import("./filtered.js").Box} Box
 * @typedef {import("./space.js").SpaceComplex} SpaceComplex
 */

/**
 * Return the place and the weight of each ball; in a box those of copies that may reach in.
 * @param {SpaceComplex} complex
 * @returns {Float32Array}
 */
export function ballsOf({ positions: p, weights, vertexCount, box }) {
  const balls = [];
  for (let v = 0; v < vertexCount; v++) {
    const place = [...p.subarray(3 * v, 3 * v + 3)];
    const weight = weights ? weights[v] : 0;
    const moves = box ? movesOf(place, place, box, 0.5) : [[0, 0, 0]];
    for (const move of moves) {
      balls.push(...place.map((x, k) => x + move[k] * (box?.periods[k] ?? 0)), weight);
    }
  }
  return Float32Array.from(balls);
}

/** The twelve sides of a box: their direction, and on which end of each other one they are. */
const SIDES = [0, 1, 2].flatMap((axis) =>
  [0, 1, 2, 3].map((corner) => {
    const ends = [corner & 1, corner >> 1];
    ends.splice(axis, 0, 0);
    return { axis, ends };
  }),
);

/**
 * Return the sides of a box in its periodic directions, 24 places, twice the same where it is
 * open.
 * @param {Box | null} box
 * @returns {Float32Array}
 */
export function frameOf(box) {
  const places = new Float32Array(72);
  if (!box) return places;
  SIDES.forEach(({ axis, ends }, i) => {
    for (const end of [0, box.periods[axis] ? 1 : 0]) {
      const place = ends.map((side, k) => ((k === axis ? end : side) ? box.high[k] : box.low[k]));
      places.set(place, 6 * i + 3 * end);
    }
    if (!box.periods[axis]) places.copyWithin(6 * i + 3, 6 * i, 6 * i + 3);
  });
  return places;
}

/**
 * Return which sides of a box nothing in it hides: one of the two faces there is turned to
 * the eye. The others are behind all of it.
 * @param {Box} box
 * @param {number[]} eye
 * @returns {boolean[]}
 */
export function sidesInFront({ low, high }, eye) {
  return SIDES.map(({ axis, ends }) =>
    ends.some((end, k) => k !== axis && (end ? eye[k] > high[k] : eye[k] < low[k])),
  );
}
