// The postures of a seven-revolute arm with its third joint locked, against their closed form; and the arm's joints against
// its Denavit-Hartenberg table.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/tests/robots/numeric_mechanism.h"

namespace corank {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLock = M_PI / 6;
const Vector3d kFlange(450, 150, 500);

Matrix3d hand() {
  Matrix3d r;
  r << 0, 0, 1, 0.8, -0.6, 0, 0.6, 0.8, 0;
  return r;
}

using Angles = std::array<double, 7>;

Matrix3d about(const Vector3d& axis, double angle) { return AngleAxisd(angle, axis).toRotationMatrix(); }

// Each joint turns about z, then d along z, then alpha about x.
Isometry3d by_table(const Angles& t) {
  const double d[] = {340, 0, 400, 0, 400, 0, 126};
  const double alpha[] = {-M_PI / 2, M_PI / 2, M_PI / 2, -M_PI / 2, -M_PI / 2, M_PI / 2, 0};
  Isometry3d pose = Isometry3d::Identity();
  for (std::size_t i = 0; i < 7; ++i)
    pose = pose * AngleAxisd(t[i], Vector3d::UnitZ()) * Eigen::Translation3d(0, 0, d[i]) *
           AngleAxisd(alpha[i], Vector3d::UnitX());
  return pose;
}

// Shoulder, elbow and wrist one after the other.
std::vector<Angles> closed_form() {
  std::vector<Angles> list;
  const Vector3d wrist = kFlange - 126 * hand().col(2) - Vector3d(0, 0, 340);
  const double bend = std::acos((wrist.squaredNorm() - 2 * 400 * 400) / (2 * 400 * 400));
  for (const double t4 : {bend, -bend}) {
    // The wrist from the shoulder in link 2: R_z(t1) R_y(t2) v = wrist.
    const Vector3d v =
        Vector3d(0, 0, 400) + about(Vector3d::UnitZ(), kLock) * about(-Vector3d::UnitY(), t4) * Vector3d(0, 0, 400);
    const double reach = std::hypot(v.x(), v.z());  // the height is reach cos(t2 + ahead)
    for (const double side : {1.0, -1.0}) {
      const double t2 = side * std::acos(wrist.z() / reach) - std::atan2(v.x(), v.z());
      const Vector3d level = about(Vector3d::UnitY(), t2) * v;
      const double t1 = std::atan2(wrist.y(), wrist.x()) - std::atan2(level.y(), level.x());
      const Matrix3d fore = about(Vector3d::UnitZ(), t1) * about(Vector3d::UnitY(), t2) * about(Vector3d::UnitZ(), kLock) *
                            about(-Vector3d::UnitY(), t4);
      const Matrix3d rest = fore.transpose() * hand();  // R_z(t5) R_y(t6) R_z(t7)
      for (const double turn : {1.0, -1.0}) {
        const double t6 = turn * std::acos(rest(2, 2));
        const double t5 = std::atan2(turn * rest(1, 2), turn * rest(0, 2));
        const double t7 = std::atan2(turn * rest(2, 1), -turn * rest(2, 0));
        list.push_back({t1, t2, kLock, t4, t5, t6, t7});
      }
    }
  }
  return list;
}

TEST(LockedArm, HasTheEightPosturesOfItsClosedForm) {
  const study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/serial/iiwa_locked.cuik");
  const System system = study::system({.model = model.mechanism, .assembly = model.assembly});
  const Cover cover = solve::solve(system, {});
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::isolated), 8u);
  EXPECT_EQ(cover.boxes.size(), 8u);
  const test::NumericMechanism numeric(model.mechanism);
  std::vector<Angles> found;
  for (const CoverBox& point : cover.points) {
    test::VectorXd x(static_cast<Eigen::Index>(point.box.size()));
    for (std::size_t i = 0; i < point.box.size(); ++i) x[static_cast<Eigen::Index>(i)] = point.box[i].mid();
    const auto values = numeric.named(x);
    Angles& t = found.emplace_back();
    t[2] = kLock;
    for (const auto& joint : model.assembly->joint_values) {
      const double value = symbolic::evaluate(joint.value, values);
      t[static_cast<std::size_t>(joint.joint.at(1) - '1')] =
          joint.sine ? std::atan2(symbolic::evaluate(*joint.sine, values), value) : value;
    }
    const Isometry3d at = by_table(t);
    EXPECT_LT((at.translation() - kFlange).norm(), 1e-5);
    EXPECT_LT((at.linear() - hand()).norm(), 1e-8);
  }
  const std::vector<Angles> expected = closed_form();
  ASSERT_EQ(expected.size(), 8u);
  for (const Angles& t : expected) {
    EXPECT_LT((by_table(t).translation() - kFlange).norm(), 1e-9) << "the closed form itself";
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [&](const Angles& other) {
                              double off = 0;
                              for (std::size_t i = 0; i < 7; ++i)
                                off = std::max(off, std::fabs(std::remainder(t[i] - other[i], 2 * M_PI)));
                              return off < 1e-7;
                            }),
              1);
  }
}

}  // namespace
}  // namespace corank
