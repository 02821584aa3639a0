// Files of maps with requirements, of clearances from requirements' limits and of paths within tolerances, changed so that
// their claim is false: none is verified. CORANK_SEEDS=340 makes more than 1,000 of them.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/paths/path.h"
#include "corank/result/files/verification.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/analyze/map_files.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

constexpr double kLink = 0.9, kBase = 1.18;  // of Dextar

// How many were refused.
struct Refusals {
  std::map<std::string, std::pair<int, int>> by_kind;  // refused, made
  void add(const std::string& kind, bool refused) {
    auto& [good, all] = by_kind[kind];
    good += refused;
    ++all;
  }
  void check() const {
    int refused = 0, made = 0;
    for (const auto& [kind, count] : by_kind) {
      printf("  %-45s refused %d of %d\n", kind.c_str(), count.first, count.second);
      EXPECT_EQ(count.first, count.second) << kind;
      refused += count.first, made += count.second;
    }
    printf("false claims refused: %d of %d\n", refused, made);
  }
};

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), text.npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
}

study::Question required_question(const std::vector<std::string>& texts) {
  return required(model_question("dextar.cuik", symbolic::SingularitySet::cspace), texts);
}

// The largest amplification of the five-bar's postures at a place.
double worst_amplification(double x, double y) {
  double worst = 0;
  for (const MatrixXd& j : five_bar_postures(x, y, kLink, kBase)) worst = std::max(worst, amplification(j));
  return worst;
}

TEST(FalseClaims, OfMapsAreRefused) {
  const std::string required = "amplification(outputs) <= 2";
  const MapFile file = make_file(
      MapQuestion{.question = required_question({required}), .over = {{"J3x", "1/4", "1"}, {"J3y", "3/10", "8/10"}}}, 32);
  const std::vector<MapCellClaim>& cells = file.claims.cells;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  Refusals count;
  // One cell alone, so that what is refused is its claim.
  const auto add = [&](const std::string& kind, const MapCellClaim& cell, const std::string& other = "") {
    MapFile changed = file;
    changed.claims.cells = {cell};
    if (!other.empty()) replace_all(changed.model_text, required, other);
    count.add(kind, !result::verify(changed).verified());
  };
  for (unsigned made = 0; made < test::seeds(100);) {
    MapCellClaim cell = cells[random() % cells.size()];
    if (cell.count == 0) continue;
    const auto at = [&](const Interval& side) { return side.lo() + unit(random) * side.width(); };
    const double worst = worst_amplification(at(cell.sides[0]), at(cell.sides[1]));
    if (std::fabs(worst - 2) < 1e-6) continue;
    ++made;
    if (cell.standing == Standing::open) {
      cell.standing = worst > 2 ? Standing::satisfied : Standing::violated;
      add("map: an open cell decided", cell);
      continue;
    }
    const bool good = cell.standing == Standing::satisfied;
    switch (made % 3) {
      case 0:
        cell.standing = good ? Standing::violated : Standing::satisfied;
        add("map: a verdict flipped", cell);
        break;
      case 1:  // so that the sample is on the other side of it
        add("map: another limit", cell,
            fmt::format("amplification(outputs) <= {:.6f}",
                        worst * (good ? 1 - unit(random) / 2 : 1 + unit(random)) + (good ? -1e-5 : 1e-5)));
        break;
      default: {  // until a place where it is otherwise
        const double x = 0.25 + 0.75 * unit(random), y = 0.3 + 0.5 * unit(random);
        if ((worst_amplification(x, y) > 2) != good) {
          --made;
          break;
        }
        cell.sides = {Interval::hull(cell.sides[0], Interval(x)), Interval::hull(cell.sides[1], Interval(y))};
        add("map: a cell enlarged", cell);
      }
    }
  }
  count.check();
}

// The cover of an empty set: its boxes are left out, and the leaves that lead to them say that nothing is there.
void drop_boxes(result::Result& r) {
  using Step = Proof::Step;
  auto proof = std::make_shared<Proof>(*r.cover.proof);
  std::vector<std::int32_t> kept;
  std::size_t integer = 0;
  for (std::uint8_t& s : proof->steps) {
    const auto step = static_cast<Step>(s);
    std::size_t taken = step == Step::empty || step == Step::elsewhere ? 0 : step == Step::cut ? 2 : 1;
    if (step == Step::keep) taken += static_cast<std::size_t>(proof->integers[integer]);
    if (step == Step::box)
      s = static_cast<std::uint8_t>(Step::empty);
    else
      kept.insert(kept.end(), proof->integers.begin() + static_cast<std::ptrdiff_t>(integer),
                  proof->integers.begin() + static_cast<std::ptrdiff_t>(integer + taken));
    integer += taken;
  }
  proof->integers = std::move(kept);
  r.cover.proof = std::move(proof);
  r.cover.boxes.clear(), r.cover.points.clear(), r.cover.regions.clear();
}

