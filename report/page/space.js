// The 3-D view: C-space and loci in any three coordinates, as points or boxes, by three.js.
import {boxCloud, nameSprite, pointCloud, ringSprite, setDetail} from "./cloud.js";
import {Orbit, offersSpace} from "./orbit.js";
import {pageColours} from "./picture.js";
import {coordinateInterval, coordinateValue, fullTurn, groupedText, isAngle, plainLabel, wrapped} from "./values.js";

export class Space {
  constructor(model, root, axes, onPick) {
    this.model = model;
    this.root = root;
    this.frame = root.querySelector(".frame");
    this.note = root.querySelector(".note");
    this.selects = [...root.querySelectorAll("select.axis")];
    this.form = root.querySelector("select.form");
    this.onPick = onPick;
    this.hidden = new Set();
    this.byAspect = false;
    this.fillSelects(axes);
    this.form.addEventListener("change", () => this.build());
    if (!this.start()) return;
    this.build();
    new ResizeObserver(() => this.resize()).observe(this.frame);
  }

  fillSelects(axes) {
    this.selects.forEach((select, k) => {
      select.replaceChildren();
      this.model.coordinates.forEach((coordinate, i) =>
        select.add(new Option(plainLabel(coordinate), i, false, i === axes[k])),
      );
      select.onchange = () => this.build();
    });
  }

  // Another model, with the same axes where the coordinates have the same names; `axes`: else.
  setModel(model, axes) {
    const names = ({coordinates}) => coordinates.map(({name}) => name).join();
    const same = names(model) === names(this.model);
    this.model = model;
    this.shown = null;
    if (!same) this.fillSelects(axes);
    this.build();
  }

  start() {
    const height = (width) => Math.max(300, Math.round(Math.min(0.62 * width, 560)));
    const fov = (aspect) => (aspect > 1.2 ? 24 : 29); // a narrow window would cut the sides off
    const onDraw = () => (this.root.dataset.frames = Number(this.root.dataset.frames || 0) + 1);
    if (!offersSpace()) {
      this.frame.innerHTML = `<p class="fallback">This browser offers no WebGL, which the view in space needs. All else on this page works without.</p>`;
      this.root.dataset.webgl = "none";
      return false;
    }
    this.orbit = new Orbit(this.frame, {height, fov, onTurn: (turning) => this.turn(turning), onDraw});
    this.root.dataset.webgl = "yes";
    this.listen();
    return true;
  }

  // Brings the axes' ranges into a cube of side 1; lengths share one scale.
  measure() {
    const side = [0, 0];
    this.axes = this.selects.map((select) => this.model.coordinates[Number(select.value)]);
    this.ranges = this.axes.map((axis) => {
      if (isAngle(axis)) return [-Math.PI, Math.PI];
      let low = Infinity,
        high = -Infinity;
      for (const set of this.model.sets) {
        for (let box = 0; box < set.count; ++box) {
          coordinateInterval(set, box, axis, side);
          low = Math.min(low, side[0]);
          high = Math.max(high, side[1]);
        }
      }
      return low < high ? [low, high] : [low - 1, low + 1];
    });
    const longest = Math.max(...this.ranges.map(([a, b], k) => (isAngle(this.axes[k]) ? 0 : b - a)));
    this.scales = this.ranges.map(([a, b], k) => (isAngle(this.axes[k]) ? 1 / (b - a) : 1 / longest));
  }

  toCube(value, k) {
    const [low, high] = this.ranges[k];
    return (value - (low + high) / 2) * this.scales[k];
  }

  build() {
    if (!this.orbit) return;
    this.measure();
    this.scene = new THREE.Scene();
    this.colours = pageColours(this.root);
    this.clouds = this.model.sets.filter((set) => !this.hidden.has(set.name) && set.count > 0).map((set) => this.cloud(set));
    for (const {object} of this.clouds) this.scene.add(object);
    this.addFrame();
    this.marker = ringSprite(this.colours.ink, this.colours.card);
    this.marker.visible = false;
    this.scene.add(this.marker);
    this.orbit.show(this.scene);
    this.mark(this.shown);
    this.resize(true);
  }

