#include "corank/app/family.h"

#include <fmt/format.h>

#include <charconv>

#include "corank/app/exit_status.h"
#include "corank/core/exact_number.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::app {
namespace {
using symbolic::Expression;

bool is_swept(const std::string& definition) {
  const std::size_t equals = definition.find('=');
  return equals != std::string::npos && definition.find(':', equals) != std::string::npos;
}

[[noreturn]] void refuse(const std::string& definition, const std::string& expected) {
  throw UsageError(fmt::format("-D {}: expected {}", definition, expected));
}

int count_of(const std::string& definition, const std::string& text) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 2 || count > Family::kMost)
    refuse(definition, fmt::format("a COUNT from 2 to {}", Family::kMost));
  return count;
}

/// The number, where numbers and + − · / make it.
std::optional<ExactNumber> rational(const Expression& e) {
  if (e.kind() == Expression::Kind::number) return ExactNumber::rational(e.name());
  std::vector<ExactNumber> x;
  for (const Expression& operand : e.operands()) {
    const std::optional<ExactNumber> value = rational(operand);
    if (!value) return std::nullopt;
    x.push_back(*value);
  }
  ExactNumber result;
  switch (e.kind()) {
    case Expression::Kind::negation: return -x[0];
    case Expression::Kind::quotient:
      if (x[1].is_zero()) return std::nullopt;
      return x[0] / x[1];
    case Expression::Kind::sum:
      for (const ExactNumber& term : x) result = result + term;
      return result;
    case Expression::Kind::product:
      result = 1;
      for (const ExactNumber& factor : x) result = result * factor;
      return result;
    default: return std::nullopt;
  }
}

std::string text_of(const ExactNumber& x) {
  const std::optional<std::string> decimal = x.decimal();
  return decimal && decimal->size() <= 8 && decimal->find('e') == std::string::npos ? *decimal : x.text();
}

std::vector<std::string> values_between(const std::string& definition, const Expression& from, const Expression& to,
                                        int count) {
  const std::optional<ExactNumber> a = rational(from), b = rational(to);
  if ((a && b && *a == *b) || same_tree(from, to)) refuse(definition, "two values FROM and TO that differ");
  std::vector<std::string> values;
  for (int k = 0; k < count; ++k) {
    const ExactNumber part = ExactNumber(k) / ExactNumber(count - 1);
    if (a && b) {
      values.push_back(text_of(*a + part * (*b - *a)));
    } else if (k == 0 || k == count - 1) {
      values.push_back((k == 0 ? from : to).text());
    } else {
      values.push_back((from + Expression(part.text()) * (to - from)).text());
    }
  }
  return values;
}

}  // namespace

Family family_of(const std::vector<std::string>& definitions) {
  std::string swept;
  for (const std::string& definition : definitions) {
    if (!is_swept(definition)) continue;
    if (!swept.empty()) throw UsageError(fmt::format("-D {} and -D {}: only one constant can be swept", swept, definition));
    swept = definition;
  }
  if (swept.empty()) throw UsageError("a constant to sweep is required: -D NAME=FROM:TO:COUNT");
  const std::size_t equals = swept.find('='), first = swept.find(':', equals), second = swept.find(':', first + 1);
  const bool whole = equals > 0 && first > equals + 1 && second != std::string::npos && second > first + 1 &&
                     swept.find(':', second + 1) == std::string::npos;
  if (!whole) refuse(swept, "NAME=FROM:TO:COUNT");
  const int count = count_of(swept, swept.substr(second + 1));
  const auto expression = [&](std::size_t begin, std::size_t end) {
    return symbolic::parse_expression(swept.substr(begin, end - begin), "-D " + swept.substr(0, equals));
  };
  return {swept.substr(0, equals),
          values_between(swept, expression(equals + 1, first), expression(first + 1, second), count)};
}

std::vector<std::string> definitions_of(const Family& family, std::size_t k, const std::vector<std::string>& definitions) {
  std::vector<std::string> own = definitions;
  for (std::string& definition : own)
    if (is_swept(definition)) definition = family.constant + "=" + family.values[k];
  return own;
}

}  // namespace corank::app
