// Draws the mechanism in space at a configuration, with velocities as arrows; it can be turned and zoomed.
import {dot, drawLabels, drawnPoints} from "./mechanism.js";
import {Orbit} from "./orbit.js";
import {Solids, isPlace, pageMaterials} from "./solids.js";
import {litScene} from "./stage.js";

const thick = {bar: 0.026, edge: 0.016, rail: 0.012, joint: 0.044, ball: 0.05, hinge: 0.04, block: 0.1, pedestal: 0.12};
// The first view: to the right and up in the picture; and towards the eye.
const [firstView, towardsEye] = viewFrom(2.0, -3.1, 1.75);

function viewFrom(...eye) {
  const back = new THREE.Vector3(...eye).normalize(),
    right = new THREE.Vector3(0, 0, 1).cross(back).normalize();
  return [[right, back.clone().cross(right)], back];
}

export class SpatialMechanism {
  // Takes the place of an <svg>. The window holds the drawing at all these configurations.
  constructor(svg, model, configurations) {
    this.model = model;
    this.frame = document.createElement("div");
    this.frame.className = "solid";
    this.orbit = new Orbit(this.frame, {
      antialias: true,
      height: (width) => this.height(width),
      fov: () => 26,
      onDraw: () => this.label(),
    });
    this.orbit.renderer.shadowMap.enabled = true;
    this.letPageScroll();
    this.measure(configurations);
    this.addControls(svg);
    svg.replaceWith(this.frame);
    this.redraw();
    new ResizeObserver(() => this.resize()).observe(this.frame);
  }

  // The page scrolls when the wheel or a finger passes over the picture: it zooms once it is taken hold of, and one finger turns it
  // sideways only.
  letPageScroll() {
    const {controls, renderer} = this.orbit;
    controls.enableZoom = false;
    for (const name of ["pointerdown", "focus"]) this.frame.addEventListener(name, () => (controls.enableZoom = true), true);
    this.frame.addEventListener("focusout", () => (controls.enableZoom = false));
    renderer.domElement.style.touchAction = "pan-y";
    controls.touches.TWO = 3; // TOUCH.DOLLY_ROTATE
  }

  addControls(svg) {
    const label = svg.getAttribute("aria-label");
    this.frame.tabIndex = 0;
    this.frame.setAttribute("role", "application");
    this.frame.setAttribute("aria-label", `${label}, in space. Arrow keys turn it, plus and minus zoom.`);
    this.names = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.names.setAttribute("aria-hidden", "true");
    const reset = document.createElement("button");
    Object.assign(reset, {type: "button", className: "reset", textContent: "⟲", title: "The view as at first"});
    reset.setAttribute("aria-label", reset.title);
    reset.addEventListener("click", () => this.orbit.reset());
    this.frame.append(this.names, reset);
    this.sides = [];
  }

