// Exact numbers as a line in prefix notation: the same expression again, node by node, which text() in the model language
// does not promise.
#pragma once

#include <string>
#include <string_view>

#include "corank/core/exact_number.h"

namespace corank {

/// "3/4 ", "+ 0 2 …" …
std::string to_prefix(const ExactNumber& x);
/// Throws std::invalid_argument where the text is no such line.
ExactNumber from_prefix(std::string_view text);

}  // namespace corank
