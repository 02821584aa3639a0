#include "corank/symbolic/sets/idle_coordinates.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {
namespace {

// The equations that are left, and in how many of them, and of the inequalities, each coordinate stands.
class RemainingEquations {
 public:
  RemainingEquations(const Mechanism& mechanism, const std::vector<std::string>& kept)
      : mechanism_(mechanism), system_(plain_system(mechanism)), compiled_(algebrize(system_)) {
    std::vector<Expression> residuals;
    for (const auto* list : {&system_.equations, &system_.inequalities})
      for (const auto& e : *list) {
        residuals.push_back(e.relation.lhs - e.relation.rhs);
        for (const std::string& name : rows_.emplace_back(mentioned(residuals.back()))) ++uses_[name];
      }
    polynomials_ = polynomials(system_, residuals);
    kept_.insert(kept.begin(), kept.end());
    kept_.insert(mechanism.outputs().begin(), mechanism.outputs().end());
    for (const Limit& limit : effective_limits(mechanism)) limited_.insert(limit.coordinate);
  }

  // Leaves out an equation and returns its x; empty where there is none.
  std::string leave_one_out() {
    for (std::size_t i = 0; i < system_.equations.size(); ++i)
      for (const std::string& name : rows_[i])
        if (uses_[name] == 1 && !kept_.contains(name) && !limited_.contains(name) && gives(i, name)) {
          const std::string x = name;
          for (const std::string& other : std::exchange(rows_[i], {})) --uses_[other];
          return x;
        }
    return {};
  }

  bool is_idle(const Coordinate& c) const {
    const auto uses = uses_.find(c.name);
    return !kept_.contains(c.name) && !is_fixed(c) && (uses == uses_.end() || uses->second == 0);
  }

 private:
  std::vector<std::string> mentioned(const Expression& e) const {
    std::vector<std::string> names;
    for (const Coordinate& c : system_.coordinates)
      if (e.mentions(c.name)) names.push_back(c.name);
    return names;
  }

  bool gives(std::size_t row, const std::string& name) const {
    const Coordinate& c = system_.coordinates[mechanism_.find_coordinate(name)];
    const int variable = compiled_.find(name);
    if (c.kind != CoordinateKind::length || variable < 0) return false;
    const UpwardRounding rounding;
    const std::optional<Polynomial> value = certify::solved_for(polynomials_[row], variable);
    if (!value) return false;
    const bool was_found = !mechanism_.coordinates()[mechanism_.find_coordinate(name)].has_range;
    const Interval domain = compiled_.variables[variable].domain;
    const auto holds = [&](const Interval& values) { return domain.lo() < values.lo() && values.hi() < domain.hi(); };
    return was_found || (c.within_one && holds(Interval(-1, 1))) || holds(certify::evaluate(*value, compiled_.domain()));
  }

  const Mechanism& mechanism_;
  TrigonometricSystem system_;
  System compiled_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<Polynomial> polynomials_;
  std::map<std::string, int> uses_;
  std::set<std::string> kept_, limited_;
};

}  // namespace

IdleCoordinates idle_coordinates(const Mechanism& mechanism, const std::vector<std::string>& kept) {
  IdleCoordinates idle;
  try {
    RemainingEquations equations(mechanism, kept);
    for (std::string x; !(x = equations.leave_one_out()).empty();) idle.given.push_back(std::move(x));
    for (const Coordinate& c : mechanism.coordinates())
      if (equations.is_idle(c) && std::ranges::find(idle.given, c.name) == idle.given.end()) idle.free.push_back(c.name);
  } catch (const ModelError&) {  // what is wrong with the model, others say
    return {};
  }
  return idle;
}

Mechanism without_idle(const Mechanism& mechanism, const IdleCoordinates& idle) {
  if (idle.free.empty()) return mechanism;
  std::vector<std::string> names = idle.free;
  names.insert(names.end(), idle.given.begin(), idle.given.end());
  return mechanism.without(names);
}

}  // namespace corank::symbolic
