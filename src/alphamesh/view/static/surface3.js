// Which triangles and edges are seen at a radius, as arrays for the GPU.

/**
 * @typedef {import("./space.js").SpaceComplex} SpaceComplex
 * @typedef {import("./filtered.js").Facts} Facts
 */

/** Picks simplices into arrays that are used again and again. */
export class SurfacePicker {
  /** @param {SpaceComplex | import("./patch.js").Patch} complex what is drawn */
  constructor(complex) {
    this.complex = complex;
    /** Triangles: those of the boundary, then the singular ones. */
    this.triangles = new Uint32Array(0);
    this.boundary = 0;
    this.singular = 0;
    this.lone = 0;
    this.corners = new Float32Array(0);
    this.ends = new Float32Array(0);
  }

  /**
   * Pick what is there at a radius.
   *
   * A triangle is on the boundary from the rank of its first tetrahedron up to, not
   * including, that of its second one.
   * @param {Facts} facts
   */
  pick({ present: [, , triangles, tetrahedra], shown }) {
    const { cofaces, covered } = this.complex;
    const [boundary, singular, lone] = [[], [], []].map((some) => /** @type {number[]} */ (some));
    for (let f = 0; f < shown[2]; f++) {
      if (cofaces.first[f] >= tetrahedra) singular.push(f);
      else if (cofaces.last[f] >= tetrahedra) boundary.push(f);
    }
    for (let e = 0; e < shown[1]; e++) if (covered[e] >= triangles) lone.push(e);
    this.boundary = boundary.length;
    this.singular = singular.length;
    this.lone = lone.length;
    this.triangles = Uint32Array.from(boundary.concat(singular));
    this.corners = this._places(this.triangles, this.complex.triangles, 3);
    this.ends = this._places(Uint32Array.from(lone), this.complex.edges, 2);
  }

  /**
   * @param {Uint32Array} chosen
   * @param {Uint32Array} simplices
   * @param {number} size
   */
  _places(chosen, simplices, size) {
    const p = this.complex.positions;
    const out = new Float32Array(3 * size * chosen.length);
    let at = 0;
    for (const index of chosen) {
      for (let k = 0; k < size; k++) {
        const v = 3 * simplices[size * index + k];
        out[at++] = p[v];
        out[at++] = p[v + 1];
        out[at++] = p[v + 2];
      }
    }
    return out;
  }

  /**
   * Return the triangle that a ray hits first.
   * @param {number[]} from
   * @param {number[]} way
   * @param {(place: number[]) => boolean} kept what is not, is not there
   * @param {{boundary: boolean, singular: boolean}} shown
   * @returns {number} -1 if there is none
   */
  hit(from, way, kept, shown) {
    let [best, nearest] = [-1, Infinity];
    const first = shown.boundary ? 0 : this.boundary;
    const end = this.boundary + (shown.singular ? this.singular : 0);
    for (let i = first; i < end; i++) {
      const t = crossing(this.corners, 9 * i, from, way);
      if (t >= nearest || t <= 0) continue;
      if (!kept(from.map((x, k) => x + t * way[k]))) continue;
      [best, nearest] = [this.triangles[i], t];
    }
    return best;
  }
}

/**
 * Return how far along a ray it meets a triangle; infinity if it does not.
 *
 * T. Möller and B. Trumbore, Fast, minimum storage ray-triangle intersection, Journal of
 * Graphics Tools 2 (1997) 21-28.
 * @param {Float32Array} c nine coordinates from `at` on
 * @param {number} at
 * @param {number[]} from
 * @param {number[]} way
 */
export function crossing(c, at, from, way) {
  const [ax, ay, az] = [c[at], c[at + 1], c[at + 2]];
  const [ux, uy, uz] = [c[at + 3] - ax, c[at + 4] - ay, c[at + 5] - az];
  const [vx, vy, vz] = [c[at + 6] - ax, c[at + 7] - ay, c[at + 8] - az];
  const [px, py, pz] = [
    way[1] * vz - way[2] * vy,
    way[2] * vx - way[0] * vz,
    way[0] * vy - way[1] * vx,
  ];
  const size = ux * px + uy * py + uz * pz;
  if (size === 0) return Infinity;
  const [tx, ty, tz] = [from[0] - ax, from[1] - ay, from[2] - az];
  const u = (tx * px + ty * py + tz * pz) / size;
  if (u < 0 || u > 1) return Infinity;
  const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
  const v = (way[0] * qx + way[1] * qy + way[2] * qz) / size;
  if (v < 0 || u + v > 1) return Infinity;
  return (vx * qx + vy * qy + vz * qz) / size;
}
