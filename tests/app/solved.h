// What `corank solve` says of a set as JSON, for tests.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "corank/tests/app/program.h"

namespace corank::app {

/// Of `corank solve ARGS --json`; an empty object where the command fails, which the test then does, too.
inline nlohmann::json solved(const std::vector<std::string>& args) {
  const Outcome outcome = run_corank(with(with({"solve"}, args), {"--json"}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json::object();
}

}  // namespace corank::app
