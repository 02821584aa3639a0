// A portrait: C-space and the loci projected onto two coordinates, on a canvas with axes, a cursor and the place of what is shown.
import {coverage, paintCoverage} from "./density.js";
import {Projection, groupTouching} from "./projection.js";
import {coordinateValue, fullTurn, groupedText, htmlLabel, isAngle, numberText, plainLabel, unitOf, withMinus} from "./values.js";

const reach = 9;  // pixels within which a curve or a point is taken to be meant
const undecidedVerdicts = ["undecided", "pending"];

// Decoration of the plane: distances at which marks stand, and their texts.
function ticks(low, high, angle, most) {
  const marks = [];
  if (angle && high - low > 3) {
    const names = {"-2": "−π", "-1": "−π/2", 0: "0", 1: "π/2", 2: "π"};
    for (const [k, text] of Object.entries(names)) marks.push({at: (k * Math.PI) / 2, text});
    return marks.filter(({at}) => at >= low - 1e-9 && at <= high + 1e-9);
  }
  const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough * 0.999);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    marks.push({at: k * step, text: withMinus((k * step).toFixed(digits))});
  }
  return marks;
}

export class Portrait {
  // `listener` has hover(candidates, place), pin(candidates, place), leave(), step(direction), escape().
  constructor(model, root, axes, listener) {
    this.model = model;
    this.root = root;
    this.listener = listener;
    this.frame = root.querySelector(".frame");
    this.base = root.querySelector("canvas.base");
    this.overlay = root.querySelector("canvas.overlay");
    this.selects = [...root.querySelectorAll("select")];
    this.hidden = new Set();
    this.cursor = null;  // in the units of the axes
    this.shown = null;   // the variables of what is shown, with its set
    this.fillSelects(axes);
    this.setAxes(axes);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.frame);
  }

  fillSelects(axes) {
    this.selects.forEach((select, k) => {
      this.model.coordinates.forEach((coordinate, i) => select.add(new Option(plainLabel(coordinate), i, false, i === axes[k])));
      select.addEventListener("change", () => this.setAxes(this.selects.map((s) => Number(s.value))));
    });
  }

  setAxes(axes) {
    this.axes = axes.map((i) => this.model.coordinates[i]);
    this.projections = this.model.sets.map((set) => new Projection(set, ...this.axes));
    this.limits = [0, 1].map((k) => this.range(k));
    this.cursor = null;
    if (this.width) this.draw();
  }

  // Of an angle the whole turn, unless the boxes are far from it; of a length what the boxes need.
  range(k) {
    let low = Infinity, high = -Infinity;
    for (const projection of this.projections) {
      const [a, b] = projection.hull(k);
      low = Math.min(low, a);
      high = Math.max(high, b);
    }
    if (!(low < high)) [low, high] = low === high ? [low - 1, high + 1] : [-1, 1];
    if (isAngle(this.axes[k]) && high - low > 0.6 * fullTurn) return [-Math.PI, Math.PI];
    const margin = 0.05 * (high - low);
    return [low - margin, high + margin];
  }

  resize() {
    const width = this.frame.clientWidth;
    if (!width || (width === this.width && this.ratio === devicePixelRatio)) return;
    this.width = width;
    this.draw();
  }

  layout() {
    const pad = {left: 56, right: 12, top: 12, bottom: 40};
    const [[x0, x1], [y0, y1]] = this.limits;
    const inner = this.width - pad.left - pad.right;
    const alike = isAngle(this.axes[0]) === isAngle(this.axes[1]);
    const wanted = alike ? (inner * (y1 - y0)) / (x1 - x0) : inner;
    const height = Math.min(Math.max(wanted, 0.55 * inner), 1.2 * inner);
    let sx = inner / (x1 - x0), sy = height / (y1 - y0);
    if (alike) sx = sy = Math.min(sx, sy);
    // The plane is centred in the frame and goes on where there is room.
    const extraX = (inner / sx - (x1 - x0)) / 2, extraY = (height / sy - (y1 - y0)) / 2;
    this.plane = {x0: x0 - extraX, x1: x1 + extraX, y0: y0 - extraY, y1: y1 + extraY, sx, sy, pad, inner, height};
    this.frame.style.height = `${height + pad.top + pad.bottom}px`;
    this.ratio = devicePixelRatio || 1;
    for (const canvas of [this.base, this.overlay]) {
      canvas.width = Math.round(this.width * this.ratio);
      canvas.height = Math.round((height + pad.top + pad.bottom) * this.ratio);
    }
    for (const projection of this.projections) projection.index([this.plane.x0, this.plane.y0, this.plane.x1, this.plane.y1]);
  }

  toX(x) {
    return this.plane.pad.left + (x - this.plane.x0) * this.plane.sx;
  }
  toY(y) {
    return this.plane.pad.top + (this.plane.y1 - y) * this.plane.sy;
  }
  fromPixels(px, py) {
    return [this.plane.x0 + (px - this.plane.pad.left) / this.plane.sx, this.plane.y1 - (py - this.plane.pad.top) / this.plane.sy];
  }

  draw() {
    this.layout();
    const style = getComputedStyle(this.root), colour = (name) => style.getPropertyValue(name).trim();
    this.colours = {ink: colour("--ink"), faint: colour("--line"), quiet: colour("--quiet"), forward: colour("--forward"),
                    inverse: colour("--inverse"), "cspace-singular": colour("--crossing"), undecided: colour("--undecided"),
                    paper: colour("--plot"), cspace: colour("--cspace").split(",").map(Number)};
    const context = this.base.getContext("2d");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.base.height);
    this.drawGrid(context);
    context.save();
    context.beginPath();
    context.rect(this.plane.pad.left, this.plane.pad.top, this.plane.inner, this.plane.height);
    context.clip();
    for (const name of ["cspace", "inverse", "forward", "cspace-singular"]) {
      const k = this.model.sets.findIndex((set) => set.name === name);
      if (k < 0 || this.hidden.has(name)) continue;
      if (name === "cspace" && this.model.sets[k].dimension > 1) this.drawDensity(context, this.projections[k]);
      else this.drawBoxes(context, this.projections[k], name);
    }
    for (const projection of this.projections) if (!this.hidden.has(projection.set.name)) this.drawUndecided(context, projection);
    context.restore();
    this.drawOverlay();
  }

  drawGrid(context) {
    const {pad, inner, height, x0, x1, y0, y1} = this.plane;
    context.fillStyle = this.colours.paper;
    context.fillRect(pad.left, pad.top, inner, height);
    context.strokeStyle = this.colours.faint;
    context.lineWidth = 1;
    context.fillStyle = this.colours.quiet;
    context.font = "12px system-ui, sans-serif";
    const line = (ax, ay, bx, by) => {
      context.beginPath();
      context.moveTo(Math.round(ax) + 0.5, Math.round(ay) + 0.5);
      context.lineTo(Math.round(bx) + 0.5, Math.round(by) + 0.5);
      context.stroke();
    };
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const {at, text} of ticks(x0, x1, isAngle(this.axes[0]), Math.max(3, inner / 80))) {
      line(this.toX(at), pad.top, this.toX(at), pad.top + height);
      context.fillText(text, this.toX(at), pad.top + height + 6);
    }
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const {at, text} of ticks(y0, y1, isAngle(this.axes[1]), Math.max(3, height / 60))) {
      line(pad.left, this.toY(at), pad.left + inner, this.toY(at));
      context.fillText(text, pad.left - 6, this.toY(at));
    }
    this.drawAxisName(context, this.axes[0], pad.left + inner / 2, pad.top + height + 30, 0);
    this.drawAxisName(context, this.axes[1], 10, pad.top + height / 2, -Math.PI / 2);
  }

  drawAxisName(context, axis, x, y, turn) {
    const unit = unitOf(this.model, axis), [base, subscript] = axis.label;
    context.save();
    context.translate(x, y);
    context.rotate(turn);
    context.fillStyle = this.colours.ink;
    context.textAlign = "left";
    context.textBaseline = "alphabetic";
    const pieces = [[base, "italic 15px Georgia, 'Times New Roman', serif", 4], [subscript, "11px Georgia, 'Times New Roman', serif", 8],
                    [unit ? ` (${unit})` : "", "12px system-ui, sans-serif", 4]];
    let width = 0;
    for (const [text, font] of pieces) {
      context.font = font;
      width += context.measureText(text).width;
    }
    let at = -width / 2;
    for (const [text, font, down] of pieces) {
      context.font = font;
      context.fillText(text, at, down);
      at += context.measureText(text).width;
    }
    context.restore();
  }

  drawDensity(context, projection) {
    const {pad, inner, height} = this.plane, width = Math.round(inner * this.ratio), rows = Math.round(height * this.ratio);
    const counts = coverage(projection, width, rows, (x) => (this.toX(x) - pad.left) * this.ratio, (y) => (this.toY(y) - pad.top) * this.ratio);
    const layer = document.createElement("canvas");
    layer.width = width;
    layer.height = rows;
    paintCoverage(layer.getContext("2d"), counts, width, rows, this.colours.cspace);
    context.drawImage(layer, pad.left, pad.top, inner, height);
  }

  // Boxes as they are, though never thinner than a line; few tiny ones as dots.
  drawBoxes(context, projection, name) {
    context.fillStyle = name === "cspace" ? `rgba(${this.colours.cspace}, 0.55)` : this.colours[name];
    const dots = projection.set.dimension === 0;
    for (let i = 0; i < projection.length; ++i) {
      const left = this.toX(projection.x[2 * i]), right = this.toX(projection.x[2 * i + 1]);
      const top = this.toY(projection.y[2 * i + 1]), bottom = this.toY(projection.y[2 * i]);
      if (dots && right - left < 7 && bottom - top < 7) {
        context.beginPath();
        context.arc((left + right) / 2, (top + bottom) / 2, name === "forward" ? 3.8 : 6.2, 0, 7);
        context.fill();
        continue;
      }
      const wide = Math.max(right - left, 1.8), high = Math.max(bottom - top, 1.8);
      context.fillRect((left + right - wide) / 2, (top + bottom - high) / 2, wide, high);
    }
  }

  drawUndecided(context, projection) {
    const {set} = projection;
    const isOpen = (box) => undecidedVerdicts.includes(this.model.verdicts[set.verdicts[box]]);
    const few = set.verdicts.reduce((n, _, box) => n + (isOpen(box) ? 1 : 0), 0) <= 60;
    context.strokeStyle = context.fillStyle = this.colours.undecided;
    context.lineWidth = 2;
    for (let i = 0; i < projection.length; ++i) {
      if (!isOpen(projection.owners[i])) continue;
      const x = this.toX((projection.x[2 * i] + projection.x[2 * i + 1]) / 2), y = this.toY((projection.y[2 * i] + projection.y[2 * i + 1]) / 2);
      context.beginPath();
      if (few) {
        context.arc(x, y, 6.5, 0, 7);
        context.stroke();
      } else {
        context.fillRect(x - 1.5, y - 1.5, 3, 3);
      }
    }
  }

  drawOverlay() {
    const context = this.overlay.getContext("2d");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.overlay.height);
    const {pad, inner, height} = this.plane;
    if (this.cursor && document.activeElement === this.frame) {
      const [x, y] = [this.toX(this.cursor[0]), this.toY(this.cursor[1])];
      context.strokeStyle = this.colours.quiet;
      context.setLineDash([3, 4]);
      context.beginPath();
      context.moveTo(x, pad.top);
      context.lineTo(x, pad.top + height);
      context.moveTo(pad.left, y);
      context.lineTo(pad.left + inner, y);
      context.stroke();
      context.setLineDash([]);
    }
    if (this.shown) {
      const [x, y] = [this.toX(coordinateValue(this.shown.x, this.axes[0])), this.toY(coordinateValue(this.shown.x, this.axes[1]))];
      context.lineWidth = 3;
      for (const [colour, radius] of [[this.colours.paper, 7.5], [this.colours.ink, 5.5]]) {
        context.strokeStyle = colour;
        context.beginPath();
        context.arc(x, y, radius, 0, 7);
        context.stroke();
      }
    }
  }

  // Marks the configuration that the panel shows.
  show(configuration) {
    this.shown = configuration;
    if (this.plane) this.drawOverlay();
  }

  // The number of boxes of a set over a place: what a picture claims, for a test to compare.
  boxesOver(name, x, y) {
    const k = this.model.sets.findIndex((set) => set.name === name);
    return this.projections[k].near(x, y, 0, 0).length;
  }

  // Assembly modes at a place: singular ones nearby first, then the C-space's over it, as groups of touching boxes.
  candidates([x, y]) {
    const dx = reach / this.plane.sx, dy = reach / this.plane.sy, found = [];
    this.projections.forEach((projection) => {
      const {set} = projection;
      if (this.hidden.has(set.name)) return;
      const surface = !set.singular() && set.dimension > 1;
      const boxes = projection.near(x, y, surface ? 0 : dx, surface ? 0 : dy);
      const groups = groupTouching(set, boxes).map((group) => ({...group, place: [x, y], axes: this.axes}));
      if (set.singular()) found.unshift(...groups);
      else found.push(...groups);
    });
    return found;
  }

  listen() {
    const place = (event) => {
      const box = this.overlay.getBoundingClientRect();
      return this.fromPixels(event.clientX - box.left, event.clientY - box.top);
    };
    const inside = ([x, y]) => x >= this.plane.x0 && x <= this.plane.x1 && y >= this.plane.y0 && y <= this.plane.y1;
    this.frame.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (inside(at)) this.moveTo(at);
    });
    this.frame.addEventListener("pointerleave", () => this.listener.leave());
    this.frame.addEventListener("click", (event) => {
      const at = place(event);
      if (!inside(at)) return;
      this.cursor = at;
      this.listener.pin(this.candidates(at), at, this);
    });
    this.frame.addEventListener("keydown", (event) => this.key(event));
    for (const name of ["focus", "blur"]) this.frame.addEventListener(name, () => this.drawOverlay());
  }

  moveTo(at) {
    this.cursor = at;
    this.listener.hover(this.candidates(at), at, this);
    this.drawOverlay();
  }

  key(event) {
    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const {x0, x1, y0, y1, sx, sy} = this.plane;
    if (steps[event.key]) {
      const pixels = event.shiftKey ? 30 : 5, [u, v] = steps[event.key];
      const [x, y] = this.cursor || [(x0 + x1) / 2, (y0 + y1) / 2];
      this.listener.escape();
      this.moveTo([Math.min(x1, Math.max(x0, x + (u * pixels) / sx)), Math.min(y1, Math.max(y0, y + (v * pixels) / sy))]);
    } else if (event.key === "Enter" && this.cursor) {
      this.listener.pin(this.candidates(this.cursor), this.cursor, this);
    } else if (event.key === "n" || event.key === "p") {
      this.listener.step(event.key === "n" ? 1 : -1);
    } else if (event.key === "Escape") {
      this.listener.escape();
    } else {
      return;
    }
    event.preventDefault();
  }

  placeText([x, y]) {
    const text = (axis, value) => {
      const unit = unitOf(this.model, axis);
      return `${htmlLabel(axis)} = ${numberText(value, 3)}${unit ? ` ${unit}` : ""}`;
    };
    return `${text(this.axes[0], x)}, ${text(this.axes[1], y)}`;
  }
}

export function legendText(set) {
  return `${groupedText(set.count)} ${set.count === 1 ? "box" : "boxes"}`;
}
