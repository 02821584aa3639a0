// Sets that are solved in parts: that the parts are the set, no more and no less, by samples of both in doubles; that what
// is stored of them is verified, and what was tampered with is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>

#include "corank/core/dense.h"
#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/study/samples.h"

namespace corank::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;
using symbolic::SingularitySet;
using test::names_of;
using test::sample;
using test::value_of;
using testing::ElementsAre;

symbolic::Mechanism model_named(const std::string& name) {
  return read_model(CORANK_SOURCE_DIR "/models/" + name + ".cuik").mechanism;
}

struct Case {
  const char* model;
  SingularitySet set;
  std::size_t parts, reached = parts;
};

// The smallest singular value of M, relative to the largest, at a configuration. These models' lengths are near 1.
class Deficiency {
 public:
  Deficiency(const symbolic::Mechanism& mechanism, SingularitySet set) {
    const auto kernel = symbolic::kernel_question(mechanism, set);
    std::vector<symbolic::Expression> entries;
    for (const auto& row : kernel.matrix.rows) entries.insert(entries.end(), row.begin(), row.end());
    entries_ = symbolic::polynomials(symbolic::plain_system(mechanism), entries);
    rows_ = static_cast<Eigen::Index>(kernel.matrix.rows.size());
    columns_ = static_cast<Eigen::Index>(kernel.matrix.columns.size());
  }
  double at(const VectorXd& x) const {
    MatrixXd m(rows_, columns_);
    for (Eigen::Index i = 0; i < rows_; ++i)
      for (Eigen::Index j = 0; j < columns_; ++j)
        m(i, j) = value_of(entries_[static_cast<std::size_t>(i * columns_ + j)], x);
    const VectorXd s = singular_values(m);
    return s[std::min(rows_, columns_) - 1] / std::max(s[0], 1e-3);  // M may vanish
  }

 private:
  std::vector<Polynomial> entries_;
  Eigen::Index rows_ = 0, columns_ = 0;
};

// A solution of a part in the variables of all configurations: of an angle that turns freely any value, and what depends on
// it.
VectorXd in_all(const System& all, const Question& question, const System& part, const VectorXd& x, double free) {
  VectorXd result(all.size());
  for (int j = 0; j < all.size(); ++j) {
    const int k = part.find(all.variables[static_cast<std::size_t>(j)].name);
    result[j] = k < 0 ? std::nan("") : x[k];
  }
  const auto& tie = std::get<symbolic::Component>(*question.part).dependent_angle;
  for (const Angle& a : all.angles) {
    if (!std::isnan(result[a.cosine])) continue;
    const double angle = a.name == tie->other ? free : tie->sign * free + tie->quarters * pi / 2;
    result[a.cosine] = std::cos(angle);
    result[a.sine] = std::sin(angle);
  }
  return result;
}

// In those of a part.
VectorXd in_part(const System& all, const System& part, const VectorXd& x) {
  VectorXd result(part.size());
  for (int k = 0; k < part.size(); ++k) result[k] = x[all.find(part.variables[static_cast<std::size_t>(k)].name)];
  return result;
}

class SetParts : public testing::TestWithParam<Case> {};

