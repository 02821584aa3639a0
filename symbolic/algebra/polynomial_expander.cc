#include "corank/symbolic/algebra/polynomial_expander.h"

#include <algorithm>
#include <cstdlib>

#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {

using Kind = Expression::Kind;

namespace {
const std::string kArgument = "a sum of integer multiples of angles, multiples of lengths and a constant";
}  // namespace

void PolynomialExpander::fail(const Expression& e, const std::string& problem, const std::string& expectation) const {
  throw ModelError(e.where().line > 0 ? e.where() : where_, problem + " in " + what_, expectation);
}

// Runs an exact computation; what it cannot do becomes an error at e.
template <typename Compute>
auto PolynomialExpander::guarded(const Expression& e, Compute&& compute) const {
  try {
    return compute();
  } catch (const ModelError&) {
    throw;
  } catch (const std::length_error& error) {
    fail(e, "the term " + in_quotes(e.text()) + " is too large: " + error.what() + ",", "a smaller polynomial");
  } catch (const std::exception& error) {
    fail(e, in_quotes(e.text()) + " has no real value: " + error.what() + ",", "a real number");
  }
}

const ConstantValue& PolynomialExpander::define(const Constant& c) {
  return constants_.insert_or_assign(c.name, constant(c.value, "the constant " + in_quotes(c.name), c.where)).first->second;
}

ConstantValue PolynomialExpander::constant(const Expression& e, const std::string& what, const SourceLocation& where) {
  const ExpandedPolynomial result = polynomial(e, what, where);
  if (const auto number = result.constant()) return *number;
  fail(e, in_quotes(e.text()) + " contains unknowns", "numbers and constants");
}

ExpandedPolynomial PolynomialExpander::polynomial(const Expression& e, const std::string& what,
                                                  const SourceLocation& where) {
  what_ = what;
  where_ = where;
  return expand(e);
}

bool PolynomialExpander::has_unknown(const Expression& e) const {
  if (e.kind() == Kind::symbol) return unknowns_.contains(e.name()) || is_angle(e.name());
  return std::any_of(e.operands().begin(), e.operands().end(), [&](const Expression& part) { return has_unknown(part); });
}

ConstantValue PolynomialExpander::value(const Expression& e) {
  if (const auto number = expand(e).constant()) return *number;
  fail(e, in_quotes(e.text()) + " is not a constant", "numbers and constants");
}

ExpandedPolynomial PolynomialExpander::expand(const Expression& e) {
  switch (e.kind()) {
    case Kind::number: return guarded(e, [&] { return ExpandedPolynomial(ConstantValue::number(e.name())); });
    case Kind::symbol: return expand_symbol(e);
    case Kind::negation: return -expand(e.operands()[0]);
    case Kind::sum: {
      ExpandedPolynomial result;
      for (const Expression& term : e.operands()) {
        const ExpandedPolynomial part = expand(term);
        guarded(e, [&] {
          result += part;
          return true;
        });
      }
      return result;
    }
    case Kind::product: {
      ExpandedPolynomial result(1);
      for (const Expression& factor : e.operands()) {
        const ExpandedPolynomial part = expand(factor);
        result = guarded(e, [&] { return result * part; });
      }
      return result;
    }
    case Kind::quotient: return expand_quotient(e);
    case Kind::power: return expand_power(e);
    case Kind::function: return expand_function(e);
  }
  return {};
}

ExpandedPolynomial PolynomialExpander::expand_symbol(const Expression& e) {
  if (e.name() == "pi") return ConstantValue::pi();
  if (const auto known = constants_.find(e.name()); known != constants_.end()) return known->second;
  if (const auto known = unknowns_.find(e.name()); known != unknowns_.end())
    return ExpandedPolynomial::variable(known->second);
  if (is_angle(e.name())) fail(e, "the angle " + in_quotes(e.name()) + " is outside sin and cos", "sin or cos of the angle");
  fail(e, "the name " + in_quotes(e.name()) + " is not declared", "a constant or a variable declared before");
}

