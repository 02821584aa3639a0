// Which coordinates a page's pictures are over at first.
import {isAngle} from "./values.js";

// Outputs, inputs, passive coordinates; then those that all singularities leave out, or that hardly move beside others of their kind.
// Those of one value are no axes.
export function axisOrder(model) {
  const rank = {output: 0, input: 1, passive: 2, auxiliary: 3};
  const indices = model.coordinates.map((_, i) => i).filter((i) => widthOf(model.coordinates[i]) > 1e-9);
  const late = (i) => Number(isLate(model, i));
  return indices.sort(
    (a, b) => late(a) - late(b) || rank[model.coordinates[a].role] - rank[model.coordinates[b].role] || a - b,
  );
}

function widthOf({range}) {
  return range[1] - range[0];
}

function isLate(model, i) {
  const own = model.coordinates[i],
    variable = own.index ?? own.cosine;
  const drawn = model.sets.filter(({count}) => count > 0),
    singular = drawn.filter((set) => set.singular),
    asked = singular.length > 0 ? singular : drawn;
  if (asked.length > 0 && asked.every((set) => set.leftOut?.includes(variable))) return true;
  const alike = model.coordinates.filter((other) => isAngle(other) === isAngle(own) && other.role === own.role);
  return widthOf(own) < 1e-2 * Math.max(...alike.map(widthOf));
}

export function firstOf(order, model, role) {
  const own = order.filter((i) => model.coordinates[i].role === role && !isLate(model, i));
  return [...own, ...order.filter((i) => !own.includes(i))].slice(0, 2);
}
