// From the variables of a box to the coordinates of the model, and numbers to text.

export const isAngle = (coordinate) => coordinate.cosine !== undefined;
export const fullTurn = 2 * Math.PI;

// An angle in (−π, π].
export function wrapped(angle) {
  const rest = angle - fullTurn * Math.floor((angle + Math.PI) / fullTurn);
  return rest === -Math.PI ? Math.PI : rest;
}

// The interval of a coordinate over a box, written to out[0], out[1]. Of an angle: the hull of atan2 over the rectangle of cosine and
// sine, whose extremes are at corners; it may go on beyond π. A rectangle around the origin says nothing.
export function coordinateInterval(set, box, coordinate, out) {
  if (!isAngle(coordinate)) {
    out[0] = set.lower(box, coordinate.index);
    out[1] = set.upper(box, coordinate.index);
    return out;
  }
  const c0 = set.lower(box, coordinate.cosine),
    c1 = set.upper(box, coordinate.cosine);
  const s0 = set.lower(box, coordinate.sine),
    s1 = set.upper(box, coordinate.sine);
  if (c0 <= 0 && c1 >= 0 && s0 <= 0 && s1 >= 0) {
    out[0] = -Math.PI;
    out[1] = Math.PI;
    return out;
  }
  // Corners relative to the direction (u, v) of the middle: less than half a turn away.
  const u = c0 + c1,
    v = s0 + s1,
    centre = Math.atan2(v, u);
  const a = Math.atan2(s0 * u - c0 * v, c0 * u + s0 * v),
    b = Math.atan2(s0 * u - c1 * v, c1 * u + s0 * v);
  const c = Math.atan2(s1 * u - c0 * v, c0 * u + s1 * v),
    d = Math.atan2(s1 * u - c1 * v, c1 * u + s1 * v);
  out[0] = centre + Math.min(a, b, c, d);
  out[1] = centre + Math.max(a, b, c, d);
  return out;
}

// The value of a coordinate at x, a vector of a set's variables.
export function coordinateValue(x, coordinate) {
  return isAngle(coordinate) ? Math.atan2(x[coordinate.sine], x[coordinate.cosine]) : x[coordinate.index];
}

export function coordinateValues(model, x) {
  const values = {};
  for (const coordinate of model.coordinates) values[coordinate.name] = coordinateValue(x, coordinate);
  return values;
}

// For innerHTML: a row for each coordinate with its value, its unit and what it is.
export function coordinateTable(model, values) {
  const rows = model.coordinates
    .filter(({role}) => role !== "auxiliary")
    .map((coordinate) => {
      const unit = htmlUnit(model, coordinate),
        value = values[coordinate.name];
      const degrees = isAngle(coordinate) ? ` <small>${numberText((value * 180) / Math.PI, 4)}°</small>` : "";
      return `<tr><th>${htmlLabel(coordinate)}</th><td>${numberText(value)}${unit ? ` ${unit}` : ""}${degrees}</td><td>${
        coordinate.role === "passive" ? "" : coordinate.role
      }</td></tr>`;
    });
  return `<table>${rows.join("")}</table>`;
}

// What a select box or an axis shows: "θ2", and the unit behind it.
export const plainLabel = (item) => item.label[0] + item.label[1];
// For innerHTML: what a model says is text, whatever it looks like.
export const htmlText = (text) =>
  text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/"/g, "&quot;");
export function htmlLabel(item) {
  return `<i>${htmlText(item.label[0])}</i>` + (item.label[1] ? `<sub>${htmlText(item.label[1])}</sub>` : "");
}
export const unitOf = (model, coordinate) => (isAngle(coordinate) ? "rad" : model.drawing.unit);
export const htmlUnit = (model, coordinate) => htmlText(unitOf(model, coordinate) || "");

export const withMinus = (text) => text.replace(/-/g, "−");
export function numberText(x, digits = 4) {
  const text =
    Math.abs(x) < 1e-12
      ? "0"
      : Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6
        ? x.toExponential(digits - 1)
        : x.toPrecision(digits);
  return withMinus(text);
}
export const groupedText = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
