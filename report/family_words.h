// A family of mechanisms in words: what is proven of it, and what is not. HTML-free sentences.
#pragma once

#include <string>
#include <vector>

#include "corank/report/family_page.h"

namespace corank::report {

struct FamilyWords {
  std::vector<std::string> proven, unproven;
};

FamilyWords family_words(const std::vector<FamilyMember>& members, const FamilyOptions& options);

}  // namespace corank::report
