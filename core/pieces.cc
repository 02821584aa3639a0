#include "corank/core/pieces.h"

#include <algorithm>

namespace corank {

int PieceClaims::members_with(int requirements) const {
  return static_cast<int>(std::ranges::count(members, requirements, &PieceMember::requirements));
}

}  // namespace corank
