#include "corank/check/tube.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/check/kernel.h"
#include "corank/check/krawczyk.h"
#include "corank/check/problem.h"

namespace corank::check {
namespace {

class TubeCheck {
 public:
  TubeCheck(const System& system, const std::vector<PolynomialMatrix>& matrices, const Tube& tube, const StopFlag& stop)
      : system_(system), tube_(tube), problem_(system, {}, stop), n_(static_cast<std::size_t>(system.size())) {
    for (const PolynomialMatrix& m : matrices) {
      int filled = 0;
      for (int i = 0; i < m.rows; ++i)
        for (int j = 0; j < m.columns; ++j)
          if (!m.entries[static_cast<std::size_t>(i * m.columns + j)].monomials.empty()) {
            ++filled;
            break;
          }
      kernels_.emplace_back(system, m, stop);
      most_.push_back(m.columns - std::min(filled, m.columns));
    }
  }

  /// What is wrong with the numbers of things; empty: nothing.
  std::string misshapen() const;
  /// Each: what is wrong, or nothing.
  std::string node(std::size_t k) const;
  std::string piece(std::size_t k) const;

 private:
  std::vector<Row> equations(const TubeNode& a, const TubeNode& b) const;
  std::vector<int> all_variables() const {
    std::vector<int> list(n_);
    std::iota(list.begin(), list.end(), 0);
    return list;
  }
  std::string about(const Box& piece, double radius) const;

