#include "corank/kinematics/loops/couplings.h"

#include <algorithm>
#include <map>

namespace corank::kinematics {
namespace {

using symbolic::ModelError;

/// The joint's value as ratio times the first driver's, plus offset.
struct Followed {
  std::size_t driver;
  ex ratio = 1, offset = 0;
};

class Reader {
 public:
  Reader(const Robot& robot, const Algebra& algebra) : robot_(robot), algebra_(algebra) {
    for (const Coupling& c : robot.couplings) of_follower_[c.follower] = &c;
  }

  Followed followed(std::size_t joint) const {
    const auto found = of_follower_.find(joint);
    if (found == of_follower_.end()) return {joint};
    const Coupling& c = *found->second;
    const Followed driver = followed(c.driver);
    const ex own = ratio(c);
    return {driver.driver, algebra_.clean(own * driver.ratio),
            algebra_.clean(own * driver.offset + algebra_.constant(c.offset, c.where))};
  }

 private:
  ex ratio(const Coupling& c) const {
    const ex exact = algebra_.constant(c.ratio, c.where);
    if (robot_.joints[c.follower].kind == JointKind::prismatic) return exact;
    if (const auto rational = algebra_.rational(exact)) return *rational;
    throw ModelError(c.where,
                     "the ratio " + c.ratio.text() + " by which the joint '" + robot_.joints[c.follower].name +
                         "' follows '" + robot_.joints[c.driver].name +
                         "' is not recognized as a rational number: the two would never come back to where they began",
                     "a ratio of whole numbers, such as -17/20, the numbers of teeth");
  }

  const Robot& robot_;
  const Algebra& algebra_;
  std::map<std::size_t, const Coupling*> of_follower_;
};

}  // namespace

Couplings::Couplings(const Robot& robot, const Algebra& algebra) : places_(robot.joints.size()) {
  const Reader reader(robot, algebra);
  std::map<std::size_t, std::size_t> train_of;  // by the first driver
  const auto add = [&](std::size_t joint) {
    if (places_[joint]) return;
    const Followed at = reader.followed(joint);
    const auto [train, is_new] = train_of.emplace(at.driver, trains_.size());
    if (is_new) trains_.push_back({at.driver, 1, {}});
    trains_[train->second].joints.push_back(joint);
    places_[joint] = Place{train->second, at.ratio, at.offset};
  };
  for (const Coupling& c : robot.couplings) {
    add(reader.followed(c.driver).driver);
    add(c.driver);
    add(c.follower);
  }
  for (Train& train : trains_) {
    if (robot.joints[train.driver].kind == JointKind::prismatic) continue;
    GiNaC::numeric parts = 1, most = 1;
    for (const std::size_t j : train.joints)
      parts = GiNaC::lcm(parts, GiNaC::ex_to<GiNaC::numeric>(places_[j]->multiple).denom());
    for (const std::size_t j : train.joints) {
      places_[j]->multiple = places_[j]->multiple * parts;
      most = std::max(most, GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(places_[j]->multiple)));
    }
    if (most > kMostTurns) {
      const auto last = std::find_if(robot.couplings.rbegin(), robot.couplings.rend(), [&](const Coupling& c) {
        return places_[c.follower]->train == places_[train.driver]->train;
      });
      throw ModelError(
          last->where,
          "joints that follow '" + robot.joints[train.driver].name + "' turn too often before all are back where they began",
          "at most " + std::to_string(kMostTurns) + " turns of each, as by ratios p/q of small numbers");
    }
    train.parts = parts.to_int();
  }
}

}  // namespace corank::kinematics
