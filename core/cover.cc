#include "corank/core/cover.h"

#include <algorithm>
#include <stdexcept>

namespace corank {
namespace {
constexpr std::array<const char*, kVerdicts> kNames = {"regular",   "isolated", "exact",  "boundary",
                                                       "undecided", "partial",  "pending"};
}

const char* to_string(Verdict verdict) { return kNames.at(static_cast<std::size_t>(verdict)); }

Verdict verdict_from_string(const std::string& text) {
  const auto at = std::find(kNames.begin(), kNames.end(), text);
  if (at == kNames.end()) throw std::invalid_argument("there is no verdict '" + text + "'");
  return static_cast<Verdict>(at - kNames.begin());
}

const char* to_string(Passage passage) {
  return passage == Passage::barrier ? "barrier" : passage == Passage::traversable ? "traversable" : "unproven";
}

const char* to_string(Reason reason) {
  switch (reason) {
    case Reason::none: return "none";
    case Reason::degenerate_point: return "degenerate_point";
    case Reason::degenerate_set: return "degenerate_set";
    case Reason::tolerance: return "tolerance";
    case Reason::precision: return "precision";
    case Reason::limit: return "limit";
  }
  return "?";
}

std::array<std::size_t, kVerdicts> Cover::counts() const {
  std::array<std::size_t, kVerdicts> result{};
  for (const CoverBox& b : boxes) ++result.at(static_cast<std::size_t>(b.verdict));
  return result;
}

std::size_t Cover::count(Verdict verdict) const { return counts().at(static_cast<std::size_t>(verdict)); }

}  // namespace corank
