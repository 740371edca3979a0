// The persistence diagram and the Betti curves: what comes and goes, and where we are.

import { element, fitCanvas } from "./dom.js";
import { number } from "./text.js";

/**
 * @typedef {import("./complex.js").Diagram} Diagram
 * @typedef {import("./steps.js").BettiCurve} BettiCurve
 * @typedef {import("./scale.js").Scale} Scale
 * @typedef {{width: number, height: number, ratio: number}} Size
 * @typedef {{left: number, top: number, right: number, bottom: number}} Frame
 */

export const CLASS_NAMES = ["components", "loops", "voids"];
const MARGIN = { left: 48, right: 10, top: 8, bottom: 22 };
const FONT = "11px system-ui, sans-serif";

/** A chart with the radius from left to right, on which the radius can be dragged. */
class RadiusChart {
  /**
   * @param {string} label for those who do not see it
   * @param {any} options
   */
  constructor(label, { scale, choice, onradius }) {
    /** @type {Scale} */
    this.scale = scale;
    this.limit = scale.limit;
    this.choice = choice;
    this.canvas = element("canvas", { role: "img", "aria-label": label });
    /** @type {HTMLCanvasElement} */
    this.still = document.createElement("canvas");
    this.drawnFor = "";
    /** @param {PointerEvent} event */
    const drag = (event) => {
      const box = this.canvas.getBoundingClientRect();
      const room = box.width - MARGIN.left - MARGIN.right;
      const share = (event.clientX - box.left - MARGIN.left) / room;
      onradius(scale.radius(share));
    };
    this.canvas.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      this.canvas.setPointerCapture(event.pointerId);
      drag(event);
    });
    this.canvas.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      if (event.buttons & 1) drag(event);
    });
  }

  /**
   * @param {number} radius
   * @param {number[]} betti
   * @param {any} palette
   * @param {string} theme
   */
  draw(radius, betti, palette, theme) {
    const size = fitCanvas(this.canvas);
    const key = [size.width, size.height, size.ratio, theme].join();
    if (key !== this.drawnFor) {
      this.still.width = this.canvas.width;
      this.still.height = this.canvas.height;
      const c = context(this.still, size.ratio);
      c.clearRect(0, 0, size.width, size.height);
      this.drawStill(c, frameOf(size), palette);
      this.drawnFor = key;
    }
    const c = context(this.canvas, size.ratio);
    c.clearRect(0, 0, size.width, size.height);
    c.drawImage(this.still, 0, 0, size.width, size.height);
    this.drawRadius(c, frameOf(size), Math.min(radius, this.limit), betti, palette);
  }

  /** @param {number} r @param {Frame} frame */
  x(r, frame) {
    return frame.left + this.scale.share(r) * (frame.right - frame.left);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {any} palette
   */
  drawAxis(c, frame, palette) {
    c.font = FONT;
    c.fillStyle = palette.quiet;
    c.strokeStyle = palette.line;
    c.lineWidth = 1;
    c.textAlign = "center";
    c.textBaseline = "top";
    for (const r of this.scale.ticks(4)) {
      const x = Math.round(this.x(r, frame)) + 0.5;
      line(c, x, frame.bottom, x, frame.bottom + 4);
      if (x < frame.right - 8) c.fillText(number(r, 3), x, frame.bottom + 6);
    }
    line(c, frame.left, frame.bottom + 0.5, frame.right, frame.bottom + 0.5);
  }

  /**
   * Shade the chosen interval.
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {any} palette
   * @param {number} top
   */
  drawChosen(c, frame, palette, top) {
    if (!this.choice) return;
    const [low, high] = [this.choice.low, this.choice.high ?? Infinity];
    const from = this.x(Math.min(low, this.limit), frame);
    const to = this.x(Math.min(high, this.limit), frame);
    c.fillStyle = palette.chosen;
    c.fillRect(from, top, Math.max(1, to - from), frame.bottom - top);
  }

  /**
   * @param {CanvasRenderingContext2D} _c
   * @param {Frame} _frame
   * @param {any} _palette
   */
  drawStill(_c, _frame, _palette) {}

  /**
   * @param {CanvasRenderingContext2D} _c
   * @param {Frame} _frame
   * @param {number} _r
   * @param {number[]} _betti
   * @param {any} _palette
   */
  drawRadius(_c, _frame, _r, _betti, _palette) {}
}

/** Births and deaths; what is alive at the radius is up and left of its corner. */
export class DiagramChart extends RadiusChart {
  /**
   * @param {Diagram[]} diagrams
   * @param {any} options
   */
  constructor(diagrams, options) {
    super("Persistence diagram: birth and death of each component and hole", options);
    this.diagrams = diagrams;
  }

