// Draws the mechanism at a configuration as SVG, with velocities as arrows.

const svgSpace = "http://www.w3.org/2000/svg";

function svgElement(parent, tag, attributes, text) {
  const element = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  parent.appendChild(element);
  return element;
}

const dualFunctions = {
  sin: (x) => [Math.sin(x), Math.cos(x)],
  cos: (x) => [Math.cos(x), -Math.sin(x)],
  tan: (x) => [Math.tan(x), 1 + Math.tan(x) ** 2],
  asin: (x) => [Math.asin(x), 1 / Math.sqrt(1 - x * x)],
  acos: (x) => [Math.acos(x), -1 / Math.sqrt(1 - x * x)],
  atan: (x) => [Math.atan(x), 1 / (1 + x * x)],
  sqrt: (x) => [Math.sqrt(x), 0.5 / Math.sqrt(x)],
  exp: (x) => [Math.exp(x), Math.exp(x)],
  log: (x) => [Math.log(x), 1 / x],
  abs: (x) => [Math.abs(x), Math.sign(x)],
};

// [value, rate] of a drawing's expression where the coordinates have these values and rates (forward differentiation).
export function evaluateTree(tree, values, rates) {
  if (typeof tree === "number") return [tree, 0];
  if (typeof tree === "string") return [values[tree], rates[tree] || 0];
  const parts = tree.slice(1).map((part) => evaluateTree(part, values, rates));
  const [[a, da], [b, db] = [0, 0]] = parts;
  switch (tree[0]) {
    case "+":
      return parts.reduce(([s, ds], [t, dt]) => [s + t, ds + dt]);
    case "*":
      return parts.reduce(([s, ds], [t, dt]) => [s * t, ds * t + s * dt]);
    case "/":
      return [a / b, (da * b - a * db) / (b * b)];
    case "^":
      return [a ** b, (da ? b * a ** (b - 1) * da : 0) + (db ? a ** b * Math.log(a) * db : 0)];
    case "-":
      return [-a, -da];
    default: {
      const [value, slope] = dualFunctions[tree[0]](a);
      return [value, slope * da];
    }
  }
}

// To the right and up in a flat picture, along the axes of the drawing: spatial ones are seen from above a corner.
export const flatView = (dimension) =>
  dimension === 2
    ? [
        [1, 0],
        [0, 1],
      ]
    : [
        [0.866, -0.866, 0],
        [-0.2885, -0.2885, 1],
      ];

export const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

// Points of the drawing, flattened to the plane. Their own coordinates are in `place` and
// `motion`.
export function drawnPoints(model, values, rates = {}) {
  // The ends of rails, of axes and of solids have no meaning of their own.
  const meant = {slider: 1, hinge: 1, sphere: 0, cylinder: 0};
  const named = new Set(model.drawing.parts.flatMap(({kind, points}) => points.slice(0, meant[kind] ?? points.length)));
  // Where the model has rates of its own a point may move by an expression in them; those that are locked are 0.
  const own = model.rates && {...values, ...Object.fromEntries(model.rates.map((name) => [name, rates[name] || 0]))};
  return model.drawing.points.map((point, i) => {
    const at = point.at.map((tree, k) => {
      const [place, speed] = evaluateTree(tree, values, rates);
      return [place, point.moves ? evaluateTree(point.moves[k], own, {})[0] : speed];
    });
    const [place, motion] = [0, 1].map((k) => at.map((dual) => dual[k]));
    const [position, velocity] = [place, motion].map((of) => flatView(at.length).map((along) => dot(along, of)));
    return {label: point.label, named: named.has(i), position, velocity, place, motion};
  });
}

// A window that holds the drawing at all these configurations.
export function drawingWindow(model, configurations) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const values of configurations) {
    for (const {
      position: [x, y],
    } of drawnPoints(model, values)) {
      if (!Number.isFinite(x + y)) continue;
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    }
  }
  if (box[0] > box[2]) return [-1, -1, 1, 1];
  const size = Math.max(box[2] - box[0], box[3] - box[1], 1e-9),
    margin = 0.08 * size;
  const grow = (low, high) => {
    const extra = Math.max(0, 0.35 * size - (high - low)) / 2 + margin;
    return [low - extra, high + extra];
  };
  const [x0, x1] = grow(box[0], box[2]),
    [y0, y1] = grow(box[1], box[3]);
  return [x0, y0, x1, y1];
}

export const flatWidth = 400; // of the picture, in its own units

