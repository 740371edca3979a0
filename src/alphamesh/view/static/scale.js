// From radii to places on the slider and on the charts.

import { ticks } from "./text.js";

/** The chosen radius is no nearer to the left end than that, if powers can do it. */
const COMFORT = 0.22;

/** A scale from 0 to 1: even, or by a root of the radius where the first ones matter most. */
export class Scale {
  /**
   * @param {number} limit
   * @param {number} [chosen] a radius around which most happens
   * @param {number} [low] the first radius; with weights it may be negative
   */
  constructor(limit, chosen = limit, low = 0) {
    this.limit = limit;
    this.low = low;
    const share = chosen > low ? Math.min(1, (chosen - low) / (limit - low)) : 1;
    const wanted = Math.log(share) / Math.log(COMFORT);
    this.power = Math.min(3, Math.max(1, Math.ceil(wanted - 0.2)));
  }

  /** @param {number} radius @returns {number} from 0 to 1 */
  share(radius) {
    const share = Math.min(1, Math.max(0, (radius - this.low) / (this.limit - this.low)));
    return this.power === 1 ? share : share ** (1 / this.power);
  }

  /** @param {number} share @returns {number} */
  radius(share) {
    const inside = Math.min(1, Math.max(0, share));
    if (inside === 1) return this.limit;
    return this.low + (this.limit - this.low) * (this.power === 1 ? inside : inside ** this.power);
  }

  /** Round radii that are not too close on the scale. @param {number} wanted */
  ticks(wanted) {
    if (this.power === 1 || this.low !== 0) return ticks(this.limit, wanted, this.low);
    const found = [0];
    for (let power = 10 ** Math.floor(Math.log10(this.limit)); found.length < wanted + 1; power /= 10) {
      for (const digit of [5, 2, 1]) {
        const radius = digit * power;
        const clear = found.every((r) => Math.abs(this.share(r) - this.share(radius)) > 0.6 / wanted);
        if (radius <= this.limit && clear) found.push(radius);
      }
      if (this.share(power) < 0.6 / wanted) break;
    }
    return found.sort((a, b) => a - b);
  }
}
