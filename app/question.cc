#include "corank/app/question.h"

#include <fmt/format.h>

#include <filesystem>

#include "corank/app/exit_status.h"
#include "corank/app/shared_options.h"
#include "corank/result/values/words.h"
#include "corank/study/model.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"

namespace corank::app {

std::vector<std::string> set_names(bool usual) {
  std::vector<std::string> names;
  for (const symbolic::SetDefinition& set : symbolic::set_definitions())
    if (!usual || set.is_usual()) names.emplace_back(set.name);
  return names;
}

void QuestionOptions::add_options(CLI::App& sub, const std::string& of_set, const std::string& of_requirements,
                                  bool boundary) {
  add_model(sub);
  std::vector<std::string> sets = set_names();
  if (!boundary) std::erase(sets, symbolic::to_string(symbolic::SingularitySet::boundary));
  sets.emplace_back(kNodes);
  sub.add_option("--set", set,
                 of_set +
                     ": all (cspace); the forward, inverse or C-space singularities; those that are forward and inverse at "
                     "once; " +
                     (boundary ? "the boundary of the workspace; " : "") +
                     "where a requirement reaches its limit; the singularities of one "
                     "type: redundant output (ro), "
                     "redundant passive motion (rpm), redundant input (ri), impossible input (ii), impossible output (io), "
                     "increased instantaneous mobility (iim); or the cusps or nodes (self-crossings) of the projection of "
                     "the forward singularities to the inputs, or of the inverse ones to the outputs. nodes: forward-nodes "
                     "or inverse-nodes, whichever "
                     "the mechanism can have; an error if it can have both or neither")
      ->check(CLI::IsMember(sets));
  sub.add_option(
         "--kernel", kernel,
         "A singular configuration is one at which a matrix M, a part of the Jacobian, has a kernel vector xi.\n"
         "right: solve M xi = 0; left: solve M^T xi = 0; none: solve the set in parts, each with an equation of\n"
         "its own in place of xi. Default: (1) none, if corank finds such parts, unless the set is points and M has\n"
         "fewer than ten rows (of an arm six); (2) otherwise left, if the set is ii or io, or M has more columns\n"
         "than rows; (3) otherwise right")
      ->check(CLI::IsMember({"right", "left", "none"}));
  add_corank(sub);
  if (boundary) add_outputs(sub);
  add_require(sub, of_requirements);
  add_definitions(sub);
}

void QuestionOptions::add_outputs(CLI::App& sub) {
  sub.add_option("--outputs", outputs,
                 "For --set boundary: the coordinates of the workspace, with commas, at most as many as the mobility;\n"
                 "default: the model's outputs")
      ->type_name("NAME[,NAME...]")
      ->delimiter(',');
}

void QuestionOptions::add_require(CLI::App& sub, const std::string& what_for) {
  add_option(sub, "--require TEXT", require,
             "What a configuration is to meet beside being one, such as 'amplification(outputs) <= 2' or\n"
             "'torque(theta2) <= 3 N m under force(x, y) <= 50 N' (doc/as_built.md); may be repeated. " +
                 what_for);
}

void QuestionOptions::add_model(CLI::App& sub) {
  sub.add_option("FILE", file, "The model: equations (.cuik), parts (.cuik with [LINKS], or .world) or URDF (.urdf)");
  add_option(sub, "--loops FILE.loops", loops,
             "Companion of a URDF file: the inputs, the outputs, and the joints that close loops")
      ->check(CLI::ExistingFile);
}

void QuestionOptions::add_corank(CLI::App& sub) {
  add_option(sub, "--corank C", corank,
             "Only those of these configurations at which the kernel of the matrix M has dimension C or more;\n"
             "default: 1, which gives all singularities")
      ->check(positive());
}

void QuestionOptions::add_definitions(CLI::App& sub) {
  add_option(sub, "-D NAME=EXPR", definitions, "Give a constant of the model another value; may be repeated");
}

std::string QuestionOptions::command_line(const std::string& subcommand) const {
  std::string text = "corank " + subcommand + " " + std::filesystem::path(file).filename().string();
  if (!loops.empty()) text += " --loops " + std::filesystem::path(loops).filename().string();
  for (const std::string& definition : definitions) text += " -D '" + definition + "'";
  if (corank != 1) text += fmt::format(" --corank {}", corank);
  for (const std::string& requirement : require) text += " --require '" + requirement + "'";
  return text;
}

study::Question load(const QuestionOptions& options, std::set<std::string>* said) {
  if (options.file.empty()) throw UsageError("FILE is required; corank --help tells more");
  std::vector<result::ConstantOverride> constants;
  for (const std::string& text : options.definitions) {
    auto [name, expression] = split_at_equals(text, "-D", "NAME=EXPR");
    constants.push_back({std::move(name), std::move(expression)});
  }
  std::optional<std::filesystem::path> loops;
  if (!options.loops.empty()) loops = options.loops;
  study::Model model = study::read_model(options.file, constants, loops);
  for (const std::string& notice : model.notices)
    if (!said || said->insert(notice).second) fmt::print(stderr, "{}: note: {}\n", options.file, result::printable(notice));
  if (!options.outputs.empty() && options.set != symbolic::definition(symbolic::SingularitySet::boundary).name)
    throw UsageError("--outputs: without effect; expected --set boundary beside it");
  result::put_in(options.outputs, model.mechanism);
  study::require(options.require, model);
  return {.model = std::move(model.mechanism),
          .kernel = symbolic::kernel_side_from_string(options.kernel),
          .corank = options.corank,
          .constants = std::move(constants),
          .assembly = std::move(model.assembly),
          .outputs = options.outputs,
          .in_parts = options.kernel == "none" ? std::optional(true) : std::nullopt};
}

std::optional<symbolic::SingularitySet> chosen_set(const QuestionOptions& question, const symbolic::Mechanism& mechanism) {
  const std::string of_requirements = symbolic::to_string(symbolic::SingularitySet::requirements);
  if (!question.require.empty() && question.set != of_requirements)
    throw UsageError("--require: without effect; expected --set " + of_requirements + " beside it");
  if (mechanism.is_plain_system()) {
    if (question.corank != 1) throw UsageError(fmt::format("{}: a plain system has no --corank", question.file));
    if (!question.kernel.empty()) throw UsageError(fmt::format("{}: a plain system has no --kernel", question.file));
    if (question.set.empty()) return std::nullopt;
    throw UsageError(fmt::format("{} names no inputs and outputs: a plain system has no --set", question.file));
  }
  if (question.set.empty())
    throw UsageError(fmt::format("{} is a mechanism: --set is required ({})", question.file, symbolic::names_of_sets()));
  if (question.set == kNodes) return symbolic::nodes_of(mechanism);
  const auto set = symbolic::singularity_set_from_string(question.set);
  if (!symbolic::definition(set).has_kernel() && (question.corank != 1 || !question.kernel.empty()))
    throw UsageError(fmt::format("--set {}: expected no --corank and no --kernel beside it", question.set));
  return set;
}

}  // namespace corank::app
