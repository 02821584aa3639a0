// The pictures of a model: portraits, the view in space, and the mechanism.
import {Aspects, aspectItems} from "./aspects.js";
import {axisOrder, firstOf} from "./axis_choice.js";
import {pointOfBox} from "./newton.js";
import {Panel} from "./panel.js";
import {Portrait} from "./portrait.js";
import {clearest, sampleConfigurations} from "./samples.js";
import {Space} from "./space.js";
import {Bench} from "./studio_bench.js";
import {htmlText, isAngle} from "./values.js";

export const element = (id) => document.getElementById(id);

const rest = 250; // ms without a change, until the modes are looked for and the view in space is drawn
const samplesOfSet = 80;

// Of one role lengths come before angles: a place in the plane is what one looks for first.
function rankOf({coordinates}, i) {
  return 2 * ["output", "input", "passive", "auxiliary"].indexOf(coordinates[i].role) + (isAngle(coordinates[i]) ? 1 : 0);
}

export class Sights {
  constructor() {
    this.model = null;
    this.samples = null; // configurations here and there in C-space
  }

  // Another robot comes: nothing is kept of where the mechanism is.
  forget() {
    this.samples = null;
    this.anew = true;
    this.bench?.forget();
  }

  draw(model) {
    this.model = model;
    document.querySelector("#portraits .aspects-legend").hidden = !model.aspects;
    const order = axisOrder(model).sort((a, b) => rankOf(model, a) - rankOf(model, b));
    const filled = model.sets.filter(({count}) => count > 0);
    const base = filled.find(({singular}) => !singular) ?? filled[0];
    document.body.classList.toggle("undrawn", model.drawing.points.length === 0);
    if (!this.samples || !model.partial) this.samples = sampleConfigurations(model, base, samplesOfSet);
    const everywhere = [...this.samples.map(({values}) => values), ...(this.bench?.values ?? [])];
    if (!this.panel) this.build(model, order, everywhere);
    else {
      for (const [role, portrait] of this.views) portrait.setModel(model, firstOf(order, model, role), this.anew);
      this.panel.setModel(model, everywhere, this.anew);
    }
    this.anew = false;
    this.showSpaceLater(model, [...new Set([...order, 0, 1, 2])].slice(0, 3));
    this.bench.setModel(model, () => (model.partial ? null : this.typical()));
    clearTimeout(this.settling);
    this.settling = setTimeout(() => !this.bench.dragging && this.bench.x && this.bench.end(), rest);
  }

  build(model, order, everywhere) {
    this.panel = new Panel(model, element("panel"), everywhere, (configuration) => {
      for (const [, portrait] of this.views) portrait.show(configuration);
      this.space?.mark(configuration);
      if (configuration) this.bench.take(configuration);
    });
    const listener = {
      hover: () => {},
      pin: (candidates, place, portrait) => candidates.length > 0 && this.panel.pin(candidates, place, portrait),
      step: (direction) => this.panel.step(direction),
      escape: () => this.panel.unpin(),
    };
    this.views = ["output", "input"].map((role) => [
      role,
      new Portrait(model, element(`${role}-portrait`), firstOf(order, model, role), listener),
    ]);
    this.bench = new Bench(
      this.panel,
      this.views.map(([, portrait]) => portrait),
      element("panel"),
    );
  }

  // The view in space takes longest to draw: it comes when nothing has changed for a while, and shows nothing until then.
  showSpaceLater(model, three) {
    const root = element("space");
    root.hidden = model.coordinates.length < 3;
    root.classList.add("waiting");
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (model !== this.model || model.partial || root.hidden) return;
      if (this.space) this.space.setModel(model, three);
      else this.space = new Space(model, root, three, (set, box) => this.panel.pinBox(set, box));
      this.space.mark(this.panel.current);
      root.classList.remove("waiting");
    }, rest);
  }

  // A configuration to begin with: clear to see, and not next to a singularity.
  typical() {
    const far = this.samples
      .map((sample) => ({...sample, distance: this.bench.distanceAt(this.model, pointOfBox(sample.set, sample.box).x)}))
      .sort((a, b) => b.distance - a.distance);
    const sample = clearest(this.model, far.slice(0, Math.ceil(far.length / 3)));
    return sample && Float64Array.from({length: sample.set.configuration}, (_, j) => sample.set.middle(sample.box, j));
  }

  // Colours of C-space's boxes, as the server has them, or null; `words`: what is known.
  showColours(colours, words) {
    const {model} = this,
      cspace = model.sets.find(({singular}) => !singular),
      list = document.querySelector("#portraits .aspects-legend");
    model.aspects = colours && cspace ? new Aspects(cspace, colours) : null;
    list.replaceChildren();
    if (model.aspects) aspectItems(model.aspects, list, () => this.redraw());
    for (const [, portrait] of this.views) portrait.setByAspect(Boolean(model.aspects));
    list.hidden = false;
    if (this.space) this.space.byAspect = Boolean(model.aspects);
    list.insertAdjacentHTML("afterbegin", `<span class="item">${htmlText(words)}</span>`);
    this.redraw();
  }

  // In the colours of the theme, and of the aspects.
  redraw() {
    if (!this.model) return;
    for (const [, portrait] of this.views) portrait.draw();
    this.space?.build();
    this.panel.picture.redraw();
  }
}
