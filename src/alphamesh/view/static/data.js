// From the bytes that Python packed to typed arrays.

/**
 * @typedef {Float32Array | Float64Array | Uint32Array | Uint8Array} Numbers
 * @typedef {{name: string, type: "f32" | "u8" | "u32" | "rising" | "signed", length: number}} Block
 * @typedef {{meta: any, arrays: Record<string, Numbers>}} Payload
 */

/**
 * Return the bytes that a text in base64 stands for.
 * @param {string} text
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function bytesOfBase64(text) {
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/**
 * Inflate bytes in the zlib format.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 */
export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * Unpack a payload: the length of a header, the header as JSON, and its arrays.
 *
 * Bytes of equal weight stand together ("planes"), which compresses far better than
 * numbers one after the other.
 * @param {Uint8Array} bytes
 * @returns {Payload}
 */
export function unpack(bytes) {
  const size = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + size)));
  let at = 4 + size;
  /** @type {Record<string, Numbers>} */
  const arrays = {};
  for (const { name, type, length } of /** @type {Block[]} */ (header.arrays)) {
    const wide = { u8: 1, u32: 4, f32: 4, rising: 8, signed: 8 }[type];
    const planes = bytes.subarray(at, at + wide * length);
    at += wide * length;
    if (type === "u8") arrays[name] = planes.slice();
    else if (type === "u32") arrays[name] = words(planes, length, 0);
    else if (type === "f32") arrays[name] = new Float32Array(words(planes, length, 0).buffer);
    else arrays[name] = risingFloats(planes, length, type === "signed");
  }
  if (at !== bytes.length) throw new Error(`the data has ${bytes.length} bytes, not ${at}`);
  return { meta: header.meta, arrays };
}

/**
 * @param {Uint8Array} planes
 * @param {number} n
 * @param {number} first the first of four planes
 * @returns {Uint32Array<ArrayBuffer>}
 */
function words(planes, n, first) {
  const out = new Uint32Array(n);
  const [p, q, r, s] = [0, 1, 2, 3].map((k) => (first + k) * n);
  for (let i = 0; i < n; i++) {
    out[i] = planes[p + i] | (planes[q + i] << 8) | (planes[r + i] << 16) | (planes[s + i] << 24);
  }
  return out;
}

/**
 * Return ascending floats from the differences of their bit patterns: the bits of floats of
 * at least 0, read as whole numbers, ascend as the floats do. Those of floats of any sign do
 * so with the sign turned, and all the other bits of negative floats, too.
 * @param {Uint8Array} planes
 * @param {number} n
 * @param {boolean} signed
 * @returns {Float64Array}
 */
function risingFloats(planes, n, signed) {
  const low = words(planes, n, 0);
  const high = words(planes, n, 4);
  const bits = new Uint32Array(2 * n);
  let [lo, hi] = [0, 0];
  for (let i = 0; i < n; i++) {
    lo += low[i];
    hi += high[i];
    if (lo >= 4294967296) {
      lo -= 4294967296;
      hi += 1;
    }
    const turn = signed && hi < 2147483648 ? -1 : 0;
    bits[2 * i] = lo ^ turn;
    bits[2 * i + 1] = (signed ? hi ^ 0x80000000 : hi) ^ (turn & 0x7fffffff);
  }
  return new Float64Array(bits.buffer);
}
