#include "corank/core/cover.h"

namespace corank {

const char* to_string(Verdict verdict) {
  static constexpr std::array<const char*, kVerdicts> kNames = {"regular",   "isolated", "exact",  "boundary",
                                                                "undecided", "partial",  "pending"};
  return kNames.at(index(verdict));
}

const char* to_string(Passage passage) {
  return passage == Passage::barrier ? "barrier" : passage == Passage::traversable ? "traversable" : "unproven";
}

const char* to_string(Reason reason) {
  static constexpr std::array<const char*, kReasons> kNames = {"none",      "degenerate_point", "degenerate_set",
                                                               "tolerance", "precision",        "limit"};
  return kNames.at(static_cast<std::size_t>(reason));
}

std::array<std::size_t, kVerdicts> Cover::counts() const {
  std::array<std::size_t, kVerdicts> result{};
  for (const CoverBox& b : boxes) ++result.at(index(b.verdict));
  return result;
}

std::size_t Cover::count(Verdict verdict) const { return counts().at(index(verdict)); }

}  // namespace corank
