// Files of maps whose numbers are known at every value.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "corank/analyze/maps/parameter_map.h"
#include "corank/study/model.h"

namespace corank::analyze {

using result::MapFile;

inline MapFile make_file(const MapQuestion& question, int resolution) {
  solve::Control control;
  const ParameterMap map =
      parameter_map(question, {.resolution = resolution, .boundary = false, .certificate = true, .threads = 2}, control);
  return to_file(question, map);
}

inline study::Question question_of(const std::string& text) {
  study::Model model = study::parse_model({text, "test.cuik"});
  return {.model = std::move(model.mechanism)};
}

inline study::Question model_question(const std::string& file, symbolic::SingularitySet set) {
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + file);
  return {.model = std::move(model.mechanism), .set = set};
}

/// Why there is no such map; "none": there is one.
inline std::string refusal_of(MapQuestion question) {
  try {
    ParameterMapper(std::move(question), {});
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "none";
}

inline constexpr const char* kCubic = R"([CONSTANTS]
a := 0
b := 0
[SYSTEM VARS]
x : [-4, 4]
[SYSTEM EQS]
x^3 + a*x + b = 0;)";

inline int roots(double a, double b) { return 4 * a * a * a + 27 * b * b < 0 ? 3 : 1; }

inline const MapFile& cubic() {
  static const MapFile file = make_file({.question = question_of(kCubic), .over = {{"a", "-2", "1"}, {"b", "-1", "1"}}}, 16);
  return file;
}

// Positions of two bars' common end: two equations in two unknowns, none or two solutions. Here the constants are lengths.
inline const MapFile& circles() {
  static const MapFile file = make_file({.question = question_of(R"([CONSTANTS]
r1 := 1
r2 := 1
[SYSTEM VARS]
x : [-4, 4]
y : [-4, 4]
[SYSTEM EQS]
x^2 + y^2 = r1^2;
(x - 2)^2 + y^2 = r2^2;)"),
                                         .over = {{"r1", "1/2", "5/2"}, {"r2", "1/2", "5/2"}}},
                                        16);
  return file;
}

inline int crossings(double r1, double r2) { return std::fabs(r1 - r2) < 2 && r1 + r2 > 2 ? 2 : 0; }

}  // namespace corank::analyze
