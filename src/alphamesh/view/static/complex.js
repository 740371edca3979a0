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
 * Return for each edge the vertex whose component it ends, of a complex in which all vertices
 * come at once: any of them, as components of the same age are alike.
 * @param {Uint32Array} loops for each triangle the edge that began the loop that it ends
 * @param {number} edges
 * @returns {Uint32Array}
 */
export function joiners(loops, edges) {
  const begins = marked(loops, edges);
  const creators = new Uint32Array(edges).fill(NEVER);
  let joined = 0;
  for (let e = 0; e < edges; e++) if (!begins[e]) creators[e] = ++joined;
  return creators;
}

/**
 * Births and deaths of the classes of one dimension that last, and births of those for ever.
 * @typedef {{births: Float64Array, deaths: Float64Array, essential: Float64Array}} Diagram
 */

/**
 * Return the diagram of one dimension.
 * @param {ArrayLike<number>} values filtration values of the simplices that begin classes
 * @param {ArrayLike<number>} above of those that end them
 * @param {Uint32Array} enders for each of those above the simplex whose class it ends
 * @param {Uint32Array | undefined} own for each simplex the one whose class it ends itself
 * @returns {Diagram}
 */
export function diagramOf(values, above, enders, own) {
  const begins = marked(enders, values.length);
  const essential = [];
  for (let i = 0; i < values.length; i++) {
    if (!begins[i] && (!own || own[i] === NEVER)) essential.push(values[i]);
  }
  let kept = 0;
  /** @param {number} i */
  const lasts = (i) => enders[i] !== NEVER && values[enders[i]] < above[i];
  for (let i = 0; i < enders.length; i++) if (lasts(i)) kept++;
  const [births, deaths] = [new Float64Array(kept), new Float64Array(kept)];
  for (let i = 0, k = 0; i < enders.length; i++) {
    if (!lasts(i)) continue;
    births[k] = values[enders[i]];
    deaths[k++] = above[i];
  }
  return { births, deaths, essential: Float64Array.from(essential) };
}
