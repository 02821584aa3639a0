// Cuspidal robots: those that change their posture, at one pose, without meeting a singularity.
//
// An arm is cuspidal if two of its postures at one pose are joined by a motion without an inverse singularity; a parallel
// robot if two poses of its platform at one position of its motors are joined by one without a forward singularity
// (key Salunkhe2022). The proof that one is: the two postures, proven, and a tube between them
// (analyze/paths/path.h). For two kinds of arms a theorem says that they are not (kinematics/equations/six_joints.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/paths/path.h"
#include "corank/analyze/postures/postures.h"

namespace corank::analyze {

struct CuspidalOptions {
  /// Of which singularities; nothing: inverse for a robot without loops, else forward.
  std::optional<Avoid> of{};
  int poses = 20;            ///< that are tried, at random but always the same ones
  double path_seconds = 20;  ///< of one attempt to find a path
  int threads = 1;
  std::function<void(int poses, std::size_t pairs)> progress{};
};

struct Cuspidality {
  std::optional<bool> cuspidal;  ///< true, false: proven; nothing: open
  Avoid of = Avoid::inverse;
  std::vector<CoordinateValue> given;                 ///< points: the pose, or the motors' values
  std::optional<std::array<double, 4>> quaternion{};  ///< and the orientation, w, x, y, z, exactly
  std::vector<CoordinateValue> from, to;              ///< the two postures
  std::shared_ptr<PathFinder> finder;                 ///< of `path`
  std::optional<Path> path{};
  int poses = 0;              ///< that were tried
  std::size_t most = 0;       ///< postures of one of them
  std::size_t same_sign = 0;  ///< pairs of postures that no sign tells apart
  std::string reason;         ///< why it is not, or why it is open
  bool complete = false;      ///< not ended by a limit
  std::string stopped;        ///< what ended it, where it is not complete
  double seconds = 0;
};

/// Throws ModelError where the question makes no sense, as PathFinder and PostureFinder do.
Cuspidality cuspidality(const study::Question& question, const CuspidalOptions& options, solve::Control& control);

std::string to_text(const Cuspidality& c, const std::string& model);
/// {"model", "cuspidal": true, false or null, "of", "given": {name: value}, "quaternion" (null, or four numbers), "from",
/// "to" (null, or {name: {"lo", "hi"}}), "radius", "certificate" (null, or `file`), "poses", "most_postures", "same_sign",
/// "reason", "complete", "stopped", "seconds"}.
std::string to_json(const Cuspidality& c, const std::string& model, const std::string& file);

}  // namespace corank::analyze
