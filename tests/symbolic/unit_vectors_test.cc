// Which coordinates are components of unit vectors: frames that turn about one of their axes after another, some of them
// spoilt. CORANK_SEEDS=1000 looks further.
#include "corank/symbolic/sets/unit_vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/seeds.h"

namespace corank::symbolic {
namespace {

struct Vector {
  std::array<std::string, 3> text;  // of its components
  std::array<double, 3> value;      // at one configuration
  bool spoilt = false;
};

// A model of turning frames, and its directions at a random configuration.
struct Turning {
  explicit Turning(unsigned seed) : random(seed) {
    std::array<Vector, 3> frame{Vector{{"1", "0", "0"}, {1, 0, 0}}, Vector{{"0", "1", "0"}, {0, 1, 0}},
                                Vector{{"0", "0", "1"}, {0, 0, 1}}};
    for (int turn = 1; turn <= 5; ++turn) {
      const std::string angle = "t" + std::to_string(turn);
      angles += angle + " ~\n";
      const double t = std::uniform_real_distribution<>(-3, 3)(random);
      const std::size_t i = random() % 3, j = (i + 1) % 3, k = (i + 2) % 3;
      const Vector a = frame[j], b = frame[k];
      frame[j] =
          direction("a" + std::to_string(turn), "cos(" + angle + ")", "sin(" + angle + ")", a, b, std::cos(t), std::sin(t));
      frame[k] = direction("b" + std::to_string(turn), "-sin(" + angle + ")", "cos(" + angle + ")", a, b, -std::sin(t),
                           std::cos(t));
    }
  }

  Vector direction(const std::string& name, const std::string& f, const std::string& g, const Vector& a, const Vector& b,
                   double x, double y) {
    const bool spoils = random() % 8 == 0;
    Vector v{{}, {}, spoils || a.spoilt || b.spoilt};
    for (std::size_t i = 0; i < 3; ++i) {
      v.text[i] = name + "_" + "xyz"[i];
      vectors += v.text[i] + " : [-11/10, 11/10]\n";
      equations += v.text[i] + " = " + (spoils && i == 1 ? "9/8" : "1") + "*((" + f + ")*(" + a.text[i] + ") + (" + g +
                   ")*(" + b.text[i] + "));\n";
      v.value[i] = (spoils && i == 1 ? 1.125 : 1) * (x * a.value[i] + y * b.value[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) directions[v.text[i]] = v;
    return v;
  }

  std::string text() const { return "[SYSTEM VARS]\n" + angles + "[DUMMY VARS]\n" + vectors + "[SYSTEM EQS]\n" + equations; }

  std::mt19937 random;
  std::string angles, vectors, equations;
  std::map<std::string, Vector> directions;  // of each component
};

TEST(UnitVectors, AreFoundInFramesThatTurnAndNotWhereTheseAreSpoilt) {
  int found = 0, spoilt = 0;
  for (unsigned seed = 1; seed <= test::seeds(20); ++seed) {
    SCOPED_TRACE(seed);
    const Turning turning(seed);
    const std::set<std::string> units = unit_vector_components(parse_model(turning.text(), "m.cuik"));
    for (const auto& [name, v] : turning.directions) {
      const double length = std::hypot(v.value[0], v.value[1], v.value[2]);
      if (units.contains(name)) {
        EXPECT_NEAR(length, 1, 1e-12) << name;
      } else {
        EXPECT_TRUE(v.spoilt) << name << " is lost";
      }
      found += units.contains(name);
      spoilt += std::fabs(length - 1) > 1e-3;
    }
  }
  std::cout << found << " components of unit vectors found, " << spoilt << " of other directions\n";
  EXPECT_GT(found, spoilt);
  EXPECT_GT(spoilt, 0);
}

TEST(UnitVectors, EndBeyondOneWithoutAnEndOfTheSet) {
  const std::string text = Turning(1).text();
  const Mechanism m = parse_model(text, "m.cuik");
  const std::set<std::string> units = unit_vector_components(m);
  ASSERT_FALSE(units.empty());
  const System system = algebrize(plain_system(m));
  for (const Variable& v : system.variables) EXPECT_EQ(v.within_one, units.contains(v.name)) << v.name;
}

}  // namespace
}  // namespace corank::symbolic
