// The gallery's page: draws each robot where the page has its configuration.
import {drawMechanism, drawingWindow} from "./mechanism.js";
import {followTheme, takeTheme} from "./theme.js";
import {coordinateValues} from "./values.js";

// The rates of the coordinates, or the mechanism's own, that the kernel vector of a set stands for; null where there is none to draw.
function kernelRates(model, x) {
  const set = model.sets[0];
  if (!set || set.columns.length === 0) return null;
  const names = model.rates || model.coordinates.map(({name}) => name);
  return Object.fromEntries(set.columns.map((column, k) => [names[column], set.scales[k] * x[set.configuration + k]]));
}

function drawRobot(svg) {
  const {model, x} = JSON.parse(document.getElementById(`robot-${svg.dataset.robot}`).textContent);
  const values = coordinateValues(model, x);
  drawMechanism(svg, model, values, kernelRates(model, x), drawingWindow(model, [values]), {unit: 0.8});
}

function showGallery() {
  takeTheme();
  for (const svg of document.querySelectorAll("svg[data-robot]")) drawRobot(svg);
  followTheme(() => {});
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

showGallery();
