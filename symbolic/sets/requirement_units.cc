#include "corank/symbolic/sets/requirement_units.h"

#include <algorithm>
#include <array>

#include "corank/core/check.h"

namespace corank::symbolic {
namespace {

// In metres, radians, newtons, newton metres.
struct Unit {
  const char* name;
  Dimension dimension;
  const char* size;
};
constexpr std::array kLengths{Unit{"um", Dimension::length, "1e-6"}, Unit{"mm", Dimension::length, "1e-3"},
                              Unit{"cm", Dimension::length, "1e-2"}, Unit{"dm", Dimension::length, "1e-1"},
                              Unit{"m", Dimension::length, "1"}};
constexpr std::array kOthers{Unit{"rad", Dimension::angle, "1"},      Unit{"mrad", Dimension::angle, "1e-3"},
                             Unit{"deg", Dimension::angle, "pi/180"}, Unit{"N", Dimension::force, "1"},
                             Unit{"kN", Dimension::force, "1e3"},     Unit{"mN", Dimension::force, "1e-3"}};

template <std::size_t n>
const Unit* find(const std::array<Unit, n>& units, const std::string& name) {
  const auto found = std::ranges::find(units, name, &Unit::name);
  return found == units.end() ? nullptr : &*found;
}

// An angle that counts as a length, where a ball is about its values (Mechanism::unroll).
bool is_in_sines_alone(const Mechanism& mechanism, const std::string& name) {
  bool some = false;
  const auto outside = [&](const auto& self, const Expression& e, bool inside) -> bool {
    if (e.kind() == Expression::Kind::symbol && e.name() == name) {
      some = true;
      return !inside;
    }
    const bool sine = e.kind() == Expression::Kind::function && (e.name() == "sin" || e.name() == "cos");
    return std::ranges::any_of(e.operands(), [&](const Expression& x) { return self(self, x, inside || sine); });
  };
  for (const Constraint& c : mechanism.equations())
    if (outside(outside, c.relation.lhs, false) || outside(outside, c.relation.rhs, false)) return false;
  return some;
}

}  // namespace

Dimension dimension_of(const Mechanism& mechanism, const std::string& name) {
  const int rate = mechanism.find_rate(name), coordinate = mechanism.find_coordinate(name);
  if (rate >= 0) return mechanism.rates()[rate].kind == CoordinateKind::angle ? Dimension::angle : Dimension::length;
  const Coordinate& c = mechanism.coordinates()[coordinate];
  if (c.direction) return Dimension::number;
  return c.kind == CoordinateKind::angle || is_in_sines_alone(mechanism, name) ? Dimension::angle : Dimension::length;
}

const char* word(Dimension dimension) {
  static constexpr std::array kWords{"a number", "a length", "an angle", "a force", "a moment"};
  return kWords[static_cast<std::size_t>(dimension)];
}

Expression size_of_unit(const std::string& unit, Dimension wanted, const std::string& own) {
  const auto length = [&](const Unit& u) -> Expression {
    const Unit* model = find(kLengths, own);
    if (!model)
      throw RequirementFault(own.empty() ? "the model has no unit of lengths" : "the model's unit of lengths is " + own,
                             "a model with a line such as `unit mm`, or limits without a unit of length");
    return Expression(u.size) / Expression(model->size);
  };
  const auto check = [&](Dimension d) {
    if (d != wanted) throw RequirementFault(unit + " is the unit of " + word(d), std::string("the unit of ") + word(wanted));
  };
  if (const Unit* u = find(kLengths, unit)) {
    check(Dimension::length);
    return length(*u);
  }
  if (const Unit* u = find(kOthers, unit)) {
    check(u->dimension);
    return u->size;
  }
  check(Dimension::moment);
  const std::size_t blank = unit.find(' ');
  const Unit* const force = find(kOthers, unit.substr(0, blank));
  const Unit* const arm = find(kLengths, unit.substr(blank + 1));
  CORANK_CHECK(force && arm);  // the grammar knows no other
  return Expression(force->size) * length(*arm);
}

}  // namespace corank::symbolic
