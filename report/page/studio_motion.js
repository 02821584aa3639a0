// Moves a configuration along C-space, in floating point: towards a place of a drawn point or values of coordinates, on the assembly
// mode that it has. Newton's method brings each step back onto the constraints; how far it is from them is the residual.
import {dot, drawnPoints, evaluateTree} from "./mechanism.js";
import {evaluatePolynomial, ontoSolutions} from "./newton.js";
import {coordinateValues, isAngle} from "./values.js";

const rounds = 40, // steps towards a target, at most
  largest = 0.06, // of a step, relative to the typical size of what moves
  singular = 1e-3; // of a pivot, relative to the largest

// Gaussian elimination with complete pivoting in place: {sign of the determinant, least: the last pivot relative to the first}.
function eliminate(a, n) {
  let sign = 1,
    first = 0,
    least = 1;
  for (let k = 0; k < n; ++k) {
    let [r, c] = [k, k];
    for (let i = k; i < n; ++i) for (let j = k; j < n; ++j) if (Math.abs(a[i][j]) > Math.abs(a[r][c])) [r, c] = [i, j];
    if (r !== k) (([a[r], a[k]] = [a[k], a[r]]), (sign = -sign));
    if (c !== k) {
      for (let i = 0; i < n; ++i) [a[i][c], a[i][k]] = [a[i][k], a[i][c]];
      sign = -sign;
    }
    const pivot = a[k][k];
    if (k === 0) first = Math.abs(pivot) || 1;
    least = Math.abs(pivot) / first;
    if (pivot === 0) return {sign: 0, least: 0};
    sign *= Math.sign(pivot);
    for (let i = k + 1; i < n; ++i) {
      const f = a[i][k] / pivot;
      for (let j = k; j < n; ++j) a[i][j] -= f * a[k][j];
    }
  }
  return {sign, least};
}

// Solves the small system (A Aᵀ + μ) y = e for y; A: rows.
function solveRows(rows, e, damping) {
  const m = rows.length;
  const a = rows.map((row, i) => [...rows.map((other) => dot(row, other)), e[i]]);
  const trace = a.reduce((sum, row, i) => sum + row[i], 0);
  for (let i = 0; i < m; ++i) a[i][i] += damping * (trace / m + 1e-12);
  for (let k = 0; k < m; ++k) {
    let r = k;
    for (let i = k; i < m; ++i) if (Math.abs(a[i][k]) > Math.abs(a[r][k])) r = i;
    [a[r], a[k]] = [a[k], a[r]];
    if (!(Math.abs(a[k][k]) > 1e-14)) continue;
    for (let i = 0; i < m; ++i) {
      if (i === k) continue;
      const f = a[i][k] / a[k][k];
      for (let j = k; j <= m; ++j) a[i][j] -= f * a[k][j];
    }
  }
  return a.map((row, i) => (Math.abs(row[i]) > 1e-14 ? row[m] / row[i] : 0));
}

// Of the rows, what is orthogonal to an orthonormal basis and to each other (Gram and Schmidt, twice).
function orthonormal(rows, basis = []) {
  const found = [];
  for (const row of rows) {
    const v = Float64Array.from(row),
      size = Math.hypot(...v);
    if (!(size > 0)) continue;
    for (let twice = 0; twice < 2; ++twice) for (const b of [...basis, ...found]) removePart(v, b);
    const rest = Math.hypot(...v);
    if (rest > 1e-9 * size) found.push(v.map((x) => x / rest));
  }
  return found;
}

// v −= (v · b) b
function removePart(v, b) {
  const part = dot(v, b);
  for (let k = 0; k < v.length; ++k) v[k] -= part * b[k];
}

export class Motion {
  constructor(model) {
    this.model = model;
    this.size = 1 + Math.max(-1, ...model.coordinates.flatMap((c) => (isAngle(c) ? [c.cosine, c.sine] : [c.index])));
    for (const monomials of model.constraints)
      for (const monomial of monomials)
        for (let k = 1; k < monomial.length; k += 3) this.size = Math.max(this.size, monomial[k] + 1);
  }

