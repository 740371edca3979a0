// Where the picture is: a canvas for the GPU, one for what lies over it, and a label.

import { element, fitCanvas } from "./dom.js";
import { listen } from "./gestures.js";
import { isSoftware } from "./gl.js";

/** Holds a picture, and draws it when something has changed. */
export class Stage {
  /**
   * @param {any} picture
   * @param {{state: () => any, onmove: () => void, redraw: () => void}} app
   */
  constructor(picture, app) {
    this.picture = picture;
    this.app = app;
    /** @type {any} */
    this.hovered = null;
    this.canvas = element("canvas", { class: "picture", role: "img" });
    this.over = element("canvas", { class: "over", "aria-hidden": "true" });
    this.label = element("div", { class: "label", hidden: "" });
    this.element = element(
      "div",
      {
        class: "stage",
        tabindex: "0",
        role: "group",
        "aria-label": "Picture: arrow keys move it, plus and minus zoom",
      },
      this.canvas,
      this.over,
      this.label,
      this._buttons(),
    );
    const controls = picture.controls?.(() => app.onmove());
    if (controls) this.element.append(controls);
    this._begin();
    this._listen();
  }

  _buttons() {
    /** @type {[string, string, () => void][]} */
    const buttons = [
      ["+", "Zoom in", () => this.picture.zoom(1.4)],
      ["−", "Zoom out", () => this.picture.zoom(1 / 1.4)],
      ["fit", "See all (0)", () => this.picture.camera.reset()],
    ];
    const made = buttons.map(([text, label, act]) =>
      element(
        "button",
        {
          type: "button",
          "aria-label": label,
          title: label,
          click: () => {
            act();
            this.app.onmove();
          },
          pointerdown: (/** @type {Event} */ event) => event.stopPropagation(),
        },
        text,
      ),
    );
    return element("div", { class: "zoom" }, ...made);
  }

  _begin() {
    const antialias = this.picture.small || !isSoftware();
    const stencil = this.picture.complex.ambient === 3;
    const wanted = { antialias, alpha: false, stencil, powerPreference: "high-performance" };
    this.gl = this.canvas.getContext("webgl2", wanted);
    if (!this.gl) {
      this.element.append(
        element(
          "p",
          { class: "sorry", role: "alert" },
          "This browser cannot draw the picture: it has no WebGL 2. The charts work.",
        ),
      );
      return;
    }
    this.picture.begin(this.gl);
    this.canvas.addEventListener("webglcontextlost", (/** @type {Event} */ event) => {
      event.preventDefault();
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.picture.begin(this.gl);
      this.app.redraw();
    });
  }

  _listen() {
    listen(this.element, {
      drag: (dx, dy, event) => {
        this.picture.drag(dx, dy, event);
        this.app.onmove();
      },
      zoom: (factor, x, y) => {
        this.picture.zoom(factor, x, y);
        this.app.onmove();
      },
      hover: (x, y) => this.point(x, y),
      leave: () => this.unpoint(),
    });
  }

  /**
   * Show what is under a pixel.
   * @param {number} x
   * @param {number} y
   */
  point(x, y) {
    const found = this.picture.hover(x, y, this.app.state().facts, this.app.state().layers);
    this.hovered = found?.simplex ?? null;
    this.label.hidden = !found;
    if (found) {
      this.label.replaceChildren(
        ...found.lines.map((/** @type {string} */ text) => element("div", {}, text)),
      );
      const left = Math.min(x + 14, this.element.clientWidth - this.label.offsetWidth - 4);
      const up = y + 18 + this.label.offsetHeight > this.element.clientHeight;
      this.label.style.left = `${left}px`;
      this.label.style.top = `${up ? y - 12 - this.label.offsetHeight : y + 16}px`;
    }
    this.drawOver();
  }

  /** Tell those who do not see the picture what is on it. @param {string} sentence */
  describe(sentence) {
    this.canvas.setAttribute("aria-label", `The alpha complex at ${sentence}`);
  }

  unpoint() {
    this.hovered = null;
    this.label.hidden = true;
    this.drawOver();
  }

  draw() {
    const { width, height, ratio } = fitCanvas(this.canvas);
    this.picture.camera.resize(width, height);
    if (this.gl && !this.gl.isContextLost()) this.picture.draw({ ...this.app.state(), ratio });
    this.drawOver();
  }

  drawOver() {
    const { width, height, ratio } = fitCanvas(this.over);
    const c = /** @type {CanvasRenderingContext2D} */ (this.over.getContext("2d"));
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    this.picture.drawOver(c, { ...this.app.state(), hovered: this.hovered });
  }

  /**
   * Return the picture as a PNG.
   * @returns {Promise<Blob | null>}
   */
  png() {
    this.draw(); // the browser forgets a picture once it is shown
    const whole = document.createElement("canvas");
    whole.width = this.canvas.width;
    whole.height = this.canvas.height;
    const c = /** @type {CanvasRenderingContext2D} */ (whole.getContext("2d"));
    c.drawImage(this.canvas, 0, 0);
    c.drawImage(this.over, 0, 0);
    return new Promise((resolve) => whole.toBlob(resolve, "image/png"));
  }
}
