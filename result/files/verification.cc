#include "corank/result/files/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <sstream>

#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/symbolic/sets/velocity_blocks.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::result {
namespace {
using check::Failure;
using check::Report;
using check::Tally;

std::string without_comments(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    line.erase(std::min(line.find('%'), line.size()));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (!line.empty()) result += line + "\n";
  }
  return result;
}

// Decimals are not proven anew; but those of a point have to be in its box, up to a unit of their last digit.
std::vector<std::string> misplaced_decimals(const Result& result) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < std::min(result.cover.decimals.size(), result.cover.points.size()); ++i) {
    const std::vector<std::string>& decimals = result.cover.decimals[i];
    for (std::size_t v = 0; v < std::min(decimals.size(), result.cover.points[i].box.size()); ++v) {
      if (decimals[v].empty()) continue;  // nothing is said of it
      const std::size_t point = std::min(decimals[v].find('.'), decimals[v].size() - 1);
      const double value = std::strtod(decimals[v].c_str(), nullptr), size = std::fabs(value),
                   unit = std::pow(10.0, -static_cast<double>(decimals[v].size() - 1 - point)),
                   room = unit + 4 * std::numeric_limits<double>::epsilon() * size;
      const Interval& side = result.cover.points[i].box[v];
      if (value + room >= side.lo() && value - room <= side.hi()) continue;
      list.push_back(fmt::format("the decimals of point {} are not in its box", i + 1));
      break;
    }
  }
  return list;
}

bool is_about(const symbolic::SetPart& part, const Result& result) {
  const auto* limits = std::get_if<symbolic::BoundaryPart>(&part);
  return is_named(part, result.part) &&
         (!limits || limits->of_output || limits->has_multipliers != result.options.kernel.empty());
}

// The parts that these results are about, all or some of a set's. Of a boundary either those of today, or as older programs
// had them, each with its λ.
std::vector<symbolic::SetPart> parts_of(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set,
                                        std::span<const Result> results) {
  std::vector<symbolic::SetPart> parts = symbolic::set_parts(mechanism, set);
  for (symbolic::SetPart& part : parts)
    for (const Result& result : results)
      if (is_about(part, result) && has_outputs(mechanism, result)) symbolic::add_outputs(mechanism, part);
  const bool has_all = std::ranges::all_of(results, [&](const Result& result) {
    return std::ranges::any_of(parts, [&](const symbolic::SetPart& part) { return is_about(part, result); });
  });
  if (has_all || !symbolic::definition(set).of_parts) return parts;
  const std::vector<symbolic::BoundaryPart> former = symbolic::boundary_parts(mechanism);
  return {former.begin(), former.end()};
}

// The one of them that the result is about.
const symbolic::SetPart& part_among(const std::vector<symbolic::SetPart>& parts, const Result& result) {
  const auto own = std::ranges::find_if(parts, [&](const symbolic::SetPart& part) { return is_about(part, result); });
  if (own == parts.end()) throw ResultFileError("the result's model has no part '" + result.part + "'");
  return *own;
}

System compiled(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set, const symbolic::SetPart& part,
                const Result& result) {
  return symbolic::SetEquations(mechanism, set, part).compiled(result.options.kernel_scales);
}

void add(const Tally& t, Tally& sum) {
  sum.verified += t.verified;
  sum.failed += t.failed;
  sum.unchecked += t.unchecked;
}

// And where it was interrupted.
void add_failures(const Report& part, const std::string& of, Report& sum) {
  for (const Failure& f : part.failures) sum.failures.push_back({f.place, f.index, "(" + of + ") " + f.reason});
  if (part.interrupted && !sum.interrupted) sum.stage = part.stage;
  sum.interrupted = sum.interrupted || part.interrupted;
}

void add(const Report& part, const std::string& name, bool first, Report& sum) {
  for (std::size_t v = 0; v < part.boxes.size(); ++v) add(part.boxes[v], sum.boxes[v]);
  add(part.points, sum.points);
  add(part.exact_points, sum.exact_points);
  sum.points_without_claim += part.points_without_claim;
  sum.left_out += part.left_out;
  sum.proof.present = part.proof.present && (first || sum.proof.present);
  sum.proof.verified = part.proof.verified && (first || sum.proof.verified);
  sum.proof.open = part.proof.open || (!first && sum.proof.open);
  sum.proof.steps += part.proof.steps;
  sum.proof.leaves += part.proof.leaves;
  sum.proof.searched += part.proof.searched;
  add_failures(part, "part: " + name, sum);
}

