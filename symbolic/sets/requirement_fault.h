// What is wrong with a requirement, before it is said of which line.
#pragma once

#include <stdexcept>
#include <string>

namespace corank::symbolic {

struct RequirementFault : std::runtime_error {
  RequirementFault(const std::string& problem, std::string expected)
      : std::runtime_error(problem), expectation(std::move(expected)) {}
  std::string expectation;
};

}  // namespace corank::symbolic
