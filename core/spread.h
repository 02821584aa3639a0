// Over how much numbers spread: along which side many boxes are to be halved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace corank {

/// The first side in which the members' numbers spread most, as far as 64 of them or fewer tell. `number`: of a member and a
/// side. 0 where there is no side.
template <class Member, class Number>
std::size_t widest_side(std::span<const Member> list, std::size_t sides, Number number) {
  constexpr std::size_t kSample = 64;
  std::vector<std::pair<double, double>> spreads(sides, {HUGE_VAL, -HUGE_VAL});
  for (std::size_t k = 0; k < list.size(); k += 1 + list.size() / kSample)  // each is somewhere else in memory
    for (std::size_t j = 0; j < sides; ++j) {
      auto& [least, greatest] = spreads[j];
      least = std::min(least, number(list[k], j));
      greatest = std::max(greatest, number(list[k], j));
    }
  const auto width = [](const auto& spread) { return spread.second - spread.first; };
  return std::ranges::max_element(spreads, {}, width) - spreads.begin();
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
