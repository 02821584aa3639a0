// An inequality ends a workspace as a limit does: random mechanisms whose limits are written as inequalities have the same
// boundary, with the same barriers, as with [LIMITS].
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/boundary.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Boxes = std::map<std::string, std::vector<const CoverBox*>>;

/// A planar mechanism with limits of some of its variables.
struct Limited {
  std::string variables, equations, outputs;
  struct Limit {
    std::string of;
    double lower, upper;
    bool is_angle;
    bool is_below = true;  // of a length: lower ≤ it
  };
  std::vector<Limit> limits{};

  std::string text(std::mt19937& random, bool as_inequalities) const {
    std::string limited, inequalities;
    for (const Limit& l : limits) {
      if (!as_inequalities) {
        limited += fmt::format("{} : [{}, {}]\n", l.of, l.lower, l.upper);
      } else if (l.is_angle) {
        const double middle = (l.lower + l.upper) / 2, half = (l.upper - l.lower) / 2;
        const bool turned = random() % 2 == 0;
        inequalities += turned ? fmt::format("-cos({0} - ({1:.17g})) <= -cos({2:.17g});\n", l.of, middle, half)
                               : fmt::format("cos({0} - ({1:.17g})) >= cos({2:.17g});\n", l.of, middle, half);
      } else {
        inequalities += l.is_below ? fmt::format("{} >= {};\n", l.of, l.lower) : fmt::format("{} <= {};\n", l.of, l.upper);
      }
    }
    return "[SYSTEM VARS]\n" + variables + (limited.empty() ? "" : "[LIMITS]\n" + limited) + "[SYSTEM EQS]\n" + equations +
           inequalities + "[OUTPUTS]\n" + outputs + "\n";
  }
};

double between(std::mt19937& random, double a, double b) { return std::uniform_real_distribution(a, b)(random); }

std::string rounded(double x) { return fmt::format("{:.3f}", x); }

Limited::Limit of_angle(std::mt19937& random, const std::string& name) {
  const double lower = std::stod(rounded(between(random, -3, 0.5)));
  return {name, lower, std::stod(rounded(between(random, lower + 0.3, std::min(3.1, lower + 4)))), true};
}

// A joint or two more than outputs: then two ends, and a kernel vector, are in one part.
Limited random_arm(std::mt19937& random) {
  const int joints = 2 + static_cast<int>(random() % 2);
  Limited m{"x : [-9, 9]\ny : [-9, 9]\n", "", "x y"};
  std::string x, y, angle;
  for (int i = 1; i <= joints; ++i) {
    const std::string t = fmt::format("t{}", i), length = rounded(between(random, 0.5, 1.5));
    angle += (angle.empty() ? "" : " + ") + t;
    x += fmt::format("{}{}*cos({})", x.empty() ? "" : " + ", length, angle);
    y += fmt::format("{}{}*sin({})", y.empty() ? "" : " + ", length, angle);
    m.variables += t + " ~\n";
    if (random() % 3 > 0) m.limits.push_back(of_angle(random, t));
  }
  m.equations = fmt::format("{} = x;\n{} = y;\n", x, y);
  if (m.limits.empty() || random() % 3 == 0)
    m.limits.push_back({"x", std::stod(rounded(between(random, -0.7, 0.7))), 9, false});
  return m;
}

Limited random_five_bar(std::mt19937& random) {
  Limited m{"x : [-9, 9]\ny : [-9, 9]\n", "", "x y"};
  for (int leg = 1; leg <= 2; ++leg) {
    m.variables += fmt::format("t{0} ~\np{0} ~\n", leg);
    const std::string base = rounded(leg == 1 ? 0 : between(random, 0.3, 1.5)), crank = rounded(between(random, 0.6, 1.4)),
                      rod = rounded(between(random, 0.7, 1.6));
    m.equations +=
        fmt::format("{0} + {1}*cos(t{3}) + {2}*cos(p{3}) = x;\n{1}*sin(t{3}) + {2}*sin(p{3}) = y;\n", base, crank, rod, leg);
    for (const char* name : {"t", "p"})
      if (random() % 2 == 0) m.limits.push_back(of_angle(random, name + std::to_string(leg)));
  }
  if (m.limits.empty() || random() % 3 == 0)
    m.limits.push_back({"y", -9, std::stod(rounded(between(random, -0.5, 1))), false, false});
  return m;
}

