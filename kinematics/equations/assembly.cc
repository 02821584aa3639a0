#include "corank/kinematics/equations/assembly.h"

#include <algorithm>

#include "corank/kinematics/equations/drafting.h"
#include "corank/kinematics/loops/parallelograms.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::kinematics {
namespace {

// Where a body is depends on all that carry it: what is written of a chain grows with the square of its length.
constexpr std::size_t kMostMovingBodies = 500;

int count_mobility(const Bodies& bodies, Space space) {
  const int full = space == Space::spatial ? 6 : 3;
  int mobility = full * (static_cast<int>(bodies.size()) - 1);
  for (const BodyJoint& j : bodies.joints) {
    // A pin in a slot turns one way in the plane, a ball three ways in space.
    const int freedom = j.kind == JointKind::slot && space == Space::planar ? 2 : traits(j.kind).freedom;
    mobility -= is_rod(j.kind) ? 6 - freedom : std::max(0, full - freedom);
  }
  return mobility;
}

/// How a robot's loops are written.
struct Way {
  bool in_branches = true;  ///< those of parallelograms (loop_branches.h)
  bool seek_identities = false, deep = false;
};

int mobility_of_rates(const Assembly& assembly) {
  const symbolic::Mechanism& m = assembly.mechanism;
  return static_cast<int>(m.rates().size()) - static_cast<int>(m.velocity_equations().size());
}

/// As many velocity equations as its mobility asks for.
bool has_rates_for(const Assembly& assembly) {
  return assembly.mechanism.rates().empty() || mobility_of_rates(assembly) == assembly.mobility;
}

Assembly draft(const Robot& robot, Way way) {
  Algebra algebra(robot);
  const Bodies bodies = bodies_of(robot, algebra);
  if (bodies.size() - 1 > kMostMovingBodies)
    throw symbolic::ModelError({robot.file.empty() ? robot.name : robot.file, 0, 0},
                               "the robot has " + std::to_string(bodies.size() - 1) + " moving bodies",
                               "at most " + std::to_string(kMostMovingBodies) + ", whose equations can be written out");
  std::vector<Parallelogram> parallelograms;
  if (!robot.keeps_parallelograms) {
    const Algebra aside = algebra;  // a copy, since most of what is compared says nothing about the equations
    parallelograms = parallelograms_of(robot, bodies, aside);
  }
  Draft draft(robot, algebra, std::move(parallelograms), way.in_branches);
  if (way.seek_identities) draft.seek_identities();
  const auto normals = plane_of(bodies, algebra);
  Space space = Space::planar;
  if (normals) {
    draft_planar(robot, bodies, *normals, algebra, draft);
  } else {
    for (const Output& output : robot.outputs)
      if (output.turn)
        throw symbolic::ModelError(output.where,
                                   "the output '" + output.name + "' has a range of phi, but it turns in space",
                                   "`keeps R` after it, or ranges of joints");
    space = draft_spatial(robot, bodies, algebra, draft, way.deep) ? Space::spherical : Space::spatial;
  }
  Assembly assembly = draft.assembly();
  assembly.space = space;
  assembly.conditions = conditions_of(robot, bodies, algebra);
  assembly.mobility_by_joints = count_mobility(bodies, space) - static_cast<int>(robot.couplings.size());
  assembly.mobility = static_cast<int>(assembly.mechanism.coordinates().size());
  for (const symbolic::Constraint& c : assembly.mechanism.constraints())
    assembly.mobility -= c.relation.kind == symbolic::Relation::Kind::equal ? 1 : 0;
  if (!assembly.mechanism.constraints().empty() && has_rates_for(assembly))
    if (const auto redundancy = sampled_redundancy(symbolic::algebrize(symbolic::plain_system(assembly.mechanism))))
      assembly.mobility_by_rank = assembly.mobility + *redundancy;
  return assembly;
}

bool seems_redundant(const Assembly& assembly) { return assembly.mobility_by_rank.value_or(0) > assembly.mobility; }

long output_rates(const symbolic::Mechanism& mechanism) {
  return std::count_if(mechanism.rates().begin(), mechanism.rates().end(),
                       [](const symbolic::Rate& rate) { return rate.role == symbolic::Role::output; });
}

Assembly as_asked(const Robot& robot) {
  Assembly best = draft(robot, {});
  // Several parallelograms that share sides may make each other's loops redundant on some of their branches.
  bool in_branches =
      std::ranges::any_of(best.parallelograms, [](const Assembly::WrittenParallelogram& p) { return !p.angle.empty(); });
  if (in_branches && seems_redundant(best))
    if (Assembly whole = draft(robot, {.in_branches = false}); !seems_redundant(whole)) {
      best = std::move(whole);
      in_branches = false;
    }
  // Over-constrained, as it seems, or its velocities say more than its positions: other ways to write its loops may show
  // which equations follow from the others.
  for (const bool deep : {false, true}) {
    if (best.space == Space::planar || (has_rates_for(best) && !seems_redundant(best))) break;
    try {
      Assembly other = draft(robot, {in_branches, true, deep});
      if (has_rates_for(other) && (!has_rates_for(best) || other.mobility > best.mobility)) best = std::move(other);
    } catch (const symbolic::ModelError&) {  // this way cannot write the robot; the first one could
    }
  }
  return best;
}

/// Of a robot with fewer freedoms than a pose has, its position is asked for, in the orientation that is kept.
Assembly in_positions_or_poses(const Robot& robot) {
  Assembly whole = as_asked(robot);
  if (output_rates(whole.mechanism) <= whole.mobility) return whole;
  Robot in_positions = robot;
  for (Output& output : in_positions.outputs)
    if (output.kind == Output::Kind::pose && output.kept) output.kind = Output::Kind::position;
  Assembly positions = as_asked(in_positions);
  return output_rates(positions.mechanism) <= positions.mobility ? std::move(positions) : std::move(whole);
}

}  // namespace

const char* to_string(Space space) {
  return space == Space::planar ? "planar" : space == Space::spherical ? "spherical" : "spatial";
}

Assembly assemble(const Robot& robot) {
  if (!robot.missing.empty()) {
    const std::size_t more = robot.missing.size() - 1;
    throw symbolic::ModelError({robot.file.empty() ? robot.name : robot.file, 0, 0},
                               "part of the robot is missing: " + robot.missing.front() +
                                   (more > 0 ? ", and " + std::to_string(more) + " more" : ""),
                               "a complete robot, for questions about its motion");
  }
  robot.validate();
  const symbolic::GinacLock lock;
  const LegsInOnePiece legs = legs_in_one_piece(robot);
  Assembly assembly = in_positions_or_poses(legs.robot);
  if (!has_rates_for(assembly))
    throw symbolic::ModelError(
        {robot.file.empty() ? robot.name : robot.file, 0, 0},
        "the robot is over-constrained, and corank does not find which of its conditions follow from the others: its "
        "positions seem to have mobility " +
            std::to_string(assembly.mobility) + ", its velocities " + std::to_string(mobility_of_rates(assembly)),
        "joints that say nothing twice, such as a spherical one in place of a universal one, or the robot's equations");
  assembly.has_universal_rods =
      std::ranges::any_of(legs.robot.joints, [](const Joint& joint) { return joint.kind == JointKind::universal_rod; });
  assembly.robot = std::make_shared<const Robot>(robot);
  assembly.links = robot.links.size();
  assembly.conditions.insert(assembly.conditions.end(), legs.conditions.begin(), legs.conditions.end());
  return assembly;
}

}  // namespace corank::kinematics
