// The state of the page in its address, so that a view can be shared.

/**
 * @typedef {object} Saved
 * @property {number} [radius]
 * @property {string} [layers] one letter each
 * @property {number[]} [view]
 * @property {string} [theme]
 */

/**
 * @param {Saved} saved
 * @returns {string} without the #
 */
export function writeHash({ radius, layers, view, theme }) {
  const parts = [];
  if (radius !== undefined) parts.push(`r=${radius}`);
  if (layers !== undefined) parts.push(`show=${layers}`);
  if (view?.length) parts.push(`view=${view.map((x) => Number(x.toPrecision(6))).join(",")}`);
  if (theme && theme !== "auto") parts.push(`theme=${theme}`);
  return parts.join("&");
}

/**
 * Read what {@link writeHash} wrote; what makes no sense is left out.
 * @param {string} hash with or without the #
 * @param {boolean} [signed] whether the radius may be negative
 * @returns {Saved}
 */
export function readHash(hash, signed = false) {
  /** @type {Saved} */
  const saved = {};
  for (const part of hash.replace(/^#/, "").split("&")) {
    const [name, value = ""] = part.split("=", 2);
    if (name === "r") {
      if (value !== "" && (Number(value) >= 0 || (signed && Number(value) < 0))) saved.radius = Number(value);
    }
    else if (name === "show" && /^[a-z]*$/.test(value)) saved.layers = value;
    else if (name === "theme" && ["light", "dark"].includes(value)) saved.theme = value;
    else if (name === "view") {
      const numbers = value.split(",").map(Number);
      if (numbers.every(Number.isFinite)) saved.view = numbers;
    }
  }
  return saved;
}
