// The result of one run: the model, the question, the options and the cover that answers it. What a result file holds and a
// summary shows; a regular value.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/system.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::result {

/// corank's version, "0.1.0".
std::string version();

/// A variable of the solved system, without its exact domain.
struct ResultVariable {
  std::string name;
  VariableKind kind = VariableKind::length;
  Interval domain;  ///< search domain, enclosed
  /// Declared in [DUMMY VARS] or [CARTESIAN VARS], or of that kind: .sol files leave it out; .h5 files keep the kind only.
  bool auxiliary = false;
};

/// `-D NAME=EXPRESSION`.
struct ConstantOverride {
  std::string name, expression;
  friend bool operator==(const ConstantOverride&, const ConstantOverride&) = default;
};

/// The options of the run, as given.
struct RunOptions {
  std::string kernel;  ///< "right", "left"; empty where the set has no kernel
  Sigma sigma;         ///< the one used, also where it was the default
  std::vector<std::string>
      kernel_scales;                ///< of each kernel unknown, an exact number (symbolic::kernel_scales); none: all are 1
  double tolerance = 0;             ///< of the coefficients, likewise; relative, 0: exact
  int threads = 1;                  ///< 0: one for each core
  std::uint64_t max_boxes = 0;      ///< 0: no limit
  std::uint64_t max_solutions = 0;  ///< 0: all
  double time_limit = 0;            ///< seconds; 0: no limit
  std::vector<ConstantOverride> constants;
  int corank = 1;  ///< the set is that of kernels of this dimension at least; the number of kernel vectors
  bool passive_rates_eliminated = false;  ///< System::passive_rates_eliminated
  std::vector<std::string> outputs{};     ///< of a workspace boundary: in place of the model's; none: those
  friend bool operator==(const RunOptions&, const RunOptions&) = default;
};

/// What the ranges of the model's coordinates did to the search (result/values/sentences.h).
struct DomainNotes {
  struct End {
    std::string coordinate;
    bool reached = false;  ///< proven: the set has a point on an end of the range; else boxes touch one
  };
  struct Reason {
    std::string text;       ///< "upper end of x", "range of theta", "m.cuik:9", "half-space of xi"
    std::size_t boxes = 0;  ///< `boundary` boxes that are not shown to be inside of it
  };
  std::vector<int> found;  ///< variables without a declared range: their domain was found from the equations
  /// Declared ranges of lengths and limited angles beyond which the set may go on; of auxiliary ones, where it does.
  std::vector<End> ends;
  std::vector<Reason> boundary;
};

/// What a solution says of a robot from parts: in double precision, from the midpoint of its box.
struct RobotState {
  struct JointValue {
    std::string joint;
    double value = 0;  ///< an angle in radians, in (−π, π], or a length
  };
  struct LinkPose {
    std::string link;
    std::array<double, 3> position{};                 ///< of the link's frame in the ground's
    std::array<std::array<double, 3>, 3> rotation{};  ///< R, row by row: x ↦ R x + position
  };
  std::vector<JointValue> joints;
  std::vector<LinkPose> links;
};

/// Relative: of decimals that somebody rounded.
inline constexpr double kRounding = 1e-6;

struct Result {
  std::string version = result::version();  ///< of the corank that made it
  std::string model;                        ///< the mechanism's name, "dextar"
  std::string model_text;                   ///< the model file as read
  std::string set;                          ///< "cspace", "forward" …; "system" for a plain system
  std::string system_text;                  ///< the solved polynomial system in the model language, constants put in
  RunOptions options;
  std::vector<ResultVariable> variables;  ///< n, the order of the boxes' components
  std::vector<Angle> angles;
  int configuration_size = 0;  ///< this many variables, the first ones, describe the configuration
  int equations = 0, inequalities = 0;
  /// Where they come from, in the words of the model that the author wrote: "arm.cuik:12 (range of elbow)". None: not known.
  std::vector<std::string> inequality_sources;
  /// Where the set consists of parts, each of these is a result of its own, with the same model, options and configuration
  /// variables, but for those that it leaves out (symbolic/sets/set_parts.h); `part` says which one it is. The whole then
  /// has the boxes of all parts, in their order and in the configuration's variables alone, those left out with their
  /// ranges, and leaves what is proven of them to the parts (merge_parts).
  std::string part;
  std::string condition;  ///< of a part that is a factor's: "d1 - x = 0"; several as "d1 = 0, d2 = 0"
  /// Coordinates that take every value in their ranges, whatever those of the others are: the set is the product of these
  /// ranges with a set in the others, but for coordinates without a declared range, and dependent angles, which follow from
  /// all.
  std::vector<std::string> free_coordinates;
  std::vector<Result> parts;
  /// Of an empty set of a robot: what was found out about its C-space (result/values/sentences.h), one result or none. Its
  /// boxes, if any, are those about one configuration, or, where no such one was found, what the search had left.
  std::vector<Result> assembly;
  /// A hint, of an empty set: within kRounding of the coefficients that are no integers there are solutions.
  bool nearly_solved = false;
  std::vector<std::string> outputs;  ///< of a workspace boundary: in whose space CoverBox::side is
  /// What ended the run early, and where: "the time limit, in the stage exact points"; empty where it ran to its end. A
  /// cover may be complete all the same: then less is proven of it than could be.
  std::string stopped;
  /// From what the search can go on, as a checkpoint holds it (result/files/checkpoint.h); empty: nothing was kept.
  /// read_result() does not read it.
  std::string search;
  Cover cover;
  /// Where boxes are undecided along a set of degenerate solutions: the dimension of the kernel that the singular values in
  /// most of them suggest, where that is above options.corank; 0: nothing. Computed from the others by
  /// study::describe_corank(): a hint.
  int seems_of_corank = 0;
  DomainNotes domain;                ///< computed from the others by describe_domain(): result files do not hold it
  std::vector<RobotState> states;    ///< of each of the cover's points, where the model is a robot from parts; likewise
  std::vector<std::string> motions;  ///< each self-motion in words, computed by describe_motions(), likewise
};

/// Copies what a result keeps of a system: variables, angles, sizes, and its dimension to the cover.
void describe_system(const System& system, Result& result);

/// Do its boxes have sides for the coordinate?
bool has_coordinate(const Result& result, const std::string& name);
/// The free coordinates that the boxes have no sides for: each is solved for all of its values.
std::vector<std::string> left_out(const Result& part);
/// Of the set: that of its boxes, and what they leave out.
int dimension_of(const Result& result);

/// Fills in what the whole has of its parts, at least one: variables, angles, sizes, boxes and points, statistics.
void merge_parts(Result& whole);
/// Is that what the whole has? Older programs have left exact points to the parts.
bool is_made_of_parts(const Result& whole);

/// Puts the constants into a model. Throws symbolic::ModelError where an expression does not parse or the model has no such
/// constant.
void put_in(const std::vector<ConstantOverride>& constants, symbolic::Mechanism& model);

/// Makes these the model's outputs, where there are any. Throws symbolic::ModelError.
void put_in(const std::vector<std::string>& outputs, symbolic::Mechanism& model);

/// The model as the result had it: its own copy of the text, with the constants and outputs that were put in. Throws
/// symbolic::ModelError.
symbolic::Mechanism model_of(const Result& result);

}  // namespace corank::result
