// The panel beside the portraits: the mechanism at the configuration that is pointed at or pinned, the assembly modes over that
// place, and what is known of it.
import {mechanismPicture} from "./mechanism_picture.js";
import {kernelVector, pointOfBoxes} from "./newton.js";
import {Player} from "./player.js";
import {coordinateTable, coordinateValues, groupedText, isAngle} from "./values.js";

const passageWords = {barrier: "barrier", traversable: "the output can pass", unproven: "passage open"};

export class Panel {
  // The picture has room for all `configurations`; `onShow(configuration)` is told what is drawn: {set, box, x}, or null.
  constructor(model, root, configurations, onShow) {
    this.model = model;
    this.onShow = onShow;
    this.picture = mechanismPicture(root.querySelector("svg"), model, configurations);
    this.player = new Player(this, root.querySelector(".player"));
    this.modes = root.querySelector(".modes");
    this.text = root.querySelector(".text");
    this.state = root.querySelector(".state");
    this.root = root;
    this.candidates = [];
    this.chosen = 0;
    this.pinned = false;
    root.querySelector(".unpin").addEventListener("click", () => this.unpin());
  }

  // Another model; what was shown is let go. `anew`: also the view in space.
  setModel(model, configurations, anew = false) {
    this.player.stop();
    const sameKind = this.model.drawing.dimension === model.drawing.dimension;
    this.model = model;
    this.current = null;
    this.player.offer(null);
    this.list([]);
    if (sameKind) {
      this.picture.setModel(model, configurations, anew);
    } else {
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      svg.setAttribute("role", "img");
      svg.setAttribute("aria-label", "The mechanism");
      this.root.querySelector(".picture").replaceChildren(svg);
      this.picture = mechanismPicture(svg, model, configurations);
    }
  }

  hover(candidates, place, portrait) {
    if (this.pinned) return;
    this.offer(candidates, place, portrait);
  }

  pin(candidates, place, portrait) {
    this.pinned = false;
    this.offer(candidates, place, portrait);
    this.pinned = candidates.length > 0;
    this.showState();
    if (this.pinned) this.player.locate();
  }

  // A configuration that is named elsewhere: a point of a table, a pick in space.
  pinBox(set, box) {
    this.pin([{set, box}]);
  }

  unpin() {
    this.player.stop();
    this.pinned = false;
    this.showState();
  }

  step(direction) {
    if (this.candidates.length === 0) return;
    this.choose((this.chosen + direction + this.candidates.length) % this.candidates.length);
    if (this.pinned) this.player.locate();
  }

  offer(candidates, place, portrait) {
    this.list(candidates);
    if (candidates.length > 0) this.choose(0);
    else this.showNothing(place, portrait);
  }

  // A button for each candidate, which may say at which `point` it is: {x, box, residual, moved}; none is chosen.
  list(candidates) {
    this.candidates = candidates;
    this.chosen = 0;
    this.modes.replaceChildren();
    candidates.slice(0, 24).forEach((candidate, k) => {
      const button = document.createElement("button");
      button.type = "button";
      button.className = `mode ${candidate.set.name}${candidate.set.singular ? " singular" : ""}`;
      button.textContent = k + 1;
      button.title = `${candidate.set.title}, box ${groupedText(candidate.box + 1)}`;
      button.addEventListener("click", () => {
        this.pinned = true;
        this.choose(k);
        this.player.locate();
      });
      this.modes.append(button);
    });
  }

  mark(k) {
    this.chosen = k;
    [...this.modes.children].forEach((button, i) => button.setAttribute("aria-pressed", String(i === k)));
  }

  choose(k) {
    this.mark(k);
    const candidate = this.candidates[k],
      {set, box, boxes = [box], point} = candidate;
    this.player.stop();
    this.show({set, ...(point ?? pointOfBoxes(set, boxes, this.conditions(candidate)))});
    this.player.offer(this.current);
  }

  // Over a surface the configuration is the one at the pointer: two equations more, x = value, or c sin θ − s cos θ = 0.
  conditions({set, place, axes}) {
    if (!place || set.dimension < 2) return [];
    return axes.map((axis, k) =>
      isAngle(axis)
        ? [
            [Math.sin(place[k]), axis.cosine, 1, 0],
            [-Math.cos(place[k]), axis.sine, 1, 0],
          ]
        : [[1, axis.index, 1, 0], [-place[k]]],
    );
  }

  show(configuration) {
    const {set, x} = configuration;
    this.current = configuration;
    const values = coordinateValues(this.model, x);
    this.picture.show(values, this.velocity(set, x));
    this.text.innerHTML = this.describe(configuration, values);
    this.showState();
    this.onShow(configuration);
  }

  // The rates of the coordinates, or the model's own, where ξ is a velocity.
  velocity(set, x) {
    if (set.columns.length === 0) return null;
    const names = this.model.rates || this.model.coordinates.map(({name}) => name);
    const rates = {},
      xi = kernelVector(set, x);
    set.columns.forEach((column, k) => (rates[names[column]] = set.scales[k] * xi[k]));
    const along = Object.entries(rates).reduce((sum, [name, rate]) => sum + rate * (this.rates?.[name] ?? 0), 0);
    if (along < 0) for (const name in rates) rates[name] *= -1; // −ξ is one as well: arrows shall not turn round
    this.rates = rates;
    return rates;
  }

  describe({set, box, residual, moved}, values) {
    const verdict = this.model.verdicts[set.verdicts[box]];
    const drawn = this.model.drawing.points.length > 0;
    const shown = drawn ? "Drawn at" : "Values at";
    const how = moved
      ? `${shown} a point in or next to the box, found by Newton’s method (residual ${residual.toExponential(0)}).`
      : `${shown} the middle of the box: Newton’s method found no point in it.`;
    const arrows =
      drawn && set.columns.length > 0 ? " Arrows: the velocity ξ that the locked joints cannot stop, not to scale." : "";
    const {aspects} = this.model;
    const aspect = aspects?.set === set ? aspects.htmlOf(box) : "";
    const types = [...set.typesOf(box), ...(set.passages ? [passageWords[set.passageOf(box)]] : [])].join(", ");
    return `<p class="headline"><span class="swatch ${set.name}"></span>${set.title} · box ${groupedText(box + 1)} of ${groupedText(
      set.count,
    )} · <span class="verdict ${verdict}">${verdict}</span>${types ? ` · ${types}` : ""}${aspect ? ` · ${aspect}` : ""}</p>${coordinateTable(this.model, values)}<p class="fine">${how}${arrows}</p>`;
  }

  showNothing(place, portrait) {
    this.player.stop();
    this.player.offer(null);
    this.picture.clear();
    this.current = null;
    const cspace = this.model.sets.find((set) => !set.singular);
    const proven = cspace && cspace.complete && cspace.dimension > 1;
    this.text.innerHTML = `<p class="headline">${portrait.placeText(place)}</p><p class="fine">${
      proven ? "No configuration has these values: every box lies elsewhere." : "No box lies there."
    }</p>`;
    this.showState();
    this.onShow(null);
  }

  showState() {
    this.root.classList.toggle("pinned", this.pinned);
    const n = this.candidates.length;
    this.state.textContent = n === 0 ? "" : n === 1 ? "one mode" : `${n} modes over this place`;
  }
}
