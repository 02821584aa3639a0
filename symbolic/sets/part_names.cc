#include "corank/symbolic/sets/part_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "corank/symbolic/model/evaluate.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

bool is_rational(const Expression& e) {
  return e.kind() != Kind::symbol && e.kind() != Kind::function && e.kind() != Kind::power &&
         std::ranges::all_of(e.operands(), is_rational);
}

Expression rounded_number(double magnitude) { return Expression::number(fmt::format("{:.6g}", magnitude)); }

class RoundedValues {
 public:
  explicit RoundedValues(const Mechanism& mechanism) {
    std::map<std::string, double> known;
    for (const Constant& c : mechanism.constants()) {
      const double value = known[c.name] = evaluate(c.value, known);
      if (!is_of_corank(c) || !std::isfinite(value)) continue;
      values_[c.name] = value;
      const Expression magnitude = rounded_number(std::fabs(value));
      numbers_.emplace(c.name, value < 0 ? -magnitude : magnitude);
    }
  }

  bool are_in(const Expression& e) const {
    return std::ranges::any_of(values_, [&e](const auto& value) { return e.mentions(value.first); });
  }

  // Of what is 0: the first term has no minus sign.
  Expression put_into(const Expression& zero) const {
    if (zero.kind() != Kind::sum) return put_into_term(zero);
    std::vector<Expression> terms;
    for (const Expression& term : zero.operands()) terms.push_back(put_into_term(term));
    if (terms.front().kind() == Kind::negation)
      for (Expression& term : terms) term = term.kind() == Kind::negation ? term.operands()[0] : -term;
    return Expression::node(Kind::sum, terms);
  }

 private:
  // A term as a number times the rest.
  struct Term {
    double factor = 1;
    std::vector<Expression> rest{};
  };

  Expression put_into_term(const Expression& e) const {
    if (!are_in(e)) return e;
    Term term;
    multiply(e, term);
    const Expression magnitude = rounded_number(std::fabs(term.factor));
    std::vector<Expression>& factors = term.rest;
    if (factors.empty() || magnitude.name() != "1") factors.insert(factors.begin(), magnitude);
    const Expression product = Expression::node(Kind::product, factors);
    return term.factor < 0 ? -product : product;
  }

  void multiply(const Expression& e, Term& term) const {
    Term below;
    if (e.kind() == Kind::quotient) multiply(e.operands()[1], below);
    const auto value = values_.find(e.kind() == Kind::power ? e.operands()[0].name() : e.name());
    const bool is_value = value != values_.end();
    if (e.kind() == Kind::number) {
      term.factor *= std::strtod(e.name().c_str(), nullptr);
    } else if (e.kind() == Kind::symbol && is_value) {
      term.factor *= value->second;
    } else if (e.kind() == Kind::power && is_value && e.operands()[1].is_whole_number()) {
      term.factor *= std::pow(value->second, std::strtod(e.operands()[1].name().c_str(), nullptr));
    } else if (e.kind() == Kind::negation) {
      term.factor = -term.factor;
      multiply(e.operands()[0], term);
    } else if (e.kind() == Kind::product) {
      for (const Expression& factor : e.operands()) multiply(factor, term);
    } else if (e.kind() == Kind::quotient && below.rest.empty()) {
      multiply(e.operands()[0], term);
      term.factor /= below.factor;
    } else {
      term.rest.push_back(e.substituted(numbers_));
    }
  }

  std::map<std::string, double> values_;
  std::map<std::string, Expression> numbers_;
};

}  // namespace

bool is_of_corank(const Constant& constant) {
  const std::string& name = constant.name;
  return name.size() > 1 && name[0] == 'k' && name.find_first_not_of("0123456789", 1) == std::string::npos &&
         !is_rational(constant.value);
}

void name_by_values(const Mechanism& mechanism, std::vector<Component>& parts) {
  const RoundedValues values(mechanism);
  for (Component& part : parts) {
    if (!part.condition || !values.are_in(*part.condition)) continue;
    const std::string exact = part.condition->text() + " = 0";
    if (!part.name.starts_with(exact)) continue;  // it says which coordinates it is about
    const std::string name = values.put_into(*part.condition).text() + " = 0" + part.name.substr(exact.size());
    const auto has_it = [&name](const Component& other) { return other.name == name || other.former_name == name; };
    if (std::ranges::none_of(parts, has_it)) part.former_name = std::exchange(part.name, name);
  }
}

}  // namespace corank::symbolic
