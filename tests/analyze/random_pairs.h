// Pairs of random configurations of a mechanism, and what is asked of the answers about them.
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "corank/analyze/paths/path.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {

struct RandomRange {
  std::string name;
  double lower, upper;
};

/// Configurations with values of three decimals of these coordinates, drawn until there is one.
class RandomConfigurations {
 public:
  RandomConfigurations(const PathFinder& finder, std::vector<RandomRange> ranges, unsigned seed)
      : finder_(finder), ranges_(std::move(ranges)), random_(seed) {}

  Box draw(solve::Control& control) {
    for (;;) {
      std::vector<NamedValue> values;
      for (const RandomRange& r : ranges_) {
        const double value = std::uniform_real_distribution<double>(r.lower, r.upper)(random_);
        values.push_back({r.name, symbolic::parse_expression(fmt::format("{:.3f}", value), r.name)});
      }
      try {
        const std::vector<Box> found = finder_.ends(values, control);
        if (!found.empty()) return found[std::uniform_int_distribution<std::size_t>(0, found.size() - 1)(random_)];
      } catch (const EndError&) {
        // outside, or on the edge
      }
    }
  }

 private:
  const PathFinder& finder_;
  std::vector<RandomRange> ranges_;
  std::mt19937_64 random_;
};

}  // namespace corank::analyze
