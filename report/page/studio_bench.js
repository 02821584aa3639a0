// The mechanism on the page: it stands at one configuration of C-space, is dragged by its joints or in a portrait, and keeps its place
// while the model changes.
import {Motion, boxAt, clearanceOf} from "./studio_motion.js";
import {drawnPoints} from "./mechanism.js";
import {coordinateTable, coordinateValue, coordinateValues, htmlLabel, numberText} from "./values.js";

const hold = 16, // how near to the mark in a portrait a pointer has to be, in pixels
  nudge = 6; // pixels of a portrait that a key moves the mechanism
const same = 1e-4; // of the variables of two modes, as far apart as that at most
const gap = (a, b) => a.reduce((most, value, j) => Math.max(most, Math.abs(value - b[j])), 0);
const names = {forward: "a forward singularity", inverse: "an inverse singularity"};

export class Bench {
  // `panel` shows the mechanism. `portraits`: those that are there.
  constructor(panel, portraits, root) {
    Object.assign(this, {panel, portraits});
    this.warning = root.querySelector("#warning");
    this.clearance = root.querySelector("#clearance");
    this.residual = root.querySelector("#residual");
    this.x = null; // the variables of C-space
    this.met = new Set(); // kinds of singularities since somebody chose the configuration
    this.dragging = null;
    this.listenToPicture(root.querySelector(".picture"));
    portraits.forEach((portrait) => this.listenToPortrait(portrait));
  }

  // Of the coordinates where it stands, in a list that is empty where it stands nowhere.
  get values() {
    return this.x ? [coordinateValues(this.model, this.x)] : [];
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

  // Another robot comes.
  forget() {
    this.x = null;
    this.say([]);
  }

  // Draws the mechanism at a point of C-space that it has moved to: {x, residual}.
  show({x, residual}) {
    const {panel, cspace, met} = this;
    if (cspace && cspace.count > 0) {
      panel.show({set: cspace, box: boxAt(cspace, x).box, x, residual, moved: true});
    } else {
      const values = coordinateValues(this.model, x);
      panel.picture.show(values, null);
      panel.text.innerHTML = coordinateTable(this.model, values);
      panel.onShow({set: this.model.sets[0], box: -1, x, residual});
    }
    this.say(met);
  }

  // The panel shows a configuration, whoever chose it.
  take({set, x, residual}) {
    this.say([]);
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
    const result = this.motion.move(this.x, target, this.panel.picture.typicalLength);
    this.show(result);
    this.say([...this.met, ...result.crossed], result.end);
    return result;
  }

  // Which singularities were met, and which coordinate is at an end of its range.
  say(kinds, end = null) {
    this.met = new Set(kinds);
    const [first] = this.met;
    const met = first ? `On its way the mechanism met ${[...this.met].map((kind) => names[kind]).join(" and ")}.` : "";
    const stopped = end ? `It stops where ${htmlLabel(end)} is at an end of its range.` : "";
    this.warning.innerHTML = [met, stopped].filter(Boolean).join(" ");
    if (first) this.warning.dataset.kind = first;
    else delete this.warning.dataset.kind;
  }

  hold(dragging) {
    this.begin();
    this.say([]);
    this.dragging = dragging;
  }

  begin() {
    this.panel.player.stop();
    this.panel.player.offer(null);
    this.panel.pinned = true;
  }

  // The modes over the place where the mechanism is now, among which its own is marked.
  end() {
    this.dragging = null;
    this.wanted = null;
    const portrait = this.portraits[0],
      {cspace} = this;
    if (!portrait?.picture.plane || !cspace) return;
    const modes = this.modesAt(portrait.picture);
    const own = modes.findIndex(({point}) => gap(point.x, this.x) < same);
    this.panel.list(modes);
    if (own >= 0) this.panel.mark(own);
    this.panel.showState();
  }

  // The configurations of C-space whose outputs are as they are now; without outputs, whose coordinates in the picture are. One for
  // each that Newton's method finds from the boxes over this place of the picture.
  modesAt(picture) {
    const {cspace, model, x} = this;
    const outputs = model.coordinates.filter(({role}) => role === "output"),
      kept = outputs.length > 0 ? outputs : picture.axes;
    const target = this.motion.ofValues(Object.fromEntries(kept.map((c) => [c.name, coordinateValue(x, c)])));
    const modes = [];
    for (const {set, boxes} of picture.candidates(picture.axes.map((axis) => coordinateValue(x, axis)))) {
      if (set !== cspace) continue;
      for (const box of boxes.slice(0, 40)) {
        const from = Float64Array.from({length: set.configuration}, (_, j) => set.middle(box, j));
        const point = this.motion.move(from, target, this.panel.picture.typicalLength);
        if (point.residual > 1e-9 || !(point.distance < 1e-9) || modes.some((mode) => gap(mode.point.x, point.x) < same)) continue;
        const at = boxAt(set, point.x).box;
        modes.push({set, box: at, point: {...point, box: at, moved: true}});
      }
    }
    return modes;
  }

  // The point that a pointer can take hold of: {point, off}, or null. `off`: in pixels from the pointer to it.
  pointAt(event) {
    const {picture} = this.panel,
      points = this.values.flatMap((values) => drawnPoints(this.model, values));
    let best = null,
      nearest = picture.grip;
    picture.onScreen(points).forEach(([x, y], point) => {
      const off = [x - event.clientX, y - event.clientY],
        far = Math.hypot(...off);
      const fixed = this.model.drawing.points[point].at.every((tree) => typeof tree === "number");
      if (points[point].named && !fixed && far < nearest) [best, nearest] = [{point, off}, far];
    });
    return best;
  }

  listenToPicture(root) {
    // Before the picture in space sees it: there a pointer on nothing turns the view.
    root.addEventListener(
      "pointerdown",
      (event) => {
        const found = this.pointAt(event);
        if (!found) return;
        event.preventDefault();
        event.stopPropagation();
        root.setPointerCapture(event.pointerId);
        this.hold(found);
      },
      true,
    );
    root.addEventListener("pointermove", (event) => {
      if (this.dragging?.point === undefined) return;
      const {point, off} = this.dragging,
        {place} = drawnPoints(this.model, coordinateValues(this.model, this.x))[point];
      const pixels = [event.clientX + off[0], event.clientY + off[1]];
      this.moveTo(this.motion.ofPoint(point, this.panel.picture.under(place, pixels)));
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
      this.hold({portrait});
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