  jacobian(x) {
    return this.model.constraints.map((equation) => {
      const gradient = new Float64Array(x.length);
      evaluatePolynomial(equation, x, gradient);
      return gradient;
    });
  }

  // The nearest configuration: {x, residual}.
  onto(x) {
    return ontoSolutions(this.model.constraints, x);
  }

  // How a row of derivatives by coordinates becomes one by the system's variables.
  row(x, slopes) {
    const row = new Float64Array(x.length);
    for (const coordinate of this.model.coordinates) {
      const slope = slopes[coordinate.name];
      if (!slope) continue;
      if (isAngle(coordinate)) {
        row[coordinate.cosine] -= slope * x[coordinate.sine];
        row[coordinate.sine] += slope * x[coordinate.cosine];
      } else row[coordinate.index] += slope;
    }
    return row;
  }

  // A target for coordinates by name.
  ofValues(wanted) {
    return (x) => {
      const values = coordinateValues(this.model, x);
      return Object.entries(wanted).map(([name, goal]) => {
        const coordinate = this.model.coordinates.find((c) => c.name === name);
        const off = isAngle(coordinate)
          ? Math.atan2(Math.sin(goal - values[name]), Math.cos(goal - values[name]))
          : goal - values[name];
        return {off, row: this.row(x, {[name]: 1})};
      });
    };
  }

  // A target for a point of the drawing: how far it is to be along some directions.
  ofPoint(index, {directions, goals}) {
    const point = this.model.drawing.points[index];
    return (x) => {
      const values = coordinateValues(this.model, x);
      const {place} = drawnPoints(this.model, values)[index];
      const slopes = directions.map(() => ({}));
      for (const {name} of this.model.coordinates) {
        const motion = point.at.map((tree) => evaluateTree(tree, values, {[name]: 1})[1]);
        directions.forEach((along, k) => (slopes[k][name] = dot(along, motion)));
      }
      return goals.map((goal, k) => ({off: goal - dot(directions[k], place), row: this.row(x, slopes[k])}));
    };
  }

  // From x towards the target, as near as C-space lets it: {x, residual, distance, crossed, end}. `crossed`: kinds of singularities that
  // the way met, "forward" or "inverse". `end`: the coordinate whose range ends the way, or null.
  move(start, target, scale = 1) {
    let now = this.onto(start);
    const crossed = new Set();
    let end = null;
    let tangents = this.tangents(now.x),
      signs = this.signs(now.x, tangents),
      distance = Infinity;
    for (let round = 0; round < rounds; ++round) {
      const rows = target(now.x);
      const before = Math.hypot(...rows.map(({off}) => off));
      distance = before;
      if (before < 1e-12 * scale) break;
      const along = rows.map(({row}) => {
        const v = new Float64Array(row.length);
        for (const t of tangents) {
          const part = dot(t, row);
          for (let k = 0; k < v.length; ++k) v[k] += part * t[k];
        }
        return v;
      });
      const y = solveRows(
        along,
        rows.map(({off}) => off),
        1e-4,
      );
      const step = new Float64Array(now.x.length);
      along.forEach((v, i) => v.forEach((value, k) => (step[k] += y[i] * value)));
      const length = Math.hypot(...step);
      if (!(length > 1e-13)) break;
      let part = Math.min(1, (largest * Math.max(1, scale)) / length),
        next = null;
      end = null;
      for (let half = 0; half < 12; ++half, part /= 2) {
        const tried = this.onto(now.x.map((value, k) => value + part * step[k]));
        const after = Math.hypot(...target(tried.x).map(({off}) => off));
        const jumped = Math.hypot(...tried.x.map((value, k) => value - now.x[k])) > 3 * part * length + 1e-9;
        const beyond = this.beyond(tried.x);
        if (tried.residual < 1e-9 && !jumped && after < before - 1e-15 && !beyond) {
          next = tried;
          distance = after;
          break;
        }
        end ??= beyond;
      }
      if (!next) break;
      now = next;
      tangents = this.tangents(now.x, tangents);
      const then = this.signs(now.x, tangents);
      for (const kind of Object.keys(then)) {
        if (signs[kind] && then[kind] && (then[kind].least < singular || then[kind].sign * signs[kind].sign < 0))
          crossed.add(kind);
      }
      signs = then;
    }
    return {...now, distance, crossed: [...crossed], end: distance > 1e-9 ? end : null};
  }

