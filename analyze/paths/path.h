// A path between two configurations without a singularity, proven from end to end; or the proof that there is none.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "corank/analyze/clearance/clearance.h"
#include "corank/core/requirement.h"
#include "corank/core/tube.h"

namespace corank::result {
struct PathFile;
}

namespace corank::analyze {

enum class Avoid { forward, inverse, both, requirements };  ///< requirements: the configurations where one is at its limit
const char* to_string(Avoid avoid);
std::optional<Avoid> avoid_from_string(const std::string& text);
/// "forward and inverse singularities", "limits of requirements".
std::string in_words(Avoid avoid);

struct PathOptions {
  Avoid avoid = Avoid::forward;
  double radius = 0;  ///< that the tube is to have where possible (Tube::radii)
  int threads = 1;
  std::uint64_t max_boxes = 400'000;  ///< of one cover
  double sampling_seconds = 20;       ///< of one attempt, where the dimension is high
  int factors_up_to =
      3;  ///< factors of the determinants are sought for C-spaces of such a dimension at most: it may take long
};

struct Path {
  enum class Status { path, separated, unknown };
  Status status = Status::unknown;
  std::string reason;        ///< what separates the ends, or why nothing is known
  std::string method;        ///< how the path was found: "direct", "graph", "sampling"
  std::optional<Tube> tube;  ///< of a path
  double length = 0;         ///< of the nodes' polyline: angles in radians, lengths in units of PathSpace::sizes; no claim
  double resolution = 0;     ///< the finest cover's edges; 0: none was made
  Box from, to;              ///< the ends, enclosed in the system's variables
  /// Where limits of requirements are avoided: do `from` and with it the whole path meet the requirements?
  std::optional<Standing> standing{};
  std::string stopped;  ///< what ended the search early; empty: nothing
  double seconds = 0;
};

const char* to_string(Path::Status status);

/// The values do not say which configuration is meant. what() is for people, and lists those there are.
class EndError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Answers questions about one space; covers made for one serve the next.
class PathFinder {
 public:
  /// Throws ModelError where the model has not the inputs or outputs that it takes.
  PathFinder(const study::Question& question, const PathOptions& options);
  ~PathFinder();

  const study::Question& question() const;
  const PathOptions& options() const;
  const System& system() const;  ///< C-space: the variables of boxes and tubes
  /// The matrices whose ranks the tubes keep, over the system's variables, and the ranks.
  const std::vector<PolynomialMatrix>& matrices() const;
  const std::vector<int>& ranks() const;

  /// The configurations with these values, each proven and isolated, enclosed, in a fixed order. As many coordinates as
  /// C-space has dimensions keep their exact values, the first that are given; of what these leave, the further ones choose
  /// those whose values are near (kNear). Throws ModelError for what is no coordinate or no value, EndError where the values
  /// leave a motion, or some configuration is not proven.
  std::vector<Box> ends(const std::vector<NamedValue>& values, solve::Control& control) const;
  /// The only one, or number `mode`, from 1. `option`: "--from", for messages. Throws as ends() does, and EndError where
  /// there is none, or are several and no mode is given.
  Box end(const std::vector<NamedValue>& values, int mode, const std::string& option, solve::Control& control) const;
  static constexpr double kNear = 0.01;

  /// Does the configuration in the box meet the requirements? open also where constants have tolerances.
  Standing standing(const Box& end) const;

  Path find(const Box& from, const Box& to, solve::Control& control);

  /// In the box: the signs that separate configurations, 0 where one is not proven.
  struct Sign {
    Avoid of;            ///< forward: det L_y, inverse: det L_z, requirements: det R
    std::string factor;  ///< of that determinant; empty: itself
    int sign;
  };
  std::vector<Sign> signs(const Box& box) const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

/// Values of the model's coordinates at each node, in doubles, angles without jumps; their names.
std::vector<std::vector<double>> node_values(const System& system, const Tube& tube, std::vector<std::string>& names);

/// The tube's size of lengths; nothing where the system has none.
std::optional<double> length_size(const System& system, const Tube& tube);
/// A few lines for a terminal.
std::string to_text(const PathFinder& finder, const Path& path);
/// doc/paths.md.
std::string to_json(const PathFinder& finder, const Path& path);
/// What is written of a path, for others to check. Requires path.tube.
result::PathFile to_file(const PathFinder& finder, const Path& path);
/// A line for each node: the coordinates, then the radius about the piece that follows.
std::string to_csv(const PathFinder& finder, const Path& path);

}  // namespace corank::analyze
