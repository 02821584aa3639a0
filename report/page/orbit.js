// Does the browser offer WebGL?
export function offersSpace() {
  offersSpace.answer ??= Boolean(document.createElement("canvas").getContext("webgl2"));
  return offersSpace.answer;
}

// A picture in space that one can turn and zoom: a canvas of three.js in a frame, drawn anew when something has changed.
export class Orbit {
  // `height(width)` of the canvas, `fov(aspect)` in degrees; `onTurn(turning)` when a turn begins and ends, `onDraw()` after a drawing.
  constructor(frame, {antialias = false, height, fov, onTurn = () => {}, onDraw = () => {}}) {
    this.renderer = new THREE.WebGLRenderer({antialias, alpha: true, preserveDrawingBuffer: true});
    Object.assign(this, {frame, height, fov, onDraw});
    frame.append(this.renderer.domElement);
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.05, 50);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.look([2.0, -3.1, 1.75]);
    this.controls.addEventListener("change", () => this.render());
    this.controls.addEventListener("start", () => onTurn(true));
    this.controls.addEventListener("end", () => onTurn(false));
    frame.addEventListener("keydown", (event) => this.key(event));
    this.seen = true;
    new IntersectionObserver((entries) => {
      this.seen = entries[entries.length - 1].isIntersecting;
      if (this.seen && this.stale) this.render();
    }).observe(frame);
  }

  // Where the eye is, and what reset() goes back to; it looks at the origin.
  look(eye) {
    this.home = eye;
    this.reset();
  }

  reset() {
    this.camera.position.set(...this.home);
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.render();
  }

  // Shows a scene; gives back what the former one holds of the graphics card.
  show(scene) {
    this.discard();
    this.scene = scene;
  }

  discard() {
    if (!this.scene) return;
    this.scene.traverse(({geometry, material, shadow}) => {
      if (geometry) geometry.dispose();
      if (material && material.map) material.map.dispose();
      if (material) material.dispose();
      if (shadow) shadow.dispose();
    });
  }

  // Is it another size?
  resize(force) {
    const width = this.frame.clientWidth,
      height = this.height(width);
    if (!width || (!force && width === this.width)) return false;
    this.width = width;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.fov = this.fov(this.camera.aspect);
    this.camera.updateProjectionMatrix();
    return true;
  }

  // Draws with the next frame. What nobody sees can wait: `lazily`.
  render(lazily = false) {
    if (!this.scene || this.waiting) return;
    this.stale = lazily && !this.seen;
    if (this.stale) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
      this.onDraw();
    });
  }

  // The place of the canvas, in its pixels, where a point is seen.
  project(point) {
    const {clientWidth: width, clientHeight: height} = this.renderer.domElement;
    const at = point.clone().project(this.camera);
    return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
  }

  // The view's directions to the right and up, and how far a point has to go along them to be seen at a place of the canvas.
  towards(point, [x, y]) {
    const {clientWidth: width, clientHeight: height} = this.renderer.domElement,
      {camera} = this;
    camera.updateMatrixWorld();
    const from = point.clone().applyMatrix4(camera.matrixWorldInverse);
    const to = new THREE.Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5).applyMatrix4(camera.projectionMatrixInverse);
    to.multiplyScalar(from.z / to.z);
    const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    camera.matrixWorld.extractBasis(...axes);
    return {directions: axes.slice(0, 2).map((axis) => axis.toArray()), shift: [to.x - from.x, to.y - from.y]};
  }

  // Arrow keys turn the view, + and − zoom.
  key(event) {
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const away = this.camera.position.clone().sub(this.controls.target),
      radius = away.length();
    let around = Math.atan2(away.y, away.x),
      down = Math.acos(away.z / radius),
      far = radius;
    if (turns[event.key]) {
      around += 0.1 * turns[event.key][0];
      down = Math.min(Math.PI - 0.05, Math.max(0.05, down + 0.08 * turns[event.key][1]));
    } else if (event.key === "+" || event.key === "-") {
      far *= event.key === "+" ? 0.9 : 1.1;
    } else {
      return;
    }
    away.set(far * Math.sin(down) * Math.cos(around), far * Math.sin(down) * Math.sin(around), far * Math.cos(down));
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.render();
    event.preventDefault();
  }
}
