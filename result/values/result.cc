#include "corank/result/values/result.h"

#include <algorithm>
#include <utility>

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

bool leaves_out(const std::vector<int>& places) { return std::ranges::find(places, -1) != places.end(); }

// Its configuration alone: what is proven of it stays with the part, but for `labels`, and for the exact point, whose place
// in the whole `points` has. What that leaves out may be all that it can. Without its region, free variables say that
// there is a solution for every value of theirs.
CoverBox of_whole(const CoverBox& box, const std::vector<int>& places, const Result& whole, int part,
                  const std::vector<int>& points, bool labels) {
  CoverBox result;
  const bool in_part = !spans(whole.parts[part].cover, box);
  result.box.reserve(places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {
    const int own = places[v];
    result.box.push_back(own < 0 ? whole.variables[v].domain : box.box[own]);
    if (!in_part && std::ranges::find(box.free, own) != box.free.end()) result.free.push_back(static_cast<int>(v));
  }
  // Over all values of what is left out, a point is a smooth piece.
  const bool is_point = box.verdict == Verdict::isolated || box.verdict == Verdict::exact;
  result.verdict = is_point && leaves_out(places) ? Verdict::regular : box.verdict;
  if (box.point >= 0 && !points.empty()) result.point = points.at(box.point);
  result.reason = box.reason;
  result.passage = box.passage;
  result.side = box.side;
  if (labels) {
    result.types = box.types;
    result.kernel_at_most = box.kernel_at_most;
  }
  result.part = part;
  return result;
}

ExactPoint of_whole(const ExactPoint& point, const std::vector<int>& places, bool labels) {
  ExactPoint result{point.polynomial, point.lower, point.upper, {}};
  for (const int own : places) result.coordinates.push_back(point.coordinates.at(own));
  if (labels) {
    result.corank = point.corank;
    result.types = point.types;
  }
  return result;
}

// Where parts meet they have the same points.
int place_of(ExactPoint point, std::vector<ExactPoint>& points) {
  const auto same = std::ranges::find(points, point);
  const auto place = static_cast<int>(same - points.begin());
  if (same == points.end()) points.push_back(std::move(point));
  return place;
}

bool same_boxes(const std::vector<CoverBox>& merged, const std::vector<CoverBox>& stored) {
  return std::ranges::equal(merged, stored, [](const CoverBox& x, const CoverBox& y) {
    return x.box == y.box && x.verdict == y.verdict && x.passage == y.passage && x.side == y.side && x.part == y.part &&
           x.free == y.free && x.reason == y.reason && x.types == y.types && x.kernel_at_most == y.kernel_at_most &&
           (x.point == y.point || y.point < 0);
  });
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
  result.inequality_sources.clear();
  for (const Polynomial& f : system.inequalities) result.inequality_sources.push_back(f.source);
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

bool has_coordinate(const Result& result, const std::string& name) {
  return std::ranges::find(result.variables, name, &ResultVariable::name) != result.variables.end() ||
         std::ranges::find(result.angles, name, &Angle::name) != result.angles.end();
}

std::vector<std::string> left_out(const Result& part) {
  std::vector<std::string> list = part.free_coordinates;
  std::erase_if(list, [&](const std::string& name) { return has_coordinate(part, name); });
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
  const auto has_pieces = [&](const Result& part) {  // to cut: the sigma of others says nothing
    return is_searched(part) && part.cover.dimension > 0 && !part.cover.boxes.empty();
  };
  const bool some_pieces = std::ranges::any_of(whole.parts, has_pieces);
  const CoverTypes& types = whole.parts.front().cover.types;
  const bool labels =
      types.asked != 0 && std::ranges::all_of(whole.parts, [&](const Result& part) { return part.cover.types == types; });
  if (labels) cover.types = types;
  for (std::size_t i = 0; i < whole.parts.size(); ++i) {
    const Result& part = whole.parts[i];
    const std::vector<int> from = places(whole, part);
    std::vector<int> points;
    if (!leaves_out(from))
      for (const ExactPoint& point : part.cover.exact_points)
        points.push_back(place_of(of_whole(point, from, labels), cover.exact_points));
    for (const auto& [own, all] : {std::pair(&part.cover.boxes, &cover.boxes), {&part.cover.points, &cover.points}})
      for (const CoverBox& box : *own) all->push_back(of_whole(box, from, whole, static_cast<int>(i), points, labels));
    if (is_searched(part) || !some_searched) cover.dimension = std::max(cover.dimension, dimension_of(part));
    if (some_pieces ? has_pieces(part) : is_searched(part) || !some_searched) {
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

bool is_made_of_parts(const Result& whole) {
  Result merged = whole;
  merge_parts(merged);
  const Cover &made = merged.cover, &stored = whole.cover;
  return same_boxes(made.boxes, stored.boxes) && same_boxes(made.points, stored.points) &&
         (stored.exact_points.empty() || made.exact_points == stored.exact_points) && made.types == stored.types &&
         made.dimension == stored.dimension && merged.outputs == whole.outputs;
}

}  // namespace corank::result
