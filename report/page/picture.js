// A picture of C-space and the loci over two coordinates, painted on a canvas; and what lies where in it.
import {Plane, drawAxes} from "./axes.js";
import {coverage, paintCoverage, paintMixture, sheetTone} from "./density.js";
import {Projection, groupTouching} from "./projection.js";
import {coordinateValue, fullTurn, isAngle} from "./values.js";

const stroke = {length: 6, apart: 5, directions: 8}; // to the forbidden side of a barrier, in pixels
const reach = 9; // pixels within which a curve or a point is taken to be meant

// The colours of the page's style, as an element has them.
export function pageColours(element) {
  const style = getComputedStyle(element);
  const colour = (name) => style.getPropertyValue(name).trim();
  return {
    ink: colour("--ink"),
    faint: colour("--line"),
    quiet: colour("--quiet"),
    paper: colour("--plot"),
    card: colour("--card"),
    line: colour("--line-strong"),
    undecided: colour("--undecided"),
    passage: {traversable: colour("--traversable"), unproven: colour("--open")},
    way: colour("--way"),
    of: ({name}) => colour(`--set-${name}`),
  };
}

export class Picture {
  // Of these sets over two coordinates, and of more configurations, `points`.
  constructor(model, sets, axes, points = []) {
    this.model = model;
    this.sets = sets;
    this.axes = axes;
    this.points = points;
    this.hidden = new Set(); // names of sets
    this.byAspect = false;
    this.projections = sets.map((set) => new Projection(set, ...axes));
    this.limits = [0, 1].map((k) => this.range(k));
  }

  // Of an angle the whole turn, unless the boxes are far from it; of a length what the boxes need.
  range(k) {
    let low = Infinity,
      high = -Infinity;
    for (const projection of this.projections) {
      const [a, b] = projection.hull(k);
      low = Math.min(low, a);
      high = Math.max(high, b);
    }
    for (const x of this.points) {
      const value = coordinateValue(x, this.axes[k]);
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    if (!(low < high)) [low, high] = low === high ? [low - 1, high + 1] : [-1, 1];
    if (isAngle(this.axes[k]) && high - low > 0.6 * fullTurn) return [-Math.PI, Math.PI];
    const margin = 0.05 * (high - low);
    return [low - margin, high + margin];
  }

  // Keeps former limits where they hold these boxes and leave little room; while sets are missing, any room.
  keepLimits(former) {
    this.limits = this.limits.map(([low, high], k) => {
      const [a, b] = former[k];
      if (this.model.partial) return [Math.min(a, low), Math.max(b, high)];
      return a <= low + 0.04 * (high - low) && b >= high - 0.04 * (high - low) && b - a < 1.35 * (high - low)
        ? [a, b]
        : [low, high];
    });
  }

  // The height, in pixels of the page, of a picture that wide; `pad` as in Plane.
  layOut(width, pad) {
    this.plane = new Plane(this.axes, this.limits, width, pad);
    const {x0, y0, x1, y1} = this.plane;
    for (const projection of this.projections) projection.index([x0, y0, x1, y1]);
    return this.plane.fullHeight;
  }

  // After layOut(). `ratio`: pixels of the canvas to one of the page.
  paint(canvas, ratio, colours) {
    this.ratio = ratio;
    this.colours = colours;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.plane.width, this.plane.fullHeight);
    drawAxes(context, this.model, this.axes, this.plane, colours);
    context.save();
    context.beginPath();
    context.rect(this.plane.pad.left, this.plane.pad.top, this.plane.inner, this.plane.height);
    context.clip();
    const shown = this.projections.filter(({set}) => !this.hidden.has(set.name));
    for (const projection of shown.filter(({set}) => !set.complete)) {
      this.drawDensity(context, projection, true, colours.undecided, (count) => 0.14 * Math.min(1, count));
    }
    for (const projection of shown.slice().sort((a, b) => a.set.layer - b.set.layer)) {
      const {set} = projection;
      if (this.aspectsOf(set)) this.drawAspects(context, projection, this.aspectsOf(set));
      else if (!set.singular && set.dimension > 1) this.drawDensity(context, projection, false, colours.of(set), sheetTone);
      else this.drawBoxes(context, projection);
    }
    for (const projection of shown) this.drawForbiddenSides(context, projection);
    for (const projection of shown) this.drawUndecided(context, projection);
    context.restore();
  }

  // Strokes of one length to the sides that barriers keep the output from, none close to another of much the same direction.
  drawForbiddenSides(context, projection) {
    const {set} = projection;
    if (!set.passages) return;
    const {plane} = this,
      taken = new Set();
    context.strokeStyle = this.colours.of(set);
    context.lineWidth = 1;
    context.beginPath();
    for (let i = 0; i < projection.owners.length; ++i) {
      const side = set.sideOf(projection.owners[i], this.axes);
      if (!side) continue;
      const {left, right, top, bottom} = this.rectangle(projection, i);
      const [x, y] = [(left + right) / 2, (top + bottom) / 2];
      // A normal of the plane of the outputs, where a unit has another length along the other axis.
      const [u, v] = [-side[0] / plane.sx, side[1] / plane.sy],
        size = Math.hypot(u, v);
      const turn = Math.round((Math.atan2(v, u) / (2 * Math.PI)) * stroke.directions);
      const key = [Math.round(x / stroke.apart), Math.round(y / stroke.apart), turn].join();
      if (!(size > 0) || taken.has(key)) continue;
      taken.add(key);
      context.moveTo(x, y);
      context.lineTo(x + (stroke.length * u) / size, y + (stroke.length * v) / size);
    }
    context.stroke();
  }

