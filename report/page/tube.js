// A path as its tube says it: each piece the solutions of the constraints and of linear equations that go over from those of one node to
// those of the next. Newton's method finds them, in floating point, for pictures.
import {ontoSolutions} from "./newton.js";

export class TubeCurve {
  constructor(constraints, {nodes, pieces}) {
    Object.assign(this, {constraints, nodes, pieces, closed: false});
    this.starts = [0]; // t at each node
    pieces.forEach((_, k) => {
      const [a, b] = [nodes[k].x, nodes[k + 1].x];
      this.starts.push(this.starts[k] + Math.max(1e-9, Math.hypot(...a.map((x, j) => b[j] - x))));
    });
    this.length = this.starts[pieces.length];
  }

  pieceAt(t) {
    const next = this.starts.findIndex((start) => start > t);
    return next < 0 ? this.pieces.length - 1 : Math.max(0, next - 1);
  }

  // Row i of the linear equations at a share s of piece k: Σ_j a_j x_j = c, as a polynomial.
  conditions(k, s) {
    const [a, b] = [this.nodes[k], this.nodes[k + 1]];
    return a.values.map((value, i) => [
      ...a.rows[i].map((entry, j) => [(1 - s) * entry + s * b.rows[i][j], j, 1, 0]),
      [-((1 - s) * value + s * b.values[i])],
    ]);
  }

  holds(k, x) {
    const {lower, upper} = this.pieces[k];
    return x.every((value, j) => value >= lower[j] - 1e-9 && value <= upper[j] + 1e-9);
  }

  solved(k, s, start) {
    const {x, residual} = ontoSolutions([...this.constraints, ...this.conditions(k, s)], start);
    return {x, residual, piece: k, moved: residual < 1e-9 && this.holds(k, x)};
  }

  // The configuration at t: {x, residual, piece, moved: does it lie in the tube?}.
  at(t) {
    const k = this.pieceAt(t),
      [from, to] = [this.starts[k], this.starts[k + 1]];
    const s = Math.min(1, Math.max(0, (t - from) / (to - from)));
    const [a, b] = [this.nodes[k].x, this.nodes[k + 1].x];
    const between = a.map((x, j) => x + s * (b[j] - x));
    const found = this.solved(k, s, between);
    return {t, ...(found.moved ? found : this.followed(k, s))};
  }

  // Step by step from the node before.
  followed(k, s) {
    const steps = 16;
    let found = {x: this.nodes[k].x, residual: NaN, piece: k, moved: false};
    for (let i = 1; i <= steps; ++i) found = this.solved(k, (s * i) / steps, found.x);
    return found;
  }

  // Configurations all along it.
  samples(most = 400) {
    const each = Math.max(2, Math.ceil(most / this.pieces.length));
    const places = this.pieces.flatMap((_, k) =>
      Array.from({length: each}, (_, i) => this.starts[k] + ((this.starts[k + 1] - this.starts[k]) * i) / each),
    );
    return [...places, this.length].map((t) => this.at(t));
  }
}
