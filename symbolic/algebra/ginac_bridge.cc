#include "corank/symbolic/algebra/ginac_bridge.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "corank/symbolic/model/evaluate.h"

namespace corank::symbolic {
namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

Expression integer_text(const numeric& n) { return Expression::number(text_of(n)); }

// |q| for q ≠ 0: a decimal where it is short, else p/q.
Expression positive_rational(const numeric& q) {
  const auto decimal = ExactNumber::rational(text_of(q)).decimal();
  if (decimal && decimal->size() <= 8 && decimal->find('e') == std::string::npos) return Expression::number(*decimal);
  if (q.is_integer()) return integer_text(q);
  return Expression::node(Expression::Kind::quotient, {integer_text(q.numer()), integer_text(q.denom())});
}

}  // namespace

std::string text_of(const ex& e) {
  std::ostringstream out;
  out << e;
  return out.str();
}

double numeric_bits(const ex& e) {
  if (is_a<numeric>(e)) {
    const numeric& q = ex_to<numeric>(e);
    if (!q.is_rational()) return q.is_crational() ? std::max(numeric_bits(q.real()), numeric_bits(q.imag())) : 64;
    return std::max(q.numer().int_length(), q.denom().int_length());
  }
  double most = 0;
  for (std::size_t i = 0; i < e.nops(); ++i) most = std::max(most, numeric_bits(e.op(i)));
  return most;
}

ex guarded_power(const ex& base, const ex& exponent) {
  if (is_a<numeric>(exponent)) {
    const numeric& n = ex_to<numeric>(exponent);
    if (!n.is_rational()) throw std::domain_error("a power with a complex exponent");
    const double size = std::abs(n.to_double());
    // 0, 1 and -1 have one bit and grow no further.
    const double bits = numeric_bits(base);
    if (!(size <= kMaxBits) || (bits > 1 && bits * size > kMaxBits))
      throw std::domain_error("a power too large to be computed exactly");
  }
  return GiNaC::pow(base, exponent);
}

numeric exact_decimal(const std::string& decimal) { return numeric(ExactNumber::rational(decimal).text().c_str()); }

std::optional<ConstantFunction> constant_function(const ex& function) {
  static const std::map<std::string, ConstantFunction> kFunctions = {
      {"sin", ConstantFunction::sin},   {"cos", ConstantFunction::cos},   {"tan", ConstantFunction::tan},
      {"asin", ConstantFunction::asin}, {"acos", ConstantFunction::acos}, {"atan", ConstantFunction::atan},
      {"exp", ConstantFunction::exp},   {"log", ConstantFunction::log},   {"abs", ConstantFunction::abs}};
  const auto known = kFunctions.find(ex_to<GiNaC::function>(function).get_name());
  return known == kFunctions.end() ? std::nullopt : std::optional(known->second);
}

GinacBridge::GinacBridge(const Mechanism& mechanism)
    : GinacBridge(names_of(mechanism.constants()), names_of(mechanism.coordinates())) {}

GinacBridge::GinacBridge(const std::vector<std::string>& constants, const std::vector<std::string>& coordinates) {
  for (const std::string& name : constants) {
    symbols_.emplace(name, GiNaC::realsymbol(name));
    constants_.emplace(name, static_cast<int>(constants_.size()));
  }
  for (const std::string& name : coordinates) {
    symbols_.emplace(name, GiNaC::realsymbol(name));
    coordinates_.emplace(name, static_cast<int>(coordinates_.size()));
  }
}