TEST_P(SetParts, AreTheSetNoMoreAndNoLess) {
  const Question question{.model = model_named(GetParam().model), .set = GetParam().set, .in_parts = true};
  const std::vector<Question> parts = parts_of(question);
  ASSERT_EQ(parts.size(), GetParam().parts);
  const Deficiency deficiency(question.model, *question.set);
  std::mt19937_64 random(5);
  const System all = symbolic::configurations(question.model);
  std::uniform_real_distribution<> turn(-pi, pi);
  std::vector<System> systems;
  std::size_t reached = 0;  // of isolated points a part may have none
  for (const Question& part : parts) {
    systems.push_back(system(part));
    int found = 0;
    for (int trial = 0; trial < 200 && found < 10; ++trial) {
      const auto x = sample(systems.back(), random);
      if (!x) continue;
      ++found;
      EXPECT_LT(deficiency.at(in_all(all, part, systems.back(), *x, turn(random))), 1e-6) << text(*part.part);
    }
    reached += found > 0;
  }
  EXPECT_EQ(reached, GetParam().reached);
  // What Newton's method finds of the whole, with its kernel vector, is a solution of some part.
  const System whole = system(question);
  int found = 0;
  for (int trial = 0; trial < 300 && found < 10; ++trial) {
    const auto x = sample(whole, random);
    if (!x) continue;
    ++found;
    const bool of_a_part = std::any_of(systems.begin(), systems.end(), [&](const System& part) {
      const bool has_kernel = part.size() > part.configuration_size;
      return has_kernel || std::ranges::all_of(part.equations, [&](const Polynomial& f) {
               return std::fabs(value_of(f, in_part(all, part, *x))) < 1e-5;
             });
    });
    EXPECT_TRUE(of_a_part);
  }
  EXPECT_GE(found, 5);
}

INSTANTIATE_TEST_SUITE_P(
    Models, SetParts,
    testing::Values(Case{"planar/3rrr", SingularitySet::inverse, 6}, Case{"planar/3prr", SingularitySet::inverse, 3},
                    Case{"dextar", SingularitySet::inverse, 4}, Case{"dextar", SingularitySet::forward, 2},
                    Case{"three_slider", SingularitySet::forward, 2},
                    Case{"planar/stephenson", SingularitySet::forward, 4, 1},
                    Case{"planar/watt", SingularitySet::inverse, 4, 1},
                    Case{"platforms/orthoglide", SingularitySet::inverse, 3},
                    Case{"spatial/agile_eye", SingularitySet::inverse, 3},
                    Case{"serial/puma_560", SingularitySet::inverse, 3}, Case{"serial/ur5", SingularitySet::inverse, 3}),
    [](const testing::TestParamInfo<Case>& test) {
      std::string name = std::string(test.param.model) + "_" + to_string(test.param.set);
      std::replace(name.begin(), name.end(), '/', '_');
      return name;
    });

TEST(SetPartsOf, MechanismsWithoutSuchSingularitiesAreNone) {
  const Question legs{.model = model_named("platforms/stewart"), .set = SingularitySet::inverse};
  const auto kernel = symbolic::kernel_question(legs.model, SingularitySet::inverse);
  EXPECT_TRUE(symbolic::decompose(legs.model, kernel).empty());  // legs have lengths above 0
}

TEST(SetPartsOf, ArmsAreConditionsOnTheirJoints) {
  const auto conditions = [](const std::string& model) {
    std::vector<std::string> list;
    for (const Question& part : parts_of({.model = model_named(model), .set = SingularitySet::inverse, .in_parts = true}))
      list.push_back(std::get<symbolic::Component>(*part.part).relation());
    return list;
  };
  // Wrist, elbow and shoulder, as textbooks have them.
  EXPECT_THAT(conditions("serial/puma_560"),
              ElementsAre("sin(theta5) = 0", "a3*sin(theta3) + d4*cos(theta3) = 0",
                          "a2*cos(theta2) + a3*cos(theta2)*cos(theta3) - a3*sin(theta2)*sin(theta3) - "
                          "d4*cos(theta2)*sin(theta3) - d4*sin(theta2)*cos(theta3) = 0"));
  EXPECT_THAT(conditions("serial/ur5"),
              ElementsAre("sin(theta3) = 0", "sin(theta5) = 0",
                          testing::AllOf(testing::HasSubstr("cos(theta2)"), testing::Not(testing::HasSubstr("_link")))));
  // Those that divide a C-space into aspects are the same.
  const symbolic::Mechanism ur5 = model_named("serial/ur5");
  for (const symbolic::Expression& f :
       symbolic::determinant_factors(ur5, symbolic::locked_matrix(ur5, SingularitySet::inverse)))
    EXPECT_EQ(f.text().find("_link"), std::string::npos) << f.text();
  EXPECT_THAT(conditions("serial/orthogonal_3r"),
              ElementsAre("d2*sin(theta3) + d3*cos(theta2)*sin(theta3) - r2*cos(theta2)*cos(theta3) = 0"));
  Question arm{.model = model_named("serial/orthogonal_3r"), .set = SingularitySet::inverse};
  EXPECT_THAT(names_of(parts_of(arm)), ElementsAre("condition on theta2, theta3")) << "its first joint has one value";
  arm.model.set_range("theta1", -symbolic::pi(), symbolic::pi());
  EXPECT_THAT(names_of(parts_of(arm)), ElementsAre(testing::StartsWith("condition on ")));
}