  /** @param {number} r @param {Frame} frame */
  y(r, frame) {
    // Room above for classes that never die, or die beyond the chart.
    const top = frame.top + 14;
    return frame.bottom - this.scale.share(r) * (frame.bottom - top);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {any} palette
   */
  drawStill(c, frame, palette) {
    this.drawChosen(c, frame, palette, frame.bottom - 5);
    this.drawAxis(c, frame, palette);
    c.textAlign = "right";
    c.textBaseline = "middle";
    for (const r of this.scale.ticks(4)) {
      const y = this.y(r, frame);
      if (y > frame.top + 22) c.fillText(number(r, 3), frame.left - 6, y);
    }
    c.fillText("∞", frame.left - 6, frame.top + 4);
    line(c, frame.left + 0.5, frame.top, frame.left + 0.5, frame.bottom);
    line(c, frame.left, frame.bottom, this.x(this.limit, frame), this.y(this.limit, frame));
    c.setLineDash([2, 3]);
    line(c, frame.left, frame.top + 4.5, frame.right, frame.top + 4.5);
    c.setLineDash([]);
    c.textBaseline = "alphabetic";
    c.fillText("birth", frame.right, frame.bottom - 6);
    c.save();
    c.translate(10, (frame.top + frame.bottom) / 2);
    c.rotate(-Math.PI / 2);
    c.textAlign = "center";
    c.fillText("death", 0, 0);
    c.restore();
    this.diagrams.forEach((diagram, k) => this.drawClasses(c, frame, diagram, k, palette));
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {Diagram} diagram
   * @param {number} k
   * @param {any} palette
   */
  drawClasses(c, frame, diagram, k, palette) {
    const { births, deaths } = diagram;
    const small = births.length > 5000 ? 1 : births.length > 500 ? 1.5 : 2.2;
    c.fillStyle = palette[CLASS_NAMES[k]];
    const seen = new Set();
    /** @param {number} birth @param {number} death */
    const mark = (birth, death) => {
      if (birth > this.limit) return;
      const x = this.x(birth, frame);
      const y = death > this.limit ? frame.top + 4 : this.y(death, frame);
      // What falls on one spot is drawn once: most classes are short-lived.
      const spot = Math.round(2 * x) * 8192 + Math.round(2 * y);
      if (seen.has(spot)) return;
      seen.add(spot);
      c.beginPath();
      // What lives long is seen at once, however many live short.
      c.arc(x, y, this.y(birth, frame) - y > 20 ? 2.4 : small, 0, 7);
      c.fill();
    };
    for (let i = 0; i < births.length; i++) mark(births[i], deaths[i]);
    for (const birth of diagram.essential) mark(birth, Infinity);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {number} r
   * @param {number[]} _betti
   * @param {any} palette
   */
  drawRadius(c, frame, r, _betti, palette) {
    const [x, y] = [this.x(r, frame), this.y(r, frame)];
    c.fillStyle = palette.radius;
    c.globalAlpha = 0.09;
    c.fillRect(frame.left, frame.top, x - frame.left, y - frame.top);
    c.globalAlpha = 1;
    c.strokeStyle = palette.radius;
    c.lineWidth = 1.5;
    line(c, x, frame.top, x, frame.bottom);
    line(c, frame.left, y, x, y);
    handle(c, x, y);
  }
}

/** Betti numbers by radius, on a scale that shows both 1 and 10,000. */
export class BettiChart extends RadiusChart {
  /**
   * @param {BettiCurve[]} curves
   * @param {any} options
   */
  constructor(curves, options) {
    super("Betti curves: the number of components and holes by radius", options);
    this.curves = curves;
    this.most = 1;
    for (const curve of curves) {
      // Between two columns of pixels nothing higher could be seen.
      for (let i = 0; i <= 400; i++) {
        this.most = Math.max(this.most, curve.at(this.scale.radius(i / 400)));
      }
    }
  }

  /** @param {number} value @param {Frame} frame */
  y(value, frame) {
    const share = Math.log1p(Math.max(0, value)) / Math.log1p(this.most);
    return frame.bottom - 4 - share * (frame.bottom - 4 - frame.top);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {any} palette
   */
  drawStill(c, frame, palette) {
    this.drawChosen(c, frame, palette, frame.top);
    this.drawAxis(c, frame, palette);
    c.textAlign = "right";
    c.textBaseline = "middle";
    let last = Infinity;
    for (const value of [0, 1, 2, 5, 10, 100, 1000, 1e4, 1e5, 1e6]) {
      const y = this.y(value, frame);
      if (value > this.most || last - y < 13) continue;
      last = y;
      c.fillText(value.toLocaleString("en-US"), frame.left - 6, y);
      c.strokeStyle = palette.line;
      c.globalAlpha = 0.6;
      line(c, frame.left, y, frame.right, y);
      c.globalAlpha = 1;
    }
    c.textBaseline = "alphabetic";
    c.lineWidth = 1.6;
    this.curves.forEach((curve, k) => {
      c.strokeStyle = palette[CLASS_NAMES[k]];
      c.beginPath();
      for (let x = frame.left; x <= frame.right; x += 0.5) {
        const r = this.scale.radius((x - frame.left) / (frame.right - frame.left));
        c.lineTo(x, this.y(curve.at(r), frame));
      }
      c.stroke();
    });
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Frame} frame
   * @param {number} r
   * @param {number[]} betti
   * @param {any} palette
   */
  drawRadius(c, frame, r, betti, palette) {
    const x = this.x(r, frame);
    c.strokeStyle = palette.radius;
    c.lineWidth = 1.5;
    line(c, x, frame.top, x, frame.bottom);
    betti.forEach((value, k) => {
      c.fillStyle = palette[CLASS_NAMES[k]];
      c.beginPath();
      c.arc(x, this.y(value, frame), 3.5, 0, 7);
      c.fill();
    });
    c.fillStyle = palette.radius;
    handle(c, x, frame.bottom);
  }
}

/** @param {Size} size @returns {Frame} */
function frameOf({ width, height }) {
  return {
    left: MARGIN.left,
    top: MARGIN.top,
    right: width - MARGIN.right,
    bottom: height - MARGIN.bottom,
  };
}

/** @param {HTMLCanvasElement} canvas @param {number} ratio */
function context(canvas, ratio) {
  const c = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  return c;
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {number} x0
 * @param {number} y0
 * @param {number} x1
 * @param {number} y1
 */
function line(c, x0, y0, x1, y1) {
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  c.stroke();
}

/** @param {CanvasRenderingContext2D} c @param {number} x @param {number} y */
function handle(c, x, y) {
  c.beginPath();
  c.arc(x, y, 4.5, 0, 7);
  c.fill();
}
