// What a search is about, its parts and its state as bytes, to be stored or sent: the same on every machine that corank
// runs on. Each begins with a line that says what it is and which version has made it.
#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>

#include "corank/solve/step/options.h"
#include "corank/solve/store/journal.h"
#include "corank/solve/store/packed_found.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// Which searches may be put together: those of one version, which come to the same boxes. "0.1.0 (search 3f9a01c2b7d4)":
/// corank's version and a hash of the sources that decide what a search does.
const std::string& engine_version();

/// What was read is not what was expected, or another version of corank has made it: what() names both.
class ShardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An answer whose boxes are as they came.
struct Received {
  struct PackedShard {
    Shard shard{0, false};  ///< without found boxes: those are
    PackedFound found{};
  };
  std::uint64_t id = 0;
  std::vector<PackedShard> parts;
};

std::string to_bytes(const Prepared& prepared);
std::string to_bytes(const Unit& unit);
std::string to_bytes(const Answer& answer);
std::string to_bytes(const SearchView& state);
void write(std::ostream& out, const SearchView& state);
/// The same value again, to the last bit. They throw ShardError, also where a box does not have the sides of the question's
/// variables, or an index names nothing. What is read says what is proven, and is as trustworthy as its writer.
Prepared prepared_from(std::string_view bytes);
Unit unit_from(std::string_view bytes, const Prepared& prepared);
/// The bytes stay where they are, as long as the answer is there.
Received answer_from(std::string_view bytes, const Prepared& prepared);
SearchState state_from(std::string_view bytes, const Prepared& prepared);

}  // namespace corank::solve
