// Pieces of a curve that the plane shows as a point or nearly so, such as a barrier: too small to be seen, too important to be missed.

// The hulls [x0, x1, y0, y1] of the groups of touching rectangles of a projection that are nowhere wider than `extent`.
export function smallGroups(projection, extent) {
  const {x, y, length} = projection,
    group = Array.from({length}, (_, i) => i);
  const root = (i) => {
    while (group[i] !== i) i = group[i] = group[group[i]];
    return i;
  };
  const order = group.slice().sort((i, j) => x[2 * i] - x[2 * j]);
  for (let a = 0; a < length; ++a) {
    const i = order[a];
    for (let b = a + 1; b < length && x[2 * order[b]] <= x[2 * i + 1]; ++b) {
      const j = order[b];
      if (y[2 * j] <= y[2 * i + 1] && y[2 * i] <= y[2 * j + 1]) group[root(i)] = root(j);
    }
  }
  const hulls = new Map();
  for (let i = 0; i < length; ++i) {
    const hull = hulls.get(root(i)) || [Infinity, -Infinity, Infinity, -Infinity];
    for (const [k, sides] of [x, y].entries()) {
      hull[2 * k] = Math.min(hull[2 * k], sides[2 * i]);
      hull[2 * k + 1] = Math.max(hull[2 * k + 1], sides[2 * i + 1]);
    }
    hulls.set(root(i), hull);
  }
  return [...hulls.values()].filter(([x0, x1, y0, y1]) => Math.max(x1 - x0, y1 - y0) <= extent);
}
