// The mechanism on the page: it stands at one configuration of C-space, is dragged by its joints or in a portrait, and keeps its place
// while the model changes.
import {Motion, boxAt, clearanceOf} from "./studio_motion.js";
import {drawnPoints} from "./mechanism.js";
import {coordinateTable, coordinateValue, coordinateValues, htmlLabel, numberText} from "./values.js";

const grip = 60, // how near to a joint a pointer has to be, in a picture of width 400
  hold = 16, // to the mark in a portrait, in pixels
  nudge = 6; // pixels of a portrait that a key moves the mechanism
const names = {forward: "a forward singularity", inverse: "an inverse singularity"};

export class Bench {
  // `panel` shows the mechanism. `portraits`: those that are there.
  constructor(panel, portraits, root) {
    Object.assign(this, {panel, portraits});
    this.warning = root.querySelector("#warning");
    this.clearance = root.querySelector("#clearance");
    this.residual = root.querySelector("#residual");
    this.x = null; // the variables of C-space
    this.dragging = null;
    this.listenToPicture(root.querySelector(".picture"));
    portraits.forEach((portrait) => this.listenToPortrait(portrait));
  }

  get cspace() {
    return this.model.sets.find(({singular}) => !singular) ?? null;
  }

  // Another model: the mechanism goes to the configuration nearest to where it was, or where there is none to `otherwise()`, a vector of
  // C-space's variables, or null.
  setModel(model, otherwise) {
    const before = this.x && this.variables.map((name, j) => [name, this.x[j]]);
    this.model = model;
    this.motion = new Motion(model);
    this.variables = model.sets[0].variables.slice(0, model.sets[0].configuration);
    let found = null;
    if (before) {
      const values = new Map(before);
      if (this.variables.every((name) => values.has(name))) {
        found = this.motion.onto(Float64Array.from(this.variables, (name) => values.get(name)));
        if (!(found.residual < 1e-9) || !this.motion.isWithin(found.x)) found = null;
      }
    }
    if (!found) {
      const x = otherwise();
      if (x) found = this.motion.onto(x);
    }
    this.x = found?.x ?? null;
    if (found) this.show(found);
  }

  // Draws the mechanism at a point of C-space: {x, residual}.
  show({x, residual}) {
    const {panel, cspace} = this;
    if (cspace && cspace.count > 0) {
      panel.show({set: cspace, box: boxAt(cspace, x).box, x, residual, moved: true});
    } else {
      const values = coordinateValues(this.model, x);
      panel.picture.show(values, null);
      panel.text.innerHTML = coordinateTable(this.model, values);
      panel.onShow({set: this.model.sets[0], box: -1, x, residual});
    }
  }

  // The panel shows a configuration, whoever chose it.
  take({set, x, residual}) {
    this.x = Float64Array.from(x.slice(0, set.configuration));
    this.residual.textContent = Number.isFinite(residual) ? residual.toExponential(0).replace("-", "−") : "–";
    this.residualNow = residual;
    this.showClearance();
  }

  // Over the outputs, of forward, inverse and other loci.
  nearestTo(model, x) {
    const outputs = model.coordinates.filter(({role}) => role === "output");
    const loci = model.sets.filter(({singular, locked}) => singular && locked.length > 0);
    return outputs.length === 0 || loci.length === 0 ? null : {...clearanceOf(loci, x, outputs), outputs};
  }
  distanceAt(model, x) {
    return this.nearestTo(model, x)?.distance ?? 0;
  }

  showClearance() {
    const nearest = this.nearestTo(this.model, this.x);
    if (!nearest) {
      this.clearance.textContent = "–";
      return;
    }
    const {distance, set, outputs} = nearest;
    const unit =
      outputs.every(({cosine}) => cosine === undefined) && this.model.drawing.unit ? ` ${this.model.drawing.unit}` : "";
    this.nearest = distance;
    this.clearance.innerHTML =
      distance === Infinity
        ? "no singularity at all"
        : `≥ ${numberText(distance, 3)}${unit} <small>over ${outputs.map(htmlLabel).join(", ")}; nearest: ${set.title.toLowerCase()}, in any mode</small>`;
  }

