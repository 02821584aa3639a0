#include "corank/study/answer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/result/values/sentences.h"
#include "corank/solve/exactness/corank_system.h"
#include "corank/study/run_journal.h"
#include "corank/study/search_steps.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/sets/velocity_blocks.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::study {
namespace {

// Is there a condition, or nothing, in place of the set's kernel vector?
bool has_no_kernel(const symbolic::SetPart& part) {
  const auto* limits = std::get_if<symbolic::BoundaryPart>(&part);
  return component_of(part) || (limits && !limits->has_multipliers);
}

// The side that was taken where none was asked for.
std::string kernel_of(const Question& q) {
  if (!symbolic::definition(q.set).has_kernel() || (q.part && has_no_kernel(*q.part))) return "";
  if (q.part && std::holds_alternative<symbolic::RequirementPart>(*q.part)) return to_string(symbolic::KernelSide::right);
  return to_string(symbolic::kernel_question(q.model, *q.set, q.kernel).side);
}

// What a solution means for a robot, one for each point of a set of dimension 0: values of its joints, poses of its links.
void describe_states(const kinematics::Assembly& assembly, result::Result& result) {
  result.states.clear();
  const std::map<std::string, double> constants = symbolic::constant_values(assembly.mechanism);
  for (const CoverBox& point : result.cover.points) {
    std::map<std::string, double> values = constants;
    for (std::size_t v = 0; v < point.box.size(); ++v) values[result.variables[v].name] = point.box[v].mid();
    for (const Angle& angle : result.angles)
      values[angle.name] = std::atan2(point.box[angle.sine].mid(), point.box[angle.cosine].mid());
    result::RobotState& state = result.states.emplace_back();
    for (const auto& joint : assembly.joint_values) {
      const double value = symbolic::evaluate(joint.value, values);
      state.joints.push_back({joint.joint, joint.sine ? std::atan2(symbolic::evaluate(*joint.sine, values), value) : value});
    }
    for (const auto& pose : assembly.poses) {
      result::RobotState::LinkPose& link = state.links.emplace_back();
      link.link = pose.link;
      for (std::size_t i = 0; i < 3; ++i) {
        link.position[i] = symbolic::evaluate(pose.origin[i], values);
        for (std::size_t j = 0; j < 3; ++j) link.rotation[i][j] = symbolic::evaluate(pose.rotation[i][j], values);
      }
    }
  }
}

// The searches of a run. Each has its turns, so that one without an end leaves time to the others.
class Searches {
 public:
  Searches(const Options& options, solve::Control& control, RunJournal& journal, std::size_t number)
      : options_(options), control_(control), journal_(journal), searches_(number) {
    journal_.expect(number);
    const solve::Options& search = options.search;
    if (number > 1 && search.max_found == 0 && search.max_solutions == 0)  // which count what one search finds
      boxes_ = std::min((options.boxes_of_first_turns + number - 1) / number, kMostOfFirstTurn);
  }

  std::vector<result::Result> run(std::span<const Question> questions, std::span<const System> systems) {
    for (bool all = false; !all; boxes_ *= kGrowth) {
      all = true;
      for (std::size_t i = 0; i < searches_.size(); ++i)
        if (!searches_[i].result && !turn(i, questions[i], systems[i])) all = false;
    }
    std::vector<result::Result> results;
    for (Search& search : searches_) results.push_back(std::move(*search.result));
    return results;
  }

 private:
  static constexpr std::uint64_t kMostOfFirstTurn = 200'000, kGrowth = 4;
  struct Search {
    std::optional<Asked> asked;
    std::optional<result::Result> result;
  };

  bool turn(std::size_t i, const Question& question, const System& system) {
    auto& [asked, result] = searches_[i];
    if (!asked) asked = prepare(question, system, options_, control_);
    std::optional<solve::SearchState> state = journal_.begin(i, asked->prepared);
    count_states();
    std::optional<Cover> cover = solve::solve_turn(asked->prepared, control_, journal_, boxes_, std::move(state));
    if (!cover) return false;
    solve::settle(asked->prepared, asked->settling, *cover, control_);
    result = describe(question, system, options_, std::move(*cover), control_.ending());
    asked.reset();
    return true;
  }

  // Their memory; to make covers of them takes time.
  void count_states() {
    const auto now = static_cast<std::int64_t>(journal_.bytes_of_others());
    control_.keep(now - std::exchange(bytes_, now));
  }

  const Options& options_;
  solve::Control& control_;
  RunJournal& journal_;
  std::vector<Search> searches_;
  std::int64_t bytes_ = 0;
  std::uint64_t boxes_ = 0;  // of a turn; 0: as many as it takes
};

}  // namespace

void describe_corank(const System& system, result::Result& result) {
  constexpr double kSmall = 0.02;              // relative to the largest: boxes are a few hundredths of typical sizes wide
  constexpr std::size_t kMostLookedAt = 1000;  // more say the same
  result.seems_of_corank = 0;
  std::vector<const CoverBox*> boxes;
  for (const CoverBox& box : result.cover.boxes)
    if (box.verdict == Verdict::undecided && box.reason == Reason::degenerate_set) boxes.push_back(&box);
  const PolynomialMatrix matrix = certify::kernel_matrix(system);
  if (boxes.empty() || matrix.rows == 0) return;
  const std::size_t n = std::min(boxes.size(), kMostLookedAt);
  std::vector<std::size_t> of_corank(matrix.columns + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> x = midpoint(boxes[i * boxes.size() / n]->box);
    const std::vector<double> s = solve::singular_values(matrix, x);
    for (std::size_t c = 0; c < s.size() && s[s.size() - 1 - c] < kSmall * s[0]; ++c) ++of_corank[c + 1];
  }
  for (std::size_t c = 1; c < of_corank.size(); ++c)
    if (2 * of_corank[c] > n && static_cast<int>(c) > result.options.corank) result.seems_of_corank = static_cast<int>(c);
}