  // Middles and extents of a set's boxes in the cube; what was not searched is left out.
  cloud(set) {
    const pending = this.model.verdicts.indexOf("pending");
    const aspects = this.byAspect && this.model.aspects?.set === set ? this.model.aspects : null;
    const owners = Uint32Array.from(set.verdicts.keys()).filter(
      (box) => set.verdicts[box] !== pending && (!aspects || aspects.isShown(box)),
    );
    const middles = new Float32Array(3 * owners.length);
    const extents = new Float32Array(3 * owners.length);
    const side = [0, 0];
    owners.forEach((box, i) => {
      for (let k = 0; k < 3; ++k) {
        const [low, high] = coordinateInterval(set, box, this.axes[k], side);
        const middle = (low + high) / 2;
        middles[3 * i + k] = this.toCube(isAngle(this.axes[k]) ? wrapped(middle) : middle, k);
        extents[3 * i + k] = Math.min(high - low, isAngle(this.axes[k]) ? fullTurn : Infinity) * this.scales[k];
      }
    });
    const make = this.form.value === "boxes" ? boxCloud : pointCloud;
    const plain = this.colours.of(set);
    const colourOf = (i) => (aspects ? aspects.colourOfBox(owners[i], plain) : plain);
    const object = make(set, middles, extents, colourOf, aspects ? "coloured" : "plain");
    object.renderOrder = set.singular ? 2 : 1;
    return {set, owners, middles, object};
  }

  addFrame() {
    const half = this.ranges.map(([a, b], k) => ((b - a) / 2) * this.scales[k]),
      lines = [];
    for (let axis = 0; axis < 3; ++axis) {
      for (const u of [-1, 1]) {
        for (const v of [-1, 1]) {
          for (const end of [-1, 1]) {
            const corner = [0, 0, 0];
            corner[axis] = end * half[axis];
            corner[(axis + 1) % 3] = u * half[(axis + 1) % 3];
            corner[(axis + 2) % 3] = v * half[(axis + 2) % 3];
            lines.push(...corner);
          }
        }
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(lines), 3));
    this.scene.add(
      new THREE.LineSegments(
        geometry,
        new THREE.LineBasicMaterial({color: this.colours.line, transparent: true, opacity: 0.7}),
      ),
    );
    this.axes.forEach((axis, k) => {
      const name = nameSprite(axis.label, this.colours.ink, 0.1);
      const at = [0, 0, 0];
      // x and y along the lower front edges, z along a vertical one.
      at[(k + 1) % 3] = -half[(k + 1) % 3];
      at[(k + 2) % 3] = -half[(k + 2) % 3];
      if (k === 0) at[1] -= 0.1;
      if (k === 1) ((at[0] = half[0] + 0.1), (at[2] = -half[2]));
      if (k === 2) at[0] = -half[0] - 0.09;
      name.position.set(...at);
      this.scene.add(name);
    });
  }

  resize(force) {
    if (!this.orbit.resize(force)) return;
    for (const {object} of this.clouds) {
      if (object.material.uniforms) object.material.uniforms.pixels.value = 0.5 * this.orbit.renderer.domElement.height;
    }
    this.orbit.render();
  }

  turn(turning) {
    for (const {set, owners, object} of this.clouds) setDetail(set, object, owners.length, turning);
    this.orbit.render();
  }

  mark(configuration) {
    this.shown = configuration;
    if (!this.marker) return;
    this.marker.visible = Boolean(configuration);
    if (configuration)
      this.marker.position.set(...this.axes.map((axis, k) => this.toCube(coordinateValue(configuration.x, axis), k)));
    this.orbit.render(true);
  }

  // The box whose middle is nearest to a place of the canvas, singular ones first; null where none is within some pixels.
  nearest(px, py) {
    const {clientWidth: width, clientHeight: height} = this.orbit.renderer.domElement,
      at = new THREE.Vector3();
    let best = null;
    for (const {set, owners, middles} of this.clouds) {
      for (let i = 0; i < owners.length; ++i) {
        at.set(middles[3 * i], middles[3 * i + 1], middles[3 * i + 2]).project(this.orbit.camera);
        const distance = Math.hypot(((at.x + 1) / 2) * width - px, ((1 - at.y) / 2) * height - py);
        if (distance > 10) continue;
        // Nearer to the eye wins among boxes at about the same place.
        const cost = distance + 60 * at.z - (set.singular ? 6 : 0);
        if (!best || cost < best.cost) best = {set, box: owners[i], cost};
      }
    }
    return best;
  }

  listen() {
    const canvas = this.orbit.renderer.domElement;
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
    canvas.addEventListener("click", (event) => {
      if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return; // the end of an orbit
      const box = canvas.getBoundingClientRect();
      const found = this.nearest(event.clientX - box.left, event.clientY - box.top);
      this.note.textContent = found ? `Picked: ${found.set.title}, box ${groupedText(found.box + 1)}` : "";
      if (found) this.onPick(found.set, found.box);
    });
  }
}
