// Where a page draws the mechanism: as SVG, or in space where its points have three coordinates and the browser offers WebGL. Either has
// show(values, rates), clear(), redraw() for another theme, and setModel(model, configurations).
import {drawMechanism, drawingWindow} from "./mechanism.js";
import {offersSpace} from "./orbit.js";
import {SpatialMechanism} from "./spatial.js";

class FlatMechanism {
  constructor(svg, model, configurations, unit) {
    Object.assign(this, {svg, model, unit, window: drawingWindow(model, configurations)});
  }
  show(values, rates) {
    drawMechanism(this.svg, this.model, values, rates, this.window, {unit: this.unit});
  }
  // The window stays where the drawing still fits well.
  setModel(model, configurations) {
    this.model = model;
    const [a, b, c, d] = drawingWindow(model, configurations),
      [x0, y0, x1, y1] = this.window,
      size = Math.max(c - a, d - b);
    const off = Math.max(x0 - a, y0 - b, c - x1, d - y1, (a - x0 + (x1 - c)) / 2, (b - y0 + (y1 - d)) / 2);
    if (!(off < 0.12 * size)) this.window = [a, b, c, d];
  }
  clear() {
    this.svg.replaceChildren();
  }
  redraw() {}
}

// `svg` is where to draw, the window holds the drawing at all `configurations`, `unit` scales the thickness of an SVG's parts.
export function mechanismPicture(svg, model, configurations, unit) {
  const inSpace = model.drawing.dimension === 3 && offersSpace();
  return inSpace ? new SpatialMechanism(svg, model, configurations) : new FlatMechanism(svg, model, configurations, unit);
}
