// Numbers as people read them.

/**
 * Return a number with four digits that count.
 * @param {number} value
 * @param {number} [digits]
 * @returns {string}
 */
export function number(value, digits = 4) {
  if (value === Infinity) return "∞";
  if (value === 0) return "0";
  if (value < 0) return `−${number(-value, digits)}`;
  const size = value;
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
 * Read a radius as people write it: a number, or infinity.
 * @param {string} text
 * @param {boolean} [signed] whether it may be negative, as with weights
 * @returns {number | null}
 */
export function readRadius(text, signed = false) {
  const word = text.trim().toLowerCase().replace("−", "-");
  if (["inf", "infinity", "∞"].includes(word)) return Infinity;
  const value = word === "" ? NaN : Number(word.replace(",", "."));
  return value >= 0 || (signed && value < 0) ? value : null;
}

/**
 * Return round numbers from `start` to `end`, about `wanted` of them.
 * @param {number} end
 * @param {number} wanted
 * @param {number} [start]
 * @returns {number[]}
 */
export function ticks(end, wanted, start = 0) {
  if (!(end > start) || !Number.isFinite(end - start)) return [start];
  const rough = (end - start) / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough) ?? rough;
  const found = [];
  const slack = 1e-9 * rough;
  for (let k = Math.ceil((start - slack) / step) || 0; k * step <= end + slack; k++) found.push(k * step);
  return found;
}
