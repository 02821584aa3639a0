// What the 3-D view is made of, by three.js: clouds of boxes, a frame, names and a ring.

const vertexShader = `
  attribute vec3 extent;
  attribute vec3 tint;
  varying vec3 colour;
  uniform float pixels;
  uniform float least;
  void main() {
    colour = tint;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * seen;
    float size = (extent.x + extent.y + extent.z) / 3.0;
    gl_PointSize = max(least, pixels * size * projectionMatrix[1][1] / gl_Position.w);
  }`;
const fragmentShader = `
  varying vec3 colour;
  uniform float opacity;
  void main() {
    vec2 at = gl_PointCoord - 0.5;
    float rim = 1.0 - smoothstep(0.16, 0.25, dot(at, at));
    if (rim <= 0.0) discard;
    gl_FragColor = vec4(colour, opacity * rim);
  }`;

// While the view turns, faint clouds show so many boxes only, spread over all.
const mostWhileTurning = 25000;

// 0 … n − 1 in an order of which every beginning is spread evenly: steps by a number coprime to n, near the golden section of it.
function spreadOrder(n) {
  const divisor = (a, b) => (b === 0 ? a : divisor(b, a % b));
  let step = Math.max(1, Math.round(0.618 * n));
  while (divisor(step, n) > 1) ++step;
  return Uint32Array.from({length: n}, (_, i) => (i * step) % n);
}

// A set of `dimension` 2 or more that is not singular is drawn faint: one sees the others through it.
const isFaint = (set) => !set.singular && set.dimension > 1;

// Colours are told apart where they are stronger than one alone has to be.
const opacities = {points: {plain: 0.16, coloured: 0.42}, boxes: {plain: 0.07, coloured: 0.2}};
const pointOpacity = (set, kind) => (isFaint(set) ? opacities.points[kind] * Math.min(1, 9e4 / set.count) : 1);

// For each box the three numbers of its colour as the screen shows it.
function tintsOf(count, colourOf) {
  const known = new Map(),
    tints = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const text = colourOf(i);
    if (!known.has(text)) known.set(text, new THREE.Color(text).convertLinearToSRGB().toArray());
    tints.set(known.get(text), 3 * i);
  }
  return tints;
}

// `colourOf(i)`: the colour of the i-th box, as CSS has it; `kind`: "plain" where it is that of all boxes, or "coloured". So below.
export function pointCloud(set, middles, extents, colourOf, kind) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(middles, 3));
  geometry.setAttribute("extent", new THREE.BufferAttribute(extents, 3));
  geometry.setIndex(new THREE.BufferAttribute(spreadOrder(extents.length / 3), 1));
  geometry.setAttribute("tint", new THREE.BufferAttribute(tintsOf(extents.length / 3, colourOf), 3));
  const faint = isFaint(set);
  const material = new THREE.ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent: true,
    depthWrite: !faint,
    uniforms: {
      opacity: {value: pointOpacity(set, kind)},
      pixels: {value: 400},
      least: {value: faint ? 1.5 : set.dimension === 0 ? 9 : 3.5},
    },
  });
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;
  points.userData.kind = kind;
  return points;
}

export function boxCloud(set, middles, extents, colourOf, kind) {
  const faint = isFaint(set);
  const material = new THREE.MeshBasicMaterial({
    transparent: faint,
    opacity: faint ? opacities.boxes[kind] : 1,
    depthWrite: !faint,
  });
  const mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(1, 1, 1), material, extents.length / 3);
  const matrix = new THREE.Matrix4(),
    colour = new THREE.Color(),
    least = set.singular ? 0.004 : 0.001;
  spreadOrder(extents.length / 3).forEach((i, place) => {
    matrix.makeScale(...[0, 1, 2].map((k) => Math.max(extents[3 * i + k], least)));
    matrix.setPosition(middles[3 * i], middles[3 * i + 1], middles[3 * i + 2]);
    mesh.setMatrixAt(place, matrix);
    mesh.setColorAt(place, colour.set(colourOf(i)));
  });
  mesh.frustumCulled = false;
  mesh.userData.kind = kind;
  return mesh;
}

// A text that faces the eye: a name in italics with a subscript.
export function nameSprite([base, subscript], colour, height) {
  const canvas = document.createElement("canvas"),
    context = canvas.getContext("2d");
  const pieces = [
    [base, "italic 64px Georgia, 'Liberation Serif', serif", 62],
    [subscript, "44px Georgia, 'Liberation Serif', serif", 76],
  ];
  let width = 12;
  for (const [text, font] of pieces) {
    context.font = font;
    width += context.measureText(text).width;
  }
  canvas.width = Math.ceil(width);
  canvas.height = 96;
  let at = 6;
  for (const [text, font, down] of pieces) {
    context.font = font;
    context.fillStyle = colour;
    context.fillText(text, at, down);
    at += context.measureText(text).width;
  }
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map, depthTest: false, transparent: true}));
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  sprite.renderOrder = 3;
  return sprite;
}

// Where the shown configuration is.
export function ringSprite(ink, paper) {
  const canvas = document.createElement("canvas"),
    context = canvas.getContext("2d");
  canvas.width = canvas.height = 64;
  for (const [colour, width] of [
    [paper, 16],
    [ink, 8],
  ]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.arc(32, 32, 20, 0, 7);
    context.stroke();
  }
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map, depthTest: false, transparent: true}));
  sprite.scale.set(0.05, 0.05, 1);
  sprite.renderOrder = 4;
  return sprite;
}

// Fewer boxes, each a little stronger, while the view turns; all of them at rest.
export function setDetail(set, object, count, turning) {
  const shown = turning && isFaint(set) ? Math.min(count, mostWhileTurning) : count;
  const strength = Math.sqrt(count / Math.max(1, shown));
  if (object.isInstancedMesh) {
    object.count = shown;
    if (isFaint(set)) object.material.opacity = opacities.boxes[object.userData.kind] * strength;
  } else {
    object.geometry.setDrawRange(0, shown);
    object.material.uniforms.opacity.value = pointOpacity(set, object.userData.kind) * strength;
  }
}