// A 3-UPU platform that keeps its orientation: legs whose lines are dependent, or whose constraint moments are. Limits of
// a joint keep a leg's links, and then that leg may lie along its fixed axis, too.
Question keeping_orientation(const std::string& range, bool limited = false) {
  ModelText file = read_text(CORANK_SOURCE_DIR "/models/platforms/3upu.cuik");
  const auto replace = [&](const std::string& from, const std::string& to) {
    file.text.replace(file.text.find(from), from.size(), to);
  };
  replace("P : position of platform.C", "P : pose of platform.C range z " + range + " keeps id");
  if (limited) replace("leg1 A + (1, 0, 0)\n", "leg1 A + (1, 0, 0) range [-3, 3] + (1, 0, 0) [-3, 3] + (0, 1, 0)\n");
  const Model robot = parse_model(file);
  return Question{.model = robot.mechanism, .set = SingularitySet::forward, .assembly = robot.assembly};
}

TEST(SetPartsOf, PlatformsThatKeepTheirOrientationHaveNoLongKernel) {
  for (const bool limited : {false, true}) {
    const Question platform = keeping_orientation("[1/2, 3/2]", limited);
    EXPECT_EQ(platform.assembly->mobility_by_rank, 3) << "no equation that is solved follows from the others";
    const std::vector<Question> parts = parts_of(platform);
    ASSERT_EQ(parts.size(), limited ? 3u : 2u);
    const Deficiency deficiency(platform.model, *platform.set);
    std::mt19937_64 random(5);
    int found = 0;
    for (const Question& part : parts) {
      EXPECT_FALSE(std::get<symbolic::Component>(*part.part).block);
      const System equations = system(part);
      for (int trial = 0; trial < 50; ++trial) {
        const auto x = sample(equations, random);
        if (!x) continue;
        ++found;
        EXPECT_LT(deficiency.at(*x), 1e-6) << text(*part.part);
      }
    }
    EXPECT_GE(found, 3);
  }
  Options options;
  options.search.sigma = 0.05;
  Question slice = keeping_orientation("[1, 1]");
  const result::Result result = answer(slice, options);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_GT(result.cover.boxes.size(), 100u);
  for (const CoverBox& box : result.cover.boxes) EXPECT_NE(box.verdict, Verdict::undecided);
  slice.kernel = symbolic::KernelSide::right;
  EXPECT_THAT(names_of(parts_of(slice)), ElementsAre("whole"));
}

TEST(SetPartsOf, WhatIsNotFactoredInTimeStaysWhole) {
  const Question arm{.model = model_named("serial/puma_560"), .set = SingularitySet::inverse, .in_parts = true};
  EXPECT_EQ(parts_of(arm).size(), 3u);
  EXPECT_THAT(names_of(parts_of(arm, [] { return true; })), ElementsAre("whole"));
}

