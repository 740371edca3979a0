// The little of WebGL 2 that is needed, with errors that say where.

/**
 * @typedef {WebGL2RenderingContext} GL
 * @typedef {{program: WebGLProgram, at: Record<string, WebGLUniformLocation | null>}} Program
 */

/**
 * @param {GL} gl
 * @param {string} vertex
 * @param {string} fragment
 * @returns {Program}
 */
export function compile(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of /** @type {[number, string][]} */ ([
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ])) {
    const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${source}`);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(gl.getShaderInfoLog(shader) ?? "a shader does not compile");
    }
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(gl.getProgramInfoLog(program) ?? "a program does not link");
  }
  /** @type {Program["at"]} */
  const at = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let i = 0; i < count; i++) {
    const name = gl.getActiveUniform(program, i)?.name.replace("[0]", "") ?? "";
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

/**
 * @param {GL} gl
 * @param {number} target
 * @param {ArrayBufferView} data
 */
export function bufferOf(gl, target, data) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return buffer;
}

/**
 * @typedef {object} Attribute
 * @property {number} place
 * @property {number} size
 * @property {boolean} [whole] unsigned whole numbers, not floats
 * @property {number} offset
 */

/**
 * Return a vertex array of interleaved attributes, one record for each vertex.
 * @param {GL} gl
 * @param {ArrayBufferView} data
 * @param {number} stride bytes of a record
 * @param {Attribute[]} attributes
 */
export function vertexArray(gl, data, stride, attributes) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  bufferOf(gl, gl.ARRAY_BUFFER, data);
  for (const { place, size, whole, offset } of attributes) {
    gl.enableVertexAttribArray(place);
    if (whole) gl.vertexAttribIPointer(place, size, gl.UNSIGNED_INT, stride, offset);
    else gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
  }
  gl.bindVertexArray(null);
  return array;
}

/** The widest row of a texture that every WebGL 2 takes. */
export const ROW = 2048;

/**
 * Return numbers as a texture that shaders read place by place, four of them in each.
 * @param {GL} gl
 * @param {Float32Array} numbers
 * @param {number} [wide] places in a row
 */
export function tableOf(gl, numbers, wide = ROW) {
  const rows = Math.max(1, Math.ceil(numbers.length / 4 / wide));
  const padded = new Float32Array(4 * wide * rows);
  padded.set(numbers);
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, wide, rows, 0, gl.RGBA, gl.FLOAT, padded);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

/**
 * Return whether pictures are drawn by the processor, where smooth edges cost too much.
 * @returns {boolean}
 */
export function isSoftware() {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  if (!gl) return false;
  const known = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(known ? known.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
