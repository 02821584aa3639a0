// Which coordinates a page's pictures are over at first.

// Outputs, inputs, passive coordinates; then those that all sets leave out. Those of one value are no axes.
export function axisOrder(model) {
  const rank = {output: 0, input: 1, passive: 2, auxiliary: 3};
  const indices = model.coordinates
    .map((_, i) => i)
    .filter((i) => model.coordinates[i].range[1] - model.coordinates[i].range[0] > 1e-9);
  const late = (i) => Number(isLeftOut(model, i));
  return indices.sort(
    (a, b) => late(a) - late(b) || rank[model.coordinates[a].role] - rank[model.coordinates[b].role] || a - b,
  );
}

function isLeftOut(model, i) {
  const variable = model.coordinates[i].index ?? model.coordinates[i].cosine;
  return model.sets.length > 0 && model.sets.every((set) => set.leftOut?.includes(variable));
}

export function firstOf(order, model, role) {
  const own = order.filter((i) => model.coordinates[i].role === role && !isLeftOut(model, i));
  return [...own, ...order.filter((i) => !own.includes(i))].slice(0, 2);
}
