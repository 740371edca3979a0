// The page: its data, its address, and the view.

import { View } from "./app.js";
import { bytesOfBase64, inflate, unpack } from "./data.js";
import { readHash, writeHash } from "./hash.js";

/**
 * Show the data that stand in the page.
 * @param {HTMLElement} root
 */
async function show(root) {
  const data = /** @type {HTMLElement} */ (document.getElementById("alphamesh-data"));
  const payload = unpack(await inflate(bytesOfBase64(data.textContent ?? "")));
  data.remove();
  const view = new View(root, payload, {
    keys: document,
    saved: readHash(location.hash, payload.meta.signed),
    onchange: (saved) => history.replaceState(null, "", `#${writeHash(saved)}`),
  });
  root.removeAttribute("aria-busy");
  Object.assign(window, { alphamesh: view });
}

/** Begin, or say why not. */
export function main() {
  const root = /** @type {HTMLElement} */ (document.getElementById("alphamesh-view"));
  show(root).catch((error) => {
    root.textContent = `This page could not be shown: ${error.message}`;
    root.setAttribute("role", "alert");
    throw error;
  });
}
