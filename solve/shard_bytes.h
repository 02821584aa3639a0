// Parts of a search as bytes, to be stored or sent: the same on every machine that corank runs on.
#pragma once

#include <stdexcept>
#include <string>

#include "corank/solve/shard.h"

namespace corank::solve {

/// What was read is no work or shard of this version of corank.
class ShardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::string to_bytes(const Work& work);
std::string to_bytes(const Shard& shard);
/// The same value again, to the last bit. Throw ShardError. What is read is as trustworthy as who has written it: it says
/// what is proven.
Work work_from(const std::string& bytes);
Shard shard_from(const std::string& bytes);

}  // namespace corank::solve
