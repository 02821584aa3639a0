#include "corank/solve/store/self_motion_search.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "corank/core/dense.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/approximate_zero.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {
using Matrix = Eigen::MatrixXd;

// Of the numbers in a fraction, at most, and how near it has to be, relative. Taken in turns: an irrational number is near
// to a fraction of long numbers, and samples that lie close together give few digits.
struct Longest {
  long number;
  double precision;
};
constexpr Longest kLongest[] = {{100, 1e-9}, {100'000, 1e-11}};

// p/q near x with p and q of at most longest.number; nothing where there is none. A long p alone would be near to any large
// x.
std::optional<ExactNumber> fraction_near(double x, Longest longest) {
  double rest = x;
  long p0 = 1, q0 = 0, p1 = 0, q1 = 1;
  for (int step = 0; step < 20; ++step) {
    if (std::fabs(rest) > 1e9) return std::nullopt;
    const long a = std::lround(std::floor(rest));
    const long p2 = a * p0 + p1, q2 = a * q0 + q1;
    if (std::max(std::labs(p2), std::labs(q2)) > longest.number) return std::nullopt;
    p1 = p0, q1 = q0, p0 = p2, q0 = q2;
    if (std::fabs(static_cast<double>(p0) / static_cast<double>(q0) - x) <= longest.precision * std::fabs(x))
      return ExactNumber(p0) / ExactNumber(q0);
    rest = 1 / (rest - static_cast<double>(a));
  }
  return std::nullopt;
}

// Likewise, or such a number times a power of ten: with lengths in another unit the same is found.
std::optional<ExactNumber> rational_near(double x, Longest longest) {
  if (auto q = fraction_near(x, longest)) return q;
  const double power = std::floor(std::log10(std::fabs(x)));
  if (!(std::fabs(power) < 300)) return std::nullopt;
  const auto q = fraction_near(power > 0 ? x / std::pow(10, power) : x * std::pow(10, -power), longest);
  if (!q) return std::nullopt;
  return *q * pow(ExactNumber(10), static_cast<int>(power));
}

// Solutions on the set, one after the other.
std::vector<LocalSolution> walk(const Problem& problem, const LocalSolution& start, std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<LocalSolution> samples{start};
  const std::vector<double>& scales = problem.compiled.scales();
  const std::size_t n = scales.size();
  std::vector<double> heading(n);
  for (double& h : heading) h = normal(random);
  for (std::size_t trial = 0; trial < 4 * count && samples.size() < count && !problem.ended(); ++trial) {
    const LocalSolution& here = samples.back();
    const std::vector<double> basis = kernel_basis(problem, here, 100 * kSampleTolerance);
    const std::size_t k = basis.size() / n;
    if (k == 0) break;
    // The heading's part along the set, and a little of chance.
    std::vector<double> direction(n, 0.0);
    for (std::size_t c = 0; c < k; ++c) {
      double along = 0.3 * normal(random);
      for (std::size_t j = 0; j < n; ++j) along += basis[j * k + c] * heading[j];
      for (std::size_t j = 0; j < n; ++j) direction[j] += along * basis[j * k + c];
    }
    double length = 0;
    for (const double d : direction) length += d * d;
    if (length == 0) continue;
    LocalSolution there = here;
    for (std::size_t j = 0; j < n; ++j) {
      heading[j] = direction[j] / std::sqrt(length);
      there.x[j] += kSampleStep * heading[j] * scales[j];
    }
    const auto next = local_solution(problem, there.x, kSampleTolerance);
    if (!next || next->rank != start.rank) {
      for (double& h : heading) h = normal(random);  // another way
      continue;
    }
    samples.push_back(*next);
  }
  return samples;
}

// Of the set around a solution on it: how many independent directions lead to others. The Jacobian's kernel may be larger.
int local_dimension(const Problem& problem, const LocalSolution& at) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const std::vector<double>& scales = problem.compiled.scales();
  const std::size_t n = scales.size();
  const std::vector<double> basis = kernel_basis(problem, at, 100 * kSampleTolerance);
  const std::size_t k = basis.size() / n;
  Matrix moves(static_cast<Eigen::Index>(kDirectionsEach * k), static_cast<Eigen::Index>(n));
  moves.setZero();
  for (Eigen::Index trial = 0; trial < moves.rows(); ++trial) {
    LocalSolution there = at;
    std::vector<double> weights(k);
    double length = 0;
    for (double& w : weights) w = normal(random), length += w * w;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t c = 0; c < k; ++c)
        there.x[j] += kShortStep * weights[c] / std::sqrt(length) * basis[j * k + c] * scales[j];
    const auto next = local_solution(problem, there.x, kSampleTolerance);
    if (!next) continue;
    for (std::size_t j = 0; j < n; ++j)
      moves(trial, static_cast<Eigen::Index>(j)) = (next->x[j] - at.x[j]) / (kShortStep * scales[j]);
    if (const double moved = moves.row(trial).norm(); moved > 1) moves.row(trial) /= moved;
  }
  const Eigen::VectorXd values = singular_values(moves);
  int dimension = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) dimension += values(i) > kDirectionShare * std::max(1.0, values(0));
  return dimension;
}

