// The boxes of a set in the plane of two coordinates, with an index of what lies where.
import {coordinateInterval, fullTurn, isAngle} from "./values.js";

const gridSize = 64;

// The turn to the other end for an angle's interval that reaches ±π; 0 where it does not.
function turnAround(sides, box, axis) {
  if (!isAngle(axis)) return 0;
  return sides[2 * box + 1] >= Math.PI ? -fullTurn : sides[2 * box] <= -Math.PI ? fullTurn : 0;
}

export class Projection {
  constructor(set, xAxis, yAxis) {
    this.set = set;
    const n = set.count,
      side = [0, 0],
      more = [];
    const x = new Float64Array(2 * n),
      y = new Float64Array(2 * n);
    for (let box = 0; box < n; ++box) {
      coordinateInterval(set, box, xAxis, side);
      [x[2 * box], x[2 * box + 1]] = side;
      coordinateInterval(set, box, yAxis, side);
      [y[2 * box], y[2 * box + 1]] = side;
      const dx = turnAround(x, box, xAxis),
        dy = turnAround(y, box, yAxis);
      // A box at ±π is seen at both ends.
      if (dx !== 0) more.push([box, dx, 0]);
      if (dy !== 0) more.push([box, 0, dy]);
      if (dx !== 0 && dy !== 0) more.push([box, dx, dy]);
    }
    this.x = new Float64Array(2 * (n + more.length));
    this.y = new Float64Array(2 * (n + more.length));
    this.owners = new Uint32Array(n + more.length);
    this.x.set(x);
    this.y.set(y);
    for (let box = 0; box < n; ++box) this.owners[box] = box;
    more.forEach(([box, dx, dy], k) => {
      this.owners[n + k] = box;
      for (const end of [0, 1]) {
        this.x[2 * (n + k) + end] = x[2 * box + end] + dx;
        this.y[2 * (n + k) + end] = y[2 * box + end] + dy;
      }
    });
  }

  get length() {
    return this.owners.length;
  }

  hull(axis) {
    const sides = axis === 0 ? this.x : this.y;
    let low = Infinity,
      high = -Infinity;
    for (let i = 0; i < sides.length; i += 2) {
      low = Math.min(low, sides[i]);
      high = Math.max(high, sides[i + 1]);
    }
    return [low, high];
  }

  // Sorts the rectangles into the cells of a grid over the window [x0, y0, x1, y1], in the units of the axes.
  index(window) {
    const [x0, y0, x1, y1] = window;
    const cell = (value, low, high) =>
      Math.max(0, Math.min(gridSize - 1, Math.floor(((value - low) / (high - low)) * gridSize)));
    this.column = (x) => cell(x, x0, x1);
    this.row = (y) => cell(y, y0, y1);
    const starts = new Uint32Array(gridSize * gridSize + 1);
    const each = (visit) => {
      for (let i = 0; i < this.length; ++i) {
        const c1 = this.column(this.x[2 * i + 1]),
          r1 = this.row(this.y[2 * i + 1]);
        for (let r = this.row(this.y[2 * i]); r <= r1; ++r) {
          for (let c = this.column(this.x[2 * i]); c <= c1; ++c) visit(r * gridSize + c, i);
        }
      }
    };
    each((key) => ++starts[key + 1]);
    for (let k = 0; k < gridSize * gridSize; ++k) starts[k + 1] += starts[k];
    const entries = new Uint32Array(starts[gridSize * gridSize]),
      next = starts.slice();
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
          const u = Math.max(this.x[2 * i] - x, 0, x - this.x[2 * i + 1]),
            v = Math.max(this.y[2 * i] - y, 0, y - this.y[2 * i + 1]);
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

// Boxes that hang together are one assembly mode: groups of touching boxes, each led by its nearest one, `box`, with all of them in `boxes`.
export function groupTouching(set, boxes, most = 4000) {
  const list = boxes.slice(0, most),
    group = list.map((_, i) => i);
  const root = (i) => {
    while (group[i] !== i) i = group[i] = group[group[i]];
    return i;
  };
  // Along the variable that spreads the boxes most, those that may touch follow one another.
  const variable = widestVariable(set, list);
  const order = list.map((_, i) => i).sort((i, j) => set.lower(list[i].box, variable) - set.lower(list[j].box, variable));
  for (let a = 0; a < order.length; ++a) {
    const i = order[a],
      end = set.upper(list[i].box, variable);
    for (let b = a + 1; b < order.length && set.lower(list[order[b]].box, variable) <= end; ++b) {
      const p = root(i),
        q = root(order[b]);
      if (p !== q && set.touch(list[i].box, list[order[b]].box)) group[Math.max(p, q)] = Math.min(p, q);
    }
  }
  const groups = new Map();
  list.forEach(({box}, i) => {
    if (!groups.has(root(i))) groups.set(root(i), {set, box, boxes: []});
    groups.get(root(i)).boxes.push(box);
  });
  return [...groups.values()];
}

function widestVariable(set, list) {
  let best = 0,
    widest = -1;
  for (let j = 0; j < set.configuration; ++j) {
    let low = Infinity,
      high = -Infinity;
    for (const {box} of list) {
      low = Math.min(low, set.lower(box, j));
      high = Math.max(high, set.lower(box, j));
    }
    if (high - low > widest) [best, widest] = [j, high - low];
  }
  return best;
}
