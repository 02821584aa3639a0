// Where a page draws the mechanism: as SVG, or in space where its points have three coordinates and the browser offers WebGL. Either has
// show(values, rates), clear() and redraw() for another theme.
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