  // From the model's lengths to those of the scene: the origin is the middle of the first view, the longest half side 1.
  measure(configurations) {
    const {points, parts} = this.model.drawing;
    const radius = points.map(() => -1); // of points that nothing is drawn at
    for (const part of parts) {
      for (const i of part.kind === "hinge" ? part.points.slice(0, 1) : part.points)
        radius[i] = Math.max(radius[i], part.radius || 0);
    }
    const low = new THREE.Vector3(Infinity, Infinity, Infinity),
      high = low.clone().negate(),
      places = [];
    const every = Math.ceil((configurations.length * points.length) / 6000);
    configurations.forEach((values, k) => {
      if (k % every !== 0) return;
      drawnPoints(this.model, values).forEach(({place}, i) => {
        const at = new THREE.Vector3(...place);
        if (radius[i] < 0 || !isPlace(at)) return;
        places.push(at);
        low.min(at.clone().subScalar(radius[i]));
        high.max(at.clone().addScalar(radius[i]));
      });
    });
    if (places.length === 0) (low.set(-1, -1, -1), high.set(1, 1, 1));
    const size = high.clone().sub(low);
    this.scale = 2 / Math.max(size.x, size.y, size.z, 1e-9);
    this.middle = low.clone().add(high).multiplyScalar(0.5);
    const floor = low.z - (1.2 * thick.pedestal) / this.scale;
    this.reach = places.flatMap((at) => [at, new THREE.Vector3(at.x, at.y, floor)]).map((at) => this.toScene(at));
    this.extents = firstView.map((axis) => {
      const along = this.reach.map((at) => at.dot(axis)),
        [least, most] = [
          along.reduce((a, b) => Math.min(a, b), Infinity),
          along.reduce((a, b) => Math.max(a, b), -Infinity),
        ];
      return along.length > 0 ? [least, most] : [-1, 1];
    });
    const [right, up] = firstView.map((axis, k) =>
      axis.clone().multiplyScalar((this.extents[k][0] + this.extents[k][1]) / 2),
    );
    const shift = right.add(up);
    for (const at of this.reach) at.sub(shift);
    this.middle.addScaledVector(shift, 1 / this.scale);
    this.floor = (floor - this.middle.z) * this.scale;
  }

  setModel(model, configurations, anew = false) {
    this.model = model;
    this.measure(configurations);
    if (anew) {
      this.orbit.fitted = false;
      this.orbit.resize(true);
      this.standBack();
    }
    this.shown = null;
    this.redraw();
  }

  // As high as the mechanism is at first, in bounds.
  height(width) {
    const [right, up] = this.extents.map(([least, most]) => most - least + 0.4);
    return Math.round(Math.min(width * Math.min(1, Math.max(0.62, up / right)), 440));
  }

  toScene(place) {
    return place.clone().sub(this.middle).multiplyScalar(this.scale);
  }

  // As of a flat picture (mechanism_picture.js). What is dragged stays as deep as it is.
  get grip() {
    return 24;
  }
  get typicalLength() {
    return 0.5 / this.scale;
  }
  onScreen(points) {
    const {left, top} = this.orbit.renderer.domElement.getBoundingClientRect();
    return points.map(({place}) => {
      const [x, y] = this.orbit.project(this.toScene(new THREE.Vector3(...place)));
      return [left + x, top + y];
    });
  }
  under(place, [x, y]) {
    const {left, top} = this.orbit.renderer.domElement.getBoundingClientRect();
    const {directions, shift} = this.orbit.towards(this.toScene(new THREE.Vector3(...place)), [x - left, y - top]);
    return {
      directions,
      goals: directions.map((along, k) => dot(along, place) + shift[k] / this.scale),
    };
  }

  // The scene, in the colours of the theme.
  redraw() {
    const {parts, points} = this.model.drawing,
      paint = pageMaterials(this.frame),
      scene = litScene(this.floor, paint.grid);
    this.solids = new Solids(scene);
    this.hinges = new Set(parts.filter(({kind}) => kind === "hinge").map((part) => part.points[0]));
    for (const part of parts) this.addPart(part, paint);
    this.arrows = points.map((_, i) => this.solids.arrow(i, 0.017, paint.velocity));
    this.orbit.show(scene);
    if (this.shown) this.show(...this.shown);
    else this.clear();
  }