TEST(SetPartsOf, SurfacesAndCurvesByDefaultAndOfPointsWhereTheyAreAskedFor) {
  Question legs{.model = model_named("planar/3prr"), .set = SingularitySet::inverse};
  EXPECT_THAT(names_of(parts_of(legs)),
              ElementsAre("2*h*sin(psi2) - cos(psi2) = 0", "2*h*sin(psi3) + cos(psi3) = 0", "cos(psi1) = 0"));
  for (auto change : std::vector<std::function<void(Question&)>>{
           [](Question& q) { q.kernel = symbolic::KernelSide::right; }, [](Question& q) { q.corank = 2; },
           [](Question& q) { q.in_parts = false; }, [](Question& q) { q.set = SingularitySet::cspace; }}) {
    Question other = legs;
    change(other);
    EXPECT_THAT(names_of(parts_of(other)), ElementsAre("whole"));
  }
  legs.set = SingularitySet::forward;  // one equation in place of the kernel vector
  EXPECT_THAT(names_of(parts_of(legs)), ElementsAre("condition on psi1, psi2, psi3, pose_phi"));
  const Question four_rows{.model = model_named("planar/3rpr"), .set = SingularitySet::forward};
  EXPECT_THAT(names_of(parts_of(four_rows)), ElementsAre("condition on alpha1, alpha2, alpha3, pose_phi"));
  Question points{.model = model_named("planar/double_butterfly"), .set = SingularitySet::forward};
  EXPECT_THAT(names_of(parts_of(points)), ElementsAre("whole"));
  points.in_parts = true;
  EXPECT_THAT(names_of(parts_of(points)), ElementsAre(testing::StartsWith("block of ")));
  Question curve{.model = model_named("dextar"), .set = SingularitySet::forward};
  EXPECT_THAT(names_of(parts_of(curve)), ElementsAre("theta4 = theta3", "theta4 = theta3 + pi"));
  curve.in_parts = false;
  EXPECT_THAT(names_of(parts_of(curve)), ElementsAre("whole"));
}

TEST(SetPartsOf, ALegFoldedUponItselfTurnsFreelyWhereItsLinksAreEquallyLong) {
  ModelText file = read_text(CORANK_SOURCE_DIR "/models/planar/3rrr.cuik");
  const auto sizes = [&] {
    std::vector<std::size_t> list;
    for (const Question& part : parts_of({.model = parse_model(file).mechanism, .set = SingularitySet::inverse}))
      list.push_back(equations(part).coordinates.size());
    return list;
  };
  EXPECT_THAT(sizes(), ElementsAre(9, 7, 9, 7, 9, 7));
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(file.text.find(from), std::string::npos);
    file.text.replace(file.text.find(from), from.size(), to);
  };
  replace("B1 (l1, 0, 0)", "B1 (4/5, 0, 0)");
  EXPECT_THAT(sizes(), ElementsAre(9, 7, 9, 7, 9, 9)) << "leg 1's links are not";
  const std::string joint = "crank2 A2 + (0, 0, 1)     actuated";
  replace(joint, joint + " range [-1, 1]");
  EXPECT_THAT(sizes(), ElementsAre(9, 9, 9, 7, 9, 9)) << "and leg 2 does not turn fully";
}

// What is left of the equations, however they are written.
TEST(SetPartsOf, ALegThatTurnsFreelyLeavesTheOthersEquations) {
  const symbolic::Mechanism robot = model_named("planar/3rrr");
  std::string text = symbolic::to_model(robot);
  for (std::size_t at; (at = text.find("\n    ")) != std::string::npos;) text.replace(at, 5, " ");  // lines that go on
  for (std::size_t at = text.find("[SYSTEM EQS]"); (at = text.find(" = 0;", at)) != std::string::npos;) {
    const std::size_t line = text.rfind('\n', at) + 1;
    text = text.substr(0, line) + "0 = " + text.substr(line, at - line) + text.substr(at + 4);
  }
  ASSERT_NE(text.find("0 = "), std::string::npos);
  const symbolic::Mechanism other = symbolic::parse_model(text, "turned.cuik");
  const auto sizes = [](const symbolic::Mechanism& m) {
    std::vector<std::pair<std::size_t, std::size_t>> list;
    for (const Question& part : parts_of({.model = m, .set = SingularitySet::inverse})) {
      const symbolic::TrigonometricSystem system = equations(part);
      list.emplace_back(system.coordinates.size(), system.equations.size());
    }
    return list;
  };
  const std::pair<std::size_t, std::size_t> stretched(9, 7), folded(7, 6);
  EXPECT_THAT(sizes(robot), ElementsAre(stretched, folded, stretched, folded, stretched, folded));
  EXPECT_EQ(sizes(other), sizes(robot));
}

