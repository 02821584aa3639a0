// The gallery's page: draws each robot where the page has its configuration.
import {drawMechanism, drawingWindow} from "./mechanism.js";
import {kernelVector} from "./newton.js";
import {followTheme, takeTheme} from "./theme.js";
import {coordinateValues} from "./values.js";

// The rates of the coordinates, or the mechanism's own, that the kernel vector of a set stands for; null where there is none to draw.
function kernelRates(model, x) {
  const set = model.sets[0];
  if (!set || set.columns.length === 0) return null;
  const names = model.rates || model.coordinates.map(({name}) => name);
  const xi = kernelVector(set, x);
  return Object.fromEntries(set.columns.map((column, k) => [names[column], set.scales[k] * xi[k]]));
}

// The drawing without the points that only give a hinge its direction, and are far from the robot.
function withoutDirections(model) {
  const {points, parts} = model.drawing;
  const used = new Set(parts.flatMap(({kind, points: own}) => (kind === "hinge" ? own.slice(0, 1) : own)));
  return {...model, drawing: {...model.drawing, points: points.filter((_, i) => used.has(i)), parts: []}};
}

// With room for the arrows, whose longest has a fifth of the width.
function roomy([x0, y0, x1, y1]) {
  const extra = 0.1 * (x1 - x0);
  return [x0 - extra, y0 - extra, x1 + extra, y1 + extra];
}

function drawRobot(svg) {
  const {model, x} = JSON.parse(document.getElementById(`robot-${svg.dataset.robot}`).textContent);
  const values = coordinateValues(model, x),
    rates = kernelRates(model, x),
    tight = drawingWindow(withoutDirections(model), [values]),
    view = rates ? roomy(tight) : tight,
    steep = (view[3] - view[1]) / (view[2] - view[0]); // a tall drawing is scaled to the height that there is
  drawMechanism(svg, model, values, rates, view, {unit: 0.8 * Math.max(1, steep)});
}

function showGallery() {
  takeTheme();
  for (const svg of document.querySelectorAll("svg[data-robot]")) drawRobot(svg);
  followTheme(() => {});
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

showGallery();
