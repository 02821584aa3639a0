// What is said of all robots within their tolerances, in a table and as JSON.
#pragma once

#include <string>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/robots/robots.h"

namespace corank::analyze {

/// "aspects 4, working modes 2".
std::string in_words(const ExactNumbers& numbers);
/// Lines of a table.
std::string robots_text(const Robots& robots);
/// {"tolerances", "every", "reason", "other": {"constants", numbers}}.
Json robots_json(const Robots& robots);

}  // namespace corank::analyze