TEST(FalseClaims, OfClearancesAreRefused) {
  const double cx = 0.59, cy = 0.55;
  const BallOptions ball{.at = {{"J3x", "0.59"}, {"J3y", "0.55"}}, .in = {"J3x", "J3y"}};
  solve::Control control;
  const auto clearance_with = [&](const std::string& limit, double precision) {
    study::Question question = required_question({"amplification(outputs) <= " + limit});
    question.set = symbolic::SingularitySet::requirements;
    return clearance(question, ball, {.precision = precision, .check_center = false}, {}, control);
  };
  const Clearance c = clearance_with("2", 0.01);
  ASSERT_TRUE(c.nearest.complete && c.nearest.upper);
  // As the search makes it, but for the boxes.
  const auto claimed_free = [&](Clearance of, double radius) {
    of.nearest.lower = radius;
    result::Result r = claim_free(of, {}, control);
    drop_boxes(r);
    return r;
  };
  // The checker searches anew where a leaf is not empty, and may not end: it may ask twenty times as often as for a true
  // claim whether it is to end.
  long asked = 0, most = std::numeric_limits<long>::max();
  const auto is_confirmed = [&](const result::Result& r) {
    asked = 0;
    return result::verify(r, check::Options{.progress = {}, .ended = [&] { return ++asked > most; }}).complete();
  };
  const auto nearest = claim_nearest(c, control);
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(result::verify(*nearest).verified());
  EXPECT_TRUE(is_confirmed(claimed_free(c, 0.8 * c.nearest.lower)));
  EXPECT_TRUE(is_confirmed(claimed_free(c, c.nearest.lower))) << "which is true";
  most = 20 * asked + 100;
  const std::string outer = fmt::format("{:.17g}", *c.nearest.upper * (1 + 1e-6));
  const auto with_outer = [&](double radius) {
    result::Result r = *nearest;
    replace_all(r.model_text, outer, fmt::format("{:.17g}", radius));
    r.system_text = symbolic::to_cuik(result::system_of(r));
    return r;
  };
  EXPECT_TRUE(result::verify(with_outer(1.01 * *c.nearest.upper)).verified());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  Refusals count;
  for (unsigned made = 0; made < test::seeds(4);) {
    switch (made % 4) {
      case 0:
        count.add("clearance: a radius enlarged",
                  !is_confirmed(claimed_free(c, *c.nearest.upper * (1.001 + 0.1 * unit(random)))));
        break;
      case 1: {  // that a configuration within the radius reaches, between two places' worst
        const double angle = 2 * M_PI * unit(random), r = 0.95 * c.nearest.lower * unit(random);
        const double here = worst_amplification(cx, cy);
        const double there = worst_amplification(cx + r * std::cos(angle), cy + r * std::sin(angle));
        if (std::fabs(here - there) < 1e-3) continue;
        const Clearance other = clearance_with(fmt::format("{:.9f}", (here + there) / 2), 0.5);
        count.add("clearance: a limit reached within the radius", !is_confirmed(claimed_free(other, c.nearest.lower)));
        break;
      }
      case 2:
        count.add("clearance: a radius below the least",
                  !result::verify(with_outer(c.nearest.lower * (0.999 - 0.9 * unit(random)))).verified());
        break;
      default: {
        result::Result changed = *nearest;
        const std::size_t v = random() % 2;
        const double by = (random() % 2 == 0 ? 1 : -1) * std::pow(10.0, -4 * unit(random));
        const auto move = [&](Box& box) { box[v] = box[v] + Interval(by); };
        for (CoverBox& box : changed.cover.boxes) move(box.box);
        for (CoverBox& point : changed.cover.points) move(point.box);
        move(changed.cover.regions.front());
        count.add("clearance: the nearest moved away", !result::verify(changed).verified());
      }
    }
    ++made;
  }
  count.check();
}

// The least largest change of a variable, in its size, from a box to one of these configurations.
double distance_to(const Box& box, const std::vector<double>& sizes, const std::vector<std::vector<double>>& points) {
  double least = HUGE_VAL;
  for (const std::vector<double>& x : points) {
    double largest = 0;
    for (std::size_t j = 0; j < x.size(); ++j)
      largest = std::max(largest, std::max(box[j].lo() - x[j], x[j] - box[j].hi()) / sizes[j]);
    least = std::min(least, largest);
  }
  return least;
}

