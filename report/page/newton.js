// Newton's method for the equations of a set, to bring the middle of a box onto the solution set before it is drawn. Floating point:
// it makes pictures, and proves nothing.

// Value and gradient of a polynomial: monomials [coefficient, variable, power, function, …], function 0: x, 1: sin x, 2: cos x.
export function evaluatePolynomial(monomials, x, gradient) {
  gradient.fill(0);
  let sum = 0;
  for (const monomial of monomials) {
    let product = monomial[0];
    for (let k = 1; k < monomial.length; k += 3) product *= factorValue(monomial, k, x);
    sum += product;
    for (let k = 1; k < monomial.length; k += 3) {
      let slope = monomial[0] * factorSlope(monomial, k, x);
      for (let other = 1; other < monomial.length; other += 3) {
        if (other !== k) slope *= factorValue(monomial, other, x);
      }
      gradient[monomial[k]] += slope;
    }
  }
  return sum;
}

function factorValue(monomial, k, x) {
  const t = x[monomial[k]];
  return monomial[k + 2] === 1 ? Math.sin(t) : monomial[k + 2] === 2 ? Math.cos(t) : t ** monomial[k + 1];
}

function factorSlope(monomial, k, x) {
  const t = x[monomial[k]],
    power = monomial[k + 1];
  return monomial[k + 2] === 1 ? Math.cos(t) : monomial[k + 2] === 2 ? -Math.sin(t) : power * t ** (power - 1);
}

// Solves A y = b (symmetric, positive definite but for rounding) in place by Cholesky's method.
function solveSymmetric(a, b, n) {
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j <= i; ++j) {
      let sum = a[i * n + j];
      for (let k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = i === j ? Math.sqrt(Math.max(sum, 1e-300)) : sum / a[j * n + j];
    }
  }
  for (let i = 0; i < n; ++i) {
    for (let k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (let i = n - 1; i >= 0; --i) {
    for (let k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

// From x the nearby point of F = 0, each step the shortest one in units of the variables' scales, 1 where none are given:
// dx = −W Jᵀ (J W Jᵀ + λ)⁻¹ F, W = diag(scale²), with a tiny λ, for F may be redundant.
export function ontoSolutions(equations, start, scales = start.map(() => 1)) {
  const n = start.length,
    m = equations.length;
  const x = Float64Array.from(start);
  const weights = scales.map((scale) => scale ** 2);
  const jacobian = equations.map(() => new Float64Array(n));
  const gram = new Float64Array(m * m),
    step = new Float64Array(m);
  let residual = Infinity;
  for (let round = 0; round < 20; ++round) {
    residual = 0;
    for (let i = 0; i < m; ++i) {
      step[i] = evaluatePolynomial(equations[i], x, jacobian[i]);
      residual = Math.max(residual, Math.abs(step[i]));
    }
    if (residual < 1e-13) break;
    let trace = 0;
    for (let i = 0; i < m; ++i) {
      for (let j = 0; j <= i; ++j) {
        let sum = 0;
        for (let k = 0; k < n; ++k) sum += jacobian[i][k] * jacobian[j][k] * weights[k];
        gram[i * m + j] = sum;
      }
      trace += gram[i * m + i];
    }
    for (let i = 0; i < m; ++i) gram[i * m + i] += 1e-12 * (trace / m + 1e-300);
    solveSymmetric(gram, step, m);
    for (let i = 0; i < m; ++i) {
      for (let k = 0; k < n; ++k) x[k] -= weights[k] * jacobian[i][k] * step[i];
    }
  }
  return {x, residual};
}

// ξ at x: of a set with a kernel vector a part of x, of one in parts the vector that M shortens most, M ξ ≈ 0, by inverse iteration.
export function kernelVector(set, x) {
  const n = set.columns.length;
  if (!set.kernel) return Array.from({length: n}, (_, k) => x[set.configuration + k]);
  const values = set.kernel.map((entry) => evaluatePolynomial(entry, x, new Float64Array(x.length)));
  const square = new Float64Array(n * n);
  let trace = 0;
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      for (let row = 0; row < values.length; row += n) square[i * n + j] += values[row + i] * values[row + j];
    }
    trace += square[i * n + i];
  }
  for (let i = 0; i < n; ++i) square[i * n + i] += 1e-12 * (trace / n + 1e-300);
  let xi = Float64Array.from({length: n}, (_, k) => 1 / (1 + k));
  for (let round = 0; round < 3; ++round) {
    solveSymmetric(square.slice(), xi, n);
    const length = Math.hypot(...xi);
    xi = xi.map((value) => value / length);
  }
  return xi;
}

// A point of the set in a box, from its middle.
export function pointOfBox(set, box) {
  return solvedFrom(set, box, set.equationsOf(box)) ?? {x: middleOf(set, box), residual: NaN, moved: false};
}

// The same in the first of the boxes that has one where the conditions, more equations, hold; if none has, anywhere in the first box.
export function pointOfBoxes(set, boxes, conditions) {
  if (conditions.length > 0) {
    for (const box of boxes) {
      const point = solvedFrom(set, box, [...set.equationsOf(box), ...conditions]);
      if (point) return {box, ...point};
    }
  }
  return {box: boxes[0], ...pointOfBox(set, boxes[0])};
}

// Of what the box leaves open, any angles, and what the equations then give.
function middleOf(set, box) {
  const x = Float64Array.from({length: set.size}, (_, j) => set.middle(box, j));
  const open = new Set(set.leftOut);
  for (const [cosine, sine] of set.angles ?? []) {
    open.delete(cosine);
    open.delete(sine);
    if (Math.hypot(x[cosine], x[sine]) < 0.1) [x[cosine], x[sine]] = [1, 0];
  }
  const gradient = new Float64Array(set.size);
  for (const equation of open.size > 0 ? set.equations : []) {
    const own = equation.find((monomial) => monomial.length === 4 && open.has(monomial[1]) && isLinear(equation, monomial));
    if (!own) continue;
    x[own[1]] -= evaluatePolynomial(equation, x, gradient) / own[0];
    open.delete(own[1]);
  }
  return x;
}

// Is it the only monomial with its variable, which is no angle?
function isLinear(equation, [, variable, power, kind]) {
  const mentions = (monomial) => monomial.some((v, k) => k % 3 === 1 && v === variable);
  return power === 1 && kind === 0 && equation.filter(mentions).length === 1;
}

// In units of the box's sides: one that is a single value, by an equation of a part of the set, stays.
function solvedFrom(set, box, equations) {
  const widths = Float64Array.from({length: set.size}, (_, j) => set.upper(box, j) - set.lower(box, j)),
    least = 1e-4 * Math.max(...widths) || 1;
  const {x, residual} = ontoSolutions(
    equations,
    middleOf(set, box),
    widths.map((w) => Math.max(w, least)),
  );
  return residual < 1e-9 && isNear(set, box, x) ? {x, residual, moved: true} : null;
}

// Is a configuration in the box, or next to it by at most the box's width?
function isNear(set, box, x) {
  for (let j = 0; j < set.configuration; ++j) {
    const low = set.lower(box, j),
      high = set.upper(box, j),
      room = 0.5 * (high - low) + 1e-6;
    if (!(x[j] >= low - room && x[j] <= high + room)) return false;
  }
  return true;
}
