#include "corank/check/tube.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corank/check/distance.h"
#include "corank/check/kernel.h"
#include "corank/check/krawczyk.h"
#include "corank/check/problem.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

bool finite(const std::vector<double>& list) {
  return std::ranges::all_of(list, [](double x) { return std::isfinite(x); });
}

class TubeCheck {
 public:
  TubeCheck(const System& system, const std::vector<PolynomialMatrix>& matrices, const KeptDistances& distances,
            const Tube& tube, const StopFlag& stop)
      : system_(system),
        tube_(tube),
        problem_(system, {}, stop),
        distances_(system, distances, stop),
        n_(system.variables.size()) {
    for (int j = 0; j < system.size(); ++j) (system.variables[j].is_parameter() ? parameters_ : unknowns_).push_back(j);
    for (const PolynomialMatrix& m : matrices) {
      std::set<int> filled;  // rows
      for (int k = 0; k < m.rows * m.columns; ++k)
        if (!m.entries[k].monomials.empty()) filled.insert(k / m.columns);
      kernels_.emplace_back(system, m, stop);
      most_.push_back(m.columns - std::min(static_cast<int>(filled.size()), m.columns));
    }
  }

  /// What is wrong with the numbers of things; empty: nothing.
  std::string misshapen() const {
    if (tube_.nodes.size() < 2) return "a tube has at least two nodes";
    if (tube_.pieces.size() + 1 != tube_.nodes.size()) return "there is not one piece between each two nodes";
    if (tube_.radii.size() != tube_.pieces.size()) return "there is not one radius for each piece";
    if (system_.equations.size() >= unknowns_.size()) return "the system leaves no motion";
    const std::size_t across = unknowns_.size() - system_.equations.size();
    for (const TubeNode& node : tube_.nodes)
      if (!is_box(node.box, n_) || node.values.size() != across || node.rows.size() != across * n_ || !finite(node.values) ||
          !finite(node.rows))
        return "a node does not have the system's sizes";
    for (const Box& piece : tube_.pieces)
      if (!is_box(piece, n_)) return "a piece's box does not have the system's sizes";
    for (const int p : parameters_) {
      const auto holds_all = [&](const Box& box) { return box[p].contains(system_.variables[p].domain); };
      if (!std::ranges::all_of(tube_.pieces, holds_all) || !std::ranges::all_of(tube_.nodes, holds_all, &TubeNode::box))
        return "a box does not hold every value of " + system_.variables[p].name;
    }
    for (const double r : tube_.radii)
      if (!(std::isfinite(r) && r >= 0)) return "a radius is not a length";
    if (tube_.sizes.size() != n_) return "there is not one size for each variable";
    for (const double size : tube_.sizes)
      if (!(std::isfinite(size) && size > 0)) return "a variable's size is not a length";
    return "";
  }

  /// Each: what is wrong, or nothing.
  std::string node(std::size_t k) const {
    const TubeNode& node = tube_.nodes[k];
    return lift_fault(node, node, node.box, Enclosure(0.0), Krawczyk::Center::polished, "no solution is shown in its box",
                      "its solution is not shown to be one");
  }

  std::string piece(std::size_t k) const {
    const Box& box = tube_.pieces[k];
    const TubeNode &a = tube_.nodes[k], &b = tube_.nodes[k + 1];
    for (const TubeNode* end : {&a, &b})
      if (!contains(box, end->box)) return "a node's box is not in its box";
    const std::string fault = lift_fault(a, b, box, Enclosure(0.0, 1.0), Krawczyk::Center::middle,
                                         "no lift is shown in its box", "its lift is not shown to be one");
    return fault.empty() ? about(box, tube_.radii[k]) : fault;
  }

 private:
  // Is there one solution in the box for each t?
  std::string lift_fault(const TubeNode& a, const TubeNode& b, const Box& box, const Enclosure& t, Krawczyk::Center around,
                         const char* none, const char* more) const {
    const std::vector<Row> rows = equations(a, b);
    Sides x(box.begin(), box.end());
    x.push_back(t);
    Krawczyk krawczyk(rows, static_cast<int>(x.size()));
    if (!krawczyk.set(unknowns_, x, around)) return "its equations are singular";
    if (!krawczyk.is_inside(krawczyk.image(x), x)) return none;
    return krawczyk.is_injective(x) ? "" : more;
  }

  // F, then (1 − t)(T·x − c) + t (T'·x − c'), with t the variable after those of x.
  std::vector<Row> equations(const TubeNode& a, const TubeNode& b) const {
    const int t = system_.size();
    std::vector<Row> rows = rows_of(system_.equations, t + 1, system_.coefficient_tolerance);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      const ExactNumber c = ExactNumber::dyadic(a.values[i]), c_next = ExactNumber::dyadic(b.values[i]);
      Polynomial f;
      f.monomials.emplace_back(-c, Factors{});
      f.monomials.emplace_back(c - c_next, Factors{{t}});
      for (std::size_t j = 0; j < n_; ++j) {
        const ExactNumber r = ExactNumber::dyadic(a.rows[i * n_ + j]), r_next = ExactNumber::dyadic(b.rows[i * n_ + j]);
        const Factor x{static_cast<int>(j)};
        f.monomials.emplace_back(r, Factors{x});
        f.monomials.emplace_back(r_next - r, Factors{x, {t}});
      }
      rows.emplace_back(f, t + 1);
    }
    return rows;
  }

  std::string about(const Box& piece, double radius) const {
    Box box;
    for (std::size_t j = 0; j < n_; ++j) {
      const Interval& side = piece[j];
      const bool varies = !system_.variables[j].is_parameter();  // of robots outside their tolerances nothing is said
      const double room = varies ? std::nextafter(radius * tube_.sizes[j], kInfinity) : 0;
      box.emplace_back(std::nextafter(side.lo() - room, -kInfinity), std::nextafter(side.hi() + room, kInfinity));
    }
    const Sides x(box.begin(), box.end());
    for (const Condition& c : problem_.conditions())
      if (!c.implied && !(c.variable >= 0 && system_.variables[c.variable].is_parameter()) &&
          !c.row.value(x).is_nonnegative())
        return "a range, a limit or an inequality is not shown about it";
    for (std::size_t k = 0; k < kernels_.size(); ++k)
      if (!kernels_[k].is_at_most(most_[k], box)) return "a singularity is not excluded about it";
    return distances_.holds(x) ? "" : "bodies are not shown to keep their distances about it";
  }

  const System& system_;
  const Tube& tube_;
  Problem problem_;
  std::vector<int> parameters_, unknowns_;
  std::vector<KernelCheck> kernels_;
  std::vector<int> most_;
  DistanceCheck distances_;
  std::size_t n_;
};

}  // namespace

TubeReport check_tube(const System& system, const std::vector<PolynomialMatrix>& matrices, const Tube& tube,
                      const Options& options, const KeptDistances& distances) {
  const StopFlag stop(options.ended);
  TubeReport report;
  report.interrupted = !finishes([&] {
    const TubeCheck check(system, matrices, distances, tube, stop);
    if (std::string problem = check.misshapen(); !problem.empty()) return report.failures.push_back(std::move(problem));
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
  });
  return report;
}

}  // namespace corank::check
