// The radius that is proven about each piece of a path, over the way: steps, and where the mechanism is.
import {numberText} from "./values.js";

const size = {width: 340, height: 96, left: 44, right: 6, top: 12, bottom: 8};

export class RadiusPlot {
  // `onSeek(t)` is told where the user points.
  constructor(svg, curve, onSeek) {
    Object.assign(this, {svg, curve});
    this.radii = curve.pieces.map(({radius}) => radius);
    this.most = Math.max(...this.radii, 1e-300);
    svg.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
    this.draw();
    const seek = (event) => {
      const box = svg.getBoundingClientRect();
      const x = ((event.clientX - box.left) * size.width) / box.width;
      onSeek(((x - size.left) / this.inner) * curve.length);
    };
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      seek(event);
    });
    svg.addEventListener("pointermove", (event) => event.buttons > 0 && seek(event));
  }

  get inner() {
    return size.width - size.left - size.right;
  }
  toX(t) {
    return size.left + (this.inner * t) / this.curve.length;
  }
  toY(radius) {
    return size.height - size.bottom - ((size.height - size.top - size.bottom) * radius) / this.most;
  }

  add(name, attributes, text) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text !== undefined) element.textContent = text;
    this.svg.append(element);
    return element;
  }

  draw() {
    const {starts} = this.curve,
      least = Math.min(...this.radii),
      floor = this.toY(0),
      right = size.width - size.right;
    const steps = this.radii.map(
      (r, k) => `${this.toX(starts[k])} ${this.toY(r)} L${this.toX(starts[k + 1])} ${this.toY(r)}`,
    );
    this.add("path", {class: "area", d: `M${size.left} ${floor} L${steps.join(" L")} L${right} ${floor} Z`});
    this.add("path", {class: "step", d: `M${steps.join(" L")}`});
    this.add("path", {class: "axis", d: `M${size.left} ${floor} H${right}`});
    this.add("text", {x: size.left - 6, y: floor + 4, "text-anchor": "end"}, "0");
    this.add("text", {x: size.left - 6, y: this.toY(this.most) + 4, "text-anchor": "end"}, numberText(this.most, 2));
    if (this.toY(least) - this.toY(this.most) > 14) {
      this.add("path", {class: "least", d: `M${size.left} ${this.toY(least)} H${right}`});
      if (floor - this.toY(least) > 12)
        this.add("text", {x: size.left - 6, y: this.toY(least) + 4, "text-anchor": "end"}, numberText(least, 2));
    }
    this.place = this.add("path", {class: "place"});
    this.show(0);
  }

  show(t) {
    this.place.setAttribute("d", `M${this.toX(t)} ${size.top - 8} V${this.toY(0)}`);
  }
}