  // The aspects whose colours a set is drawn in; null: it is not.
  aspectsOf(set) {
    const {aspects} = this.model;
    return this.byAspect && aspects?.set === set && set.dimension > 1 ? aspects : null;
  }

  // The boxes of a projection that are pending, or those that are not, in one colour.
  drawDensity(context, projection, pending, colour, tone) {
    const counts = this.countsOf(projection, (box) => this.isPending(projection.set, box) !== pending);
    this.drawLayer(context, (layer, width, rows) => paintCoverage(layer, counts, width, rows, colour, tone));
  }

  // Each box in the colour of its aspect, mixed where several lie over one another.
  drawAspects(context, projection, aspects) {
    const plain = this.colours.of(projection.set);
    const sheets = aspects.numbers
      .filter((number) => !aspects.hidden.has(number))
      .map((number) => ({
        colour: aspects.colourOf(number, plain),
        counts: this.countsOf(projection, (box) => aspects.of[box] !== number || this.isPending(projection.set, box)),
      }));
    this.drawLayer(context, (layer, width, rows) => paintMixture(layer, sheets, width, rows));
  }

  // How many boxes lie over each pixel of the plane.
  countsOf(projection, skip) {
    const {pad, inner, height} = this.plane;
    const toX = (x) => (this.plane.toX(x) - pad.left) * this.ratio;
    const toY = (y) => (this.plane.toY(y) - pad.top) * this.ratio;
    return coverage(projection, Math.round(inner * this.ratio), Math.round(height * this.ratio), toX, toY, skip);
  }

  // What paint(context, width, rows) paints in pixels of the canvas goes over the plane.
  drawLayer(context, paint) {
    const {pad, inner, height} = this.plane,
      layer = document.createElement("canvas");
    layer.width = Math.round(inner * this.ratio);
    layer.height = Math.round(height * this.ratio);
    paint(layer.getContext("2d"), layer.width, layer.height);
    context.drawImage(layer, pad.left, pad.top, inner, height);
  }

  // Boxes as they are, though never thinner than a line; few tiny ones as dots.
  drawBoxes(context, projection) {
    const {set} = projection;
    context.fillStyle = this.colours.of(set);
    context.globalAlpha = set.singular ? 1 : 0.55;
    const dots = set.dimension === 0;
    for (let i = 0; i < projection.length; ++i) {
      if (this.isPending(set, projection.owners[i])) continue;
      if (set.passages)
        context.fillStyle = this.colours.passage[set.passageOf(projection.owners[i])] || this.colours.of(set);
      const {left, right, top, bottom} = this.rectangle(projection, i);
      if (dots && right - left < 7 && bottom - top < 7) {
        context.beginPath();
        context.arc((left + right) / 2, (top + bottom) / 2, set.dot, 0, 7);
        context.fill();
        continue;
      }
      const wide = Math.max(right - left, 1.8);
      const high = Math.max(bottom - top, 1.8);
      context.fillRect((left + right - wide) / 2, (top + bottom - high) / 2, wide, high);
    }
    context.globalAlpha = 1;
  }

  // Rings, or dots where they are many.
  drawUndecided(context, projection) {
    const isUndecided = (box) => this.model.verdicts[projection.set.verdicts[box]] === "undecided";
    const few = projection.owners.filter(isUndecided).length <= 60;
    context.strokeStyle = context.fillStyle = this.colours.undecided;
    context.lineWidth = 2;
    for (let i = 0; i < projection.length; ++i) {
      if (!isUndecided(projection.owners[i])) continue;
      const {left, right, top, bottom} = this.rectangle(projection, i);
      const [x, y] = [(left + right) / 2, (top + bottom) / 2];
      if (few) {
        context.beginPath();
        context.arc(x, y, 6.5, 0, 7);
        context.stroke();
      } else {
        context.fillRect(x - 1.5, y - 1.5, 3, 3);
      }
    }
  }

  // Not searched: a limit or an interrupt came before.
  isPending(set, box) {
    return this.model.verdicts[set.verdicts[box]] === "pending";
  }

  // Rectangle i of a projection in pixels.
  rectangle(projection, i) {
    const {plane} = this;
    return {
      left: plane.toX(projection.x[2 * i]),
      right: plane.toX(projection.x[2 * i + 1]),
      top: plane.toY(projection.y[2 * i + 1]),
      bottom: plane.toY(projection.y[2 * i]),
    };
  }

  // The number of boxes of a set over a place: what a picture claims, for a test to compare.
  boxesOver(name, x, y) {
    return this.near(name, x, y, 0).length;
  }

  // Those within a distance, in the units of the axes.
  near(name, x, y, distance) {
    return this.projections.find(({set}) => set.name === name).near(x, y, distance, distance);
  }

  // Assembly modes at a place: singular ones nearby first, then the C-space's over it, as groups of touching boxes.
  candidates([x, y]) {
    const dx = reach / this.plane.sx,
      dy = reach / this.plane.sy,
      found = [];
    this.projections.forEach((projection) => {
      const {set} = projection;
      if (this.hidden.has(set.name)) return;
      const surface = !set.singular && set.dimension > 1;
      const aspects = this.aspectsOf(set);
      const boxes = projection
        .near(x, y, surface ? 0 : dx, surface ? 0 : dy)
        .filter(({box}) => !aspects || aspects.isShown(box));
      const groups = groupTouching(set, boxes).map((group) => ({...group, place: [x, y], axes: this.axes}));
      if (set.singular) found.unshift(...groups);
      else found.push(...groups);
    });
    return found;
  }
}
