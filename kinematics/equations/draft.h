// A mechanism in the making: coordinates, equations and rates in the algebra of a robot's geometry, turned into the model
// language's expressions at the end.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corank/kinematics/equations/assembly.h"
#include "corank/kinematics/loops/couplings.h"
#include "corank/kinematics/loops/identities.h"
#include "corank/kinematics/loops/loop_branches.h"
#include "corank/kinematics/loops/plane.h"
#include "corank/kinematics/robot/algebra.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::kinematics {

class Draft {
 public:
  Draft(const Robot& robot, Algebra& algebra, std::vector<Parallelogram> parallelograms, bool in_branches)
      : robot_(robot),
        algebra_(algebra),
        branches_(std::move(parallelograms), algebra, in_branches),
        couplings_(robot, algebra),
        common_(couplings_.trains().size()),
        rate_(common_) {}

  /// From now on equations that follow from those before them, by exact identities, are left out.
  void seek_identities() { identities_.emplace(algebra_); }
  bool seeks_identities() const { return identities_.has_value(); }
  /// Is e = 0 known to follow?
  bool follows(const ex& e) { return identities_ && identities_->imply(algebra_.clean(e)); }

  /// With underscores for what is no letter or digit.
  static std::string identifier(const std::string& name);
  /// Free names: `wanted`, or with underscores where that is taken or no name.
  std::string free_name(const std::string& wanted);

  ex angle(const std::string& name, const std::optional<Range>& range, const SourceLocation& where);
  /// Without a range: what the equations leave.
  ex length(const std::string& name, const std::optional<Range>& range, const SourceLocation& where, bool auxiliary = false);
  /// An angle that is a coordinate is looked at in this range only. Throws ModelError where its own range has other values.
  void slice(const ex& angle, const Range& range, const std::string& what, const SourceLocation& where);
  /// The middle of a range of angles and half of its width; nothing where it is the whole circle.
  struct Arc {
    ex middle, half;
  };
  std::optional<Arc> arc(const Range& range, const SourceLocation& where) const;
  /// The range of the coordinate declared last is a joint's: the mechanism's limit, where it is one.
  void limit_last();
  /// A joint's angle or way, in terms of its coordinate.
  struct JointCoordinate {
    ex moving;      ///< the coordinate, or a multiple of that of joints that move together
    ex offset = 0;  ///< constant
    ex value() const { return moving + offset; }
    /// e^{i sign θ}
    Turn turn(int sign) const { return {{GiNaC::cos(offset), sign * GiNaC::sin(offset)}, sign * moving}; }
  };
  /// Declares it with the joint's range, its limit. Of joints that follow each other the first call declares what they
  /// share.
  JointCoordinate joint_angle(std::size_t joint, const std::string& name);
  JointCoordinate joint_way(std::size_t joint, const std::string& name);
  /// The symbol that stands for the joint's motion among inputs and outputs; `own` where it follows none.
  ex symbol_of(std::size_t joint, const ex& own) const;
  /// Of that symbol, where the joint's rate is declared.
  ex rate_of_symbol(std::size_t joint, const ex& own) const;
  /// All that move with the joint, itself included.
  std::vector<std::size_t> moving_with(std::size_t joint) const;
  /// The rate of a joint's motion.
  ex joint_rate(std::size_t joint, const std::string& prefix, symbolic::CoordinateKind kind, symbolic::Role role);

  /// No longer than 1, by equations that the caller adds. Its range is a little wider: the set is to reach no end of it.
  Vec vector(const std::string& name, const SourceLocation& where);
  /// With |w| = 1.
  Vec unit_vector(const std::string& name, const SourceLocation& where);

  /// e = 0, left out where it is 0 by its constants alone or known to follow. Throws ModelError where it is a constant that
  /// is not 0: `what` then cannot be assembled. Returns whether there is anything to say.
  bool equation(const ex& e, const std::string& note, const SourceLocation& where, const std::string& what = "the loop");
  /// A loop that closes where `loop` = 0. Where it has branches their equations take the place of these, and an angle tells
  /// which branch it is; velocities are those of `loop` all the same, so that the branches' meeting stays a singularity.
  /// Returns whether there is anything to say.
  bool closing(const std::vector<ex>& loop, const std::optional<LoopBranches>& branches, const std::string& note,
               const SourceLocation& where, const std::string& what);
  const BranchFinder& branches() const { return branches_; }
  bool has_branches() const { return !loops_.empty(); }
  /// Which of an output's components are coordinates: those asked for that are not constant. Throws ModelError where the
  /// output names a component, by `only` or by a range, that is.
  std::array<bool, 3> moving(const Output& output, const Vec& value) const;
  void at_least_zero(const ex& e, const std::string& note, const SourceLocation& where);
  /// The difference of two angles is 0.
  void no_turn(const Turn& difference, const SourceLocation& where) {
    if (equation(difference.sine(), "angle", where)) at_least_zero(difference.cosine(), "choice of angle", where);
  }

  ex rate(const std::string& name, symbolic::CoordinateKind kind, symbolic::Role role, const SourceLocation& where);
  /// Left out where it is 0 or known to follow.
  void velocity(const ex& e, const std::string& note, const SourceLocation& where);
  /// The derivative of all equations so far, loops as they are without branches, with a rate for each coordinate.
  void velocity_of_equations();

