// A curve's boxes in the order in which one passes them, and points along it. What follows makes motions for pictures; it proves nothing.
import {ontoSolutions} from "./newton.js";

const mostKnots = 600;

// Which boxes of a list may touch a box of it: those in the neighbouring cells of a grid over a few variables.
class Neighbours {
  constructor(set, boxes, scales) {
    this.set = set;
    const spread = (j) => {
      const middles = boxes.map((box) => set.middle(box, j));
      return (
        middles.reduce((most, x) => Math.max(most, x), -Infinity) -
        middles.reduce((least, x) => Math.min(least, x), Infinity)
      );
    };
    const spreads = scales.map((scale, j) => ({j, size: spread(j), scaled: spread(j) * scale}));
    this.axes = spreads
      .sort((a, b) => b.scaled - a.scaled)
      .slice(0, 3)
      .map(({j, size}) => {
        const widest = boxes.reduce((most, box) => Math.max(most, set.upper(box, j) - set.lower(box, j)), size / 2000);
        return {j, cell: widest * 1.01 || 1};
      });
    this.cells = new Map();
    for (const box of boxes) {
      const key = this.cell(box).join();
      if (!this.cells.has(key)) this.cells.set(key, []);
      this.cells.get(key).push(box);
    }
  }

  cell(box) {
    return this.axes.map(({j, cell}) => Math.floor(this.set.middle(box, j) / cell));
  }

  of(box) {
    const found = [];
    const visit = (cell, rest) => {
      if (rest.length === 0) {
        for (const other of this.cells.get(cell.join()) || []) {
          if (other !== box && this.set.touch(box, other)) found.push(other);
        }
        return;
      }
      for (const step of [-1, 0, 1]) visit([...cell, rest[0] + step], rest.slice(1));
    };
    visit([], this.cell(box));
    return found;
  }
}

// The way through touching boxes, straight on where there is a choice, from a box to where the curve ends or comes back to it:
// {boxes, closed}.
export function wayThrough(set, boxes, start) {
  const scales = set.domains.slice(0, set.configuration).map(([low, high]) => 1 / Math.max(high - low, 1e-12));
  const neighbours = new Neighbours(set, boxes, scales);
  const step = (a, b) => scales.map((scale, j) => scale * (set.middle(b, j) - set.middle(a, j)));
  const passed = new Set([start]);
  const best = (from, towards, least) => {
    let found = null;
    for (const box of neighbours.of(from)) {
      if (passed.has(box)) continue;
      const along = step(from, box),
        length = Math.hypot(...along);
      const cosine = towards && length > 0 ? along.reduce((sum, x, j) => sum + x * towards[j], 0) / length : 1;
      const cost = length * (2 - cosine);
      if (cosine >= least && (!found || cost < found.cost)) found = {box, along, length, cost};
    }
    return found;
  };
  const walk = (towards) => {
    const way = [start];
    for (;;) {
      let next = best(way[way.length - 1], towards, -2);
      // A box at the side may be a dead end: what lies ahead of the boxes before it goes on.
      for (let back = 2; !next && back <= Math.min(6, way.length); ++back) {
        next = best(way[way.length - back], towards, 0.3);
        if (next) way.length -= back - 1;
      }
      if (!next) return way;
      passed.add(next.box);
      way.push(next.box);
      if (!(next.length > 0)) continue;
      const mixed = next.along.map((x, j) => x / next.length + (towards ? towards[j] : 0)),
        norm = Math.hypot(...mixed);
      towards = norm > 1e-9 ? mixed.map((x) => x / norm) : towards;
    }
  };
  const ahead = walk(null);
  if (ahead.length > 3 && neighbours.of(ahead[ahead.length - 1]).includes(start)) return {boxes: ahead, closed: true};
  const first = ahead.length > 1 ? step(start, ahead[1]) : null,
    norm = first ? Math.hypot(...first) : 0;
  const behind = norm > 0 ? walk(first.map((x) => -x / norm)) : [start];
  return {boxes: [...behind.reverse(), ...ahead.slice(1)], closed: false};
}

// A curve with points on it, at(t) for t from 0 to `length`; of a closed one the end is the beginning.
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
      set.equations,
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
    const {x, residual} = ontoSolutions(this.set.equations, between);
    const good = residual < 1e-9 && this.distance(x, between) <= this.distance(a.x, b.x) + 1e-6;
    return {set: this.set, box: this.boxOf(good ? x : between, a, b), x: good ? x : between, residual, moved: good};
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
