// Values and ranges by name, as command lines give them: "theta1=0.3,x=15deg".
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "corank/analyze/ball.h"

namespace corank::app {

/// "a=1,b=[2,3]" in its parts, at commas outside of parentheses and brackets.
std::vector<std::string> parts_of(const std::vector<std::string>& texts);
/// Throws UsageError, with what was expected.
std::pair<std::string, std::string> split_at_equals(const std::string& text, const std::string& option,
                                                    const std::string& expected);
/// An expression of the model language, in which 15deg is an angle of 15 degrees.
symbolic::Expression expression(const std::string& text, const std::string& option);
/// NAME=VALUE, comma by comma.
std::vector<analyze::NamedValue> named_values(const std::vector<std::string>& texts, const std::string& option);

}  // namespace corank::app
