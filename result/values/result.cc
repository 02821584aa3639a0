#include "corank/result/values/result.h"

#include <algorithm>

#include "corank/core/check.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::result {
namespace {

// Its configuration alone: what is proven of it stays with the part.
CoverBox of_whole(const CoverBox& box, std::size_t variables, int part) {
  CoverBox result;
  result.box.assign(box.box.begin(), box.box.begin() + static_cast<std::ptrdiff_t>(variables));
  result.verdict = box.verdict;
  result.reason = box.reason;
  for (const int v : box.free)
    if (v < static_cast<int>(variables)) result.free.push_back(v);
  result.passage = box.passage;
  result.side = box.side;
  result.part = part;
  return result;
}

}  // namespace

std::string version() { return CORANK_VERSION; }

void describe_system(const System& system, Result& result) {
  result.variables.clear();
  for (const Variable& v : system.variables)
    result.variables.push_back(
        {v.name, v.kind, v.domain, v.auxiliary || v.kind == VariableKind::auxiliary || v.is_parameter()});
  result.angles = system.angles;
  result.configuration_size = system.configuration_size;
  result.equations = static_cast<int>(system.equations.size());
  result.inequalities = static_cast<int>(system.inequalities.size());
}

void put_in(const std::vector<ConstantOverride>& constants, symbolic::Mechanism& model) {
  for (const auto& [name, expression] : constants) {
    const symbolic::Constant read = symbolic::parse_constant(name, expression, "-D " + name);
    model.set_constant(name, read.value, read.tolerance);
  }
}

void put_in(const std::vector<std::string>& outputs, symbolic::Mechanism& model) {
  if (outputs.empty()) return;
  std::vector<symbolic::Expression> symbols;
  for (const std::string& name : outputs) symbols.push_back(symbolic::Expression::symbol(name, {"--outputs", 0, 0}));
  model.replace_outputs(symbols, {"--outputs", 0, 0});
}

symbolic::Mechanism model_of(const Result& result) {
  symbolic::Mechanism model = symbolic::parse_model(result.model_text, result.model + ".cuik");
  put_in(result.options.constants, model);
  put_in(result.options.outputs, model);
  return model;
}

void merge_parts(Result& whole) {
  CORANK_CHECK(!whole.parts.empty());
  const std::size_t n = whole.variables.size();
  Cover cover;
  cover.sigma = {0, 0};
  cover.tolerance = whole.parts.front().cover.tolerance;
  whole.stopped.clear();
  whole.options = whole.parts.front().options;
  // A part that was never searched was perhaps not reduced, either: its dimension says nothing, unless there is no other.
  const auto is_searched = [](const Result& part) { return part.cover.statistics.processed > 0 || part.cover.complete(); };
  const bool some_searched = std::ranges::any_of(whole.parts, is_searched);
  for (std::size_t i = 0; i < whole.parts.size(); ++i) {
    const Result& part = whole.parts[i];
    CORANK_CHECK(part.variables.size() >= n);
    for (const CoverBox& box : part.cover.boxes) cover.boxes.push_back(of_whole(box, n, static_cast<int>(i)));
    for (const CoverBox& box : part.cover.points) cover.points.push_back(of_whole(box, n, static_cast<int>(i)));
    if (is_searched(part) || !some_searched) {
      cover.dimension = std::max(cover.dimension, part.cover.dimension);
      cover.sigma.length = std::max(cover.sigma.length, part.cover.sigma.length);
      cover.sigma.angle = std::max(cover.sigma.angle, part.cover.sigma.angle);
    }
    cover.observed_dimension = std::max(cover.observed_dimension, part.cover.observed_dimension);
    cover.wider_than_sigma += part.cover.wider_than_sigma;
    const Statistics& s = part.cover.statistics;
    cover.statistics.processed += s.processed;
    cover.statistics.newton_steps += s.newton_steps;
    cover.statistics.proofs_tried += s.proofs_tried;
    cover.statistics.seconds_total += s.seconds_total;
    cover.statistics.seconds_search += s.seconds_search;
    cover.statistics.seconds_certify += s.seconds_certify;
    if (whole.stopped.empty()) whole.stopped = part.stopped;
  }
  if (cover.dimension > 0) cover.points.clear();
  whole.options.sigma = cover.sigma;
  whole.outputs = whole.parts.front().outputs;
  whole.cover = std::move(cover);
}

}  // namespace corank::result
