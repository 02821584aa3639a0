// What the script of a family's page reads: the plane of the portraits and each member's sets as JSON, and which variables
// of a result the page holds.
#pragma once

#include <string>
#include <vector>

#include "corank/report/family_page.h"

namespace corank::report {

/// The variables of a result in the plane of two coordinates, by index: of a length itself, of an angle its cosine and its
/// sine. Throws std::invalid_argument where the result lacks a coordinate.
std::vector<int> plane_variables(const result::Result& result, const std::array<std::string, 2>& axes);

/// The element of a set's boxes is "boxes-" and this, with members from 0: "3-forward".
std::string family_set_id(std::size_t member, const std::string& set);

/// One JSON object; numbers of variables count those of plane_variables().
std::string family_model(const std::vector<FamilyMember>& members, const FamilyOptions& options);

}  // namespace corank::report