ExpandedPolynomial PolynomialExpander::expand_quotient(const Expression& e) {
  const ExpandedPolynomial above = expand(e.operands()[0]), below = expand(e.operands()[1]);
  const auto divisor = below.constant();
  if (!divisor) fail(e, "the term " + in_quotes(e.text()) + " divides by an unknown", "a division by constants only");
  return guarded(e, [&] { return (ConstantValue(1) / *divisor) * above; });
}

ExpandedPolynomial PolynomialExpander::expand_power(const Expression& e) {
  const ExpandedPolynomial base = expand(e.operands()[0]), exponent = expand(e.operands()[1]);
  const auto n = exponent.constant();
  if (!n) fail(e, "the term " + in_quotes(e.text()) + " has an unknown in its exponent", "an integer exponent");
  if (const auto number = base.constant()) return guarded(e, [&] { return ExpandedPolynomial(pow(*number, *n)); });
  const std::optional<int> power = n->integer();
  if (!power && n->is_rational() && n->sign() == 1 && (*n - ConstantValue(kMaxExponent)).sign() != 1)
    fail(e, "the term " + in_quotes(e.text()) + " is a fractional power of an unknown", "an integer exponent");
  if ((power && *power < 0) || n->sign() == -1)
    fail(e, "the term " + in_quotes(e.text()) + " is a negative power of an unknown", "a positive integer exponent");
  if (power && *power <= kMaxExponent) return guarded(e, [&] { return pow(base, *power); });
  if (power || n->is_rational())
    fail(e, "the exponent of " + in_quotes(e.text()) + " is too large", "at most " + std::to_string(kMaxExponent));
  fail(e, "the term " + in_quotes(e.text()) + " is a power of an unknown that is not an integer", "an integer exponent");
}

ExpandedPolynomial PolynomialExpander::expand_function(const Expression& e) {
  const Expression& argument = e.operands()[0];
  if (has_unknown(argument)) {
    if (e.name() == "sin" || e.name() == "cos") return expand_sine_or_cosine(e);
    fail(e, "the term " + in_quotes(e.text()) + " is " + e.name() + " of an unknown",
         "a polynomial in unknowns and in sin and cos");
  }
  const ConstantValue x = value(argument);
  return guarded(e, [&] { return ExpandedPolynomial(ConstantValue::function(e.name(), x)); });
}

PolynomialExpander::LinearForm PolynomialExpander::linear_form(const Expression& e) {
  if (!has_unknown(e)) return {{}, value(e)};
  const auto scaled = [](const ConstantValue& factor, LinearForm form) {
    for (auto& [name, multiple] : form.multiples) multiple = factor * multiple;
    form.offset = factor * form.offset;
    return form;
  };
  switch (e.kind()) {
    case Kind::symbol: return {{{e.name(), ConstantValue(1)}}, 0};
    case Kind::negation: return scaled(-1, linear_form(e.operands()[0]));
    case Kind::sum: {
      LinearForm result;
      for (const Expression& term : e.operands()) {
        const LinearForm part = linear_form(term);
        for (const auto& [name, multiple] : part.multiples) result.multiples[name] = result.multiples[name] + multiple;
        result.offset = result.offset + part.offset;
      }
      return result;
    }
    case Kind::product: {
      LinearForm result{{}, 1};
      for (const Expression& factor : e.operands()) {
        LinearForm part = linear_form(factor);
        if (!part.multiples.empty() && !result.multiples.empty())
          fail(e, in_quotes(e.text()) + " inside sin or cos is a product of unknowns", kArgument);
        result = part.multiples.empty() ? scaled(part.offset, std::move(result)) : scaled(result.offset, std::move(part));
      }
      return result;
    }
    case Kind::quotient:
      if (!has_unknown(e.operands()[1])) {
        const ConstantValue divisor = value(e.operands()[1]);
        const ConstantValue inverse = guarded(e, [&] { return ConstantValue(1) / divisor; });
        return scaled(inverse, linear_form(e.operands()[0]));
      }
      break;
    default: break;
  }
  fail(e, in_quotes(e.text()) + " is inside sin or cos", kArgument);
}

