// Numbers as people read them.

/**
 * Return a number with four digits that count.
 * @param {number} value
 * @param {number} [digits]
 */
export function number(value, digits = 4) {
  if (value === Infinity) return "∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${trimmed(mantissa)}e${Number(exponent)}`;
  }
  if (size >= 10 ** digits) return count(value);
  return trimmed(value.toPrecision(digits));
}

/** @param {string} text */
function trimmed(text) {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/**
 * Return a whole number with thousands set apart.
 * @param {number} value
 */
export function count(value) {
  return Math.round(value).toLocaleString("en-US");
}

/**
 * Return "1 hole", "2 holes".
 * @param {number} value
 * @param {string} what
 * @param {string} [many]
 */
export function counted(value, what, many = `${what}s`) {
  return `${count(value)} ${value === 1 ? what : many}`;
}

/**
 * Read a radius as people write it: a number of at least 0, or infinity.
 * @param {string} text
 * @returns {number | null}
 */
export function readRadius(text) {
  const word = text.trim().toLowerCase();
  if (["inf", "infinity", "∞"].includes(word)) return Infinity;
  const value = word === "" ? NaN : Number(word.replace(",", "."));
  return value >= 0 ? value : null;
}

/**
 * Return round numbers from 0 to `end`, about `wanted` of them.
 * @param {number} end
 * @param {number} wanted
 * @returns {number[]}
 */
export function ticks(end, wanted) {
  if (!(end > 0) || !Number.isFinite(end)) return [0];
  const rough = end / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough) ?? rough;
  const found = [];
  for (let k = 0; k * step <= end * (1 + 1e-9); k++) found.push(k * step);
  return found;
}
