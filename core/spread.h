// Over how much numbers spread: along which side many boxes are to be halved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace corank {

struct Spread {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  void add(double x) {
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
};

/// The first one that is widest; 0 where there is none.
inline std::size_t widest(std::span<const Spread> spreads) {
  std::size_t result = 0;
  for (std::size_t j = 1; j < spreads.size(); ++j)
    if (spreads[j].greatest - spreads[j].least > spreads[result].greatest - spreads[result].least) result = j;
  return result;
}

/// Halves a list: no member of the first half, which may have one less, comes after one of the second by `before`, which
/// compares pairs of a member's number and the member. What the numbers are read from is looked at once for each member.
template <class Member, class Number, class Before>
void halve(std::span<Member> list, Number number, Before before, std::vector<std::pair<double, Member>>& room) {
  room.clear();
  for (const Member member : list) room.emplace_back(number(member), member);
  const auto half = room.begin() + list.size() / 2;
  std::nth_element(room.begin(), half, room.end(), before);
  for (std::size_t k = 0; k < list.size(); ++k) list[k] = room[k].second;
}

}  // namespace corank