int PolynomialExpander::whole_multiple(const Expression& e, const std::string& angle, const ConstantValue& multiple) const {
  const std::optional<int> n = multiple.integer();
  if (!n)
    fail(e, "the term " + in_quotes(e.text()) + " has a fractional multiple of the angle " + in_quotes(angle),
         "integer multiples of angles");
  if (std::abs(*n) > kMaxExponent)
    fail(e, "the multiple of the angle " + in_quotes(angle) + " in " + in_quotes(e.text()) + " is too large",
         "at most " + std::to_string(kMaxExponent));
  return *n;
}

PolynomialExpander::CosineAndSine PolynomialExpander::of_lengths(const std::map<std::string, ConstantValue>& multiples) {
  ExpandedPolynomial sum;
  for (const auto& [name, multiple] : multiples) sum += multiple * ExpandedPolynomial::variable(unknowns_.at(name));
  // One argument for x − y and y − x.
  const bool negative = sum.terms().begin()->second.sign() == -1;
  const int argument = length_functions_.argument(negative ? -sum : sum);
  const auto [c, s] = length_functions_.cosine_and_sine(argument);
  return {c, negative ? -s : s};
}

PolynomialExpander::CosineAndSine PolynomialExpander::of_constant(const Expression& argument, const ConstantValue& value) {
  std::string text = argument.text();
  if (const auto known = of_constants_.find(text); known != of_constants_.end()) return known->second;
  CosineAndSine both{ConstantValue::function("cos", value), ConstantValue::function("sin", value)};
  return of_constants_.emplace(std::move(text), std::move(both)).first->second;
}

ExpandedPolynomial PolynomialExpander::expand_sine_or_cosine(const Expression& e) {
  const LinearForm form = guarded(e, [&] { return linear_form(e.operands()[0]); });
  std::map<std::string, int> angles;
  std::map<std::string, ConstantValue> lengths;
  ConstantValue offset = form.offset;
  int quarters = 0;
  for (const auto& each : form.multiples) {  // no structured binding: C++20's lambdas may capture it, clang 14's may not
    const std::string& name = each.first;
    const ConstantValue& multiple = each.second;
    if (is_angle(name)) {
      const int n = whole_multiple(e, name, multiple);
      const auto fixed = fixed_angles_.find(name);
      const auto dependent = dependent_angles_.find(name);
      if (fixed != fixed_angles_.end()) {
        offset = guarded(e, [&] { return offset + n * fixed->second; });
      } else if (dependent != dependent_angles_.end()) {
        const DependentAngle& angle = dependent->second;
        angles[angle.other] += angle.sign * n;
        quarters += angle.quarters * n;
      } else {
        angles[name] += n;
      }
      continue;
    }
    if (multiple.is_zero()) continue;
    if (!guarded(e, [&] { return multiple.sign(); }))
      fail(e, "the multiple of " + in_quotes(name) + " in " + in_quotes(e.text()) + " cannot be distinguished from zero",
           "multiples whose sign is known");
    lengths.emplace(name, multiple);
  }
  return guarded(e, [&] {
    // cos and sin of the sum so far; then cos(a + b) = cos a cos b − sin a sin b, sin(a + b) = sin a cos b + cos a sin b.
    auto [cosine, sine] = of_constant(e.operands()[0], offset);
    const auto add = [&](const CosineAndSine& b) {
      ExpandedPolynomial next = cosine * b.first - sine * b.second;
      sine = sine * b.first + cosine * b.second;
      cosine = std::move(next);
    };
    for (; quarters % 4 != 0; quarters += quarters > 0 ? -1 : 1) {
      ExpandedPolynomial next = quarters > 0 ? -sine : sine;
      sine = quarters > 0 ? cosine : -cosine;
      cosine = std::move(next);
    }
    for (const auto& [name, n] : angles) {
      if (n == 0) continue;
      const AngleVariables& own = angles_.at(name);
      add(multiple_angle(n, ExpandedPolynomial::variable(own.cosine), ExpandedPolynomial::variable(own.sine)));
    }
    if (!lengths.empty()) add(of_lengths(lengths));
    return e.name() == "cos" ? cosine : sine;
  });
}

}  // namespace corank::symbolic
