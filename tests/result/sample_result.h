// A made-up result with every kind of content, for tests of report/. No claim of it is true.
#pragma once

#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "corank/result/values/result.h"

namespace corank::result {

inline CoverBox sample_box(std::initializer_list<Interval> box, Verdict verdict, std::vector<int> free) {
  return {Box(box), verdict, std::move(free)};
}

/// Variables x (length), c_t, s_t (angle t), xi1: two points, six boxes with awkward doubles.
inline Result sample_result() {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min(), kHuge = std::numeric_limits<double>::max();
  Result r;
  r.model = "sample";
  r.model_text = "% a model\n[SYSTEM VARS]\nα : [0, 1]\n";
  r.set = "forward";
  r.system_text = "x = 0;\n";
  r.options = {
      "left", {0.1, 0.25}, {"9/5"}, 1e-6, 2, (std::uint64_t{1} << 53) + 1, 7, 0.1, {{"L2", "4/5"}, {"d", "sqrt(2)"}}};
  r.variables = {{"x", VariableKind::length, {-2.0, 2.0}},
                 {"c_t", VariableKind::cosine, {-1.0, 1.0}},
                 {"s_t", VariableKind::sine, {-1.0, 1.0}},
                 {"xi1", VariableKind::kernel, {-1.0, 1.0}}};
  r.angles = {{"t", 1, 2, {-3.1415926535897936, 3.1415926535897936}}};
  r.configuration_size = 3;
  r.equations = 4;
  r.inequalities = 1;
  r.cover.sigma = {0.1, 0.25};
  r.cover.wider_than_sigma = 1;
  r.cover.observed_dimension = 2;
  r.cover.tolerance = 1e-5;
  r.cover.statistics = {123, 45, 6, 1.5, 1.25, 0.1};
  r.cover.boxes = {sample_box({{-0.0, 0.0}, {0.0, kTiny}, {-kTiny, -0.0}, {-kHuge, kHuge}}, Verdict::regular, {0, 3}),
                   sample_box({0.1, 0.2, 0.3, {-1.0, -0.1}}, Verdict::isolated, {}),
                   sample_box({0.1, 0.2, 0.3, 0.4}, Verdict::exact, {}),
                   sample_box({0.1, 0.2, 0.3, 0.4}, Verdict::boundary, {2}),
                   sample_box({0.1, 0.2, 0.3, 0.4}, Verdict::undecided, {}),
                   sample_box({0.1, 0.2, 0.3, 0.4}, Verdict::partial, {}),
                   sample_box({0.1, 0.2, 0.3, 0.4}, Verdict::pending, {})};
  r.cover.points = {sample_box({{0.1, 0.2}, {-1.0, -0.9}, {-0.1, 0.1}, 0.5}, Verdict::isolated, {}),
                    sample_box({1.0 / 3, {0.0, 1e-17}, 1.0, -0.5}, Verdict::undecided, {})};
  r.cover.regions = {{{-0.0, 0.0}, {-kTiny, kTiny}, {-kTiny, kTiny}, {-kHuge, kHuge}}, {{0.0, 1.0}, 0.2, 0.3, {-1.0, 0.0}}};
  r.cover.boxes[0].region = 0;
  r.cover.boxes[1].region = r.cover.points[0].region = 1;
  r.cover.boxes[2].point = 0;
  r.cover.boxes[3].kernel_at_most = 1;
  r.cover.boxes[4].point = r.cover.points[1].point = 1;
  const auto number = [](const char* text) { return ExactNumber::rational(text); };
  r.cover.exact_points = {{{0, 1}, -1, 1, {{number("1/3")}, {0, 1}, {}, {number("-2/7"), 0, 5}}, -1, 0.25},
                          {{-2, 0, 1}, 1, number("3/2"), {{1}, {2}, {}, {}}, 2, 0}};
  r.cover.reduction = {Elimination{3, {}}, SumOfEquations{0, 2, ExactNumber::rational("-3/4")}, Elimination{1, 2},
                       ImpliedEquation{{{0, ExactNumber::rational("2/3"), {{0, 1}, {2, 3}}}, {4, -1, {}}}},
                       ImpliedEquation{{{5, 1, {{2, 2}}}}}};
  Proof proof;
  proof.roots = {{{-2.0, 2.0}, {-kTiny, kHuge}}};
  proof.combinations = {{{2, 0}, {1, 0}, {1.0f, -0.1f, 0.0f, 3e-39f}}, {{}, {}, {}}, {{1}, {1}, {2.5f}}};
  proof.steps = {2, 0, 3, 5, 6};
  proof.integers = {1, -5, 1 << 30};
  proof.reals = {0.1, -0.0, kTiny, kHuge};
  r.cover.proof = std::make_shared<const Proof>(std::move(proof));
  return r;
}

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool same_bits(const Interval& a, const Interval& b) {
  return same_bits(a.lo(), b.lo()) && same_bits(a.hi(), b.hi());
}

}  // namespace corank::result
