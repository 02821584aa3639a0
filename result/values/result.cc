#include "corank/result/values/result.h"

#include <algorithm>

#include "corank/core/check.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::result {
namespace {

// Which of the part's variables each of the whole's is; −1: the part leaves it out.
std::vector<int> places(const Result& whole, const Result& part) {
  std::vector<int> list;
  for (const ResultVariable& v : whole.variables) {
    const auto at = std::ranges::find(part.variables, v.name, &ResultVariable::name);
    list.push_back(at == part.variables.end() ? -1 : static_cast<int>(at - part.variables.begin()));
  }
  return list;
}

// Its configuration alone: what is proven of it stays with the part. What that leaves out may be all that it can.
CoverBox of_whole(const CoverBox& box, const std::vector<int>& places, const Result& whole, int part) {
  CoverBox result;
  result.box.reserve(places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    const int own = places[v];
    result.box.push_back(own < 0 ? whole.variables[v].domain : box.box[own]);
    if (std::ranges::find(box.free, own) != box.free.end()) result.free.push_back(static_cast<int>(v));
  }
  // Over all values of what is left out, a point is a smooth piece.
  const bool is_point = box.verdict == Verdict::isolated || box.verdict == Verdict::exact;
  const bool leaves_out = std::ranges::find(places, -1) != places.end();
  result.verdict = is_point && leaves_out ? Verdict::regular : box.verdict;
  result.reason = box.reason;
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

std::vector<std::string> left_out(const Result& part) {
  std::vector<std::string> list = part.free_coordinates;
  std::erase_if(list, [&](const std::string& name) {
    return std::ranges::find(part.variables, name, &ResultVariable::name) != part.variables.end() ||
           std::ranges::find(part.angles, name, &Angle::name) != part.angles.end();
  });
  return list;
}

int dimension_of(const Result& result) { return result.cover.dimension + static_cast<int>(left_out(result).size()); }

void merge_parts(Result& whole) {
  CORANK_CHECK(!whole.parts.empty());
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
    const std::vector<int> from = places(whole, part);
    for (const CoverBox& box : part.cover.boxes) cover.boxes.push_back(of_whole(box, from, whole, static_cast<int>(i)));
    for (const CoverBox& box : part.cover.points) cover.points.push_back(of_whole(box, from, whole, static_cast<int>(i)));
    if (is_searched(part) || !some_searched) {
      cover.dimension = std::max(cover.dimension, dimension_of(part));
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
  whole.free_coordinates = whole.parts.front().free_coordinates;
  std::erase_if(whole.free_coordinates, [&](const std::string& name) {
    return std::ranges::any_of(whole.parts, [&](const Result& part) {
      return std::ranges::find(part.free_coordinates, name) == part.free_coordinates.end();
    });
  });
  if (cover.dimension > 0) cover.points.clear();
  whole.options.sigma = cover.sigma;
  whole.outputs = whole.parts.front().outputs;
  whole.cover = std::move(cover);
}

}  // namespace corank::result
