#include "corank/symbolic/limits.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "corank/symbolic/expression_words.h"
#include "corank/symbolic/ginac_lock.h"
#include "corank/symbolic/polynomial_expander.h"

namespace corank::symbolic {
namespace {

std::string range_text(const Expression& lower, const Expression& upper) {
  return "[" + lower.text() + ", " + upper.text() + "]";
}

// Of the ends of limits and of the ranges of their coordinates. Constants that these do not need may take long.
class Values {
 public:
  explicit Values(const Mechanism& mechanism) {
    std::vector<Expression> asked;
    for (const Limit& limit : mechanism.limits()) {
      const Coordinate& c = mechanism.coordinates()[mechanism.find_coordinate(limit.coordinate)];
      asked.insert(asked.end(), {limit.lower, limit.upper, c.lower, c.upper});
    }
    const std::vector<Constant>& constants = mechanism.constants();
    std::vector<bool> needed(constants.size());
    for (std::size_t k = constants.size(); k-- > 0;) {  // each needs only those before it
      const std::string& name = constants[k].name;
      needed[k] = std::any_of(asked.begin(), asked.end(), [&name](const Expression& e) { return e.mentions(name); });
      if (needed[k]) asked.push_back(constants[k].value);
    }
    for (std::size_t k = 0; k < constants.size(); ++k) {
      const Constant& c = constants[k];
      if (needed[k])
        expander_.add_constant(c.name, expander_.constant(c.value, "the constant " + in_quotes(c.name), c.where));
    }
  }

  ConstantValue operator()(const Expression& e, const std::string& what, const SourceLocation& where) {
    return expander_.constant(e, what, where);
  }

 private:
  PolynomialExpander expander_;
};

// Is it one? Throws where it is faulty.
bool is_effective(const Limit& limit, const Coordinate& coordinate, Values& values) {
  const std::string what = "the limit of " + in_quotes(limit.coordinate),
                    text = what + ", " + range_text(limit.lower, limit.upper) + ",";
  const ConstantValue lower = values(limit.lower, what, limit.where), upper = values(limit.upper, what, limit.where);
  const ConstantValue turn = ConstantValue(2) * ConstantValue::pi();
  const std::optional<int> width = (upper - lower).sign();
  if (width == -1) throw ModelError(limit.where, text + " is empty", "a lower end that is below the upper one");
  if (width.value_or(0) == 0)
    throw ModelError(limit.where, text + " is one value",
                     "a lower end that is below the upper one, or a range of one value");
  if (!lower.exact().enclose().is_bounded() || !upper.exact().enclose().is_bounded())
    throw ModelError(limit.where, text + " is unbounded", "ends within double precision's range");
  const bool angle = coordinate.kind == CoordinateKind::angle;
  if (angle && (turn - (upper - lower)).sign().value_or(0) <= 0) return false;
  if (!coordinate.has_range) return true;
  const std::string range = "the range of " + in_quotes(limit.coordinate);
  const ConstantValue from = values(coordinate.lower, range, coordinate.where),
                      to = values(coordinate.upper, range, coordinate.where);
  if (angle && (turn - (to - from)).sign().value_or(0) <= 0) return true;
  if ((lower - from).sign().value_or(-1) < 0 || (to - upper).sign().value_or(-1) < 0)
    throw ModelError(limit.where,
                     text + " reaches beyond the declared range, " + range_text(coordinate.lower, coordinate.upper),
                     "a range that holds the limit");
  return true;
}

}  // namespace

std::vector<Limit> effective_limits(const Mechanism& mechanism) {
  if (mechanism.limits().empty()) return {};
  const GinacLock lock;
  Values values(mechanism);
  std::vector<Limit> result;
  for (const Limit& limit : mechanism.limits()) {
    try {
      const int index = mechanism.find_coordinate(limit.coordinate);
      if (is_effective(limit, mechanism.coordinates()[index], values)) result.push_back(limit);
    } catch (const std::domain_error& error) {
      throw ModelError(limit.where, "the limit of " + in_quotes(limit.coordinate) + " has no real ends: " + error.what(),
                       "real numbers");
    }
  }
  return result;
}

Mechanism limits_as_ranges(Mechanism mechanism) {
  for (const Limit& limit : effective_limits(mechanism)) mechanism.set_range(limit.coordinate, limit.lower, limit.upper);
  mechanism.clear_limits();
  return mechanism;
}

void keep_limits(const Mechanism& mechanism, std::vector<Coordinate>& coordinates) {
  for (const Limit& limit : effective_limits(mechanism)) {
    Coordinate& c = coordinates[mechanism.find_coordinate(limit.coordinate)];
    c.lower = limit.lower;
    c.upper = limit.upper;
    c.has_range = true;
  }
}

}  // namespace corank::symbolic