// Draws into an <svg>, replacing what it holds. `rates` may be null: no arrows.
export function drawMechanism(svg, model, values, rates, view, options = {}) {
  const [x0, y0, x1, y1] = view;
  const width = flatWidth,
    scale = width / (x1 - x0),
    height = scale * (y1 - y0);
  const unit = options.unit || 1; // thicknesses, in a picture of width 400
  svg.replaceChildren();
  svg.setAttribute("viewBox", `0 0 ${width} ${height.toFixed(1)}`);
  const points = drawnPoints(model, values, rates || {});
  const at = points.map(({position: [x, y]}) => [scale * (x - x0), scale * (y1 - y)]);
  const path = (indices) => indices.map((i) => at[i].map((v) => v.toFixed(2)).join(",")).join(" ");
  const parts = (kind) => model.drawing.parts.filter((part) => part.kind === kind);
  const circle = (i, radius, name) => svgElement(svg, "circle", {cx: at[i][0], cy: at[i][1], r: radius * unit, class: name});

  for (const {
    points: [, a, b],
  } of parts("slider"))
    svgElement(svg, "polyline", {points: path([a, b]), class: "rail"});
  for (const part of parts("ground")) for (const i of part.points) drawGround(svg, at[i], unit);
  for (const part of parts("platform"))
    coloured(svgElement(svg, "polygon", {points: path(part.points), class: "platform"}), part, ["stroke", "fill"]);
  for (const name of ["casing", "link"]) {
    for (const part of parts("link")) {
      const line = svgElement(svg, "polyline", {
        points: path(part.points),
        class: name,
        "stroke-width": (name === "link" ? 7 : 10) * unit,
      });
      if (name === "link") coloured(line, part, ["stroke"]);
    }
  }
  for (const part of parts("cylinder")) {
    const width = 2 * part.radius * scale;
    coloured(svgElement(svg, "polyline", {points: path(part.points), class: "cylinder", "stroke-width": width}), part, [
      "stroke",
    ]);
  }
  for (const part of parts("sphere")) {
    const [x, y] = at[part.points[0]];
    coloured(svgElement(svg, "circle", {cx: x, cy: y, r: part.radius * scale, class: "sphere"}), part, ["fill"]);
  }
  for (const {
    points: [p, a, b],
  } of parts("slider")) {
    const angle = (Math.atan2(at[b][1] - at[a][1], at[b][0] - at[a][0]) * 180) / Math.PI;
    svgElement(svg, "rect", {
      x: -13 * unit,
      y: -8 * unit,
      width: 26 * unit,
      height: 16 * unit,
      rx: 3 * unit,
      class: "block",
      transform: `translate(${at[p][0]} ${at[p][1]}) rotate(${angle})`,
    });
  }
  for (const part of parts("ground")) for (const i of part.points) circle(i, 6, "joint");
  for (const part of parts("joint")) for (const i of part.points) circle(i, 5, "joint");
  for (const part of parts("ball")) for (const i of part.points) circle(i, 5, "ball");
  for (const part of parts("hinge")) drawHinge(svg, at, part.points, unit);
  for (const part of parts("effector")) {
    for (const i of part.points) {
      circle(i, 9, "effector-ring");
      circle(i, 3.2, "effector");
    }
  }
  const arrows = rates ? drawVelocities(svg, points, at, scale, unit, width) : [];
  const bars = ["link", "platform"]
    .flatMap((kind) => parts(kind))
    .flatMap(({points: ends}) => ends.slice(1).map((b, k) => [at[ends[k]], at[b]]));
  const rails = parts("slider").map(({points: [, a, b]}) => [at[a], at[b]]);
  const pedestals = parts("ground").flatMap((part) => part.points.map((i) => [at[i], [at[i][0], at[i][1] + 22 * unit]]));
  drawLabels(svg, points, at, [...bars, ...rails, ...arrows, ...pedestals], unit, width, height);
}

// A part's own colour; a sheet's is thin.
function coloured(element, {colour}, properties) {
  if (!colour) return;
  for (const property of properties) element.style[property] = colour;
  if (properties.includes("stroke") && properties.includes("fill")) element.style.fillOpacity = 0.25;
}

