// The boxes of a set in the plane of two coordinates, with an index of what lies where.
import {coordinateInterval, fullTurn, isAngle} from "./values.js";

const gridSize = 64;

export class Projection {
  // `window` = [x0, y0, x1, y1] in the units of the axes.
  constructor(set, xAxis, yAxis) {
    this.set = set;
    const side = [0, 0], xs = [], ys = [], owners = [];
    const shifts = (low, high, axis) => (isAngle(axis) && high > Math.PI ? [0, -fullTurn] : isAngle(axis) && low < -Math.PI ? [0, fullTurn] : [0]);
    for (let box = 0; box < set.count; ++box) {
      const [x0, x1] = coordinateInterval(set, box, xAxis, side), [y0, y1] = coordinateInterval(set, box, yAxis, side);
      // A box across ±π is seen at both ends.
      for (const dx of shifts(x0, x1, xAxis)) {
        for (const dy of shifts(y0, y1, yAxis)) {
          xs.push(x0 + dx, x1 + dx);
          ys.push(y0 + dy, y1 + dy);
          owners.push(box);
        }
      }
    }
    this.x = Float64Array.from(xs);
    this.y = Float64Array.from(ys);
    this.owners = Uint32Array.from(owners);
  }

  get length() {
    return this.owners.length;
  }

  hull(axis) {
    const sides = axis === 0 ? this.x : this.y;
    let low = Infinity, high = -Infinity;
    for (let i = 0; i < sides.length; i += 2) {
      low = Math.min(low, sides[i]);
      high = Math.max(high, sides[i + 1]);
    }
    return [low, high];
  }

  // Sorts the rectangles into the cells of a grid over the window.
  index(window) {
    const [x0, y0, x1, y1] = window;
    const cell = (value, low, high) => Math.max(0, Math.min(gridSize - 1, Math.floor(((value - low) / (high - low)) * gridSize)));
    this.column = (x) => cell(x, x0, x1);
    this.row = (y) => cell(y, y0, y1);
    const starts = new Uint32Array(gridSize * gridSize + 1);
    const each = (visit) => {
      for (let i = 0; i < this.length; ++i) {
        const c1 = this.column(this.x[2 * i + 1]), r1 = this.row(this.y[2 * i + 1]);
        for (let r = this.row(this.y[2 * i]); r <= r1; ++r) {
          for (let c = this.column(this.x[2 * i]); c <= c1; ++c) visit(r * gridSize + c, i);
        }
      }
    };
    each((key) => ++starts[key + 1]);
    for (let k = 0; k < gridSize * gridSize; ++k) starts[k + 1] += starts[k];
    const entries = new Uint32Array(starts[gridSize * gridSize]), next = starts.slice();
    each((key, i) => (entries[next[key]++] = i));
    this.starts = starts;
    this.entries = entries;
  }

  // The boxes within (dx, dy) of a place, each once, with their distance in those units (0: over the place), nearest first.
  near(x, y, dx, dy) {
    const found = new Map();
    for (let r = this.row(y - dy); r <= this.row(y + dy); ++r) {
      for (let c = this.column(x - dx); c <= this.column(x + dx); ++c) {
        const key = r * gridSize + c;
        for (let k = this.starts[key]; k < this.starts[key + 1]; ++k) {
          const i = this.entries[k];
          const u = Math.max(this.x[2 * i] - x, 0, x - this.x[2 * i + 1]), v = Math.max(this.y[2 * i] - y, 0, y - this.y[2 * i + 1]);
          const distance = Math.hypot(dx > 0 ? u / dx : u * Infinity || 0, dy > 0 ? v / dy : v * Infinity || 0);
          if (!(distance <= 1)) continue;
          const box = this.owners[i];
          if (!found.has(box) || found.get(box) > distance) found.set(box, distance);
        }
      }
    }
    return [...found].sort((a, b) => a[1] - b[1]).map(([box, distance]) => ({box, distance}));
  }
}

// Boxes that hang together are one assembly mode: groups of touching boxes, each led by its nearest one.
export function groupTouching(set, boxes, most = 1500) {
  const list = boxes.slice(0, most), group = list.map((_, i) => i);
  const root = (i) => {
    while (group[i] !== i) i = group[i] = group[group[i]];
    return i;
  };
  for (let i = 0; i < list.length; ++i) {
    for (let j = 0; j < i; ++j) {
      const a = root(i), b = root(j);
      if (a !== b && set.touch(list[i].box, list[j].box)) group[Math.max(a, b)] = Math.min(a, b);
    }
  }
  return list.filter((_, i) => root(i) === i).map(({box}, _, leaders) => ({set, box, leaders: leaders.length}));
}