result::Result boundary_of(const std::string& text) {
  return study::answer({.model = symbolic::parse_model(text, "m.cuik"), .set = symbolic::SingularitySet::boundary});
}

/// By which limits are met, whichever end, written as either.
Boxes by_limits(const result::Result& result, const Limited& m) {
  std::map<std::string, std::string> of_name;
  for (std::size_t k = 0; k < m.limits.size(); ++k) of_name[fmt::format("inequality {} reached", k + 1)] = m.limits[k].of;
  Boxes boxes;
  for (const CoverBox& box : result.cover.boxes) {
    std::string name = result.parts[static_cast<std::size_t>(box.part)].part, key;
    name = name.substr(0, name.find(':'));
    while (!name.empty()) {
      const std::size_t comma = std::min(name.find(", "), name.size());
      const std::string one = name.substr(0, comma);
      name.erase(0, std::min(comma + 2, name.size()));
      key += (of_name.contains(one) ? of_name.at(one) : one.substr(0, one.find(" at its "))) + ";";
    }
    boxes[key].push_back(&box);
  }
  for (auto& [key, list] : boxes) std::ranges::sort(list, {}, [](const CoverBox* b) { return b->box[0].lo(); });
  return boxes;
}

constexpr double kRoom = 1e-9;
constexpr std::size_t kMostOfPart = 2000;  // boxes that are looked at

bool share_points(const Box& a, const Box& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j].lo() > b[j].hi() + kRoom || b[j].lo() > a[j].hi() + kRoom) return false;
  return true;
}

struct Agreement {
  std::size_t boxes = 0, lost = 0, passages = 0, contradicted = 0;
};

bool agree(const CoverBox& a, const CoverBox& b) {
  if (a.passage == Passage::unproven || b.passage == Passage::unproven) return true;
  if (a.passage != b.passage) return false;
  double product = 0;
  for (std::size_t k = 0; k < std::min(a.side.size(), b.side.size()); ++k) product += a.side[k] * b.side[k];
  return a.passage != Passage::barrier || product > 0;
}

// Boxes of one with a proven solution each meet one of the other's.
void compare(const Boxes& one, const Boxes& other, Agreement& tally) {
  double width = 0;
  for (const auto& [limits, boxes] : other)
    for (const CoverBox* box : boxes) width = std::max(width, box->box[0].width());
  for (const auto& [limits, boxes] : one)
    for (std::size_t k = 0; k < boxes.size(); k += 1 + boxes.size() / kMostOfPart) {
      const CoverBox* box = boxes[k];
      if (box->verdict == Verdict::undecided || box->verdict == Verdict::boundary) continue;
      ++tally.boxes;
      bool found = false, right = false;
      if (const auto same = other.find(limits); same != other.end()) {
        const std::vector<const CoverBox*>& list = same->second;  // by their lower ends of x
        const auto beyond = [&](double x) {
          return std::ranges::upper_bound(list, x, {}, [](const CoverBox* b) { return b->box[0].lo(); });
        };
        for (auto b = beyond(box->box[0].lo() - width - kRoom); b != list.end() && !right; ++b) {
          if ((*b)->box[0].lo() > box->box[0].hi() + kRoom) break;
          if (!share_points(box->box, (*b)->box)) continue;
          found = true;
          right = right || agree(*box, **b);
        }
      }
      tally.lost += !found;
      tally.passages += box->passage != Passage::unproven;
      tally.contradicted += found && !right;
    }
}

TEST(ReachedInequalities, EndAWorkspaceAsLimitsDo) {
  Agreement tally;
  for (unsigned seed = 1; seed <= test::seeds(8); ++seed) {
    std::mt19937 random(seed);
    const Limited m = seed % 2 == 0 ? random_arm(random) : random_five_bar(random);
    const std::string limits = m.text(random, false), inequalities = m.text(random, true);
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, inequalities));
    const result::Result a = boundary_of(limits), b = boundary_of(inequalities);
    if (!a.cover.complete() || !b.cover.complete()) continue;
    const Boxes of_a = by_limits(a, m), of_b = by_limits(b, m);
    const std::size_t lost = tally.lost, contradicted = tally.contradicted;
    compare(of_a, of_b, tally);
    compare(of_b, of_a, tally);
    EXPECT_EQ(tally.lost, lost);
    EXPECT_EQ(tally.contradicted, contradicted);
    if (seed <= 2) {
      EXPECT_TRUE(result::verify(b).verified());
    }
  }
  EXPECT_GT(tally.boxes, 1000 * test::seeds(8));
  EXPECT_GT(tally.passages, tally.boxes / 2);
  std::printf("%zu boxes, %zu lost; %zu passages, %zu contradicted\n", tally.boxes, tally.lost, tally.passages,
              tally.contradicted);
}