// Where leg 2 of a 3-RRR is folded its motor is free, and the two other legs are stretched at the same orientation: there
// four sheets cross along a curve. In 40 times as many boxes this search came to no end.
TEST(SetPartsOf, SheetsThatCrossAlongACurveComeToAnEnd) {
  ModelText file = read_text(CORANK_SOURCE_DIR "/models/planar/3rrr.cuik");
  for (const auto& [crank, range] :
       {std::pair("crank1 A1", "[0.1, 0.4]"), {"crank2 A2", "[-2.4, -2.3]"}, {"crank3 A3", "[-1, -0.6]"}}) {
    const std::string joint = std::string(crank) + " + (0, 0, 1)     actuated";
    ASSERT_NE(file.text.find(joint), std::string::npos);
    file.text.insert(file.text.find(joint) + joint.size(), std::string(" range ") + range);
  }
  Options options;
  options.search.sigma = 0.1;
  options.search.max_boxes = 60'000;
  const result::Result result =
      answer({.model = parse_model(file).mechanism, .set = SingularitySet::inverse, .in_parts = true}, options);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_GT(result.cover.count(Verdict::regular), 1000u);
  for (const CoverBox& box : result.cover.boxes)
    EXPECT_EQ(box.reason, box.verdict == Verdict::undecided ? Reason::degenerate_set : Reason::none);
}

const result::Result& legs() {
  static const result::Result result = [] {
    Question question{.model = model_named("planar/3prr"), .set = SingularitySet::inverse};
    Options options;
    options.search.sigma = 0.5;
    options.search.proof = true;
    return answer(question, options);
  }();
  return result;
}

TEST(SetPartsOf, AMechanismsLegsAreProvenAndVerified) {
  EXPECT_TRUE(legs().cover.complete());
  EXPECT_EQ(legs().cover.dimension, 2);
  ASSERT_EQ(legs().parts.size(), 3u);
  EXPECT_EQ(legs().cover.count(Verdict::undecided), 0u);
  EXPECT_EQ(legs().parts[2].condition, "cos(psi1) = 0");
  // cos ψ_i = 0 in the frame of each rail, whose directions are 0 and ±120 degrees.
  std::size_t inside = 0;
  for (const CoverBox& box : legs().parts[2].cover.boxes) inside += box.box[3].contains(0.0);
  EXPECT_EQ(inside, legs().parts[2].cover.boxes.size());
}

class SetPartsFile : public testing::Test {
 protected:
  ~SetPartsFile() override { std::filesystem::remove(path_); }
  // Through a file: why the result is rejected; nothing where it is accepted.
  std::string rejection(const result::Result& result) const {
    std::string reasons;
    try {
      result::write_result(path_, result);
      const result::Verification verification = result::verify(result::read_result(path_));
      for (const std::string& c : verification.contradictions) reasons += c + "\n";
      for (const auto& failure : verification.report.failures) reasons += failure.reason + "\n";
      EXPECT_EQ(verification.verified(), reasons.empty());
      EXPECT_TRUE(verification.complete() || !reasons.empty());
    } catch (const result::ResultFileError& error) {
      reasons = error.what();
    }
    return reasons;
  }
  std::string rejection_of(const std::function<void(result::Result&)>& change) const {
    result::Result result = legs();
    change(result);
    merge_parts(result);
    return rejection(result);
  }