  addPart(part, paint) {
    const {solids} = this,
      [a, b, c] = part.points;
    const chain = (corners, radius, material) => {
      corners.forEach((i, k) => {
        solids.ball(i, radius, material);
        if (k > 0) solids.bar(corners[k - 1], i, radius, material);
      });
    };
    const each = (draw) => part.points.forEach(draw);
    switch (part.kind) {
      case "link":
        return chain(part.points, thick.bar, paint.of(part));
      case "platform":
        solids.sheet(part.points, paint.sheetOf(part));
        return chain([...part.points, a], thick.edge, paint.of(part));
      case "joint":
        return each((i) => solids.ball(i, thick.joint, paint.joint));
      case "ball":
        return each((i) => solids.ball(i, thick.ball, paint.joint));
      case "hinge":
        return solids.hinge(a, b, thick.hinge, paint.joint, paint.link);
      case "slider":
        chain([b, c], thick.rail, paint.rail);
        return solids.block(a, b, c, thick.block, paint.joint);
      case "ground":
        return each((i) => {
          solids.pedestal(i, thick.pedestal, paint.ground);
          if (!this.hinges.has(i)) solids.ball(i, thick.joint, paint.joint);
        });
      case "effector":
        return each((i) => {
          solids.ball(i, 1.3 * thick.joint, paint.effector);
          solids.ball(i, 2.3 * thick.joint, paint.halo, false);
        });
      case "sphere":
        return solids.ball(a, part.radius * this.scale, paint.of(part));
      case "cylinder":
        return solids.bar(a, b, part.radius * this.scale, paint.of(part));
    }
  }

  // `rates` may be null: no arrows. They stand at points with a name; the longest has a quarter of the window, ξ has no scale of its own.
  show(values, rates) {
    this.shown = [values, rates];
    this.points = drawnPoints(this.model, values, rates || {});
    this.at = this.points.map(({place}) => this.toScene(new THREE.Vector3(...place)));
    this.solids.pose(this.at);
    const motions = this.points.map(({motion}) => new THREE.Vector3(...motion)),
      speeds = motions.map((motion, i) => (this.points[i].named ? motion.length() : 0)),
      fastest = Math.max(0, ...speeds.filter(Number.isFinite));
    this.velocities = motions.map((motion, i) =>
      rates && fastest > 1e-9 && speeds[i] > 1e-6 * fastest ? motion.multiplyScalar(0.55 / fastest) : null,
    );
    this.arrows.forEach((arrow, i) => arrow(this.at, this.velocities[i]));
    this.orbit.scene.visible = true;
    this.orbit.render();
  }

  clear() {
    this.shown = this.at = null;
    this.orbit.scene.visible = false;
    this.orbit.render();
  }

  resize() {
    if (!this.orbit.resize()) return;
    this.standBack();
    this.orbit.render();
  }

  // As near as shows all of the window, with room for names; a view that somebody has turned stays.
  standBack() {
    const {camera} = this.orbit,
      [right, up] = firstView;
    const slopeUp = Math.tan((camera.fov * Math.PI) / 360),
      slopeRight = slopeUp * camera.aspect;
    let far = 2;
    for (const p of this.reach) {
      const away = p.dot(towardsEye);
      far = Math.max(far, away + (Math.abs(p.dot(right)) + 0.2) / slopeRight, away + (Math.abs(p.dot(up)) + 0.2) / slopeUp);
    }
    const eye = towardsEye.clone().multiplyScalar(far).toArray();
    if (this.orbit.fitted) this.orbit.home = eye;
    else this.orbit.look(eye);
    this.orbit.fitted = true;
  }

  // Names beside their points, where they hide little.
  label() {
    const {clientWidth: width, clientHeight: height} = this.orbit.renderer.domElement;
    this.names.replaceChildren();
    if (!this.at || !width) return;
    this.names.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const at = this.at.map((point) => this.orbit.project(point));
    const bars = this.model.drawing.parts
      .filter(({kind}) => ["link", "platform", "cylinder"].includes(kind))
      .flatMap(({points}) => points.slice(1).map((b, k) => [at[points[k]], at[b]]));
    const arrows = this.velocities.flatMap((vector, i) =>
      vector ? [[at[i], this.orbit.project(this.at[i].clone().add(vector))]] : [],
    );
    const feet = this.model.drawing.parts
      .filter(({kind}) => kind === "ground")
      .flatMap(({points}) =>
        points.map((i) => [at[i], this.orbit.project(this.at[i].clone().setZ(this.at[i].z - thick.pedestal))]),
      );
    drawLabels(this.names, this.points, at, [...bars, ...arrows, ...feet], 0.95, width, height, this.sides);
  }
}