// Compares what a result says of its system with the system that its model gives: names, kinds, domains, angles, sizes, the
// polynomials' text (comments aside) and the options.
std::vector<std::string> contradictions(const Result& result, const System& system) {
  std::vector<std::string> list;
  const auto check = [&list](bool good, const std::string& what) {
    if (!good) list.push_back(what + " not that of the model");
  };
  Result expected;
  describe_system(system, expected);
  bool variables = result.variables.size() == expected.variables.size();
  for (std::size_t i = 0; variables && i < expected.variables.size(); ++i) {
    const ResultVariable &a = result.variables[i], &b = expected.variables[i];
    variables = a.name == b.name && a.kind == b.kind;
    check(!variables || a.domain == b.domain, "the domain of " + b.name + " is");
  }
  check(variables, "the list of variables is");
  check(std::ranges::equal(result.angles, expected.angles,
                           [](const Angle& a, const Angle& b) {
                             return a.name == b.name && a.cosine == b.cosine && a.sine == b.sine && a.range == b.range;
                           }),
        "the list of angles is");
  check(result.configuration_size == expected.configuration_size, "the number of configuration variables is");
  check(result.equations == expected.equations, "the number of equations is");
  check(result.inequalities == expected.inequalities, "the number of inequalities is");
  check(without_comments(result.system_text) == without_comments(symbolic::to_cuik(system)), "the system is");
  if (result.options.sigma != result.cover.sigma) list.emplace_back("two different values of sigma");
  const double tolerance = kPartialTolerance * system.coefficient_tolerance;
  const bool square = system.equations.size() <= system.variables.size();
  if (!(result.cover.tolerance == tolerance || (!square && result.cover.tolerance == 0)))
    list.emplace_back("the tolerance is not that of the options");
  for (const std::string& misplaced : misplaced_decimals(result)) list.push_back(misplaced);
  return list;
}

// Where a result contradicts its parts or is not made of those that its model has; nothing where it is no set of parts.
// `expected`: those.
std::vector<std::string> contradictions_of_parts(const symbolic::Mechanism& model, const Result& result,
                                                 std::vector<symbolic::SetPart>& expected) {
  const bool is_boundary = symbolic::definition(result.set).of_parts;
  if (!is_boundary && result.parts.empty()) return {};
  const auto set = symbolic::singularity_set_from_string(result.set);
  const symbolic::SetDefinition& asked = symbolic::definition(set);
  if (!set || !(asked.has_kernel() || asked.is_cspace())) return {"the set has no parts"};
  expected = parts_of(model, *set, result.parts);
  const bool all = std::equal(expected.begin(), expected.end(), result.parts.begin(), result.parts.end(), is_about);
  if (!all || result.parts.empty()) return {"the parts are not those of the model's set"};
  std::vector<std::string> list;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Result& part = result.parts[i];
    if (is_boundary && part.outputs != model.outputs())
      list.push_back("(part: " + part.part + ") the outputs are not those of the model");
    if (part.set != result.set) return {"a part is of another set"};
    if (part.free_coordinates.empty()) continue;
    const std::vector<std::string> free =
        free_coordinates(model, compiled(model, *set, expected[i], part), true, joints(expected[i]));
    for (const std::string& name : part.free_coordinates)
      if (std::ranges::find(free, name) == free.end())
        list.push_back(fmt::format("(part: {}) {} is not free", part.part, name));
  }
  if (!is_made_of_parts(result)) list.emplace_back("the whole is not made of its parts");
  return list;
}

