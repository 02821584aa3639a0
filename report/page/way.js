// A curve's boxes in the order in which one passes them. It makes motions for pictures and proves nothing.
import {dot} from "./mechanism.js";

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
  const seen = (from, box, towards) => {
    const along = step(from, box),
      length = Math.hypot(...along);
    const cosine = towards && length > 0 ? dot(along, towards) / length : 1;
    return {box, along, length, cosine, cost: length * (2 - cosine)};
  };
  // Of these boxes the one to go to: not passed, near and straight on.
  const best = (from, boxes, towards, least) =>
    boxes
      .filter((box) => !passed.has(box))
      .map((box) => seen(from, box, towards))
      .filter(({cosine}) => cosine >= least)
      .reduce((found, other) => (!found || other.cost < found.cost ? other : found), null);
  // Beyond boxes ahead that were passed another way, where the curve crosses itself.
  const across = (from, towards) => {
    let ring = [from],
      found = null;
    const known = new Set(ring);
    for (let depth = 0; towards && !found && depth < 4; ++depth) {
      ring = ring
        .flatMap((box) => neighbours.of(box))
        .filter((box) => !known.has(box) && seen(from, box, towards).cosine > 0.6);
      for (const box of ring) known.add(box);
      found = best(from, ring, towards, 0.85);
    }
    return found;
  };
  const walk = (towards) => {
    const way = [start];
    for (;;) {
      const last = way[way.length - 1],
        around = neighbours.of(last);
      let next = best(last, around, towards, 0);
      if (!next && way.length > 3 && around.includes(start)) return way; // closed
      next ??= across(last, towards);
      // A box at the side may be a dead end: what lies ahead of the boxes before it goes on.
      for (let back = 2; !next && back <= Math.min(6, way.length); ++back) {
        const before = way[way.length - back];
        next = best(before, neighbours.of(before), towards, 0.3);
        if (next) way.length -= back - 1;
      }
      next ??= best(last, around, towards, -1); // a cusp
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
