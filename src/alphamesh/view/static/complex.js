// The complex at every radius: simplices sorted by filtration value, so that the complex
// at a radius is a prefix of each array. What is in it is told by ranks, whole numbers:
// no rounding can change it.

/** The rank of a coface that there is not. */
export const NEVER = 0xffffffff;

/**
 * Return how many of the ascending `values` are at most `limit`.
 * @param {ArrayLike<number>} values
 * @param {number} limit
 * @returns {number}
 */
export function countUpTo(values, limit) {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (values[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Return, for each k, how many of the ranks are less than k; `NEVER` counts nowhere.
 * @param {Uint32Array} ranks
 * @param {number} size how many ranks there can be
 * @returns {Uint32Array} of `size + 1` numbers
 */
export function countsBelow(ranks, size) {
  const counts = new Uint32Array(size + 1);
  for (let i = 0; i < ranks.length; i++) if (ranks[i] !== NEVER) counts[ranks[i] + 1]++;
  for (let k = 0; k < size; k++) counts[k + 1] += counts[k];
  return counts;
}

/**
 * Return the least and the greatest rank of the cofaces of each face.
 *
 * The greatest is `NEVER` for a face with fewer than two cofaces: it never gets inside.
 * @param {Uint32Array} faces the faces of each coface, one coface after the other
 * @param {number} each how many faces a coface has
 * @param {number} count how many faces there are
 * @returns {{first: Uint32Array, last: Uint32Array}}
 */
export function cofaceRanks(faces, each, count) {
  const first = new Uint32Array(count).fill(NEVER);
  const last = new Uint32Array(count).fill(NEVER);
  for (let i = 0; i < faces.length; i++) {
    const face = faces[i];
    const rank = Math.floor(i / each);
    // Ranks come in ascending order.
    if (first[face] === NEVER) first[face] = rank;
    else last[face] = rank;
  }
  return { first, last };
}

/**
 * Return the rank of the first edge of each vertex.
 * @param {Uint32Array} edges
 * @param {number} vertices
 * @returns {Uint32Array}
 */
export function firstEdges(edges, vertices) {
  const joined = new Uint32Array(vertices).fill(NEVER);
  for (let i = 0; i < edges.length; i++) {
    if (joined[edges[i]] === NEVER) joined[edges[i]] = i >> 1;
  }
  return joined;
}

/**
 * Return the corners of triangles whose edges are given, each opposite to a corner.
 * @param {Uint32Array} edges
 * @param {Uint32Array} triangleEdges
 * @returns {Uint32Array}
 */
export function cornersOf(edges, triangleEdges) {
  const corners = new Uint32Array(triangleEdges.length);
  for (let i = 0; i < corners.length; i += 3) {
    // Corners a < b < c; the edges are bc, ac and ab.
    corners[i] = edges[2 * triangleEdges[i + 2]];
    corners[i + 1] = edges[2 * triangleEdges[i + 2] + 1];
    corners[i + 2] = edges[2 * triangleEdges[i] + 1];
  }
  return corners;
}

/**
 * Mark the simplices that begin a class.
 * @param {Uint32Array} creators for each destroyer its creator, or `NEVER`
 * @param {number} count
 * @returns {Uint8Array}
 */
export function marked(creators, count) {
  const marks = new Uint8Array(count);
  for (const creator of creators) if (creator !== NEVER) marks[creator] = 1;
  return marks;
}

/**
 * Return sums of all values before each place.
 * @param {ArrayLike<number>} values
 * @returns {Float64Array} one longer than `values`
 */
export function sumsBefore(values) {
  const sums = new Float64Array(values.length + 1);
  for (let i = 0; i < values.length; i++) sums[i + 1] = sums[i] + values[i];
  return sums;
}

/**
 * Births and deaths of the classes of one dimension that last.
 * @typedef {{births: Float64Array, deaths: Float64Array, essential: number}} Diagram
 */

/**
 * @param {ArrayLike<number>} births
 * @param {ArrayLike<number>} deaths
 * @param {number} essential classes that never die; they are born at 0
 * @returns {Diagram}
 */
export function lasting(births, deaths, essential) {
  let kept = 0;
  for (let i = 0; i < births.length; i++) if (births[i] < deaths[i]) kept++;
  const [from, to] = [new Float64Array(kept), new Float64Array(kept)];
  for (let i = 0, k = 0; i < births.length; i++) {
    if (births[i] < deaths[i]) {
      from[k] = births[i];
      to[k++] = deaths[i];
    }
  }
  return { births: from, deaths: to, essential };
}

/**
 * Return the diagrams of all dimensions, from which class each simplex ends.
 * @param {number} vertices
 * @param {ArrayLike<number>[]} values filtration values of edges, triangles, ...
 * @param {Uint32Array[]} creators of the classes that triangles, ... end
 * @returns {Diagram[]} one for each dimension
 */
export function diagramsOf(vertices, values, creators) {
  const begins = marked(creators[0], values[0].length);
  const ends = Array.from(values[0]).filter((_, i) => !begins[i]);
  const diagrams = [lasting(new Float64Array(ends.length), ends, vertices - ends.length)];
  creators.forEach((of, k) => {
    /** @type {number[]} */
    const births = [];
    /** @type {number[]} */
    const deaths = [];
    for (let i = 0; i < of.length; i++) {
      if (of[i] === NEVER) continue;
      births.push(values[k][of[i]]);
      deaths.push(values[k + 1][i]);
    }
    diagrams.push(lasting(births, deaths, 0));
  });
  return diagrams;
}