 private:
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("corank-set-parts-" + std::to_string(getpid()) + ".h5");
};

TEST_F(SetPartsFile, ComesBackVerifiedAndIsRejectedWithoutAPartOrWithAnother) {
  EXPECT_EQ(rejection(legs()), "");
  EXPECT_THAT(rejection_of([](result::Result& r) { r.parts.pop_back(); }), testing::HasSubstr("the parts are not those"));
  EXPECT_THAT(rejection_of([](result::Result& r) { std::swap(r.parts[0], r.parts[1]); }),
              testing::HasSubstr("the parts are not those"));
  EXPECT_THAT(rejection_of([](result::Result& r) { r.parts[0].part = "cos(psi1) = 1"; }),
              testing::HasSubstr("the parts are not those"));
  EXPECT_NE(rejection_of([](result::Result& r) { std::swap(r.parts[0].cover, r.parts[1].cover); }), "");
  EXPECT_NE(rejection_of([](result::Result& r) { r.parts[2].cover.boxes.pop_back(); }), "");
}

// What ended before it was reduced has more unknowns than the set has dimensions, and a coarser sigma.
TEST(SetParts, ThatWereNotSearchedSayNothingOfTheDimension) {
  result::Result result = legs();
  const int dimension = result.cover.dimension;
  const Sigma sigma = result.cover.sigma;
  const auto end_early = [](result::Result& part) {
    part.cover.statistics.processed = 0;
    part.cover.dimension += 2;
    part.cover.sigma = {1, 1};
    part.cover.boxes.resize(1);
    part.cover.boxes[0].verdict = Verdict::pending;
  };
  end_early(result.parts[0]);
  merge_parts(result);
  EXPECT_EQ(result.cover.dimension, dimension);
  EXPECT_EQ(result.cover.sigma.length, sigma.length);
  EXPECT_FALSE(result.cover.complete());
  for (std::size_t i = 1; i < result.parts.size(); ++i) end_early(result.parts[i]);
  merge_parts(result);
  EXPECT_EQ(result.cover.dimension, dimension + 2) << "where there is no other";
}

// Against the equations that they stand for: the same solutions, for each kind.
TEST(DependentAngles, HoldWhatTheyStandFor) {
  std::mt19937_64 random(11);
  for (const int sign : {1, -1})
    for (int quarters = 0; quarters < 4; ++quarters) {
      symbolic::Mechanism rods("rods");
      const auto a = rods.angle("a"), b = rods.angle("b");
      const auto x = rods.length("x", -5, 5);
      rods.constrain(x == 2 * cos(a) + sin(b + a) + cos(2 * b));
      symbolic::TrigonometricSystem tied = symbolic::plain_system(rods);
      tied.dependent_angle = symbolic::DependentAngle{"b", "a", sign, quarters};
      const System system = symbolic::algebrize(tied);
      EXPECT_EQ(system.size() - static_cast<int>(system.equations.size()), 1);
      for (int trial = 0; trial < 20; ++trial) {
        const double alpha = std::uniform_real_distribution<>(-pi, pi)(random), beta = sign * alpha + quarters * pi / 2;
        VectorXd v(5);
        v << std::cos(alpha), std::sin(alpha), std::cos(beta), std::sin(beta),
            2 * std::cos(alpha) + std::sin(beta + alpha) + std::cos(2 * beta);
        for (const Polynomial& f : system.equations)
          EXPECT_NEAR(value_of(f, v), 0, 1e-12) << tied.dependent_angle->text() << f.source;
        v[2] = -v[2];
        v[3] = -v[3];
        EXPECT_TRUE(std::any_of(system.equations.begin(), system.equations.end(),
                                [&](const Polynomial& f) { return std::fabs(value_of(f, v)) > 1e-6; }));
      }
    }
}

}  // namespace
}  // namespace corank::study
