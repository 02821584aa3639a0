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

constexpr std::ptrdiff_t kNameDigits = 6;
constexpr double kLongNumber = 1e6;

bool has_long_number(const Expression& e) {
  if (e.kind() != Kind::number) return std::ranges::any_of(e.operands(), has_long_number);
  return std::ranges::count_if(e.name(), [](char c) { return c >= '0' && c <= '9'; }) > kNameDigits;
}

Expression rounded_number(double magnitude) { return Expression::number(fmt::format("{:.{}g}", magnitude, kNameDigits)); }

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
    return has_long_number(e) || std::ranges::any_of(values_, [&e](const auto& value) { return e.mentions(value.first); });
  }

  // Of what is 0: a power of ten may be left out, and the first term has no minus sign.
  Expression put_into(const Expression& zero) const {
    std::vector<Term> terms;
    double most = 0;
    for (const Expression& e : zero.kind() == Kind::sum ? zero.operands() : std::vector{zero}) {
      multiply(e, terms.emplace_back());
      most = std::max(most, std::fabs(terms.back().factor));
    }
    const double power = most < kLongNumber ? 1 : std::pow(10, std::floor(std::log10(most)));
    std::vector<Expression> sum;
    for (const Term& term : terms) sum.push_back(written(term, terms.front().factor < 0 ? -power : power));
    return Expression::node(Kind::sum, sum);
  }

 private:
  // A term as a number times the rest.
  struct Term {
    double factor = 1;
    std::vector<Expression> rest{};
  };

  static Expression written(const Term& term, double scale) {
    const Expression magnitude = rounded_number(std::fabs(term.factor / scale));
    std::vector<Expression> factors = term.rest;
    if (factors.empty() || magnitude.name() != "1") factors.insert(factors.begin(), magnitude);
    const Expression product = Expression::node(Kind::product, factors);
    return term.factor / scale < 0 ? -product : product;
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
    if (part.conditions.size() != 1 || !values.are_in(part.conditions.front())) continue;
    const std::string exact = part.conditions.front().text() + " = 0";
    if (!part.name.starts_with(exact)) continue;  // it says which coordinates it is about
    const std::string name = values.put_into(part.conditions.front()).text() + " = 0" + part.name.substr(exact.size());
    const auto has_it = [&name](const Component& other) { return other.name == name || other.former_name == name; };
    if (std::ranges::none_of(parts, has_it)) part.former_name = std::exchange(part.name, name);
  }
}

}  // namespace corank::symbolic