// Of the parts with a condition in place of the set's kernel vector; those of a boundary are together the part without
// limits.
void sample_parts(const symbolic::Mechanism& model, const Result& result, const std::vector<symbolic::SetPart>& all,
                  const std::vector<System>& systems, const check::Options& options, Verification& verification) {
  const auto set = *symbolic::singularity_set_from_string(result.set);
  std::vector<check::PartOfSet> parts;
  const auto is_at_limits = [](const symbolic::SetPart& part) {
    const auto* limits = std::get_if<symbolic::BoundaryPart>(&part);
    return limits && !limits->active.empty();
  };
  for (std::size_t i = 0; i < systems.size(); ++i)
    if (component_of(all[i]) != nullptr && !is_at_limits(all[i]))
      parts.push_back({result.parts[i].part, systems[i], result.parts[i].free_coordinates});
  if (parts.empty()) return;
  const auto* limits = std::get_if<symbolic::BoundaryPart>(&all.front());
  const symbolic::SetEquations whole =
      limits ? symbolic::SetEquations(model, set, symbolic::BoundaryPart{.active = {}, .idle = limits->idle})
             : symbolic::SetEquations(model, set);
  const System system = whole.compiled(whole.scales());
  Report report;
  report.interrupted = !check::finishes([&] {
    verification.samples = check::sample_parts(system, parts, options.seed, check::StopFlag(options.ended));
    for (const std::string& failure : verification.samples->failures)
      verification.report.failures.push_back({Failure::Place::cover, 0, failure});
  });
  report.stage = "samples of the parts";
  add_failures(report, "samples", verification.report);
}

Verification verify_parts(const Result& result, Verification verification, const check::Options& options) {
  const symbolic::Mechanism model = model_of(result);
  if (!model.toleranced().empty())
    verification.contradictions.emplace_back("it has parts, which are one robot's, but the model has tolerances");
  std::vector<symbolic::SetPart> expected;
  for (std::string& c : contradictions_of_parts(model, result, expected))
    verification.contradictions.push_back(std::move(c));
  const auto set = symbolic::singularity_set_from_string(result.set);
  std::vector<System> systems;
  for (std::size_t i = 0; verification.contradictions.empty() && i < result.parts.size(); ++i) {
    const Result& part = result.parts[i];
    System& system = systems.emplace_back(compiled(model, *set, expected[i], part));
    system.coefficient_tolerance = part.options.tolerance;
    for (const std::string& c : contradictions(part, system))
      verification.contradictions.push_back("(part: " + part.part + ") " + c);
    if (verification.contradictions.empty()) {
      const auto blocks = blocks_of(part);
      add(check::check(system, part.cover, options, blocks ? &*blocks : nullptr), part.part, i == 0, verification.report);
    }
    if (verification.report.interrupted) break;
  }
  if (verification.contradictions.empty() && !verification.report.interrupted)
    sample_parts(model, result, expected, systems, options, verification);
  return verification;
}

// Of an empty set: the sample, or the search of C-space.
void verify_assembly(const Result& result, const check::Options& options, Verification& verification) {
  if (result.assembly.empty() || !verification.contradictions.empty()) return;
  const Result& cspace = result.assembly.front();
  if (!result.cover.boxes.empty() || !symbolic::definition(cspace.set).is_cspace()) {
    verification.contradictions.emplace_back("it says something about C-space, but its set is not empty");
    return;
  }
  const System system = system_of(model_of(result), cspace);
  for (const std::string& c : contradictions(cspace, system)) verification.contradictions.push_back("(C-space) " + c);
  if (!verification.contradictions.empty()) return;
  check::Options whole = options;
  whole.sample = 0;
  const Report found = check::check(system, cspace.cover, whole);
  const std::optional<bool> claimed = assembled(cspace);
  if (found.verified() && claimed == std::optional(true)) verification.assembled = true;
  if (found.complete() && claimed == std::optional(false)) {
    verification.assembled = false;
    // The set's configurations are among those of C-space, in the same ranges.
    if (!verification.report.proof.present && verification.report.left_out == 0) verification.report.proof = found.proof;
  }
  add_failures(found, "C-space", verification.report);
}