  isWithin(x) {
    return !this.beyond(x);
  }

  // A coordinate that is out of its range, or null.
  beyond(x) {
    const values = coordinateValues(this.model, x);
    const within = (c) => {
      const value = values[c.name],
        [low, high] = c.range,
        room = 1e-9 * (1 + Math.abs(high - low));
      if (!isAngle(c)) return value >= low - room && value <= high + room;
      if (high - low >= 2 * Math.PI - 1e-9) return true;
      const turned = value + 2 * Math.PI * Math.ceil((low - room - value) / (2 * Math.PI));
      return turned <= high + room;
    };
    return this.model.coordinates.find((c) => !within(c)) ?? null;
  }

  // An orthonormal basis of the velocities at x. One that begins with a former one keeps its orientation along a way.
  tangents(x, former = null) {
    const units = Array.from(x, (_, j) => Float64Array.from(x, (_, k) => (j === k ? 1 : 0)));
    return orthonormal(former ?? units, orthonormal(this.jacobian(x)));
  }

  // Of the matrices that take velocities to the rates of the inputs and of the outputs, where square: the sign of the determinant,
  // which is 0 at a forward and at an inverse singularity, with how near to 0: {forward, inverse}.
  signs(x, tangents) {
    const found = {};
    for (const [kind, role] of [
      ["forward", "input"],
      ["inverse", "output"],
    ]) {
      const moved = this.model.coordinates.filter((c) => c.role === role);
      // With rates of its own an output's velocity is not the rate of a coordinate.
      if (moved.length !== tangents.length || (kind === "inverse" && this.model.rates)) continue;
      found[kind] = eliminate(
        moved.map(({name}) => tangents.map((velocity) => dot(this.row(x, {[name]: 1}), velocity))),
        moved.length,
      );
    }
    return found;
  }
}

// The box of a set that a configuration lies in, or the nearest one: {box, distance}, in the largest difference of a variable.
export function boxAt(set, x) {
  let best = {box: -1, distance: Infinity};
  for (let box = 0; box < set.count && best.distance > 0; ++box) {
    let far = 0;
    for (let j = 0; j < set.configuration && far < best.distance; ++j)
      far = Math.max(far, set.lower(box, j) - x[j], x[j] - set.upper(box, j));
    if (far < best.distance) best = {box, distance: Math.max(0, far)};
  }
  return best;
}

// How far a configuration is from all boxes of some sets, in the Euclidean distance over coordinates of choice (lengths, and angles in
// radians): no singularity is nearer than that, but for rounding, where the sets are complete.
export function clearanceOf(sets, x, coordinates) {
  let nearest = {distance: Infinity, set: null, box: -1};
  for (const set of sets) {
    for (let box = 0; box < set.count; ++box) {
      let sum = 0;
      const most = nearest.distance * nearest.distance;
      for (const c of coordinates) {
        sum +=
          (isAngle(c)
            ? angleGap(set, box, x, c)
            : Math.max(0, set.lower(box, c.index) - x[c.index], x[c.index] - set.upper(box, c.index))) ** 2;
        if (sum >= most) break;
      }
      if (sum < most) nearest = {distance: Math.sqrt(sum), set, box};
    }
  }
  return nearest;
}

// Between an angle and the angles of a box: at least the chord on the unit circle.
function angleGap(set, box, x, {cosine, sine}) {
  const u = Math.max(0, set.lower(box, cosine) - x[cosine], x[cosine] - set.upper(box, cosine)),
    v = Math.max(0, set.lower(box, sine) - x[sine], x[sine] - set.upper(box, sine));
  return Math.hypot(u, v);
}
