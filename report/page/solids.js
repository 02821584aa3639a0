// The solids that a mechanism in space is made of, by three.js. Each hangs on points of the drawing, by their indices, and goes where
// these are; lengths are those of the scene, in which the mechanism is about 2 wide.
const yAxis = () => new THREE.Vector3(0, 1, 0);
export const isPlace = (v) => Number.isFinite(v.x + v.y + v.z);

// The materials of a theme: what the page's colours look like in soft light.
export function pageMaterials(frame) {
  const style = getComputedStyle(frame),
    colour = (name) => style.getPropertyValue(name).trim();
  const solid = (color, more = {}) => new THREE.MeshStandardMaterial({color, roughness: 0.5, metalness: 0.05, ...more});
  const sheet = (color) =>
    solid(color, {
      transparent: true,
      opacity: 0.3,
      side: THREE.DoubleSide,
      depthWrite: false,
      flatShading: true,
      roughness: 0.9,
    });
  const own = new Map();
  const once = (make, text) => own.get(make.name + text) ?? own.set(make.name + text, make(text)).get(make.name + text);
  return {
    link: solid(colour("--link-solid")),
    joint: solid(colour("--joint-solid"), {roughness: 0.3}),
    ground: solid(colour("--ground-solid"), {roughness: 0.85}),
    rail: solid(colour("--line-strong")),
    effector: solid(colour("--effector"), {roughness: 0.35}),
    halo: solid(colour("--effector"), {transparent: true, opacity: 0.2, depthWrite: false, roughness: 1}),
    velocity: solid(colour("--set-forward"), {emissive: colour("--set-forward"), emissiveIntensity: 0.35}),
    grid: new THREE.LineBasicMaterial({
      color: colour("--line-strong"),
      vertexColors: true,
      transparent: true,
      opacity: 0.75,
    }),
    // Of a part with a colour of its own, or without.
    of: ({colour: text}) => (text ? once(solid, text) : solid(colour("--link-solid"))),
    sheetOf: ({colour: text}) => once(sheet, text || colour("--link-solid")),
  };
}

export class Solids {
  constructor(group) {
    this.group = group;
    this.poses = [];
    this.round = new THREE.SphereGeometry(1, 36, 24);
    this.rod = new THREE.CylinderGeometry(1, 1, 1, 36);
  }

  // `at`: the points in the scene.
  pose(at) {
    for (const pose of this.poses) pose(at);
  }

  add(geometry, material, casts = true) {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = casts;
    mesh.frustumCulled = false;
    this.group.add(mesh);
    return mesh;
  }

  // Brings the y axis of a solid onto a direction.
  aim(mesh, at, direction, scale) {
    const length = direction.length();
    mesh.visible = isPlace(at) && length > 1e-9;
    if (!mesh.visible) return;
    mesh.position.copy(at);
    mesh.quaternion.setFromUnitVectors(yAxis(), direction.clone().divideScalar(length));
    mesh.scale.set(...scale);
  }

  ball(i, radius, material, casts) {
    const mesh = this.add(this.round, material, casts);
    this.poses.push((at) => {
      mesh.visible = isPlace(at[i]);
      mesh.position.copy(at[i]);
      mesh.scale.setScalar(radius);
    });
  }

  bar(i, j, radius, material) {
    const mesh = this.add(this.rod, material);
    this.poses.push((at) => {
      const along = at[j].clone().sub(at[i]);
      this.aim(mesh, at[i].clone().add(at[j]).multiplyScalar(0.5), along, [radius, along.length(), radius]);
    });
  }

  // A cylinder about a joint with a known axis, on a longer and thinner pin.
  hinge(i, j, radius, sleeve, pin) {
    for (const [r, length, material] of [
      [radius, 3.4 * radius, sleeve],
      [0.45 * radius, 4.6 * radius, pin],
      [1.12 * radius, 0.5 * radius, pin],
    ]) {
      const mesh = this.add(this.rod, material);
      this.poses.push((at) => this.aim(mesh, at[i], at[j].clone().sub(at[i]), [r, length, r]));
    }
  }

  block(i, a, b, size, material) {
    const mesh = this.add(new THREE.BoxGeometry(1, 1, 1), material);
    this.poses.push((at) => this.aim(mesh, at[i], at[b].clone().sub(at[a]), [size, 1.7 * size, size]));
  }

  // A foot under a point that stays, on a plate.
  pedestal(i, size, material) {
    const foot = this.add(new THREE.CylinderGeometry(0.3, 0.75, 1, 36), material);
    const plate = this.add(this.rod, material);
    this.poses.push((at) => {
      foot.visible = plate.visible = isPlace(at[i]);
      for (const mesh of [foot, plate]) mesh.rotation.x = Math.PI / 2;
      foot.position.copy(at[i]).z -= 0.5 * size;
      foot.scale.set(size, size, size);
      plate.position.copy(at[i]).z -= 1.05 * size;
      plate.scale.set(size, 0.14 * size, size);
    });
  }

  // A flat sheet with these corners, which may be no convex polygon.
  sheet(corners, material) {
    const geometry = new THREE.BufferGeometry(),
      place = new THREE.BufferAttribute(new Float32Array(3 * corners.length), 3);
    geometry.setAttribute("position", place);
    const mesh = this.add(geometry, material, false);
    mesh.castShadow = true;
    this.poses.push((at) => {
      mesh.visible = corners.every((i) => isPlace(at[i]));
      if (!mesh.visible) return;
      corners.forEach((i, k) => place.setXYZ(k, at[i].x, at[i].y, at[i].z));
      place.needsUpdate = true;
      geometry.index ?? geometry.setIndex(trianglesOf(corners.map((i) => at[i])));
    });
  }

  // An arrow with its tail at a point; `vectors` are given to the function that is returned.
  arrow(i, radius, material) {
    const shaft = this.add(this.rod, material),
      head = this.add(new THREE.CylinderGeometry(0, 1, 1, 28), material);
    return (at, vector) => {
      const length = vector ? vector.length() : 0,
        point = Math.min(5.5 * radius, 0.6 * length);
      shaft.visible = head.visible = length > 1e-6 && isPlace(at[i]);
      if (!shaft.visible) return;
      const along = vector.clone().divideScalar(length);
      this.aim(shaft, at[i].clone().addScaledVector(along, (length - point) / 2), vector, [radius, length - point, radius]);
      this.aim(head, at[i].clone().addScaledVector(along, length - point / 2), vector, [0.42 * point, point, 0.42 * point]);
    };
  }
}

// A plane polygon in triangles, as indices of its corners.
function trianglesOf(corners) {
  const normal = new THREE.Vector3();
  corners.forEach((p, k) => normal.add(p.clone().cross(corners[(k + 1) % corners.length]))); // twice the area (Newell)
  const turn = new THREE.Quaternion().setFromUnitVectors(normal.normalize(), new THREE.Vector3(0, 0, 1));
  const flat = corners.map((p) => p.clone().applyQuaternion(turn)).map(({x, y}) => new THREE.Vector2(x, y));
  const triangles = THREE.ShapeUtils.triangulateShape(flat, []).flat();
  return triangles.length > 0 ? triangles : corners.slice(2).flatMap((_, k) => [0, k + 1, k + 2]);
}
