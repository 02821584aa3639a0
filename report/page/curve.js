// A curve of configurations with points along it, for pictures; it proves nothing.
import {ontoSolutions} from "./newton.js";
import {wayThrough} from "./way.js";

const mostKnots = 600;

// Through the touching boxes from `start`: at(t) for t from 0 to `length`; of a closed curve the end is the beginning.
export class Curve {
  constructor(set, boxes, start) {
    const way = wayThrough(set, boxes, start);
    this.set = set;
    this.closed = way.closed;
    this.boxes = way.boxes;
    const every = Math.ceil(way.boxes.length / mostKnots);
    this.knots = way.boxes.flatMap((box, place) => (place % every === 0 || box === start ? this.knot(box, place) : []));
    if (this.closed && this.knots.length > 1) this.knots.push({...this.knots[0], place: way.boxes.length});
    this.length = 0;
    this.knots.forEach((knot, k) => {
      if (k > 0) this.length += this.distance(this.knots[k - 1].x, knot.x);
      knot.t = this.length;
      if (k > 0) this.alignKernel(this.knots[k - 1], knot);
    });
  }

  knot(box, place) {
    const {set} = this;
    const {x, residual} = ontoSolutions(
      set.equationsOf(box),
      Float64Array.from({length: set.size}, (_, j) => set.middle(box, j)),
    );
    return residual < 1e-9 ? [{x, box, place}] : [];
  }

  distance(a, b) {
    let sum = 0;
    for (let j = 0; j < this.set.configuration; ++j) {
      const [low, high] = this.set.domains[j];
      sum += ((a[j] - b[j]) / Math.max(high - low, 1e-12)) ** 2;
    }
    return Math.sqrt(sum);
  }

  // With ξ also −ξ is in the kernel: arrows shall not turn round between two knots.
  alignKernel(before, knot) {
    let product = 0;
    for (let j = this.set.configuration; j < this.set.size; ++j) product += before.x[j] * knot.x[j];
    if (product < 0) knot.x = knot.x.map((x, j) => (j < this.set.configuration ? x : -x));
  }

  // Where on the curve a configuration is.
  locate(x) {
    let best = {t: 0, far: Infinity};
    for (const knot of this.knots) {
      const far = this.distance(knot.x, x);
      if (far < best.far) best = {t: knot.t, far};
    }
    return best.t;
  }

  // The configuration at t, as the panel shows it.
  at(t) {
    const k = Math.max(
      1,
      this.knots.findIndex((knot) => knot.t >= t),
    );
    const [a, b] = [this.knots[k - 1], this.knots[k] ?? this.knots[k - 1]];
    const share = b.t > a.t ? Math.min(1, Math.max(0, (t - a.t) / (b.t - a.t))) : 0;
    const between = a.x.map((x, j) => x + share * (b.x[j] - x));
    const {x, residual} = ontoSolutions(this.equationsBetween(a.box, b.box), between);
    const good = residual < 1e-9 && this.distance(x, between) <= this.distance(a.x, b.x) + 1e-6;
    return {set: this.set, box: this.boxOf(good ? x : between, a, b), x: good ? x : between, residual, moved: good};
  }

  // Boxes that touch may be of two parts of the set.
  equationsBetween(a, b) {
    const {parts, equations} = this.set;
    return parts && parts[a] !== parts[b] ? equations : this.set.equationsOf(a);
  }

  // The box, of those from one knot to the next, that the configuration is least outside of.
  boxOf(x, a, b) {
    let best = a.box,
      least = Infinity;
    for (let place = a.place; place <= b.place; ++place) {
      const box = this.boxes[place % this.boxes.length];
      let out = 0;
      for (let j = 0; j < this.set.configuration; ++j)
        out = Math.max(out, this.set.lower(box, j) - x[j], x[j] - this.set.upper(box, j));
      if (out < least) [best, least] = [box, out];
    }
    return best;
  }
}
