// How large points and lines are drawn, by how close the points are.

/** Whether edges inside can be told apart. @param {number} spacing in CSS pixels */
export function showsEdges(spacing) {
  return spacing > 4;
}

/**
 * Return the width of boundary and singular edges in CSS pixels.
 * @param {number} spacing of the points, in CSS pixels
 */
export function lineWidth(spacing) {
  return Math.min(Math.max(0.16 * spacing, 1.2), 3);
}

/**
 * Return the diameters of points with edges and without, in CSS pixels; 0 hides them.
 * @param {number} spacing
 * @returns {[number, number]}
 */
export function pointSizes(spacing) {
  const size = Math.min(Math.max(0.24 * spacing, 1.2), 6.5);
  return [spacing > 4 ? size : 0, 1.4 * size];
}

/** The diameter of a ring that marks a hidden point, in CSS pixels. @param {number} spacing */
export function hiddenSize(spacing) {
  return Math.max(4, 1.3 * pointSizes(spacing)[0]);
}

/**
 * Return the typical distance of neighbours, in units of the picture.
 * @param {{vertexCount: number, edgeCount: number, joined: Uint32Array,
 *          edgeLength: (edge: number) => number}} complex
 */
export function spacingOf(complex) {
  if (complex.edgeCount === 0) return 0.2;
  const lengths = new Float64Array(complex.vertexCount);
  for (let v = 0; v < lengths.length; v++) lengths[v] = complex.edgeLength(complex.joined[v]);
  lengths.sort();
  // Neighbours are a little farther apart than the nearest of them.
  return 1.5 * lengths[lengths.length >> 1];
}
