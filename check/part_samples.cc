#include "corank/check/part_samples.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <random>

#include "corank/check/kernel.h"
#include "corank/check/search.h"
#include "corank/check/sheets.h"
#include "corank/core/box.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

constexpr std::size_t kSamples = 16;
constexpr int kAttempts = 160;  // of each system
constexpr int kNewtonSteps = 50;
constexpr double kStill = 1e-13, kLeastShare = 1e-7;
constexpr std::size_t kPartsLookedAt = 300;
constexpr std::size_t kShownCoordinates = 8;

using Random = std::mt19937_64;

double uniform(Random& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

// Draws solutions of a system, and tells whether it may have one with given coordinates.
class Sampled {
 public:
  Sampled(const System& system, const StopFlag& stop) : problem_(system, {}, stop), search_(problem_) {}

  const System& system() const { return problem_.system(); }

  /// A solution in the domain, proven; nothing where this start leads to none, or to one that is degenerate.
  std::optional<Sides> draw(Random& random) {
    std::vector<double> x;
    for (const Interval& side : system().domain()) x.push_back(uniform(random, side.lo(), side.hi()));
    if (!solve(x)) return std::nullopt;
    const std::optional<std::vector<int>> held = free_variables(x);
    if (!held) return std::nullopt;
    std::string fault;
    Sides solution = solution_near(problem_, x, *held, fault);
    const auto is_met = [&](const Condition& c) { return c.implied || c.row.value(solution).is_nonnegative(); };
    if (!fault.empty() || !std::ranges::all_of(problem_.conditions(), is_met)) return std::nullopt;
    return solution;
  }

  /// The domain, with what a solution of another system says of the configuration. False: it is outside.
  bool put(const Sides& solution, const System& of, Sides& sides) const {
    for (int j = 0; j < of.size(); ++j) {
      const int place = is_shared(of.variables[j]) ? system().find(of.variables[j].name) : -1;
      if (place >= 0 && is_shared(system().variables[place]) && !sides[place].intersect(solution[j])) return false;
    }
    return true;
  }

  /// Any value of a coordinate within its domain.
  void put_any(const std::string& coordinate, Random& random, Sides& sides) const {
    if (const int place = system().find(coordinate); place >= 0) {
      sides[place] = Enclosure(uniform(random, sides[place].lo(), sides[place].hi()));
      return;
    }
    for (const Angle& a : system().angles) {
      if (a.name != coordinate) continue;
      const Enclosure value(uniform(random, a.range.lo(), a.range.hi()));
      sides[a.cosine] = cosine(value);
      sides[a.sine] = sine(value);
    }
  }

  Sides domain() const { return problem_.domain(); }
  Search& search() { return search_; }

 private:
  static bool is_shared(const Variable& v) {
    return !v.auxiliary &&
           (v.kind == VariableKind::length || v.kind == VariableKind::cosine || v.kind == VariableKind::sine);
  }

  // The Jacobian with its columns in units of the domains.
  Eigen::MatrixXd jacobian(const std::vector<double>& x) const {
    Eigen::MatrixXd result = approximate_jacobian(problem_.equations(), x);
    for (std::size_t j = 0; j < x.size(); ++j) result.col(static_cast<Eigen::Index>(j)) *= lengths_[j];
    return result;
  }

  // Newton's method with the shortest steps.
  bool solve(std::vector<double>& x) const {
    for (int step = 0; step < kNewtonSteps; ++step) {
      problem_.stop().poll();
      Eigen::VectorXd values(std::ssize(problem_.equations()));
      for (Eigen::Index i = 0; i < values.size(); ++i) values(i) = problem_.equations()[i].approximate(x);
      const Eigen::VectorXd shift = least_squares(jacobian(x), values, kLeastShare).x;
      if (!shift.allFinite()) return false;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] -= lengths_[k] * shift(static_cast<Eigen::Index>(k));
      if (shift.lpNorm<Eigen::Infinity>() < kStill) return true;
    }
    return false;
  }

  // All but those for which the equations can be solved; nothing where these are dependent.
  std::optional<std::vector<int>> free_variables(const std::vector<double>& x) const {
    const Pivots chosen = pivots(jacobian(x), problem_.equations().size(), kLeastShare);
    if (chosen.rows.size() < problem_.equations().size()) return std::nullopt;
    return all_but(chosen.columns, system().size());
  }

  const Problem problem_;
  Search search_;
  const std::vector<double> lengths_ = domain_lengths(problem_.system());
};

bool has(const System& system, const std::string& coordinate) {
  return system.find(coordinate) >= 0 || std::ranges::find(system.angles, coordinate, &Angle::name) != system.angles.end();
}

std::string coordinates_of(const System& system, const Sides& solution) {
  std::string text;
  std::size_t shown = 0;
  for (int j = 0; j < system.size() && shown < kShownCoordinates; ++j, ++shown)
    text += (shown > 0 ? ", " : "") + system.variables[j].name + " = " + std::to_string(solution[j].mid());
  return text;
}

}  // namespace

PartSamples sample_parts(const System& set, const std::vector<PartOfSet>& parts, std::uint64_t seed, const StopFlag& stop) {
  Random random(seed);
  PartSamples result;
  Sampled whole(set, stop);
  const KernelCheck kernel(set, stop);
  std::vector<std::unique_ptr<Sampled>> in_parts;
  for (const PartOfSet& part : parts) in_parts.push_back(std::make_unique<Sampled>(part.system, stop));
  const auto may_be_in = [&](Sampled& part, const Sides& solution) {
    Sides sides = part.domain();
    return part.put(solution, set, sides) && !part.search().is_empty(std::move(sides), kPartsLookedAt);
  };
  const auto may_be_in_set = [&](const PartOfSet& part, const Sides& solution) {
    Sides sides = whole.domain();
    for (const std::string& coordinate : part.free)
      if (!has(part.system, coordinate)) whole.put_any(coordinate, random, sides);
    if (!whole.put(solution, part.system, sides) || !whole.search().contract(sides)) return false;
    return kernel.columns() == 0 || !kernel.is_at_most(0, Box(sides.begin(), sides.end()));
  };
  // Returns how many were drawn.
  const auto draw = [&](Sampled& from, const auto& is_in_others, const std::string& fault) {
    std::size_t drawn = 0;
    for (int attempt = 0; attempt < kAttempts && drawn < kSamples; ++attempt) {
      const std::optional<Sides> solution = from.draw(random);
      if (!solution) continue;
      ++drawn;
      if (is_in_others(*solution)) continue;
      result.failures.push_back(fault + ": " + coordinates_of(from.system(), *solution));
      break;
    }
    return drawn;
  };
  const auto is_in_a_part = [&](const Sides& solution) {
    return std::ranges::any_of(in_parts, [&](const auto& part) { return may_be_in(*part, solution); });
  };
  result.of_set = draw(whole, is_in_a_part, "a solution of the set is in no part");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto is_in_set = [&](const Sides& solution) { return may_be_in_set(parts[k], solution); };
    result.of_parts += draw(*in_parts[k], is_in_set, "a solution of the part '" + parts[k].name + "' is not in the set");
  }
  return result;
}

}  // namespace corank::check
