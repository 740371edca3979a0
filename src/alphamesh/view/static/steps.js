// Betti numbers as step functions of the radius, and where they change.

import { countUpTo } from "./complex.js";

/**
 * @typedef {import("./complex.js").Diagram} Diagram
 */

/** When the classes of one dimension come and go. */
export class BettiCurve {
  /** @param {Diagram} diagram */
  constructor(diagram) {
    this.births = diagram.births.slice().sort();
    this.deaths = diagram.deaths.slice().sort();
    this.essential = diagram.essential.slice().sort();
  }

  /**
   * Return how many classes are alive at a radius.
   * @param {number} radius
   */
  at(radius) {
    const born = countUpTo(this.births, radius) + countUpTo(this.essential, radius);
    return born - countUpTo(this.deaths, radius);
  }
}

/**
 * Return every radius at which some class comes or goes, ascending, without repeats.
 * @param {BettiCurve[]} curves
 * @param {number} [first] where the first vertices come, which is no change
 * @returns {Float64Array}
 */
export function changesOf(curves, first = 0) {
  const parts = curves.flatMap((c) => [c.births, c.deaths, c.essential]);
  const all = new Float64Array(parts.reduce((n, part) => n + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  all.sort();
  let kept = 0;
  for (let i = 0; i < all.length; i++) {
    if (all[i] > first && (kept === 0 || all[i] > all[kept - 1])) all[kept++] = all[i];
  }
  return all.slice(0, kept);
}

/**
 * Return the next change after `radius`, or the last one before it.
 * @param {Float64Array} changes
 * @param {number} radius
 * @param {1 | -1} direction
 * @returns {number | null} null if there is none
 */
export function neighbouringChange(changes, radius, direction) {
  const upTo = countUpTo(changes, radius);
  if (direction > 0) return upTo < changes.length ? changes[upTo] : null;
  const before = upTo - (upTo > 0 && changes[upTo - 1] === radius ? 2 : 1);
  return before >= 0 ? changes[before] : null;
}

/**
 * Return the largest radius that the slider shows: all that changes the Betti numbers and
 * the chosen interval are seen, but not the huge circles along the hull.
 * @param {number} lastChange
 * @param {number} greatest the greatest filtration value
 * @param {number} chosen
 */
export function shownUpTo(lastChange, greatest, chosen) {
  const wanted = Math.max(1.2 * lastChange, 1.5 * chosen);
  if (wanted === 0) return greatest || 1;
  return greatest <= 2 * wanted ? Math.max(1.05 * greatest, chosen) : wanted;
}
