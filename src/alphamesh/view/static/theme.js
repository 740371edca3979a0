// Colours by what is drawn, told apart by everybody, in light and in dark.

/**
 * @typedef {Record<string, string> & {cells: string[]}} Palette
 */

/** @type {{light: any, dark: any}} */
export const PALETTES = {
  light: {
    background: "#ffffff",
    text: "#22262b",
    quiet: "#5b6472",
    line: "#d4d9e0",
    union: "#f8e7c3",
    arcs: "#8a5a14",
    circles: "#dcb974",
    ridges: "#ffffff",
    triangles: "#c6e0f3",
    interior: "#86b6da",
    boundary: "#0b4f8a",
    singular: "#d55e00",
    points: "#374151",
    isolated: "#b0127b",
    components: "#0b4f8a",
    loops: "#d55e00",
    voids: "#00785a",
    radius: "#b0127b",
    chosen: "#f3d9ea",
    surface: "#9cc8ea",
    sheet: "#f0a060",
    inside: "#c9ced6",
    cells: ["#dfc690", "#99c6f4", "#b4e6c1", "#e9ae9d", "#dbc7e3", "#e1eeb6", "#bcc9c4"],
  },
  dark: {
    background: "#14181f",
    text: "#e6e9ee",
    quiet: "#a3adbb",
    line: "#3a424e",
    union: "#43371f",
    arcs: "#e0b268",
    circles: "#6e5730",
    ridges: "#14181f",
    triangles: "#1d4b70",
    interior: "#3f78a8",
    boundary: "#8ec9f5",
    singular: "#ffa35c",
    points: "#cdd5df",
    isolated: "#f57fc8",
    components: "#7cc0f3",
    loops: "#ffa35c",
    voids: "#4fd0a7",
    radius: "#f57fc8",
    chosen: "#47283c",
    surface: "#4d8fc4",
    sheet: "#d58a4c",
    inside: "#566070",
    cells: ["#6d5a2c", "#2c5478", "#2f6443", "#74463a", "#5d4a68", "#5b662f", "#46555a"],
  },
};

/**
 * Return a colour as three numbers from 0 to 1.
 * @param {string} hex such as #ff8000
 * @returns {[number, number, number]}
 */
export function rgb(hex) {
  const number = parseInt(hex.slice(1), 16);
  return [(number >> 16) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}
