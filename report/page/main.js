// Puts the page together.
import {aspectLegend, readAspects} from "./aspects.js";
import {axisOrder, firstOf} from "./axis_choice.js";
import {readModel} from "./data.js";
import {mechanismPicture} from "./mechanism_picture.js";
import {Panel} from "./panel.js";
import {Portrait} from "./portrait.js";
import {clearest, sampleConfigurations} from "./samples.js";
import {Space} from "./space.js";
import {followTheme, takeTheme} from "./theme.js";

function main() {
  takeTheme();
  const model = readModel();
  readAspects(model);
  const filled = (test = () => true) => model.sets.find((set) => set.count > 0 && test(set));
  const samples = sampleConfigurations(model, filled((set) => !set.singular) || filled(), 300);
  const everywhere = model.sets.flatMap((set) => sampleConfigurations(model, set, 150));
  const typical = clearest(model, samples);
  let hero = null;
  if (typical && model.drawing.points.length > 0) {
    hero = mechanismPicture(document.querySelector("#mechanism svg"), model, [typical.values], 0.9);
    hero.show(typical.values, null);
  } else {
    document.body.classList.add("undrawn");
  }

  const order = axisOrder(model),
    views = [];
  const panel = new Panel(
    model,
    document.getElementById("panel"),
    everywhere.map(({values}) => values),
    (configuration) => {
      for (const portrait of views) portrait.show(configuration);
      if (space) space.mark(configuration);
    },
  );
  const listener = {
    hover: (candidates, place, portrait) => panel.hover(candidates, place, portrait),
    pin: (candidates, place, portrait) => panel.pin(candidates, place, portrait),
    step: (direction) => panel.step(direction),
    escape: () => panel.unpin(),
  };
  let space = null;
  for (const role of ["output", "input"]) {
    const root = document.getElementById(`${role}-portrait`);
    if (order.length > 1) views.push(new Portrait(model, root, firstOf(order, model, role), listener));
    else root.remove();
  }
  const three = [...new Set([...order, 0, 1, 2].filter((i) => i < model.coordinates.length))].slice(0, 3);
  if (three.length === 3) {
    space = new Space(model, document.getElementById("space"), three, (set, box) => panel.pinBox(set, box));
  } else {
    document.getElementById("space").remove();
  }

  for (const box of document.querySelectorAll("input.toggle")) {
    box.addEventListener("change", () => {
      for (const drawn of [...views, space].filter(Boolean)) drawn.hidden[box.checked ? "delete" : "add"](box.value);
      for (const other of document.querySelectorAll(`input.toggle[value="${box.value}"]`)) other.checked = box.checked;
      for (const portrait of views) portrait.draw();
      if (space) space.build();
    });
  }
  if (model.aspects) {
    const redraw = () => {
      for (const portrait of views) portrait.draw();
      if (space) space.build();
    };
    const inPlane = (on) => views.forEach((portrait) => portrait.setByAspect(on));
    aspectLegend(model.aspects, document.getElementById("portraits"), inPlane, redraw);
    if (space) aspectLegend(model.aspects, document.getElementById("space"), (on) => (space.byAspect = on), redraw);
    if (space) space.build();
  }
  for (const button of document.querySelectorAll(".show-point"))
    button.addEventListener("click", () => showPoint(model, panel, button));
  followTheme(() => {
    for (const portrait of views) portrait.draw();
    if (space) space.build();
    for (const picture of [hero, panel.picture].filter(Boolean)) picture.redraw();
  });

  const first = clearest(model, sampleConfigurations(model, filled((set) => set.locked.includes("input")) || filled(), 100));
  if (first) panel.offer([{set: first.set, box: first.box}]);
  window.corank = {model, panel, hero, portraits: views, space};
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

// The box that holds the middle of an isolated point.
function showPoint(model, panel, button) {
  const row = button.closest("tr"),
    set = model.sets.find(({name}) => name === button.closest("section").dataset.set);
  const {bounds} = set.points[Number(row.dataset.point)];
  let best = 0,
    least = Infinity;
  for (let box = 0; box < set.count; ++box) {
    let far = 0;
    for (let j = 0; j < set.configuration; ++j)
      far = Math.max(far, Math.abs(set.middle(box, j) - (bounds[j][0] + bounds[j][1]) / 2));
    if (far < least) [best, least] = [box, far];
  }
  panel.pinBox(set, best);
  document.getElementById("portraits").scrollIntoView({behavior: "smooth"});
}

main();