Verification verify_set(const Result& result, const System& system, const check::Options& options) {
  Verification verification{contradictions(result, system), {}};
  if (!result.parts.empty() || symbolic::definition(result.set).of_parts)
    return verify_parts(result, std::move(verification), options);
  // Boxes of another system are not worth a check.
  if (!verification.contradictions.empty()) return verification;
  const auto blocks = blocks_of(result);
  verification.report = check::check(system, result.cover, options, blocks ? &*blocks : nullptr);
  return verification;
}

}  // namespace

symbolic::TrigonometricSystem equations_of(const symbolic::Mechanism& mechanism, symbolic::SingularitySet set,
                                           const RunOptions& options) {
  symbolic::SetEquations equations(mechanism, set, symbolic::kernel_side_from_string(options.kernel));
  if (options.passive_rates_eliminated) equations.eliminate_passive_rates();
  return equations.system(options.kernel_scales, options.corank);
}

System system_of(const Result& result) { return system_of(model_of(result), result); }

System system_of(const symbolic::Mechanism& mechanism, const Result& result) {
  const auto set = symbolic::singularity_set_from_string(result.set);
  if (mechanism.is_plain_system() ? result.set != symbolic::definition(std::nullopt).name : !set)
    throw ResultFileError("the result's model has no set '" + result.set + "'");
  const bool parts = set && (symbolic::definition(set).of_parts || !result.part.empty() || !result.parts.empty());
  System system =
      !parts ? symbolic::algebrize(set ? equations_of(mechanism, *set, result.options) : symbolic::plain_system(mechanism))
      : result.part.empty() ? symbolic::configurations(mechanism)
                            : compiled(mechanism, *set, part_of(mechanism, result), result);
  system.coefficient_tolerance = result.options.tolerance;
  if (parts) return system;
  try {
    system.validate();
  } catch (const std::invalid_argument& error) {
    throw ResultFileError(std::string("the result's system: ") + error.what());
  }
  return system;
}

bool has_outputs(const symbolic::Mechanism& mechanism, const Result& result) {
  return std::ranges::all_of(mechanism.outputs(), [&](const std::string& name) { return has_coordinate(result, name); });
}

std::vector<System> systems_of_parts(const symbolic::Mechanism& mechanism, const Result& result) {
  std::vector<System> systems;
  if (result.parts.empty()) return systems;
  const auto set = symbolic::singularity_set_from_string(result.set);
  if (!set) throw ResultFileError("the result's model has no set '" + result.set + "'");
  const std::vector<symbolic::SetPart> parts = parts_of(mechanism, *set, result.parts);
  for (const Result& part : result.parts) systems.push_back(compiled(mechanism, *set, part_among(parts, part), part));
  return systems;
}

symbolic::SetPart part_of(const symbolic::Mechanism& mechanism, const Result& result) {
  const auto set = symbolic::singularity_set_from_string(result.set);
  return part_among(set ? parts_of(mechanism, *set, std::span(&result, 1)) : std::vector<symbolic::SetPart>{}, result);
}

std::optional<VelocityBlocks> blocks_of(const Result& result) {
  const auto set = symbolic::singularity_set_from_string(result.set);
  if (result.cover.types.asked == 0 || !set) return std::nullopt;
  return symbolic::velocity_blocks(model_of(result), *set, symbolic::kernel_side_from_string(result.options.kernel),
                                   result.options.corank);
}

Verification verify(const Result& result, const check::Options& options) {
  return verify(result, system_of(result), options);
}

Verification verify(const Result& result, const System& system, const check::Options& options) {
  Verification verification = verify_set(result, system, options);
  verify_assembly(result, options, verification);
  return verification;
}

ReadResult read_to_show(const std::filesystem::path& path) {
  Result result = read_result(path);
  symbolic::Mechanism model = model_of(result);
  System system = system_of(model, result);
  std::vector<std::string> wrong = contradictions(result, system);
  std::vector<symbolic::SetPart> parts;
  for (std::string& c : contradictions_of_parts(model, result, parts)) wrong.push_back(std::move(c));
  if (!wrong.empty())
    throw ResultFileError(fmt::format("{}: contradicts the model in it: {}", path.string(), fmt::join(wrong, "; ")));
  describe_in_words(model, system, result);
  return {std::move(result), std::move(model), std::move(system)};
}

}  // namespace corank::result