  // What a solution means, and how it is drawn.
  struct LinkPose {
    Vec origin;
    Mat axes;  ///< R
  };
  void pose(const LinkPose& pose) { poses_.push_back(pose); }
  void joint_value(const std::string& joint, const ex& value) { values_.push_back({joint, value, {}}); }
  void joint_value(const std::string& joint, const ex& cosine, const ex& sine) { values_.push_back({joint, cosine, sine}); }
  /// Returns the point's name, `wanted` or one like it.
  std::string point(const std::string& wanted, const Vec& at, const std::optional<Vec>& velocity, std::size_t dimension);
  /// `body`: the link or rod that it is a part of; empty: none.
  void part(symbolic::DrawingPart::Kind kind, const std::vector<std::string>& points, const std::string& body = "",
            const Expression& radius = {}, const std::string& colour = "") {
    symbolic::DrawingPart& part = parts_.emplace_back();
    part.kind = kind;
    part.points = points;
    part.radius = radius;
    part.colour = colour;
    if (!body.empty()) part.name = identifier(body);
  }

  void input(const ex& coordinate) { inputs_.push_back(coordinate); }
  void output(const ex& coordinate) { outputs_.push_back(coordinate); }
  /// An output that is a joint's coordinate. Throws ModelError where it has none.
  void output_of_joint(const Output& output, const std::optional<ex>& coordinate);
  /// Makes coordinates of the components that move. Throws ModelError where none does, unless it `may_rest`.
  void output_components(const Output& output, const Vec& value, bool may_rest = false);

  /// The mechanism, with the robot's constants, and what its solutions mean.
  Assembly assembly() const;

 private:
  struct DraftCoordinate {
    std::string name;
    symbolic::CoordinateKind kind;
    std::optional<Range> range;
    bool auxiliary, unit;  ///< unit: the first of three that are a unit vector
    SourceLocation where;
    std::optional<Range> limit{};  ///< of the joint
    bool tells_branches = false;
  };
  struct DraftEquation {
    ex value;
    bool inequality;
    std::string note;
    SourceLocation where;
    bool of_branch = false;
  };
  /// Of what identities are made of.
  enum class Origin { unit_vector, equation, velocity };
  struct Numbered {
    Origin origin;
    std::size_t index;  ///< among those of its origin, from 0; inequalities do not count
  };
  struct DraftLeftOut {
    DraftEquation equation;
    std::vector<Numbered> from;
  };

  /// From now on e = 0 is known, where identities are sought.
  void know(const ex& e, Numbered number);
  /// Notes it where e = 0 is known to follow; then returns true.
  bool leaves_out(const DraftEquation& e);
  symbolic::LeftOut left_out(const DraftLeftOut& e, std::optional<Expression> value) const;

  JointCoordinate common(std::size_t joint, bool turns);
  std::optional<Range> common_range(const Couplings::Train& train) const;

  const Robot& robot_;
  Algebra& algebra_;
  const BranchFinder branches_;
  const Couplings couplings_;
  std::vector<std::optional<ex>> common_, rate_;  // of each train
  std::set<std::string> names_;
  std::vector<DraftCoordinate> coordinates_;
  std::vector<DraftEquation> equations_, velocity_;
  /// Of parallelograms whose branches are told apart: the angle's name and the number of branches.
  std::map<std::size_t, std::pair<std::string, std::size_t>> taken_apart_;
  std::vector<DraftEquation> loops_;                    // whose branches took their place
  std::map<ex, std::size_t, GiNaC::ex_is_less> known_;  // equations, as they are
  std::size_t equalities_ = 0, unit_vectors_ = 0;
  std::optional<Identities> identities_;  // of equations and velocity equations
  std::vector<Numbered> numbered_;        // as they are known to the identities
  std::vector<DraftLeftOut> left_out_;
  std::vector<symbolic::Rate> rates_;
  std::vector<ex> inputs_, outputs_;
  struct JointValue {
    std::string joint;
    ex value;  ///< or the cosine
    std::optional<ex> sine;
  };
  struct DraftPoint {
    std::string name;
    Vec at;
    std::optional<Vec> velocity;
    std::size_t dimension;
  };
  std::vector<LinkPose> poses_;
  std::vector<JointValue> values_;
  std::vector<DraftPoint> points_;
  std::vector<symbolic::DrawingPart> parts_;
};

/// The base of those who write equations of a robot's bodies into a draft.
class Drafter {
 public:
  Drafter(const Robot& robot, const Bodies& bodies, Algebra& algebra, Draft& draft)
      : robot_(robot), bodies_(bodies), algebra_(algebra), draft_(draft) {}

 protected:
  const Joint& joint(const BodyJoint& j) const { return robot_.joints[j.index]; }
  const Joint& joint(std::size_t in_bodies) const { return joint(bodies_.joints[in_bodies]); }
  /// In Bodies::joints.
  std::size_t number(const BodyJoint& j) const { return &j - bodies_.joints.data(); }
  std::size_t group(std::size_t body) const { return bodies_.group[body]; }
  const std::string& name_of(std::size_t body) const { return robot_.links[bodies_.link_of(body)].name; }

  /// Writes poses of links and values of joints, by which a solution is told. image(body, vector) and place(body, point) are
  /// in the world; angle(joint) is the cosine and sine of a revolute joint that has no coordinate.
  void report(const std::vector<std::optional<ex>>& coordinates, auto&& image, auto&& place, auto&& angle) {
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      const Placement& at = bodies_.placement[l];
      Mat axes = transpose(at.rotation);
      for (Vec& column : axes) column = image(bodies_.of_link[l], column);
      draft_.pose({place(bodies_.of_link[l], at.translation), transpose(axes)});
    }
    for (const BodyJoint& j : bodies_.joints)
      if (coordinates[j.index]) {
        draft_.joint_value(joint(j).name, *coordinates[j.index]);
      } else if (j.kind == JointKind::revolute) {
        const auto [cosine, sine] = angle(j);
        draft_.joint_value(joint(j).name, cosine, sine);
      }
  }

  const Robot& robot_;
  const Bodies& bodies_;
  Algebra& algebra_;
  Draft& draft_;
};

}  // namespace corank::kinematics
