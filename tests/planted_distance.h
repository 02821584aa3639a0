// Random bodies whose points are affine in two offsets but for a small rest, and their distance, found in another way than
// by the code that is tried: over all faces of the bodies' difference.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "corank/core/requirement.h"
#include "corank/tests/planted_requirement.h"

namespace corank::test {

using BodyPoints = std::vector<Eigen::Vector3d>;

/// Of hulls of a few points: the point of least norm of the differences' hull lies in the hull of at most three of them, at
/// right angles to these, or the hull holds 0: then in that of four.
inline double distance_of_hulls(const BodyPoints& a, const BodyPoints& b) {
  std::vector<Eigen::Vector3d> d;
  for (const auto& p : a)
    for (const auto& q : b) d.push_back(p - q);
  double least = std::numeric_limits<double>::infinity();
  const auto n = static_cast<int>(d.size());
  const auto try_face = [&](const std::vector<int>& members) {
    const auto m = static_cast<int>(members.size()) - 1;
    Eigen::MatrixXd edges(3, m);
    for (int k = 0; k < m; ++k) edges.col(k) = d[members[k + 1]] - d[members[0]];
    if (m > 0 && Eigen::FullPivLU<Eigen::MatrixXd>(edges).rank() < m) return;
    Eigen::VectorXd w(m);
    if (m > 0) w = edges.colPivHouseholderQr().solve(-d[members[0]]);
    if (m > 0 && (w.minCoeff() < -1e-12 || w.sum() > 1 + 1e-12)) return;
    Eigen::Vector3d at = d[members[0]];
    if (m > 0) at += edges * w;
    least = std::min(least, at.norm());
  };
  for (int i = 0; i < n; ++i) {
    try_face({i});
    for (int j = i + 1; j < n; ++j) {
      try_face({i, j});
      for (int k = j + 1; k < n; ++k) {
        try_face({i, j, k});
        for (int l = k + 1; l < n; ++l) try_face({i, j, k, l});
      }
    }
  }
  return least;
}

struct PlantedDistance {
  using Entry = PlantedRequirement::Entry;

  Requirement requirement;
  std::vector<Entry> entries;  // of the variable of that index
  double width = 0;            // offsets are in [−width, width]
  double least = 0;

  explicit PlantedDistance(unsigned seed) : random_(seed) {
    const bool flat = seed % 3 == 0;
    width = std::pow(10.0, number(-3, -0.3));
    DistanceTest test;
    const auto size = [&] { return 1 + random_() % 3; };
    for (std::size_t b = 0; b < 2; ++b) {
      const std::size_t n = size();
      for (std::size_t k = 0; k < n; ++k) {
        auto& p = test.hulls[b].emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
          if (i == 2 && flat) continue;
          if (random_() % 8 == 0) {
            p[i] = {-1, static_cast<int>(random_() % 3) - 1};
            continue;
          }
          p[i] = {static_cast<int>(entries.size()), {}};
          entries.push_back({number(-1, 1), {number(-1, 1), number(-1, 1)}, random_() % 2 == 0 ? 0 : 0.1 * width * width});
        }
      }
    }
    // Near the distance at the centre, so that many a standing is not the same all over.
    requirement.distances.push_back(std::move(test));
    const double there = distance_at(0, 0);
    const std::string text = std::to_string(there < 1e-3 || random_() % 4 == 0 ? number(0.1, 1) : there * number(0.6, 1.4));
    requirement.distances[0].least = ExactNumber::rational(text);
    least = std::stod(text);
  }

  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  /// For random offsets and rests: what the distance is beyond what it is to be.
  double margin() { return distance_at(at_random(), at_random()) - least; }

 private:
  double at_random() { return random_() % 2 == 0 ? number(-width, width) : random_() % 2 == 0 ? width : -width; }
  double distance_at(double u, double v) {
    std::vector<double> values;
    for (const Entry& e : entries) values.push_back(e.constant + e.slopes[0] * u + e.slopes[1] * v + e.rest * number(-1, 1));
    std::array<BodyPoints, 2> bodies;
    for (std::size_t b = 0; b < 2; ++b)
      for (const auto& p : requirement.distances[0].hulls[b]) {
        Eigen::Vector3d at;
        for (int i = 0; i < 3; ++i) at(i) = p[i].variable >= 0 ? values[p[i].variable] : p[i].number.enclose().mid();
        bodies[b].push_back(at);
      }
    return distance_of_hulls(bodies[0], bodies[1]);
  }

  std::mt19937 random_;
};

/// A body in the offsets u and v, of points (x, y, z), each a + b u + c v.
struct DistanceCase {
  std::array<std::vector<std::array<PlantedRequirement::Entry, 3>>, 2> bodies;
  const char* least;
  double width;
  Standing expected;

  Requirement requirement() const {
    DistanceTest test;
    int variable = 0;
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < bodies[b].size(); ++k)
        test.hulls[b].push_back({MatrixEntry{variable++, {}}, MatrixEntry{variable++, {}}, MatrixEntry{variable++, {}}});
    test.least = ExactNumber::rational(least);
    return {"", {}, {}, {test}};
  }
  std::vector<PlantedRequirement::Entry> entries() const {
    std::vector<PlantedRequirement::Entry> result;
    for (const auto& body : bodies)
      for (const auto& p : body) result.insert(result.end(), p.begin(), p.end());
    return result;
  }
};

inline std::vector<DistanceCase> distance_cases() {
  using Entry = PlantedRequirement::Entry;
  const Entry zero, one{1, {0, 0}, 0}, minus{-1, {0, 0}, 0}, u{0, {1, 0}, 0}, mu{0, {-1, 0}, 0}, two{2, {0, 0}, 0};
  using Points = std::vector<std::array<Entry, 3>>;
  const Points origin{{zero, zero, zero}};
  // A bar at height 1 that turns with u about its middle, over a point: 1/√(1 + u²) apart. To first order it keeps 1.
  const Points turning{{minus, {1, {-1, 0}, 0}, zero}, {one, {1, {1, 0}, 0}, zero}};
  // A point that moves past another one at the distance 1: √(1 + u²).
  const Points passing{{u, one, zero}};
  // Crossing bars: what is nearest to what has no direction.
  const Points across{{minus, zero, zero}, {one, zero, zero}}, along{{zero, minus, zero}, {u, one, zero}};
  // Two bars at right angles, one over the other: the height, where they turn and where they do not.
  const Points above{{mu, minus, one}, {u, one, one}}, lower{{minus, zero, zero}, {one, zero, zero}};
  return {{{turning, origin}, "0.98", 0.1, Standing::satisfied},
          {{turning, origin}, "0.98", 0.3, Standing::open},
          {{passing, origin}, "1", 0.5, Standing::satisfied},
          {{passing, origin}, "1.1", 0.3, Standing::violated},
          {{passing, origin}, "1.1", 0.5, Standing::open},
          {{passing, origin}, "1.001", 0.0, Standing::violated},
          {{across, along}, "0.1", 0.01, Standing::violated},
          {{across, along}, "0.001", 0.01, Standing::open},
          {{above, lower}, "0.999999", 0.2, Standing::satisfied},
          {{above, lower}, "1.01", 0.2, Standing::violated},
          {{origin, origin}, "0.001", 0.1, Standing::violated},
          {{above, Points{{two, zero, zero}}}, "1.8", 0.1, Standing::satisfied}};
}

}  // namespace corank::test
