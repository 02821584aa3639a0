// Systems and covers for tests of the checker.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "corank/check/checker.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::check {

inline constexpr const char* kCircle = "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n";
inline ExactNumber number(const char* text) { return ExactNumber::rational(text); }

/// A plain system in the model language.
inline System plain(const std::string& text) {
  return symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(text, "test")));
}

/// A set of one of the repository's models, with constants of its own ("L2", "1").
inline System model(const std::string& name, symbolic::SingularitySet set,
                    const std::vector<std::pair<std::string, std::string>>& constants = {}) {
  auto mechanism = symbolic::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik");
  for (const auto& [constant, value] : constants) mechanism.set_constant(constant, symbolic::parse_expression(value));
  return symbolic::algebrize(symbolic::singularity_system(mechanism, set));
}

inline Cover solved(const System& system, double sigma) {
  solve::Options options;
  options.sigma = sigma;
  return solve::solve(system, options);
}

inline std::string text(const Report& report) {
  std::string all = report.interrupted ? "interrupted\n" : "";
  for (const Failure& f : report.failures)
    all += std::to_string(static_cast<int>(f.place)) + " " + std::to_string(f.index) + ": " + f.reason + "\n";
  return all;
}

/// Every box of the cover is verified.
inline void expect_verified(const System& system, const Cover& cover) {
  const Report report = check(system, cover);
  EXPECT_TRUE(report.verified()) << text(report);
  std::size_t boxes = 0;
  for (const Tally& t : report.boxes) boxes += t.verified;
  EXPECT_EQ(boxes, cover.boxes.size());
  EXPECT_GT(boxes, 0u);
  EXPECT_FALSE(report.proof.present);
}

inline Tally tally(const Report& report, Verdict verdict) { return report.boxes[static_cast<std::size_t>(verdict)]; }

inline std::size_t first(const Cover& cover, Verdict verdict) {
  for (std::size_t i = 0; i < cover.boxes.size(); ++i)
    if (cover.boxes[i].verdict == verdict) return i;
  ADD_FAILURE() << "no box is " << to_string(verdict);
  return 0;
}

}  // namespace corank::check
