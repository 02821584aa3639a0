// Light, and a floor that takes the shadow: what a mechanism in space stands in, by three.js.

const floorRadius = 1.9,
  squares = 14;

// `floor`: its height.
export function litScene(floor, gridMaterial) {
  const scene = new THREE.Scene();
  const shadow = new THREE.Mesh(
    new THREE.CircleGeometry(floorRadius, 64),
    new THREE.ShadowMaterial({opacity: 0.28, depthWrite: false}),
  );
  shadow.receiveShadow = true;
  const grid = new THREE.LineSegments(gridGeometry(), gridMaterial);
  grid.position.z = shadow.position.z = floor;
  scene.add(sun(), ...softLight(), shadow, grid);
  return scene;
}

function sun() {
  const light = new THREE.DirectionalLight("#ffffff", 2);
  light.position.set(1.6, -2.2, 4);
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  Object.assign(light.shadow.camera, {left: -2.4, right: 2.4, top: 2.4, bottom: -2.4, near: 0.5, far: 9});
  Object.assign(light.shadow, {radius: 5, normalBias: 0.02, intensity: 0.6});
  return light;
}

function softLight() {
  const back = new THREE.DirectionalLight("#dfe8ff", 0.7);
  back.position.set(-3, 2, 0.5);
  const sky = new THREE.HemisphereLight("#ffffff", "#b5b0a8", 1.9);
  sky.position.set(0, 0, 1);
  return [back, sky];
}

// Lines that fade out towards the rim.
function gridGeometry() {
  const lines = [],
    colours = [],
    place = (k) => (floorRadius * (2 * k - squares)) / squares;
  const end = (x, y) => {
    lines.push(x, y, 0);
    colours.push(1, 1, 1, Math.max(0, 1 - (x * x + y * y) / floorRadius ** 2) ** 1.5);
  };
  for (let k = 0; k <= squares; ++k) {
    for (let j = 0; j < squares; ++j) {
      for (const i of [j, j + 1]) end(place(i), place(k));
      for (const i of [j, j + 1]) end(place(k), place(i));
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(lines), 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(Float32Array.from(colours), 4));
  return geometry;
}
