#include "corank/analyze/paths/tube_builder.h"

#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/Constraint.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <mutex>

namespace corank::analyze {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class Equations : public ob::Constraint {
 public:
  explicit Equations(const PathSpace& space)
      : ob::Constraint(static_cast<unsigned>(space.size()), static_cast<unsigned>(space.size() - space.dimension()), 1e-10),
        space_(space) {}
  void function(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> out) const override {
    out = space_.residual(x);
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> out) const override {
    out = space_.jacobian(x);
  }
  bool project(Eigen::Ref<Eigen::VectorXd> x) const override {
    PathSpace::Point point = x;
    if (!space_.project(point)) return false;
    x = point;
    return true;
  }

 private:
  const PathSpace& space_;
};

// The same way each time.
void settle_ompl() {
  static std::once_flag once;
  std::call_once(once, [] {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(1);
  });
}

}  // namespace

std::optional<TubeBuilder::Points> sampled_way(const PathSpace& space, const PathSpace::Point& from,
                                               const PathSpace::Point& to, double margin, double seconds,
                                               const solve::Control& control) {
  settle_ompl();
  const auto n = static_cast<unsigned>(space.size());
  const auto ambient = std::make_shared<ob::RealVectorStateSpace>(n);
  ob::RealVectorBounds bounds(n);
  for (unsigned j = 0; j < n; ++j) {
    const Interval& side = space.system().variables[j].domain;
    const double size = space.sizes()[j], room = 1e-6 * (1 + side.width() / size);
    bounds.setLow(j, side.lo() / size - room);
    bounds.setHigh(j, side.hi() / size + room);
  }
  ambient->setBounds(bounds);
  const auto constraint = std::make_shared<Equations>(space);
  const auto projected = std::make_shared<ob::ProjectedStateSpace>(ambient, constraint);
  const auto information = std::make_shared<ob::ConstrainedSpaceInformation>(projected);
  og::SimpleSetup setup(information);
  const std::vector<int> signs = space.state(from).signs;
  setup.setStateValidityChecker([&](const ob::State* state) {
    const auto& x = *state->as<ob::ConstrainedStateSpace::StateType>();
    const PathSpace::State s = space.state(x);
    return s.inside && s.margin >= margin && s.signs == signs;
  });
  ob::ScopedState<> start(projected), goal(projected);
  start->as<ob::ConstrainedStateSpace::StateType>()->copy(from);
  goal->as<ob::ConstrainedStateSpace::StateType>()->copy(to);
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<og::RRTConnect>(information));
  try {
    setup.setup();
    const auto limit = ob::timedPlannerTerminationCondition(seconds);
    const ob::PlannerTerminationCondition ended([&] { return limit() || control.ended(); });
    if (setup.solve(ended) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
  } catch (const ompl::Exception&) {
    return std::nullopt;
  }
  og::PathGeometric path = setup.getSolutionPath();
  path.interpolate();
  TubeBuilder::Points points;
  for (const ob::State* state : path.getStates()) {
    PathSpace::Point x = *state->as<ob::ConstrainedStateSpace::StateType>();
    if (!space.project(x)) return std::nullopt;
    points.push_back(std::move(x));
  }
  if (points.size() < 2) return std::nullopt;
  points.front() = from;
  points.back() = to;
  return points;
}

}  // namespace corank::analyze
