// CORANK_CHECK: a broken invariant of corank itself (never a user's mistake, never a mathematical outcome). Always on, in
// every build, because a claim of proof must not outlive a broken invariant.
#pragma once

#include <stdexcept>
#include <string>

namespace corank {

/// Thrown when an invariant of corank is broken: a bug in corank, whatever the input was.
class InvariantError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  throw InvariantError(std::string("corank: broken invariant `") + condition + "` at " + file + ":" + std::to_string(line));
}

}  // namespace corank

#define CORANK_CHECK(condition) ((condition) ? static_cast<void>(0) : ::corank::check_failed(#condition, __FILE__, __LINE__))
