#include "corank/app/named_values.h"

#include <fmt/format.h>

#include "corank/app/exit_status.h"
#include "corank/symbolic/model_file.h"

namespace corank::app {

std::vector<std::string> parts_of(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    int depth = 0;
    parts.emplace_back();
    for (const char c : text) {
      depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
      if (c == ',' && depth == 0) {
        parts.emplace_back();
      } else {
        parts.back() += c;
      }
    }
  }
  return parts;
}

std::pair<std::string, std::string> split_at_equals(const std::string& text, const std::string& option,
                                                    const std::string& expected) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw UsageError(fmt::format("{} {}: expected {}", option, text, expected));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

symbolic::Expression expression(const std::string& text, const std::string& option) {
  return symbolic::parse_expression(text, option + " " + text);
}

std::vector<analyze::NamedValue> named_values(const std::vector<std::string>& texts, const std::string& option) {
  std::vector<analyze::NamedValue> values;
  for (const std::string& part : parts_of(texts)) {
    const auto [name, value] = split_at_equals(part, option, "NAME=VALUE");
    values.push_back({name, expression(value, option)});
  }
  return values;
}

}  // namespace corank::app
