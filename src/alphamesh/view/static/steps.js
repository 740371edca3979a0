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
    this.essential = diagram.essential;
  }

  /**
   * Return how many classes are alive at a radius.
   * @param {number} radius
   */
  at(radius) {
    const born = countUpTo(this.births, radius);
    return this.essential + born - countUpTo(this.deaths, radius);
  }
}

/**
 * Return every radius at which some class comes or goes, ascending, without repeats.
 * @param {BettiCurve[]} curves
 * @returns {Float64Array}
 */
export function changesOf(curves) {
  const size = curves.reduce((n, c) => n + c.births.length + c.deaths.length, 0);
  const all = new Float64Array(size);
  let at = 0;
  for (const curve of curves) {
    all.set(curve.births, at);
    all.set(curve.deaths, at + curve.births.length);
    at += curve.births.length + curve.deaths.length;
  }
  all.sort();
  let kept = 0;
  for (let i = 0; i < all.length; i++) {
    if (all[i] > 0 && (kept === 0 || all[i] > all[kept - 1])) all[kept++] = all[i];
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
