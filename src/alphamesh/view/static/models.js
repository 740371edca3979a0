// From a payload to the complex that it holds, and to the picture of a complex.

import { Picture2 } from "./picture2.js";
import { Picture3 } from "./picture3.js";
import { PlaneComplex } from "./plane.js";
import { SpaceComplex } from "./space.js";

/**
 * @param {import("./data.js").Payload} payload
 * @returns {any} a complex in the plane or in space
 */
export function complexOf(payload) {
  return payload.meta.ambient === 3 ? new SpaceComplex(payload) : new PlaneComplex(payload);
}

/**
 * @param {any} complex
 * @param {number} limit the largest radius of the slider
 * @returns {any} a picture in the plane or in space
 */
export function pictureOf(complex, limit) {
  return complex.ambient === 3 ? new Picture3(complex, limit) : new Picture2(complex, limit);
}
