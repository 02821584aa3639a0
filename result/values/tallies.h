// What the table and the JSON object of a result count and list.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "corank/result/values/result.h"

namespace corank::result {

inline constexpr std::array kVerdictsInOrder{Verdict::regular, Verdict::isolated,  Verdict::exact,  Verdict::boundary,
                                             Verdict::partial, Verdict::undecided, Verdict::pending};
static_assert(kVerdictsInOrder.size() == kVerdicts);

/// Is there a solution in such a box that is surely within the ranges? A `boundary` box may hold one outside, a `partial`
/// one none.
inline bool is_surely_within(Verdict verdict) {
  return verdict == Verdict::regular || verdict == Verdict::isolated || verdict == Verdict::exact;
}

/// How many of the items are so.
template <class Items, class Is>
std::size_t how_many(const Items& items, const Is& is) {
  return std::count_if(items.begin(), items.end(), is);
}

/// How many undecided boxes there are with each reason.
std::map<Reason, std::size_t> undecided_reasons(const Cover& cover);

/// How many boxes there are with each passage, in the order of Passage.
std::array<std::size_t, kPassages> passages(const Cover& cover);

/// Of each box: is it a smooth piece of which it is not shown that it has a solution for every value of the free variables
/// (spans)? A whole has the boxes of its parts, in their order, of which only these know.
std::vector<bool> on_parts_of_sheets(const Result& result);
/// How many there are.
std::size_t parts_of_sheets(const Result& result);

/// Boxes that lie on the self-motion of that number.
std::size_t boxes_on(const Cover& cover, std::size_t motion);

/// One of the model's own coordinates in a box.
struct Value {
  std::string name;
  Interval value;
  int variable;  ///< −1: an angle
  const Angle* angle = nullptr;
};
/// The model's own coordinates among the first variables, without values: an angle stands in place of its cosine and sine,
/// in the order of the variables.
std::vector<Value> own_coordinates(const Result& result, int variables);
/// The same with what they are in the box.
std::vector<Value> values(const Result& result, const CoverBox& box, int variables);

/// Boxes by what is proven of the types of the solutions in them.
struct TypeTally {
  std::map<SingularityType, std::size_t>
      proven;                ///< boxes that hold solutions, all of this type; of each that was asked for
  std::size_t unproven = 0;  ///< boxes that may hold none, or where a type that makes up the set is not settled
};
/// No types where none were asked for.
TypeTally type_tally(const Cover& cover);
/// "RO, II".
std::vector<std::string> type_names(TypeSet types);

/// The point that the box names, if any.
const ExactPoint* exact_point(const Result& result, const CoverBox& box);

/// Constants with tolerances.
std::vector<const ResultVariable*> parameters_of(const Result& result);

/// Boxes by the bound of the kernel's dimension; without the undecided boxes that may hold no solution.
struct KernelTally {
  std::map<int, std::size_t> at_most;
  std::size_t larger = 0;     ///< with a bound above the corank that was asked for
  std::size_t explained = 0;  ///< of these, with a point where the dimension is known to be above 1
  std::size_t known = 0;      ///< of the others, likewise: the corank asked for was above 1
};
KernelTally kernel_tally(const Result& result);

}  // namespace corank::result