  const System& system_;
  const Tube& tube_;
  Problem problem_;
  std::vector<KernelCheck> kernels_;
  std::vector<int> most_;
  std::size_t n_;
};

bool is_box(const Box& box, std::size_t n) {
  return box.size() == n && std::all_of(box.begin(), box.end(),
                                        [](const Interval& side) { return side.is_bounded() && side.lo() <= side.hi(); });
}

bool finite(const std::vector<double>& list) {
  return std::all_of(list.begin(), list.end(), [](double x) { return std::isfinite(x); });
}

std::string TubeCheck::misshapen() const {
  if (tube_.nodes.size() < 2) return "a tube has at least two nodes";
  if (tube_.pieces.size() + 1 != tube_.nodes.size()) return "there is not one piece between each two nodes";
  if (tube_.radii.size() != tube_.pieces.size()) return "there is not one radius for each piece";
  if (system_.equations.size() >= n_) return "the system leaves no motion";
  const std::size_t across = n_ - system_.equations.size();
  for (const TubeNode& node : tube_.nodes)
    if (!is_box(node.box, n_) || node.values.size() != across || node.rows.size() != across * n_ || !finite(node.values) ||
        !finite(node.rows))
      return "a node does not have the system's sizes";
  for (const Box& piece : tube_.pieces)
    if (!is_box(piece, n_)) return "a piece's box does not have the system's sizes";
  for (const double r : tube_.radii)
    if (!(std::isfinite(r) && r >= 0)) return "a radius is not a length";
  if (tube_.sizes.size() != n_) return "there is not one size for each variable";
  for (const double size : tube_.sizes)
    if (!(std::isfinite(size) && size > 0)) return "a variable's size is not a length";
  return "";
}

// F, then (1 − t)(T·x − c) + t (T'·x − c'), with t the variable after those of x.
std::vector<Row> TubeCheck::equations(const TubeNode& a, const TubeNode& b) const {
  std::vector<int> place = all_variables();
  const int t = static_cast<int>(n_);
  place.push_back(t);
  std::vector<Row> rows;
  for (const Polynomial& f : system_.equations) rows.emplace_back(Terms(f, system_.coefficient_tolerance), place);
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const ExactNumber c = ExactNumber::dyadic(a.values[i]), c_next = ExactNumber::dyadic(b.values[i]);
    Polynomial f;
    f.monomials.emplace_back(-c, std::vector<Factor>{});
    f.monomials.emplace_back(c - c_next, std::vector<Factor>{{t, 1, Function::identity}});
    for (std::size_t j = 0; j < n_; ++j) {
      const ExactNumber r = ExactNumber::dyadic(a.rows[i * n_ + j]), r_next = ExactNumber::dyadic(b.rows[i * n_ + j]);
      const Factor x{static_cast<int>(j), 1, Function::identity};
      f.monomials.emplace_back(r, std::vector<Factor>{x});
      f.monomials.emplace_back(r_next - r, std::vector<Factor>{x, {t, 1, Function::identity}});
    }
    rows.emplace_back(Terms(f, 0), place);
  }
  return rows;
}

std::string TubeCheck::node(std::size_t k) const {
  const TubeNode& node = tube_.nodes[k];
  const std::vector<Row> rows = equations(node, node);
  Sides x;
  for (const Interval& side : node.box) x.emplace_back(side);
  x.emplace_back(0.0);
  Krawczyk krawczyk(rows, static_cast<int>(n_) + 1);
  if (!krawczyk.set(all_variables(), x, Krawczyk::Center::polished)) return "its equations are singular";
  const Sides image = krawczyk.image(x);
  for (std::size_t j = 0; j < n_; ++j)
    if (!image[j].strictly_inside(x[j])) return "no solution is shown in its box";
  return krawczyk.is_injective(x) ? "" : "its solution is not shown to be one";
}

std::string TubeCheck::piece(std::size_t k) const {
  const Box& box = tube_.pieces[k];
  const TubeNode &a = tube_.nodes[k], &b = tube_.nodes[k + 1];
  for (const TubeNode* end : {&a, &b})
    for (std::size_t j = 0; j < n_; ++j)
      if (!box[j].contains(end->box[j])) return "a node's box is not in its box";
  const std::vector<Row> rows = equations(a, b);
  Sides x;
  for (const Interval& side : box) x.emplace_back(side);
  x.emplace_back(0.0, 1.0);
  Krawczyk krawczyk(rows, static_cast<int>(n_) + 1);
  if (!krawczyk.set(all_variables(), x, Krawczyk::Center::middle)) return "its equations are singular";
  const Sides image = krawczyk.image(x);
  for (std::size_t j = 0; j < n_; ++j)
    if (!image[j].strictly_inside(x[j])) return "no lift is shown in its box";
  if (!krawczyk.is_injective(x)) return "its lift is not shown to be one";
  return about(box, tube_.radii[k]);
}

std::string TubeCheck::about(const Box& piece, double radius) const {
  Box box;
  Sides x;
  for (std::size_t j = 0; j < n_; ++j) {
    const Interval& side = piece[j];
    const double room = std::nextafter(radius * tube_.sizes[j], kInfinity);
    box.emplace_back(std::nextafter(side.lo() - room, -kInfinity), std::nextafter(side.hi() + room, kInfinity));
    x.emplace_back(box.back());
  }
  for (const Condition& c : problem_.conditions())
    if (!c.implied && !c.row.value(x).is_nonnegative()) return "a range, a limit or an inequality is not shown about it";
  for (std::size_t k = 0; k < kernels_.size(); ++k)
    if (!kernels_[k].is_at_most(most_[k], box)) return "a singularity is not excluded about it";
  return "";
}

}  // namespace

TubeReport check_tube(const System& system, const std::vector<PolynomialMatrix>& matrices, const Tube& tube,
                      const Options& options) {
  const NearestRounding rounding;
  const StopFlag stop(options.ended);
  TubeReport report;
  try {
    const TubeCheck check(system, matrices, tube, stop);
    if (std::string problem = check.misshapen(); !problem.empty()) {
      report.failures.push_back(std::move(problem));
      return report;
    }
    const auto note = [&](const std::string& what, std::size_t k, const std::string& problem, std::size_t& confirmed) {
      stop.poll();
      if (problem.empty()) {
        ++confirmed;
      } else {
        report.failures.push_back(what + " " + std::to_string(k + 1) + ": " + problem);
      }
    };
    for (std::size_t k = 0; k < tube.nodes.size(); ++k) note("node", k, check.node(k), report.nodes);
    for (std::size_t k = 0; k < tube.pieces.size(); ++k) note("piece", k, check.piece(k), report.pieces);
  } catch (const Stopped&) {
    report.interrupted = true;
  }
  return report;
}

}  // namespace corank::check
