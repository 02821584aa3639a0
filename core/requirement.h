// What is required of a configuration q besides being one: how fast, strong or exact the robot is there. As conditions on
// its feasible velocities, those m with A(q) m = 0, which are compared with numbers; as a function's sign; and on distances.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/core/system.h"

namespace corank {

/// What is proven of a requirement over a region.
enum class Standing { satisfied, violated, open };
/// "satisfied", "violated", "open".
const char* to_string(Standing standing);
std::optional<Standing> standing_from_string(const std::string& text);

/// An entry of A, or of a point: a variable of the system that stands for it, or a number.
struct MatrixEntry {
  int variable = -1;  ///< none: the number
  ExactNumber number;
};

/// A condition on ker A, A with `columns` columns. Either of
///   form     Σ_j form_j m_j² > 0 for every m ∈ ker A but 0;
///   groups   ker A is a line, and Σ_g weight_g ‖(m_j)_{j ∈ g}‖ < bound · Σ |m_e| for its m ≠ 0, m_e the last components,
///            `ends` of them.
struct VelocityTest {
  struct Group {
    std::vector<int> columns;
    ExactNumber weight;  ///< not negative
  };

  int columns = 0;
  std::vector<MatrixEntry> matrix;  ///< row by row
  std::vector<ExactNumber> form;    ///< one for each column; empty: groups
  std::vector<Group> groups;
  ExactNumber bound;
  int ends = 1;

  int rows() const { return columns > 0 ? static_cast<int>(matrix.size()) / columns : 0; }
};

/// A condition on two bodies: the distance of the convex hulls of their points is at least that.
struct DistanceTest {
  std::array<std::vector<std::array<MatrixEntry, 3>>, 2> hulls;  ///< points, one or more of each
  ExactNumber least;                                             ///< positive
};

/// Distances that are kept all over boxes: what a test calls a variable is one of these functions of a system's variables.
struct KeptDistances {
  std::vector<Polynomial> functions;
  std::vector<DistanceTest> tests;
};

/// All of its conditions.
struct Requirement {
  std::string text;  ///< as it was asked for
  std::vector<VelocityTest> tests;
  std::optional<int> excess{};  ///< a variable of the system that is not to be positive
  std::vector<DistanceTest> distances{};
};

}  // namespace corank
