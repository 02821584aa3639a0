// Which configurations of a set a page shows at first.
import {drawnPoints} from "./mechanism.js";
import {pointOfBox} from "./newton.js";
import {coordinateValues} from "./values.js";

// Configurations here and there in a set: {set, box, values}.
export function sampleConfigurations(model, set, most) {
  if (!set) return [];
  const step = Math.max(1, Math.floor(set.count / most)),
    samples = [];
  for (let box = step >> 1; box < set.count; box += step)
    samples.push({set, box, values: coordinateValues(model, pointOfBox(set, box).x)});
  return samples;
}

// The clearest of some configurations: one that keeps its points apart, upright rather than hanging.
export function clearest(model, samples) {
  let best = null;
  for (const sample of samples) {
    const at = drawnPoints(model, sample.values)
      .filter(({named}) => named)
      .map(({position}) => position);
    let room = Infinity,
      height = 0;
    at.forEach((p, i) => {
      height += p[1] / at.length;
      for (let j = 0; j < i; ++j) room = Math.min(room, Math.hypot(p[0] - at[j][0], p[1] - at[j][1]));
    });
    const score = room + 0.15 * height;
    if (!best || score > best.score) best = {score, ...sample};
  }
  return best;
}