  // Towards a target, at most once a frame.
  moveTo(target) {
    this.wanted = target;
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = null;
      if (this.x && this.wanted) this.moveNow(this.wanted);
    });
  }

  moveNow(target) {
    const window = this.panel.picture.window;
    const result = this.motion.move(this.x, target, window ? Math.max(window[2] - window[0], window[3] - window[1]) / 4 : 1);
    this.show(result);
    if (result.crossed.length > 0) this.warn(result.crossed);
    return result;
  }

  warn(kinds) {
    this.warning.textContent = `On its way the mechanism met ${kinds.map((kind) => names[kind]).join(" and ")}.`;
    this.warning.dataset.kind = kinds[0];
  }

  begin() {
    this.panel.player.stop();
    this.panel.pinned = true;
    this.warning.textContent = "";
    delete this.warning.dataset.kind;
  }

  // The modes over the place where the mechanism is now, among which its own is marked.
  end() {
    this.dragging = null;
    this.wanted = null;
    const portrait = this.portraits[0],
      {cspace} = this;
    if (!portrait?.picture.plane || !cspace) return;
    const candidates = portrait.picture.candidates(portrait.picture.axes.map((axis) => coordinateValue(this.x, axis)));
    const {box} = boxAt(cspace, this.x);
    const own = candidates.findIndex(({set, boxes}) => set === cspace && boxes.includes(box));
    this.panel.list(candidates);
    if (own >= 0) this.panel.mark(own);
    this.panel.showState();
  }

  listenToPicture(root) {
    const place = (event) => {
      const {svg, window} = this.panel.picture;
      if (!svg || !window || !svg.getScreenCTM()) return null; // in space a pointer turns the view
      const {x, y} = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      const scale = 400 / (window[2] - window[0]);
      return {at: [window[0] + x / scale, window[3] - y / scale], scale};
    };
    root.addEventListener("pointerdown", (event) => {
      const where = this.x && place(event);
      if (!where) return;
      let best = null;
      drawnPoints(this.model, coordinateValues(this.model, this.x)).forEach(({position, named}, i) => {
        const far = Math.hypot(position[0] - where.at[0], position[1] - where.at[1]) * where.scale;
        const fixed = this.model.drawing.points[i].at.every((tree) => typeof tree === "number");
        if (named && !fixed && far < grip && (!best || far < best.far)) best = {i, far};
      });
      if (!best) return;
      event.preventDefault();
      root.setPointerCapture(event.pointerId);
      this.begin();
      this.dragging = {point: best.i};
    });
    root.addEventListener("pointermove", (event) => {
      if (this.dragging?.point === undefined) return;
      this.moveTo(this.motion.ofPoint(this.dragging.point, place(event).at));
    });
    for (const name of ["pointerup", "pointercancel"])
      root.addEventListener(name, () => this.dragging?.point !== undefined && this.end());
  }

  listenToPortrait(portrait) {
    const {frame} = portrait;
    const place = (event) => {
      const box = portrait.overlay.getBoundingClientRect();
      return portrait.picture.plane.fromPixels(event.clientX - box.left, event.clientY - box.top);
    };
    const target = (at) => this.motion.ofValues(Object.fromEntries(portrait.picture.axes.map(({name}, k) => [name, at[k]])));
    const here = () => portrait.picture.axes.map((axis) => coordinateValue(this.x, axis));
    frame.addEventListener("pointerdown", (event) => {
      if (!this.x || !portrait.picture.plane) return;
      const {plane} = portrait.picture,
        [x, y] = place(event),
        [u, v] = here();
      if (Math.hypot((x - u) * plane.sx, (y - v) * plane.sy) > hold) return;
      frame.setPointerCapture(event.pointerId);
      this.begin();
      this.dragging = {portrait};
    });
    frame.addEventListener("pointermove", (event) => {
      if (this.dragging?.portrait !== portrait) return;
      this.dragged = true;
      this.moveTo(target(place(event)));
    });
    for (const name of ["pointerup", "pointercancel"])
      frame.addEventListener(name, () => this.dragging?.portrait === portrait && this.end());
    // The end of a drag is no click.
    frame.addEventListener(
      "click",
      (event) => {
        if (this.dragged) event.stopImmediatePropagation();
        this.dragged = false;
      },
      true,
    );
    frame.addEventListener(
      "keydown",
      (event) => {
        const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
        if (!steps || !event.altKey || !this.x) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        const {sx, sy} = portrait.picture.plane,
          [u, v] = here();
        this.begin();
        this.moveNow(target([u + (steps[0] * nudge) / sx, v + (steps[1] * nudge) / sy]));
        this.end();
      },
      true,
    );
  }
}
