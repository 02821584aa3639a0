// The page of a path: the mechanism moves along it; or, where there is none, stands at both ends.
import {axisOrder, firstOf} from "./axis_choice.js";
import {readModel} from "./data.js";
import {mechanismPicture} from "./mechanism_picture.js";
import {Playback} from "./playback.js";
import {Portrait} from "./portrait.js";
import {RadiusPlot} from "./radius_plot.js";
import {followTheme, takeTheme} from "./theme.js";
import {Trace} from "./trace.js";
import {TubeCurve} from "./tube.js";
import {coordinateTable, coordinateValues, groupedText, numberText} from "./values.js";

const reachOfClick = 40; // pixels

class PathShow {
  constructor(model, path) {
    this.model = model;
    this.ends = path.ends;
    this.avoided = path.avoided;
    this.text = document.getElementById("panel-text");
    this.curve = path.nodes.length > 0 ? new TubeCurve(model.constraints, path) : null;
    this.samples = this.curve ? this.curve.samples() : [];
    this.trace = new Trace(
      this.samples.map(({x}) => x),
      this.ends,
    );
    this.drawMechanisms(this.trace.points.map((x) => coordinateValues(model, x)));
    this.addPortraits();
    if (this.curve) this.addPlayer();
    else this.showEnds();
  }

  drawMechanisms(configurations) {
    if (this.model.drawing.points.length === 0) document.body.classList.add("undrawn");
    this.pictures = [...document.querySelectorAll("#panel .picture svg")].map((svg) =>
      mechanismPicture(svg, this.model, configurations),
    );
  }

  addPortraits() {
    const order = axisOrder(this.model);
    const listener = {
      hover: () => {},
      step: () => {},
      escape: () => {},
      pin: (_, place, portrait) => this.goTo(place, portrait),
    };
    this.portraits = [];
    for (const role of ["output", "input"]) {
      const root = document.getElementById(`${role}-portrait`);
      if (order.length < 2) root.remove();
      else this.portraits.push(new Portrait(this.model, root, firstOf(order, this.model, role), listener, this.trace));
    }
  }

  addPlayer() {
    this.player = new Playback(this, document.querySelector(".player"));
    this.player.curve = this.curve;
    this.plot = new RadiusPlot(document.querySelector(".radius svg"), this.curve, (t) => this.player.seek(t));
    this.rows = [...document.querySelectorAll("#waypoints tbody tr")];
    this.rows.forEach((row, k) => row.addEventListener("click", () => this.player.seek(this.curve.starts[k])));
    this.player.seek(0);
  }

  goTo(place, portrait) {
    const sample = this.trace.nearest(place, portrait.picture, reachOfClick);
    if (sample >= 0) this.player.seek(this.samples[sample].t);
  }

  show(configuration) {
    const {x, t, piece, moved} = configuration,
      values = coordinateValues(this.model, x),
      count = this.curve.pieces.length;
    this.current = configuration;
    for (const picture of this.pictures) picture.show(values, null);
    for (const portrait of this.portraits) portrait.show({x});
    this.plot.show(t);
    this.rows.forEach((row, k) => row.classList.toggle("current", k === piece));
    const how = moved
      ? "A point of the proven tube, found by Newton’s method."
      : "Newton’s method found no point of the tube here.";
    this.text.innerHTML = `<p class="headline">piece ${groupedText(piece + 1)} of ${groupedText(count)} · no ${this.avoided} within ${numberText(
      this.curve.pieces[piece].radius,
      3,
    )}</p>${coordinateTable(this.model, values)}<p class="fine">${how}</p>`;
  }

  showEnds() {
    this.ends.forEach((x, end) => this.pictures[end].show(coordinateValues(this.model, x), null));
  }

  redraw() {
    for (const portrait of this.portraits) portrait.draw();
    for (const picture of this.pictures) picture.redraw();
  }
}

function showPath() {
  takeTheme();
  const show = new PathShow(readModel(), JSON.parse(document.getElementById("path").textContent));
  for (const box of document.querySelectorAll("input.toggle")) {
    box.addEventListener("change", () => {
      for (const portrait of show.portraits) {
        portrait.hidden[box.checked ? "delete" : "add"](box.value);
        portrait.draw();
      }
    });
  }
  followTheme(() => show.redraw());
  window.corank = {show, model: show.model};
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

showPath();