ex GinacBridge::to_ginac(const Expression& e, const SourceLocation& otherwise) const {
  const SourceLocation& where = e.where().line > 0 ? e.where() : otherwise;
  const auto operand = [&](std::size_t i) { return to_ginac(e.operands()[i], where); };
  const auto here = [&](auto&& compute) -> ex {
    try {
      return compute();
    } catch (const ModelError&) {
      throw;
    } catch (const std::exception& error) {
      throw ModelError(where, "`" + e.text() + "` has no value: " + error.what());
    }
  };
  switch (e.kind()) {
    case Expression::Kind::number: return here([&] { return ex(exact_decimal(e.name())); });
    case Expression::Kind::symbol: {
      if (e.name() == "pi") return GiNaC::Pi;
      const auto known = symbols_.find(e.name());
      if (known == symbols_.end()) throw ModelError(where, "unknown name `" + e.name() + "`", "a constant or a coordinate");
      return known->second;
    }
    case Expression::Kind::negation: return -operand(0);
    case Expression::Kind::sum:
    case Expression::Kind::product: {
      GiNaC::exvector parts;
      for (std::size_t i = 0; i < e.operands().size(); ++i) parts.push_back(operand(i));
      return here([&] {
        ex result = e.kind() == Expression::Kind::sum ? ex(GiNaC::add(parts)) : ex(GiNaC::mul(parts));
        if (numeric_bits(result) > 2 * kMaxBits) throw std::domain_error("a number too long");
        return result;
      });
    }
    case Expression::Kind::quotient: return here([&] { return operand(0) / operand(1); });
    case Expression::Kind::power: return here([&] { return guarded_power(operand(0), operand(1)); });
    case Expression::Kind::function: return here([&] { return function_value(e.name(), operand(0)); });
  }
  return 0;
}

std::set<std::string> GinacBridge::names_in(const ex& e) const {
  std::set<std::string> names;
  for (GiNaC::const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i)
    if (is_a<GiNaC::symbol>(*i)) names.insert(ex_to<GiNaC::symbol>(*i).get_name());
  return names;
}

bool GinacBridge::mentions_coordinate(const ex& e) const {
  return first_coordinate(e) < static_cast<int>(coordinates_.size());
}

int GinacBridge::first_coordinate(const ex& e) const {
  int first = static_cast<int>(coordinates_.size());
  for (GiNaC::const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i) {
    if (!is_a<GiNaC::symbol>(*i)) continue;
    const auto found = coordinates_.find(ex_to<GiNaC::symbol>(*i).get_name());
    if (found != coordinates_.end()) first = std::min(first, found->second);
  }
  return first;
}

GinacBridge::Rank GinacBridge::rank(const ex& factor) const {
  if (is_a<GiNaC::constant>(factor)) return {0, 0, ""};
  if (is_a<GiNaC::symbol>(factor)) {
    const std::string name = ex_to<GiNaC::symbol>(factor).get_name();
    const auto constant = constants_.find(name);
    if (constant != constants_.end()) return {1, constant->second, ""};
    return {2, coordinates_.at(name), ""};
  }
  if (is_a<GiNaC::function>(factor)) return {3, first_coordinate(factor), to_expression(factor).text()};
  return {4, first_coordinate(factor), to_expression(factor).text()};
}

std::vector<GinacBridge::Factor> GinacBridge::factors(const ex& term, numeric& coefficient) const {
  std::vector<Factor> result;
  const auto add = [&](const ex& f) {
    if (is_a<numeric>(f)) {
      coefficient = coefficient * ex_to<numeric>(f);
      return;
    }
    const bool is_power = is_a<GiNaC::power>(f);
    ex base = is_power ? f.op(0) : f;
    const ex exponent = is_power ? f.op(1) : ex(1);
    // GiNaC takes the sign out of a sum by its own order of terms.
    if (is_a<GiNaC::add>(base) && exponent.info(GiNaC::info_flags::integer) && begins_negative(base)) {
      base = -base;
      if (exponent.info(GiNaC::info_flags::odd)) coefficient = -coefficient;
    }
    result.push_back({rank(base), base, exponent});
  };
  for (const ex& f : parts_of<GiNaC::mul>(term)) add(f);
  std::ranges::stable_sort(result, [](const Factor& a, const Factor& b) { return a.order < b.order; });
  return result;
}

