// The page of a family of mechanisms that differ in one constant: the output portraits of all, side by side and in one frame
// with a slider, with what is found and proven of each. One HTML file that needs no other. doc/sweep.md describes it for
// users.
//
// Of the boxes that are drawn the page holds the sides in the plane of the portrait, in the order of the results, as
// page_data.h says.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "corank/report/html/set_view.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::report {

/// The default of sigma is coarser than in corank solve by this factor: a page has many pictures, and they are small.
inline constexpr double kFamilyCoarser = 2;

struct FamilyMember {
  std::string value;               ///< of the constant, in the model language
  symbolic::Mechanism mechanism;   ///< with that value
  std::vector<SetView> sets;       ///< the same ones in the same order for every member
  std::vector<std::string> files;  ///< of the results; shown and linked
};

struct FamilyOptions {
  std::string constant;              ///< the one that differs
  std::array<std::string, 2> axes;   ///< coordinates
  std::size_t asked = 0;             ///< members that were to be; more than there are where the sweep ended early
  std::string command;               ///< the command line that made it; shown
  std::string report_command;        ///< one that makes a report of the first member; shown
  std::vector<std::string> figures;  ///< files, linked
};

/// Requires a member. Throws std::invalid_argument where an axis is no coordinate, or the members' sets differ.
std::string family_page(const std::vector<FamilyMember>& members, const FamilyOptions& options);

/// What stands on it, as JSON: {"model", "constant", "page", "complete", "members": [{"value", "sets": [{…}]}]}, of each
/// set the same as page_summary says. `page`: the page's file.
std::string family_summary(const std::string& model, const std::string& constant, const std::string& page,
                           const std::vector<FamilyMember>& members, bool complete);

}  // namespace corank::report
