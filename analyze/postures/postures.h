// All postures of a robot: the configurations in which some of its coordinates have given values, each proven to exist, and
// the proof that there are no others.
//
// Example: an arm of six joints whose tool has a given pose has up to 16. The other way round, the values of a parallel
// robot's motors leave some poses of its platform.
//
// A posture is an `isolated` box of an exhaustive search: exactly one configuration is in it. Where the search is complete,
// and leaves nothing else, there are no more.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/core/exact_number.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

/// Which coordinates have a value.
struct PostureQuestion {
  study::Question question;        ///< a robot, or a mechanism of equations; its set is ignored
  std::vector<std::string> given;  ///< coordinates
  bool orientation = false;        ///< and the orientation of a link in space
  std::string orientation_of{};    ///< the link; empty: the one that is an output
};

/// Rotation by a quaternion that is not 0, w + xi + yj + zk, of any length. Exact.
Rotation rotation_of(const std::array<ExactNumber, 4>& quaternion);

/// Of the coordinates of an output's position, those that there are among them.
std::array<std::string, 3> position_names(const kinematics::Output& output);

struct Posture {
  std::vector<CoordinateValue> values;  ///< of the robot's joints and coordinates; an angle in radians, within its range
  /// It is a configuration; false: it solves the equations, but is so near an end of a range that it may be beyond.
  bool proven = true;
};

/// A set of postures of larger dimension than 0.
struct PostureFamily {
  int dimension = 0;
  std::vector<CoordinateValue> values;  ///< hulls
  bool proven = false;                  ///< false: boxes that may hold such a set, or a double solution, or nothing
};

struct Postures {
  std::vector<Posture> found;  ///< sorted by the values
  std::vector<PostureFamily> families;
  bool complete = false;  ///< the search came to its end: all postures are in `found` or `families`
  std::string stopped;    ///< what ended it early; empty: nothing
  std::uint64_t processed = 0;
  double seconds = 0;

  int at_least() const;
  /// Nothing where there are families, or boxes of which nothing is proven.
  std::optional<int> at_most() const;
};

/// Made once for many values.
class PostureFinder {
 public:
  /// Throws ModelError where a name is unknown, the orientation's link is not clear, or the values leave more unknowns
  /// than equations.
  explicit PostureFinder(PostureQuestion question);
  ~PostureFinder();
  PostureFinder(PostureFinder&&) noexcept;

  /// `values`: of PostureQuestion::given, in its order. May be called by several threads at once. Throws ModelError where a
  /// value makes no sense.
  Postures find(const std::vector<symbolic::Expression>& values, const std::optional<Rotation>& orientation,
                solve::Control& control, int threads = 1) const;

  /// Of an arm of six joints at a whole pose, else a ModelError: the plain system whose solutions are its postures.
  /// `values` may name the robot's constants.
  symbolic::Mechanism equations(const std::vector<symbolic::Expression>& values, const Rotation& orientation) const;

  const PostureQuestion& question() const;
  /// How the equations are written: "six joints", "hand held" or "coordinates held".
  std::string way() const;
  /// Of the values of a posture.
  std::vector<std::string> names() const;
  bool is_angle(const std::string& name) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// A few lines for a terminal.
std::string to_table(const PostureFinder& finder, const Postures& postures);
/// {"model", "given": [names], "postures": [{name: {"lo", "hi"}}], "proven": [bool], "at_least", "at_most" (null: unknown),
/// "families": [{"dimension", "proven", "values"}], "complete", "stopped", "processed", "seconds"}.
std::string to_json(const PostureFinder& finder, const Postures& postures);

}  // namespace corank::analyze
