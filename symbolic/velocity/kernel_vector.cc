#include "corank/symbolic/velocity/kernel_vector.h"

#include <algorithm>

#include "corank/core/exact_number.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {

using Kind = Expression::Kind;

SourceLocation model_place(const Mechanism& mechanism) {
  for (const Constraint& constraint : mechanism.constraints())
    if (!constraint.where.file.empty()) return {constraint.where.file, 0, 0};
  return {mechanism.name(), 0, 0};
}

std::vector<std::string> kernel_names(const Mechanism& mechanism, std::size_t n, std::size_t vectors, std::string prefix) {
  for (;; prefix += "_") {
    std::vector<std::string> names;
    for (std::size_t v = 0; v < vectors; ++v)
      for (std::size_t i = 0; i < n; ++i)
        names.push_back(prefix + (vectors > 1 ? std::to_string(v + 1) + "_" : "") + std::to_string(i + 1));
    if (std::ranges::none_of(names, [&](const std::string& name) { return mechanism.has(name); })) return names;
  }
}

Expression times(const Expression& entry, const Expression& unknown) {
  if (same_tree(entry, Expression(1))) return unknown;
  if (entry.kind() == Kind::negation) return -times(entry.operands()[0], unknown);
  return entry * unknown;
}

Expression positive_number(const std::string& text, const std::string& unknown) {
  bool positive = false;
  try {
    positive = ExactNumber::rational(text).sign() == 1;
  } catch (const std::exception&) {  // no number
  }
  if (!positive)
    throw ModelError({"scale of " + unknown, 0, 0}, "'" + text + "' is not a scale", "a positive rational number");
  return parse_expression(text, "scale of " + unknown);
}

std::vector<Expression> symbols(const std::vector<std::string>& names) {
  std::vector<Expression> list;
  for (const std::string& name : names) list.push_back(Expression::symbol(name));
  return list;
}

std::vector<Expression> scaled(const std::vector<std::string>& unknowns, const std::vector<std::string>& scales) {
  std::vector<Expression> result;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const Expression unknown = Expression::symbol(unknowns[j]);
    const bool plain = scales.empty() || scales[j] == "1";
    result.push_back(plain ? unknown : positive_number(scales[j], unknowns[j]) * unknown);
  }
  return result;
}

std::optional<Expression> kernel_row(const std::vector<Expression>& entries, const std::vector<Expression>& unknowns) {
  std::vector<Expression> terms;
  for (std::size_t j = 0; j < entries.size(); ++j)
    if (!same_tree(entries[j], Expression(0))) terms.push_back(times(entries[j], unknowns[j]));
  if (terms.empty()) return std::nullopt;
  return Expression::node(Kind::sum, terms);
}

Expression sum_of(const std::vector<Expression>& terms) { return Expression::node(Kind::sum, terms); }

Expression square_of(const std::vector<Expression>& x) {
  std::vector<Expression> terms;
  for (const Expression& component : x) terms.push_back(pow(component, 2));
  return sum_of(terms);
}

Expression dot(const std::vector<Expression>& x, const std::vector<Expression>& y) {
  std::vector<Expression> terms;
  for (std::size_t k = 0; k < x.size(); ++k) terms.push_back(x[k] * y[k]);
  return sum_of(terms);
}

Expression generic_form(const std::vector<Expression>& x) {
  std::vector<Expression> terms;
  for (const Expression& component : x) {
    const unsigned long fraction = (terms.size() + 1) * 618'034UL % 1'000'000UL;
    const std::string digits = std::to_string(3000 + 7 * fraction / 1000);  // in 3000 … 9999
    terms.push_back(Expression::number("0." + digits) * component);
  }
  return sum_of(terms);
}

}  // namespace corank::symbolic
