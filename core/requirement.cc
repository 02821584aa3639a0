#include "corank/core/requirement.h"

#include <array>

namespace corank {
namespace {

constexpr std::array kStandings{"satisfied", "violated", "open"};

}  // namespace

const char* to_string(Standing standing) { return kStandings[static_cast<std::size_t>(standing)]; }

std::optional<Standing> standing_from_string(const std::string& text) {
  for (std::size_t k = 0; k < kStandings.size(); ++k)
    if (text == kStandings[k]) return static_cast<Standing>(k);
  return std::nullopt;
}

}  // namespace corank