// The smallest around a few: where pieces cross there are more directions.
int sampled_dimension(const Problem& problem, const std::vector<LocalSolution>& samples) {
  int dimension = problem.compiled.variables();
  for (std::size_t i = 0; i < kDimensionSamples; ++i)
    dimension = std::min(dimension, local_dimension(problem, samples[i * (samples.size() - 1) / (kDimensionSamples - 1)]));
  return dimension;
}

// As many of the samples as relations take, each moved to the set.
std::vector<LocalSolution> precise(const System& system, const std::vector<LocalSolution>& samples) {
  const std::size_t wanted = std::min(samples.size(), system.variables.size() + 4);
  std::vector<LocalSolution> result;
  for (std::size_t k = 0; k < wanted; ++k) {
    const LocalSolution& sample = samples[k * samples.size() / wanted];
    std::vector<ExactNumber> start;
    for (const double c : sample.x) start.push_back(ExactNumber::dyadic(c));
    const auto zero = approximate_zero(system, start, kSampleBits);
    if (!zero) continue;
    result.push_back({{}, sample.rank});
    for (const ExactNumber& c : *zero) result.back().x.push_back(c.enclose().mid());
  }
  return result;
}

// Reduced row echelon form of the relations a·(x/scale) + a_0 = 0, the pivots among the variables.
struct Echelon {
  Matrix rows;  // q × (n + 1), scaled
  std::vector<Eigen::Index> pivots;
};

Echelon relations_of(const Problem& problem, const std::vector<LocalSolution>& samples) {
  const auto n = static_cast<Eigen::Index>(problem.compiled.variables());
  Matrix a(static_cast<Eigen::Index>(samples.size()), n + 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (Eigen::Index j = 0; j < n; ++j) a(static_cast<Eigen::Index>(i), j) = samples[i].x[j] / problem.compiled.scales()[j];
    a(static_cast<Eigen::Index>(i), n) = 1;
  }
  const SingularValueDecomposition svd = decompose(a);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) rank += svd.values(k) > kNullTolerance * svd.values(0);
  Echelon e{svd.v.rightCols(n + 1 - rank).transpose(), {}};
  for (Eigen::Index row = 0; row < e.rows.rows(); ++row) {
    Eigen::Index r = 0, c = 0;
    const double best = e.rows.block(row, 0, e.rows.rows() - row, n).cwiseAbs().maxCoeff(&r, &c);
    if (best < kRelationTolerance) {
      e.rows.conservativeResize(row, n + 1);
      break;
    }
    e.rows.row(row).swap(e.rows.row(row + r));
    e.rows.row(row) /= e.rows(row, c);
    for (Eigen::Index other = 0; other < e.rows.rows(); ++other)
      if (other != row) e.rows.row(other) -= e.rows(other, c) * e.rows.row(row);
    e.pivots.push_back(c);
  }
  return e;
}

// x_p + Σ a_j x_j + b = 0 with rational numbers; nothing where they are none.
std::optional<Polynomial> rational_relation(const Problem& problem, const Eigen::RowVectorXd& row, Eigen::Index pivot,
                                            Longest longest) {
  const std::vector<double>& scales = problem.compiled.scales();
  const double unit = scales[pivot];
  const Eigen::Index n = row.size() - 1;
  Polynomial f{{}, "self-motion"};
  for (Eigen::Index j = 0; j < n; ++j) {
    if (std::fabs(row(j)) < kRelationTolerance) continue;
    const auto a = rational_near(row(j) * unit / scales[j], longest);
    if (!a) return std::nullopt;
    if (!a->is_zero()) f.monomials.emplace_back(*a, std::vector<Factor>{{static_cast<int>(j), 1}});
  }
  if (std::fabs(row(n)) >= kRelationTolerance) {
    const auto b = rational_near(row(n) * unit, longest);
    if (!b) return std::nullopt;
    f.monomials.emplace_back(*b, std::vector<Factor>{});
  }
  return f;
}

