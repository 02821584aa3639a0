// For messages: which of the names that exist an author may have meant.
#pragma once

#include <string>
#include <vector>

namespace corank::kinematics {

/// The name with the fewest changes of letters (insert, delete, replace), where these are few for the length of both.
/// Capital letters count as small ones. Empty where there is none.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// "; did you mean 'hand'?" or nothing.
std::string suggestion(const std::string& name, const std::vector<std::string>& known);

}  // namespace corank::kinematics
