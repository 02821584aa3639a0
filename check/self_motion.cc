#include "corank/check/self_motion.h"

#include <algorithm>

#include "corank/check/krawczyk.h"

namespace corank::check {
namespace {

constexpr int kMostTries = 4096;

bool is_linear_and_rational(const Polynomial& f) {
  return std::ranges::all_of(f.monomials, [](const Monomial& m) {
    return m.coefficient.is_rational() && m.degree() <= 1 && !m.is_trigonometric();
  });
}

// As many equations as there are dependent variables, by elimination with the largest pivots at a point; fewer where it
// finds no more.
std::vector<Row> independent(const std::vector<Row>& equations, const std::vector<int>& dependent,
                             const std::vector<double>& at) {
  std::vector<Row> result;
  for (const int row : pivots(approximate_jacobian(equations, at)(Eigen::all, dependent), dependent.size()).rows)
    result.push_back(equations[row]);
  return result;
}

}  // namespace

MotionCheck::MotionCheck(const Problem& problem, const SelfMotionRecord& record) : problem_(problem) {
  const int n = problem.system().size();
  std::vector<Terms> rest = problem.terms(), relations;
  for (const Polynomial& f : record.relations) {
    for (const Monomial& m : f.monomials)
      for (const Factor& x : m.factors)
        if (x.variable < 0 || x.variable >= n || problem.place(x.variable) < 0)
          fault_ = "a relation is not one of variables that were kept";
    if (!is_linear_and_rational(f)) fault_ = "a relation is not linear, with rational coefficients";
    if (!fault_.empty()) return;
    relations.emplace_back(f, 0);
  }
  for (std::size_t i = 0; i < relations.size(); ++i) {
    int own = -1;  // a variable that no other relation mentions
    for (int v = 0; v < n && own < 0; ++v) {
      bool alone = relations[i].mentions(v);
      for (std::size_t k = 0; k < relations.size(); ++k) alone = alone && (k == i || !relations[k].mentions(v));
      if (alone) own = v;
    }
    const auto value = own < 0 ? std::nullopt : relations[i].solved_for(own);
    if (!value) {
      fault_ = "a relation defines no variable of its own";
      return;
    }
    for (Terms& f : rest) {
      auto substituted = f.substituted(own, *value);
      if (!substituted) {
        fault_ = "a relation is about the argument of a sine or cosine";
        return;
      }
      f = std::move(*substituted);
    }
    rows_.emplace_back(relations[i], problem.places());
  }
  std::vector<std::size_t> classes;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (!rest[i].is_exact()) fault_ = "an equation has a tolerance";
    if (rest[i].list().empty()) continue;
    if (std::ranges::any_of(classes, [&](std::size_t g) { return rest[i].is_multiple_of(rest[g]); })) continue;
    classes.push_back(i);
    rows_.push_back(problem.equations()[i]);
  }
  if (problem.size() - static_cast<int>(rows_.size()) != record.dimension)
    fault_ = "its relations leave " + std::to_string(classes.size()) + " equations, which do not make a set of dimension " +
             std::to_string(record.dimension);
  // Else points would be pieces of a set, which nobody counts.
  if (record.dimension <= std::max(0, problem.size() - static_cast<int>(problem.equations().size())))
    fault_ = "a set of dimension " + std::to_string(record.dimension) + " is not larger than the number of equations says";
}

std::string MotionCheck::unique(const CoverBox& box, const Box& region) const {
  std::vector<unsigned char> is_free(problem_.system().variables.size(), 0);
  for (const int j : box.free) is_free[j] = 1;
  std::vector<int> dependent, free;
  Sides all;
  std::vector<double> middle;
  for (std::size_t k = 0; k < problem_.kept().size(); ++k) {
    const std::size_t v = problem_.kept()[k];
    (is_free[v] ? free : dependent).push_back(static_cast<int>(k));
    all.emplace_back(is_free[v] ? box.box[v] : region[v]);
    middle.push_back(box.box[v].mid());
  }
  // From which E is chosen: any will do, and not all do.
  const std::vector<Row>& equations = problem_.equations();
  std::vector<std::vector<Row>> choices{equations};
  for (std::size_t without = 0; without < equations.size(); ++without) {
    choices.push_back(equations);
    choices.back().erase(choices.back().begin() + without);
  }
  std::size_t best = 0;
  int tries = 0;
  const auto shown = [&](const Sides& x) {
    for (const int f : free) middle[f] = x[f].mid();
    const auto injective = [&](const std::vector<Row>& from) {
      if (++tries > kMostTries) return false;
      const std::vector<Row> chosen = independent(from, dependent, middle);
      if (chosen.size() != dependent.size()) return false;
      Krawczyk newton(chosen, problem_.size());
      for (const auto around : {Krawczyk::Center::polished, Krawczyk::Center::middle})
        if (newton.set(dependent, x, around) && newton.is_injective(x)) return true;
      return false;
    };
    if (injective(choices[best])) return true;
    const auto other = std::ranges::find_if(choices, injective);
    if (other == choices.end()) return false;
    best = other - choices.begin();
    return true;
  };
  const std::vector<double> lengths(all.size(), 1.0);
  if (shown_in_parts(all, free, lengths, kMostTries, problem_.stop(), shown)) return {};
  return "uniqueness along its self-motion is not shown";
}

}  // namespace corank::check
