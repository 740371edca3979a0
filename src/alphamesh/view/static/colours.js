// Colours of cells.

import { NEVER } from "./complex.js";

/**
 * Return one of seven numbers for each vertex, different for neighbours where possible.
 * @param {Uint32Array} edges
 * @param {number} vertices
 * @param {number} colours
 * @returns {Uint8Array}
 */
export function colouring(edges, vertices, colours) {
  const start = new Uint32Array(vertices + 1);
  for (const vertex of edges) start[vertex + 1]++;
  for (let v = 0; v < vertices; v++) start[v + 1] += start[v];
  const fill = start.slice(0, vertices);
  const neighbours = new Uint32Array(edges.length);
  for (let i = 0; i < edges.length; i += 2) {
    neighbours[fill[edges[i]]++] = edges[i + 1];
    neighbours[fill[edges[i + 1]]++] = edges[i];
  }
  const found = new Uint8Array(vertices).fill(255);
  const used = new Uint32Array(colours).fill(NEVER);
  for (let v = 0; v < vertices; v++) {
    for (let i = start[v]; i < start[v + 1]; i++) {
      if (found[neighbours[i]] !== 255) used[found[neighbours[i]]] = v;
    }
    // Begin at a place that depends on the vertex, so that all colours are used alike.
    const first = Math.imul(v, 2654435761) >>> 16;
    found[v] = first % colours;
    for (let k = 0; k < colours; k++) {
      const colour = (first + k) % colours;
      if (used[colour] !== v) {
        found[v] = colour;
        break;
      }
    }
  }
  return found;
}