// Variables that are constant with irrational values: x_p = (value of p / value of q) x_q where that ratio is rational.
std::vector<Polynomial> ratios(const Problem& problem, const Echelon& e, const std::vector<Eigen::Index>& constants,
                               Longest longest) {
  std::vector<Polynomial> result;
  const Eigen::Index n = e.rows.cols() - 1;
  const auto value = [&](Eigen::Index row) { return -e.rows(row, n) * problem.compiled.scales()[e.pivots[row]]; };
  std::vector<Eigen::Index> bases;
  for (const Eigen::Index row : constants) {
    bool joined = false;
    for (const Eigen::Index base : bases) {
      const auto ratio = rational_near(value(row) / value(base), longest);
      if (!ratio || ratio->is_zero()) continue;
      const int p = static_cast<int>(e.pivots[row]), q = static_cast<int>(e.pivots[base]);
      Polynomial f{{}, "self-motion"};
      f.monomials.emplace_back(1, std::vector<Factor>{{p, 1}});
      f.monomials.emplace_back(-*ratio, std::vector<Factor>{{q, 1}});
      result.push_back(std::move(f));
      joined = true;
      break;
    }
    if (!joined) bases.push_back(row);
  }
  return result;
}

std::vector<Polynomial> rational_relations(const Problem& problem, const Echelon& e, Longest longest) {
  std::vector<Polynomial> relations;
  std::vector<Eigen::Index> constants;
  for (Eigen::Index row = 0; row < e.rows.rows(); ++row) {
    const Eigen::Index pivot = e.pivots[row];
    if (auto f = rational_relation(problem, e.rows.row(row), pivot, longest)) {
      relations.push_back(std::move(*f));
      continue;
    }
    Eigen::RowVectorXd others = e.rows.row(row).head(e.rows.cols() - 1);
    others(pivot) = 0;
    if (others.cwiseAbs().maxCoeff() < kRelationTolerance) constants.push_back(row);
  }
  for (Polynomial& f : ratios(problem, e, constants, longest)) relations.push_back(std::move(f));
  return relations;
}

}  // namespace

MotionCandidate find_self_motion(const Problem& problem, const System& system, const LocalSolution& from) {
  MotionCandidate candidate;
  const auto start = local_solution(problem, from.x, kSampleTolerance);
  const int n = problem.compiled.variables(), expected = std::max(0, n - problem.compiled.equations());
  if (!start) return candidate;
  if (n - start->rank <= expected) return candidate;
  const std::vector<LocalSolution> samples = walk(problem, *start, static_cast<std::size_t>(3 * n + 10));
  if (samples.size() < static_cast<std::size_t>(n + 2)) return candidate;  // a point, or a set that ends too soon
  candidate.dimension = sampled_dimension(problem, samples);
  // The theorem needs as many independent equations as the set leaves variables.
  if (candidate.dimension <= expected || candidate.dimension != n - start->rank) return candidate;
  const std::vector<LocalSolution> points = precise(system, samples);
  if (points.size() < static_cast<std::size_t>(n + 2)) return candidate;
  const Echelon e = relations_of(problem, points);
  const UpwardRounding rounding;
  for (const Longest& longest : kLongest) {
    if (candidate.motion) break;
    candidate.motion = certify::self_motion(system, rational_relations(problem, e, longest), candidate.dimension);
  }
  if (candidate.motion) candidate.motion->compiled.set_scales(problem.compiled.scales());
  return candidate;
}

bool holds_at(const certify::SelfMotion& motion, const Problem& problem, const std::vector<double>& x) {
  const UpwardRounding rounding;
  for (const Polynomial& f : motion.relations) {
    double sum = 0, size = 0;
    for (const Monomial& m : f.monomials) {
      const double c = m.enclosure.mid();
      const double scale = m.factors.empty() ? 1 : problem.compiled.scales()[m.factors[0].variable];
      sum += c * (m.factors.empty() ? 1 : x[m.factors[0].variable]);
      size = std::max(size, std::fabs(c) * scale);
    }
    if (std::fabs(sum) > 1e-5 * size) return false;
  }
  return true;
}

}  // namespace corank::solve
