// The same view in a notebook; the radius is shared with Python.

import { View } from "./app.js";
import { inflate, unpack } from "./data.js";

/**
 * @param {{model: any, el: HTMLElement}} context
 */
export async function render({ model, el }) {
  const packed = model.get("data");
  const copy = new Uint8Array(packed.buffer, packed.byteOffset, packed.byteLength).slice();
  const payload = unpack(await inflate(copy));
  const root = document.createElement("div");
  root.style.height = model.get("height");
  el.append(root);
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let later;
  payload.meta.radius = model.get("radius");
  const view = new View(root, payload, {
    onradius: (radius) => {
      if (radius === model.get("radius")) return;
      model.set("radius", radius);
      // Some times a second, also while it plays.
      later ??= setTimeout(() => {
        later = undefined;
        model.save_changes();
      }, 60);
    },
  });
  const follow = () => {
    const radius = model.get("radius");
    if (radius !== view.radius) view.setRadius(radius, true);
  };
  model.on("change:radius", follow);
  return () => {
    model.off("change:radius", follow);
    view.destroy();
  };
}