TEST(FalseClaims, OfPathsAreRefused) {
  const std::vector<result::ConstantOverride> constants{{"l", "0.9 ± 0.005"}, {"d", "1.18 ± 0.005"}};
  study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik", constants);
  PathFinder finder({.model = std::move(model.mechanism), .constants = constants}, {});
  solve::Control control;
  const Path path = finder.find(finder.end({{"J3x", "1/2"}, {"J3y", "1"}}, 1, "--from", control),
                                finder.end({{"J3x", "7/10"}, {"J3y", "-1"}}, 2, "--to", control), control);
  ASSERT_TRUE(path.tube);
  const result::PathFile file = to_file(finder, path);
  const check::TubeReport report = result::verify(file);
  ASSERT_TRUE(report.verified()) << result::to_table(report, file);
  const System& system = finder.system();
  // Forward singularities of the robot as drawn: J2, J3, J4 in line, J3 between the others or beyond them.
  std::vector<std::vector<double>> singular;
  for (int k = 0; k < 20'000; ++k) {
    const double theta5 = 2 * M_PI * k / 20'000;
    const Vector2d j4 = kLink * Vector2d(std::cos(theta5), std::sin(theta5)), to = j4 - Vector2d(kBase, 0);
    for (const double way : {-1.0, 1.0}) {
      const double cosine = (to.squaredNorm() + kLink * kLink - 4 * kLink * kLink) / (2 * kLink * to.norm());
      if (std::fabs(cosine) > 1) continue;
      const double theta2 = std::atan2(to.y(), to.x()) + way * std::acos(cosine);
      const Vector2d j2 = Vector2d(kBase, 0) + kLink * Vector2d(std::cos(theta2), std::sin(theta2)), j3 = (j2 + j4) / 2;
      const std::map<std::string, double> values{{"J3x", j3.x()}, {"J3y", j3.y()}};
      const double theta3 = std::atan2((j3 - j2).y(), (j3 - j2).x()), theta4 = std::atan2((j4 - j3).y(), (j4 - j3).x());
      const std::map<std::string, double> angles{
          {"theta2", theta2}, {"theta3", theta3}, {"theta4", theta4}, {"theta5", theta5}};
      std::vector<double>& x = singular.emplace_back();
      for (int j = 0; j < system.size(); ++j) {
        const auto angle = std::ranges::find_if(system.angles, [&](const Angle& a) { return a.cosine == j || a.sine == j; });
        const std::string& name = system.variables[j].name;
        if (angle != system.angles.end())
          x.push_back(angle->cosine == j ? std::cos(angles.at(angle->name)) : std::sin(angles.at(angle->name)));
        else
          x.push_back(name == "l" ? kLink : name == "d" ? kBase : values.at(name));
      }
    }
  }
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  Refusals count;
  for (unsigned made = 0; made < test::seeds(60); ++made) {
    result::PathFile changed = file;
    const std::size_t k = random() % changed.tube.pieces.size(), n = random() % changed.tube.nodes.size();
    const auto j = static_cast<std::size_t>(random() % 6);
    TubeNode& node = changed.tube.nodes[n];
    std::string kind;
    switch (made % 6) {
      case 0:
        changed.tube.radii[k] = distance_to(changed.tube.pieces[k], changed.tube.sizes, singular) * (1.001 + unit(random));
        kind = "path: a radius that holds a singularity";
        break;
      case 1: {  // a link of no length, for which no node's values are met: the solutions' boxes are of others
        const double wide = kLink * (1.01 + unit(random));
        changed.constants[0].expression = fmt::format("0.9 ± {:.6f}", wide);
        const std::size_t l = system.find("l");
        const auto widen = [&](Box& box) { box[l] = Interval(kLink - wide - 1e-9, kLink + wide + 1e-9); };
        for (Box& piece : changed.tube.pieces) widen(piece);
        for (TubeNode& other : changed.tube.nodes) widen(other.box);
        kind = "path: a tolerance widened";
        break;
      }
      case 2: {
        const double by = (random() % 2 == 0 ? 1 : -1) * (2 * node.box[j].width() + std::pow(10.0, -6 * unit(random)));
        node.box[j] = node.box[j] + Interval(by);
        kind = "path: a node's box moved away";
        break;
      }
      case 3: {
        const std::size_t i = random() % node.values.size();
        node.values[i] += (random() % 2 == 0 ? 1 : -1) * (0.3 + unit(random));
        kind = "path: a node's section moved away";
        break;
      }
      case 4: {  // less than what the path takes
        Interval& side = changed.tube.pieces[k][j];
        const Interval from = changed.tube.nodes[k].box[j], to = changed.tube.nodes[k + 1].box[j];
        side = Interval(side.lo(), std::nextafter(std::min(from.lo(), to.lo()), -9.0));
        kind = "path: a piece without its ends";
        break;
      }
      default:
        std::swap(changed.tube.nodes[n].box, changed.tube.nodes[n == 0 ? 1 : 0].box);
        kind = "path: two nodes exchanged";
    }
    count.add(kind, !result::verify(changed).verified());
  }
  count.check();
}

}  // namespace
}  // namespace corank::analyze
