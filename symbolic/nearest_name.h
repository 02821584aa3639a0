// For messages: which of the names that exist an author may have meant.
#pragma once

#include <string>
#include <vector>

namespace corank::symbolic {

/// So many letters are to be inserted, deleted or replaced to make one name the other. Capital letters count as small ones.
std::size_t letter_changes(const std::string& a, const std::string& b);

/// The name with the fewest changes, where these are few for the length of both. Empty where there is none.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// "; did you mean 'hand'?" or nothing.
std::string suggestion(const std::string& name, const std::vector<std::string>& known);

}  // namespace corank::symbolic
