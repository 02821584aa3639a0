#include "corank/kinematics/assembly.h"

#include "corank/kinematics/planar.h"
#include "corank/kinematics/spatial.h"
#include "corank/symbolic/ginac_lock.h"

namespace corank::kinematics {
namespace {

int freedom(JointKind kind) {
  switch (kind) {
    case JointKind::revolute:
    case JointKind::prismatic: return 1;
    case JointKind::cylindrical:
    case JointKind::universal: return 2;
    case JointKind::spherical:
    case JointKind::planar: return 3;
    case JointKind::distance: return 5;
    case JointKind::distance_variable: return 6;
    case JointKind::fixed: return 0;
  }
  return 0;
}

int count_mobility(const Bodies& bodies, bool is_planar) {
  const int space = is_planar ? 3 : 6;
  int mobility = space * (static_cast<int>(bodies.size()) - 1);
  for (const BodyJoint& j : bodies.joints) {
    const bool is_free_in_plane = is_planar && j.kind == JointKind::planar;
    const bool is_rod = j.kind == JointKind::distance || j.kind == JointKind::distance_variable;
    mobility -= is_free_in_plane ? 0 : is_rod ? 6 - freedom(j.kind) : space - freedom(j.kind);
  }
  return mobility;
}

}  // namespace

Assembly assemble(const Robot& robot) {
  const symbolic::GinacLock lock;
  Algebra algebra(robot);
  const Bodies bodies = bodies_of(robot, algebra);
  Draft draft(robot, algebra);
  const auto normals = plane_of(robot, bodies, algebra);
  if (normals) {
    draft_planar(robot, bodies, *normals, algebra, draft);
  } else {
    draft_spatial(robot, bodies, algebra, draft);
  }
  Assembly assembly{draft.mechanism(), normals.has_value(), 0, count_mobility(bodies, normals.has_value()), {}};
  assembly.mobility = static_cast<int>(assembly.mechanism.coordinates().size());
  for (const symbolic::Constraint& c : assembly.mechanism.constraints())
    assembly.mobility -= c.relation.kind == symbolic::Relation::Kind::equal ? 1 : 0;
  assembly.mobility_by_rank = sampled_mobility(assembly.mechanism);
  return assembly;
}

}  // namespace corank::kinematics