// With the sign of a numeric exponent ignored: the caller puts negative powers below the line.
Expression GinacBridge::expression(const Factor& factor) const {
  const Expression base = to_expression(factor.base);
  if (!is_a<numeric>(factor.exponent)) return pow(base, to_expression(factor.exponent));
  const numeric n = GiNaC::abs(ex_to<numeric>(factor.exponent));
  if (n == 1) return base;
  if (n == numeric(1, 2)) return sqrt(base);
  return pow(base, positive_rational(n));
}

Expression GinacBridge::product(const ex& e) const {
  using Kind = Expression::Kind;
  numeric coefficient = 1;
  const std::vector<Factor> parts = factors(e, coefficient);
  if (!coefficient.is_real()) throw std::domain_error("it is not a real number");
  std::vector<Expression> above, below;
  const numeric size = GiNaC::abs(coefficient);
  if (size != 1) above.push_back(positive_rational(size));
  for (const Factor& part : parts)
    (part.exponent.info(GiNaC::info_flags::negative) ? below : above).push_back(expression(part));
  Expression result = Expression::node(Kind::product, above);
  if (!below.empty()) result = Expression::node(Kind::quotient, {result, Expression::node(Kind::product, below)});
  return coefficient.is_negative() ? -result : result;
}

const GiNaC::exvector& GinacBridge::ordered_terms(const ex& sum) const {
  const auto known = ordered_.find(sum);
  if (known != ordered_.end()) return known->second;
  // Terms of a sum differ in their factors, so these alone decide.
  using Key = std::vector<std::tuple<Rank, bool, std::string>>;
  std::vector<std::pair<Key, ex>> terms;
  for (const ex& term : sum) {
    numeric coefficient = 1;
    Key key;
    for (const Factor& part : factors(term, coefficient))
      key.emplace_back(part.order, part.exponent.info(GiNaC::info_flags::negative), expression(part).text());
    terms.emplace_back(std::move(key), term);
  }
  std::ranges::stable_sort(terms, [](const auto& a, const auto& b) { return a.first < b.first; });
  GiNaC::exvector result;
  for (const auto& [key, term] : terms) result.push_back(term);
  return ordered_.emplace(sum, std::move(result)).first->second;
}

bool GinacBridge::begins_negative(const ex& sum) const {
  numeric coefficient = 1;
  factors(ordered_terms(sum).front(), coefficient);
  return coefficient.is_real() && coefficient.is_negative();
}

Expression GinacBridge::sum(const ex& e) const {
  std::vector<Expression> parts;
  for (const ex& term : ordered_terms(e)) parts.push_back(to_expression(term));
  return Expression::node(Expression::Kind::sum, parts);
}

Expression GinacBridge::to_expression(const ex& e) const {
  const auto known = translated_.find(e);
  if (known == translated_.end()) return translated_.emplace(e, translate(e)).first->second;
  return known->second;
}

Expression GinacBridge::translate(const ex& e) const {
  if (is_a<numeric>(e)) {
    const numeric& q = ex_to<numeric>(e);
    if (!q.is_real() || !q.is_rational()) throw std::domain_error("it is not a real number");
    if (q.is_zero()) return 0;
    return q.is_negative() ? -positive_rational(-q) : positive_rational(q);
  }
  if (is_a<GiNaC::symbol>(e)) return Expression::symbol(ex_to<GiNaC::symbol>(e).get_name());
  if (is_a<GiNaC::constant>(e)) {
    if (!e.is_equal(GiNaC::Pi)) throw std::domain_error("it contains an unknown constant");
    return pi();
  }
  if (is_a<GiNaC::add>(e)) return sum(e);
  if (is_a<GiNaC::mul>(e) || is_a<GiNaC::power>(e)) return product(e);
  if (is_a<GiNaC::function>(e) && e.nops() == 1 && constant_function(e))
    return Expression::function(ex_to<GiNaC::function>(e).get_name(), to_expression(e.op(0)));
  throw std::domain_error("`" + text_of(e) + "` is not in the model language");
}

}  // namespace corank::symbolic
