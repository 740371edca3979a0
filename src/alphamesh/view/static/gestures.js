// Mouse, touch and wheel on a picture.

/**
 * @typedef {object} Gestures
 * @property {(dx: number, dy: number, event: PointerEvent) => void} drag
 * @property {(factor: number, x: number, y: number) => void} zoom
 * @property {(x: number, y: number) => void} hover
 * @property {() => void} leave
 */

/**
 * Listen on an element; places are pixels from its upper left corner.
 * @param {HTMLElement} target
 * @param {Gestures} handlers
 */
export function listen(target, { drag, zoom, hover, leave }) {
  /** @type {Map<number, {x: number, y: number}>} */
  const down = new Map();
  /** @param {PointerEvent | WheelEvent} event */
  const place = (event) => {
    const box = target.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  target.addEventListener("pointerdown", (event) => {
    target.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
    leave();
  });
  target.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = down.get(event.pointerId);
    if (!before) {
      hover(now.x, now.y);
      return;
    }
    const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const [was, is] = [before, now].map((p) => Math.hypot(p.x - other.x, p.y - other.y));
      if (was > 0) zoom(is / was, (now.x + other.x) / 2, (now.y + other.y) / 2);
    } else drag(now.x - before.x, now.y - before.y, event);
    down.set(event.pointerId, now);
  });
  for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
    target.addEventListener(name, (event) => down.delete(event.pointerId));
  }
  target.addEventListener("pointerleave", leave);
  target.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { x, y } = place(event);
      const lines = event.deltaMode === 1 ? 16 : 1;
      zoom(Math.exp(-0.0015 * event.deltaY * lines), x, y);
    },
    { passive: false },
  );
}