std::vector<std::string> names_of_parts(const std::string& inequalities, const std::string& limits = "") {
  const symbolic::Mechanism m = symbolic::parse_model(
      "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\na ~\nb ~\n[SYSTEM EQS]\ncos(a) + cos(b) = x;\n"
      "sin(a) + sin(b) = y;\n" +
          inequalities + "\n[OUTPUTS]\nx y\n" + limits,
      "m.cuik");
  std::vector<std::string> names;
  for (const symbolic::BoundaryPart& part : symbolic::boundary_parts(m)) names.push_back(part.text());
  return names;
}

TEST(ReachedInequalities, AreNamedByTheirNamesOrNumbers) {
  using testing::ElementsAre;
  EXPECT_THAT(
      names_of_parts("cos(a) >= 0; sin(a) >= 0;\n\"elbow\": sin(a - b) <= 0.9;\n\"elbow\": sin(a - b) >= 0;\nx + y <= 1;"),
      ElementsAre("no limit", "inequality 1 reached", "inequality 2 reached", "elbow reached", "elbow, 2 reached",
                  "inequality 5 reached"));
  EXPECT_THAT(names_of_parts("cos(a) >= 0.3;\ncos(a) >= 0.3;"), ElementsAre("no limit", "inequality 1 reached")) << "twice";
  EXPECT_THAT(names_of_parts("sin(a)^2 + cos(a)^2 >= 1/2;"), ElementsAre("no limit")) << "holds everywhere";
  EXPECT_THAT(names_of_parts("\"choice of axes\": cos(a) >= 0;"), ElementsAre("no limit"));
  // What a limit settles: cos 1 < 0.9 < cos 0.
  EXPECT_THAT(names_of_parts("cos(a) >= 0.9;", "[LIMITS]\na : [0, 1]\n"),
              ElementsAre("no limit", "a at its lower limit", "inequality 1 reached"));
  EXPECT_THROW(names_of_parts("\"name\": cos(a) = 0;"), symbolic::ModelError);
}

// A slice that meets a joint's limit is an inequality: at its other end the search ends, and the robot goes on.
TEST(ReachedInequalities, SlicesAreNone) {
  const study::Model robot = study::parse_model(
      {"[LINKS]\nbase : point O (0, 0, 0)\narm : point E (1, 0, 0)\nfore : point H (1/2, 0, 0)\n[JOINTS]\n"
       "revolute q : base O + (0, 0, 1)  arm (0, 0, 0) + (0, 0, 1)  zero (1, 0, 0) (1, 0, 0)  range [-pi/2, pi/2]\n"
       "revolute e : arm E + (0, 0, 1)  fore (0, 0, 0) + (0, 0, 1)\n[OUTPUTS]\n"
       "f : orientation of arm  range phi [0, pi/2]\np : position of fore.H only x\n",
       "arm.cuik"});
  std::vector<std::string> names;
  for (const symbolic::BoundaryPart& part : symbolic::boundary_parts(robot.mechanism)) names.push_back(part.text());
  EXPECT_THAT(names, testing::ElementsAre("no limit", "q at its upper limit")) << "the lower limit is not in the slice";
}

// A result file has the equations of a robot from parts as text.
TEST(ReachedInequalities, OfPartsAreVerifiedInAResultFile) {
  const study::Model robot = study::parse_model(
      {"[LINKS]\nbase : point O (0, 0, 0)\nl1 : point E (1, 0, 0)\nl2 : point H (0.7, 0, 0)\n[JOINTS]\n"
       "revolute sh : base O + (0, 0, 1)  l1 (0, 0, 0) + (0, 0, 1)  actuated\n"
       "revolute el : l1 E + (0, 0, 1)  l2 (0, 0, 0) + (0, 0, 1)  range [-1, 2]\n[OUTPUTS]\np : position of l2.H\n",
       "arm.cuik"});
  const result::Result result = study::answer({.model = robot.mechanism, .set = symbolic::SingularitySet::boundary});
  ASSERT_EQ(result.parts.size(), 2u);
  EXPECT_EQ(result.parts[1].part, "range of el reached");
  EXPECT_TRUE(result::verify(result).verified());
}

}  // namespace
}  // namespace corank
