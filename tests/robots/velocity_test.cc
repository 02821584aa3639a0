// The velocity equation by twists against the equations: at random configurations both have the same motions, and the rates
// of the joints are the derivatives of their values.
#include <gtest/gtest.h>

#include <filesystem>

#include "corank/kinematics/equations/assembly.h"
#include "corank/kinematics/language/part_file.h"
#include "corank/symbolic/velocity/velocity_equation.h"
#include "corank/tests/kinematics/read_robot.h"
#include "corank/tests/robots/numeric_mechanism.h"

namespace corank {
namespace {

namespace fs = std::filesystem;
using test::MatrixXd;
using test::VectorXd;

constexpr int kConfigurations = 20;

// L's coefficients at a configuration.
MatrixXd twists_at(const symbolic::ExpressionMatrix& l, const std::map<std::string, double>& values) {
  MatrixXd result(static_cast<Eigen::Index>(l.rows.size()), static_cast<Eigen::Index>(l.columns.size()));
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (Eigen::Index j = 0; j < result.cols(); ++j)
      result(i, j) = symbolic::evaluate(l.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], values);
  return result;
}

// The derivative of a joint's value along x', by differences.
double joint_rate(const test::NumericMechanism& numeric, const kinematics::Assembly::JointValue& joint, const VectorXd& x,
                  const VectorXd& along) {
  constexpr double kStep = 1e-6;
  const auto before = numeric.named(x - kStep * along), after = numeric.named(x + kStep * along);
  const auto change = [&](const symbolic::Expression& e) {
    return symbolic::evaluate(e, after) - symbolic::evaluate(e, before);
  };
  if (!joint.sine) {
    const double by = change(joint.value);
    return std::remainder(by, 2 * M_PI) / (2 * kStep);
  }
  const auto at = numeric.named(x);
  return (symbolic::evaluate(joint.value, at) * change(*joint.sine) -
          symbolic::evaluate(*joint.sine, at) * change(joint.value)) /
         (2 * kStep);
}

void expect_same_motions(const kinematics::Assembly& assembly) {
  const test::NumericMechanism numeric(assembly.mechanism);
  const symbolic::ExpressionMatrix l = symbolic::derive(assembly.mechanism).velocity.matrix;
  const auto is_input = [](const symbolic::Rate& rate) { return rate.role == symbolic::Role::input; };
  EXPECT_EQ(std::ranges::count_if(assembly.mechanism.rates(), is_input), std::ssize(assembly.mechanism.inputs()));
  std::mt19937 random(1);
  int found = 0, compared = 0;
  for (int k = 0; k < kConfigurations; ++k) {
    const auto x = numeric.random_configuration(random);
    if (!x) continue;
    ++found;
    const MatrixXd of_equations = test::kernel(numeric.jacobian(*x)),
                   of_twists = test::kernel(twists_at(l, numeric.named(*x)));
    ASSERT_EQ(of_equations.cols(), of_twists.cols()) << "degrees of freedom";
    // Rates that both know: of joints with a value, and of outputs.
    std::vector<VectorXd> rows;
    std::vector<VectorXd> own;
    const auto compare = [&](const std::string& rate, const auto& derivative) {
      const auto column = std::find(l.columns.begin(), l.columns.end(), rate);
      if (column == l.columns.end()) return;
      VectorXd row(of_equations.cols());
      for (Eigen::Index i = 0; i < row.size(); ++i) row[i] = derivative(VectorXd(of_equations.col(i)));
      rows.push_back(row);
      own.emplace_back(of_twists.row(column - l.columns.begin()).transpose());
    };
    for (const auto& joint : assembly.joint_values) {
      const bool turns = joint.sine || std::find(l.columns.begin(), l.columns.end(), "v_" + joint.joint) == l.columns.end();
      compare((turns ? "w_" : "v_") + joint.joint,
              [&](const VectorXd& along) { return joint_rate(numeric, joint, *x, along); });
    }
    for (const symbolic::Coordinate& c : assembly.mechanism.coordinates())
      if (const int variable = numeric.system().find(c.name); variable >= 0)
        compare("v_" + c.name, [&](const VectorXd& along) { return along[variable]; });
    ASSERT_GT(rows.size(), 0u);
    const auto n = static_cast<Eigen::Index>(rows.size()), m = of_equations.cols();
    MatrixXd by_equations(n, m), by_twists(n, m);
    for (Eigen::Index i = 0; i < n; ++i) {
      by_equations.row(i) = rows[static_cast<std::size_t>(i)].transpose();
      by_twists.row(i) = own[static_cast<std::size_t>(i)].transpose();
    }
    MatrixXd both(n, 2 * m);
    both << by_equations, by_twists;
    const Eigen::Index expected = test::rank(by_equations, 1e-6);
    EXPECT_EQ(test::rank(by_twists, 1e-6), expected);
    EXPECT_EQ(test::rank(both, 1e-6), expected) << "the same joint rates";
    compared += static_cast<int>(n);
  }
  EXPECT_GT(found, kConfigurations / 2);
  std::cout << compared << " joint rates at " << found << " configurations\n";
}

std::vector<std::string> models() {
  std::vector<std::string> list;
  for (const char* folder : {"spatial", "serial"})
    for (const auto& entry : fs::directory_iterator(std::string(CORANK_SOURCE_DIR "/models/") + folder)) {
      const std::string name = entry.path().stem().string();
      // Equations, and what others include.
      if (name == "bricard_motion" || name == "agile_eye_apart" || name == "orthogonal_3r_section") continue;
      list.push_back(std::string(folder) + "/" + name);
    }
  std::sort(list.begin(), list.end());
  return list;
}

class Twists : public testing::TestWithParam<std::string> {};

TEST_P(Twists, HaveTheMotionsOfTheEquations) {
  kinematics::Robot robot = kinematics::read_part_file(CORANK_SOURCE_DIR "/models/" + GetParam() + ".cuik");
  for (kinematics::Joint& j : robot.joints) j.ranges.clear();  // a locked joint's coordinate does not move
  const auto is_actuated = [](const kinematics::Joint& j) { return j.actuated; };
  if (std::none_of(robot.joints.begin(), robot.joints.end(), is_actuated)) {
    robot.joints.front().actuated = true;  // a linkage without a motor has no velocity equation
    robot.equations.clear();
  }
  const kinematics::Assembly assembly = kinematics::assemble(robot);
  ASSERT_TRUE(assembly.mechanism.has_own_velocity_equation());
  expect_same_motions(assembly);
}

INSTANTIATE_TEST_SUITE_P(Models, Twists, testing::ValuesIn(models()), [](const auto& model) {
  std::string name = model.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

// A platform on three tubes that turn, each with one of its balls: 3-RPS, whose lengths are driven, or whose tubes are.
TEST(Twists, OfBallsInTubesHaveTheMotionsOfTheEquations) {
  for (const bool lengths : {true, false}) {
    std::string links = "[LINKS]\nbase\ntop\n", joints = "[JOINTS]\n";
    const char* const places[] = {"2, 0", "-1, 3/2", "-1, -2"};
    const char* const axes[] = {"0, 1", "3, 2", "2, -1"};
    for (int i = 0; i < 3; ++i) {
      const std::string n = std::to_string(i), at = std::string("(") + places[i] + ", 0)";
      links += "tube" + n + "\n";
      joints += "revolute q" + n + " : base " + at + "+(" + axes[i] + ", 0) tube" + n + " (0,0,0)+(0,1,0)" +
                (lengths ? "" : " actuated") + "\nslot s" + n + " : tube" + n + " (0,0,0)+(0,0,1) top " + at +
                " range [1, 5]" + (lengths ? " actuated" : "") + "\n";
    }
    const kinematics::Assembly assembly = kinematics::assemble(
        kinematics::parse_parts(links + joints + "[OUTPUTS]\nhand : position of top (0,0,1/3)\n", "tubes.cuik"));
    EXPECT_EQ(assembly.mobility, 3);
    expect_same_motions(assembly);
  }
}

}  // namespace
}  // namespace corank
