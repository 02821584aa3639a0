// Where a page draws the mechanism: as SVG, or in space where its points have three coordinates and the browser offers WebGL. Either has
// show(values, rates), clear(), redraw() for another theme, and setModel(model, configurations). For a pointer that drags a point it has
// `grip`, how near in pixels that has to be, `typicalLength` of the mechanism, onScreen(points) and under(place, pixels).
import {drawMechanism, drawingWindow, flatView, flatWidth} from "./mechanism.js";
import {offersSpace} from "./orbit.js";
import {SpatialMechanism} from "./spatial.js";

class FlatMechanism {
  constructor(svg, model, configurations, unit) {
    Object.assign(this, {svg, model, unit, window: drawingWindow(model, configurations)});
  }
  show(values, rates) {
    drawMechanism(this.svg, this.model, values, rates, this.window, {unit: this.unit});
  }
  get grip() {
    return 0.15 * this.svg.getBoundingClientRect().width;
  }
  get typicalLength() {
    const [x0, y0, x1, y1] = this.window;
    return Math.max(x1 - x0, y1 - y0) / 4;
  }
  get perUnit() {
    return flatWidth / (this.window[2] - this.window[0]);
  }
  // Where points of the drawing are, in pixels of the browser's window.
  onScreen(points) {
    const [x0, , , y1] = this.window,
      turn = this.svg.getScreenCTM();
    return points.map(({position: [x, y]}) => {
      const at = new DOMPoint((x - x0) * this.perUnit, (y1 - y) * this.perUnit).matrixTransform(turn);
      return [at.x, at.y];
    });
  }
  // What brings a point of the drawing to such pixels: how far it has to be along two directions.
  under(place, [x, y]) {
    const at = new DOMPoint(x, y).matrixTransform(this.svg.getScreenCTM().inverse());
    const goals = [this.window[0] + at.x / this.perUnit, this.window[3] - at.y / this.perUnit];
    return {directions: flatView(place.length), goals};
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