std::string stopped_words(const result::Result& result) {
  return "stopped by " + (result.stopped.empty() ? "a limit" : result.stopped);
}

result::Result answer(const Question& question, const Options& options) {
  options.search.validate();
  solve::Control control(solve::limits_of(options.search));
  return answer(systems_of(question, control), options, control);
}

void check_options(const solve::Options& options, const System& system) {
  options.validate(system);
  if (options.proof && system.coefficient_tolerance > 0)
    throw solve::OptionError("proof", "expected exact coefficients; a tolerance of 0 takes them as exact");
}

Asked prepare(const Question& question, const System& system, const Options& options, solve::Control& control,
              bool settled) {
  solve::Options searched = options.search;
  NodeSearch nodes;
  if (symbolic::definition(question.set).part == symbolic::LocusPart::nodes && !searched.proof && searched.roots.empty()) {
    nodes = node_search(question, system, searched, control);
    searched.roots = std::move(nodes.roots);
  }
  solve::Settling settling{settled ? labelling(question, system) : std::nullopt, options.digits, nodes.processed};
  return {solve::prepare(system, searched, control), std::move(settling)};
}

result::Result join(const std::vector<Question>& parts, std::vector<result::Result> results) {
  CORANK_CHECK(!parts.empty() && parts.size() == results.size());
  const Question& first = parts.front();
  if (!first.part) return std::move(results.front());
  result::Result whole;
  whole.model = first.model.name();
  whole.model_text = first.model.source_text();
  whole.set = symbolic::definition(first.set).name;
  const System common = symbolic::configurations(first.model);
  result::describe_system(common, whole);
  whole.system_text = symbolic::to_cuik(common);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    whole.parts.push_back(std::move(results[i]));
    whole.parts.back().part = text(*parts[i].part);
    if (const symbolic::Component* component = component_of(*parts[i].part))
      whole.parts.back().condition = component->relation();
  }
  result::merge_parts(whole);
  result::describe_in_words(first.model, common, whole);
  return whole;
}

result::Result answer(const Systems& systems, const Options& options, solve::Control& control, RunJournal* journal) {
  const auto& [parts, of_parts] = systems;
  for (const System& system : of_parts) check_options(options.search, system);
  CORANK_CHECK(!parts.empty() && parts.size() == of_parts.size());
  RunJournal none({}, {});
  result::Result result =
      join(parts, Searches(options, control, journal ? *journal : none, parts.size()).run(parts, of_parts));
  search_assembly(parts.front(), control, result);
  return result;
}

result::Result answer(const Question& question, const System& system, const Options& options, solve::Control& control,
                      RunJournal* journal) {
  RunJournal none({}, {});
  result::Result result =
      std::move(Searches(options, control, journal ? *journal : none, 1).run({&question, 1}, {&system, 1}).front());
  search_assembly(question, control, result);
  return result;
}

std::optional<solve::Labelling> labelling(const Question& q, const System& system) {
  if (!q.set || (q.part && !system.singular)) return std::nullopt;
  auto blocks = symbolic::velocity_blocks(q.model, *q.set, q.kernel, q.corank);
  if (!blocks) return std::nullopt;
  return solve::Labelling{std::move(*blocks), symbolic::definition(q.set).type};
}

result::Result describe(const Question& question, const System& system, const Options& options, Cover cover,
                        const std::optional<solve::Ending>& ending) {
  result::Result result;
  result.model = question.model.name();
  result.model_text = question.model.source_text();
  result.set = symbolic::definition(question.set).name;
  result.system_text = symbolic::to_cuik(system);
  result.cover = std::move(cover);
  if (ending) result.stopped = to_string(*ending);
  result::describe_system(system, result);
  result.free_coordinates =
      result::free_coordinates(question.model, system, question.assembly.has_value(),
                               question.part ? symbolic::joints(*question.part) : std::vector<std::string>());
  result::describe_in_words(question.model, system, result);
  const solve::Options& search = options.search;
  result.options = {kernel_of(question),          result.cover.sigma, system.kernel_scales,
                    system.coefficient_tolerance, search.threads,     search.max_boxes,
                    search.max_solutions,         search.time_limit,  question.constants};
  result.options.corank = system.kernel_vectors;
  result.options.outputs = question.outputs;
  if (question.part && std::holds_alternative<symbolic::BoundaryPart>(*question.part))
    result.outputs = question.model.outputs();
  result.options.passive_rates_eliminated = system.passive_rates_eliminated;
  describe_corank(system, result);
  const bool leaves_out = question.part && !symbolic::joints(*question.part).empty();
  if (question.assembly && !leaves_out) describe_states(*question.assembly, result);
  return result;
}

}  // namespace corank::study
