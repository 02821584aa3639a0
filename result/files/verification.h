// What the independent checker found about a result, for people and for programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/check/checker.h"
#include "corank/check/part_samples.h"
#include "corank/result/values/result.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::result {

struct Verification {
  /// Where the file contradicts the model that it holds: variables, domains, equations, options.
  std::vector<std::string> contradictions;
  check::Report report;  ///< of a result of parts: those of all parts
  /// What assembled() says of an empty set and is confirmed: the sample, or that C-space is empty, which shows that the set
  /// is, too. Nothing where nothing is said, or it is not confirmed.
  std::optional<bool> assembled{};
  /// Of a set whose matrix decomposes into parts; nothing where the check did not come to it.
  std::optional<check::PartSamples> samples{};

  /// No contradiction, and every claim is confirmed.
  bool verified() const { return contradictions.empty() && report.verified(); }
  /// verified(), and that the boxes hold all solutions in the search domain is proven, too.
  bool complete() const { return contradictions.empty() && report.complete(); }
};

/// The equations of a set as the options of a result say: its kernel's side, scales, corank, passive rates.
symbolic::TrigonometricSystem equations_of(const symbolic::Mechanism& model, symbolic::SingularitySet set,
                                           const RunOptions& options);
/// The system that a result's model and options give; of one that consists of parts symbolic::configurations(). Throws
/// ModelError where the model is none, ResultFileError where it has no such set.
System system_of(const Result& result);
/// The same for its model, model_of(result), made before.
System system_of(const symbolic::Mechanism& model, const Result& result);

/// Do its boxes have sides for all of the model's outputs?
bool has_outputs(const symbolic::Mechanism& model, const Result& result);

/// Of each part of a result; none where it has no parts. Throws as system_of().
std::vector<System> systems_of_parts(const symbolic::Mechanism& model, const Result& result);

/// The part of its model's set that a result is about, with outputs where it has these. Throws ResultFileError where there
/// is none.
symbolic::SetPart part_of(const symbolic::Mechanism& model, const Result& result);

/// The blocks of L whose ranks a result's types speak of; nothing where it has no types.
std::optional<VelocityBlocks> blocks_of(const Result& result);

/// Checks a result against its model: contradictions, check::check. `system` is system_of(result).
Verification verify(const Result& result, const System& system, const check::Options& options = {});
Verification verify(const Result& result, const check::Options& options = {});

/// A result that was read, and what the model in it makes.
struct ReadResult {
  Result result;
  symbolic::Mechanism model;
  System system;
};
/// Reads a result that may be anybody's, and puts words beside it (describe_in_words). What it says of its variables has to
/// be so before a picture relies on it: throws ResultFileError where it contradicts the model in it.
ReadResult read_to_show(const std::filesystem::path& path);

/// A table of counts per verdict, the completeness proof, the first failures.
std::string to_table(const Verification& verification, const Result& result);

/// {"verified", "complete", "interrupted", "stage" (where it ended early), "not_in_sample" (boxes, of a sample),
/// "verdicts": {"regular": {"verified", "failed", "not_checkable"} …}, "points", "exact_points", "samples" (of a set in
/// parts): {"of_set", "of_parts"},
/// "completeness": {"proof", "verified", "open", "steps", "leaves", "searched"}, "contradictions",
/// "failures": [{"what", "number", "reason"}]}; numbers count from 1.
std::string to_json(const Verification& verification);
/// The same of a check that had no report when it was ended, in the stage: {"verified", "complete", "interrupted", "stage"}.
std::string ended_early_json(const std::string& stage);

}  // namespace corank::result