// A joint with its axis, of a length that depends on the point of view only.
function drawHinge(svg, at, [a, b], unit) {
  const [dx, dy] = [at[b][0] - at[a][0], at[b][1] - at[a][1]],
    length = Math.hypot(dx, dy),
    half = length > 1e-9 ? (12 * unit) / length : 0;
  const [x, y] = at[a];
  svgElement(svg, "line", {
    x1: x - half * dx,
    y1: y - half * dy,
    x2: x + half * dx,
    y2: y + half * dy,
    class: "hinge",
    "stroke-width": 3 * unit,
  });
  svgElement(svg, "circle", {cx: x, cy: y, r: 5 * unit, class: "joint"});
}

function drawGround(svg, [x, y], unit) {
  const group = svgElement(svg, "g", {class: "ground", transform: `translate(${x} ${y}) scale(${unit})`});
  svgElement(group, "path", {d: "M0 0 L-11 17 H11 Z", class: "pedestal"});
  svgElement(group, "path", {d: "M-16 17 H16", class: "floor"});
  svgElement(group, "path", {d: "M-13 17 l-5 6 M-6 17 l-5 6 M1 17 l-5 6 M8 17 l-5 6 M15 17 l-5 6", class: "hatch"});
}

// The longest arrow has a fifth of the picture's width; ξ has no scale of its own. Returns the arrows as segments.
function drawVelocities(svg, points, at, scale, unit, width) {
  const speeds = points.map(({velocity: [u, v]}) => Math.hypot(u, v));
  const fastest = Math.max(...speeds, 0);
  const arrows = [];
  if (!(fastest > 1e-9)) return arrows;
  points.forEach(({velocity: [u, v]}, i) => {
    if (speeds[i] < 1e-6 * fastest) return;
    const length = (0.2 * width * speeds[i]) / fastest,
      dx = u / speeds[i],
      dy = -v / speeds[i];
    const [x, y] = at[i],
      tip = [x + length * dx, y + length * dy],
      head = Math.min(9 * unit, 0.6 * length);
    arrows.push([at[i], tip]);
    const back = [tip[0] - head * dx, tip[1] - head * dy];
    svgElement(svg, "line", {x1: x, y1: y, x2: back[0], y2: back[1], class: "velocity", "stroke-width": 2.6 * unit});
    svgElement(svg, "polygon", {
      points: [
        tip,
        [back[0] - 0.45 * head * dy, back[1] + 0.45 * head * dx],
        [back[0] + 0.45 * head * dy, back[1] - 0.45 * head * dx],
      ]
        .map((p) => p.join(","))
        .join(" "),
      class: "velocity-head",
    });
  });
  return arrows;
}

// Each label goes to the side of its point where the other points are not; of points in one place the first is labelled for all. `sides`
// remembers the sides: a label stays where it is while another place is hardly better.
export function drawLabels(svg, points, at, obstacles, unit, width, height, sides = []) {
  const done = [],
    taken = [];
  points.forEach((point, i) => {
    if (!point.named) return;
    if (done.some((j) => Math.hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]) < 3)) return;
    done.push(i);
    let best = null;
    for (let k = 0; k < 8; ++k) {
      const angle = (k * Math.PI) / 4 - Math.PI / 4,
        distance = 22 * unit;
      const place = [at[i][0] + distance * Math.cos(angle), at[i][1] + distance * Math.sin(angle)];
      let room = Math.min(place[0], width - place[0], place[1], height - place[1]) - 10;
      at.forEach((other, j) => {
        if (j !== i) room = Math.min(room, Math.hypot(place[0] - other[0], place[1] - other[1]) - 12);
      });
      for (const other of taken)
        room = Math.min(room, Math.hypot((place[0] - other[0]) * 0.8, place[1] - other[1]) - 14 * unit);
      for (const [a, b] of obstacles) room = Math.min(room, distanceToLine(place, a, b));
      if (k === sides[i]) room += 8;
      if (!best || room > best.room + 1e-6) best = {room, place, side: k};
    }
    sides[i] = best.side;
    taken.push(best.place);
    const text = svgElement(svg, "text", {x: best.place[0], y: best.place[1], class: "point-label", "font-size": 17 * unit});
    svgElement(text, "tspan", {class: "symbol"}, point.label[0]);
    if (point.label[1]) svgElement(text, "tspan", {"font-size": 12 * unit, dy: 4 * unit}, point.label[1]);
  });
}

function distanceToLine(p, a, b) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  if (length < 1) return Infinity;
  const t = Math.max(0, Math.min(1, ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length ** 2));
  return Math.hypot(p[0] - a[0] - t * (b[0] - a[0]), p[1] - a[1] - t * (b[1] - a[1]));
}
