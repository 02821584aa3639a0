// A portrait: a picture over two coordinates with a cursor, the place of what is shown, and choices of axes.
import {Picture, pageColours} from "./picture.js";
import {coordinateValue, htmlLabel, htmlUnit, numberText, plainLabel} from "./values.js";

export class Portrait {
  // `listener` has hover(candidates, place, portrait), pin(…), step(direction), escape(). `trace`: a path to be drawn.
  constructor(model, root, axes, listener, trace = null) {
    this.model = model;
    this.root = root;
    this.listener = listener;
    this.trace = trace;
    this.frame = root.querySelector(".frame");
    this.base = root.querySelector("canvas.base");
    this.overlay = root.querySelector("canvas.overlay");
    this.selects = [...root.querySelectorAll("select")];
    this.hidden = new Set();
    this.byAspect = false;
    this.cursor = null; // in the units of the axes
    this.shown = null; // the variables of what is shown, with its set
    this.fillSelects(axes);
    this.setAxes(axes);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.frame);
  }

  fillSelects(axes) {
    this.selects.forEach((select, k) => {
      select.replaceChildren();
      this.model.coordinates.forEach((coordinate, i) =>
        select.add(new Option(plainLabel(coordinate), i, false, i === axes[k])),
      );
      select.onchange = () => this.setAxes(this.selects.map((s) => Number(s.value)));
    });
  }

  // Another model, over coordinates of the same names where it has them; `axes`: else. The limits stay while they fit: what moves is then
  // the picture, not its frame.
  // Over the axes that it has, where the model has them, too; `anew`: over those that are given.
  setModel(model, axes, anew = false) {
    const {limits} = this.picture;
    const names = this.picture.axes.map(({name}) => name);
    const places = names.map((name) => model.coordinates.findIndex((coordinate) => coordinate.name === name));
    const same = model.coordinates.map(({name}) => name).join() === this.model.coordinates.map(({name}) => name).join();
    this.model = model;
    this.shown = null;
    const kept = !anew && places.every((place) => place >= 0) ? places : axes;
    if (!same || anew) this.fillSelects(kept);
    this.setAxes(kept, kept === places ? limits : null);
  }

  setAxes(axes, limits = null) {
    this.picture = new Picture(
      this.model,
      this.model.sets,
      axes.map((i) => this.model.coordinates[i]),
      this.trace?.points,
    );
    if (limits) this.picture.keepLimits(limits);
    this.picture.hidden = this.hidden;
    this.picture.byAspect = this.byAspect;
    this.cursor = null;
    if (this.width) this.draw();
  }

  resize() {
    const width = this.frame.clientWidth;
    if (!width || (width === this.width && this.ratio === devicePixelRatio)) return;
    this.width = width;
    this.draw();
  }

  draw() {
    const height = this.picture.layOut(this.width);
    this.frame.style.height = `${height}px`;
    this.ratio = devicePixelRatio || 1;
    for (const canvas of [this.base, this.overlay]) {
      canvas.width = Math.round(this.width * this.ratio);
      canvas.height = Math.round(height * this.ratio);
    }
    this.picture.paint(this.base, this.ratio, pageColours(this.root));
    this.drawOverlay();
  }

  drawOverlay() {
    const context = this.overlay.getContext("2d");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.overlay.height);
    this.trace?.draw(context, this.picture);
    const {pad, inner, height} = this.picture.plane;
    if (this.cursor && document.activeElement === this.frame) {
      const [x, y] = [this.picture.plane.toX(this.cursor[0]), this.picture.plane.toY(this.cursor[1])];
      context.strokeStyle = this.picture.colours.quiet;
      context.lineWidth = 1;
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
      const [x, y] = [
        this.picture.plane.toX(coordinateValue(this.shown.x, this.picture.axes[0])),
        this.picture.plane.toY(coordinateValue(this.shown.x, this.picture.axes[1])),
      ];
      context.lineWidth = 3;
      for (const [colour, radius] of [
        [this.picture.colours.paper, 7.5],
        [this.picture.colours.ink, 5.5],
      ]) {
        context.strokeStyle = colour;
        context.beginPath();
        context.arc(x, y, radius, 0, 7);
        context.stroke();
      }
    }
  }

  setByAspect(byAspect) {
    this.byAspect = this.picture.byAspect = byAspect;
  }

  // Marks the configuration that the panel shows.
  show(configuration) {
    this.shown = configuration;
    if (this.picture.plane) this.drawOverlay();
  }

  listen() {
    const place = (event) => {
      const box = this.overlay.getBoundingClientRect();
      return this.picture.plane.fromPixels(event.clientX - box.left, event.clientY - box.top);
    };
    this.frame.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (this.picture.plane.holds(at)) this.moveTo(at);
    });
    this.frame.addEventListener("click", (event) => {
      const at = place(event);
      if (!this.picture.plane.holds(at)) return;
      this.cursor = at;
      this.listener.pin(this.picture.candidates(at), at, this);
    });
    this.frame.addEventListener("keydown", (event) => this.key(event));
    for (const name of ["focus", "blur"]) this.frame.addEventListener(name, () => this.drawOverlay());
  }

  moveTo(at) {
    this.cursor = at;
    this.listener.hover(this.picture.candidates(at), at, this);
    this.drawOverlay();
  }

  key(event) {
    const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const {x0, x1, y0, y1, sx, sy} = this.picture.plane;
    if (steps[event.key]) {
      const pixels = event.shiftKey ? 30 : 5,
        [u, v] = steps[event.key];
      const [x, y] = this.cursor || [(x0 + x1) / 2, (y0 + y1) / 2];
      this.listener.escape();
      this.moveTo([Math.min(x1, Math.max(x0, x + (u * pixels) / sx)), Math.min(y1, Math.max(y0, y + (v * pixels) / sy))]);
    } else if (event.key === "Enter" && this.cursor) {
      this.listener.pin(this.picture.candidates(this.cursor), this.cursor, this);
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
      const unit = htmlUnit(this.model, axis);
      return `${htmlLabel(axis)} = ${numberText(value, 3)}${unit ? ` ${unit}` : ""}`;
    };
    return `${text(this.picture.axes[0], x)}, ${text(this.picture.axes[1], y)}`;
  }
}
