#include "corank/result/values/summary.h"

#include <nlohmann/json.hpp>

#include "corank/certify/algebraic_number.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::result {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const symbolic::TrigonometricSystem& system) {
  Json json{{"name", system.name}, {"unknowns", Json::array()}};
  const auto unknown = [&](const std::string& name, int lower, int upper) {
    json["unknowns"].push_back({{"name", name}, {"lower", std::to_string(lower)}, {"upper", std::to_string(upper)}});
  };
  for (const auto* names : {&system.kernel_unknowns, &system.second_unknowns})
    for (const std::string& name : *names) unknown(name, -1, 1);
  for (const auto& [name, lower, upper] : system.further_unknowns) unknown(name, lower, upper);
  const auto put = [&](const char* name, const std::vector<symbolic::TrigonometricSystem::Equation>& equations) {
    json[name] = Json::array();
    for (const auto& e : equations) json[name].push_back({{"relation", e.relation.text()}, {"source", e.source}});
  };
  put("equations", system.equations);
  put("inequalities", system.inequalities);
  put("implied", system.claimed);
  return json;
}

Json to_json(const symbolic::Coordinate& c) {
  Json json{{"name", c.name}, {"kind", c.kind == symbolic::CoordinateKind::angle ? "angle" : "length"}};
  json["lower"] = c.has_range ? Json(c.lower.text()) : Json();
  json["upper"] = c.has_range ? Json(c.upper.text()) : Json();
  return json;
}

Json to_json(const symbolic::VelocityEquation& velocity) {
  Json json{{"given", velocity.given}, {"columns", velocity.matrix.columns}, {"rows", Json::array()}};
  for (const auto& row : velocity.matrix.rows) {
    Json entries = Json::array();
    for (const symbolic::Expression& e : row) entries.push_back(e.text());
    json["rows"].push_back(std::move(entries));
  }
  return json;
}

Json ends(const Interval& x) { return {{"lo", x.lo()}, {"hi", x.hi()}}; }

// The coordinates of an exact point that have a short text.
Json exact_json(const Result& result, const ExactPoint& point) {
  Json json = Json::object();
  for (std::size_t v = 0; v < result.variables.size(); ++v)
    if (const auto text = exact_coordinate(point, static_cast<int>(v))) json[result.variables[v].name] = *text;
  return json;
}

// The same as kernel_text.
Json kernel_json(const Result& result) {
  const KernelTally tally = kernel_tally(result);
  if (tally.at_most.empty()) return Json();
  Json json = {{"at_most", Json::object()}, {"points", Json::array()}};
  for (const auto& [bound, n] : tally.at_most) json["at_most"][std::to_string(bound)] = n;
  for (const ExactPoint& point : result.cover.exact_points)
    if (point.corank > 1) {
      json["points"].push_back({{"dimension", point.corank}, {"exact", exact_json(result, point)}});
      if (result.cover.types.asked != 0) json["points"].back()["types"] = type_names(point.types.proven);
    }
  return json;
}

// The same as types_text.
Json types_json(const Cover& cover) {
  const TypeTally tally = type_tally(cover);
  if (tally.proven.empty()) return Json();
  Json json;
  for (const SingularityType type : kSingularityTypes) {
    const auto n = tally.proven.find(type);
    json[to_string(type)] = n == tally.proven.end() ? Json() : Json(n->second);
  }
  json["unproven"] = tally.unproven;
  return json;
}

Json passages_json(const Result& result) {
  const auto counts = passages(result.cover);
  Json json = Json::object();
  for (const Passage passage : {Passage::barrier, Passage::traversable, Passage::unproven})
    json[to_string(passage)] = counts[static_cast<std::size_t>(passage)];
  json["outputs"] = result.outputs;
  return json;
}

Json parts_json(const Result& result) {
  Json list = Json::array();
  for (const Result& part : result.parts) {
    Json entry = {{"part", part.part},
                  {"boxes", part.cover.boxes.size()},
                  {"dimension", dimension_of(part)},
                  {"complete", part.cover.complete()}};
    if (!part.condition.empty()) entry["condition"] = part.condition;
    entry["free_coordinates"] = part.free_coordinates;
    const auto counts = part.cover.counts();
    for (const Verdict verdict : kVerdictsInOrder)
      if (const std::size_t n = counts[static_cast<std::size_t>(verdict)]; n > 0) entry[to_string(verdict)] = n;
    if (!result.outputs.empty()) {
      entry["boundary"] = passages_json(part);
      entry["boundary"].erase("outputs");
    }
    entry["seconds"] = part.cover.statistics.seconds_total;
    list.push_back(std::move(entry));
  }
  return list;
}

Json sample_json(const Result& result) {
  const std::optional<Sample> found = sample(result);
  if (!found) return {};
  Json json = Json::object();
  for (const Value& v : values(*found->of, found->box, found->of->configuration_size)) json[v.name] = ends(v.value);
  return json;
}

void add_state(Json& entry, const RobotState& state) {
  entry["joints"] = Json::object();
  for (const auto& joint : state.joints) entry["joints"][joint.joint] = joint.value;
  entry["links"] = Json::object();
  for (const auto& link : state.links)
    entry["links"][link.link] = {{"position", link.position}, {"rotation", link.rotation}};
}

}  // namespace

std::string derivation_json(const symbolic::Mechanism& mechanism, const std::optional<std::string>& robot,
                            const std::vector<symbolic::LeftOut>& left_out, const std::string& set,
                            const std::vector<symbolic::TrigonometricSystem>& systems) {
  Json json{{"model", mechanism.name()}};
  json["robot"] = robot ? Json(*robot) : Json();
  json["constants"] = Json::object();
  for (const symbolic::Constant& c : mechanism.constants()) json["constants"][c.name] = c.value.text();
  json["coordinates"] = Json::array();
  for (const symbolic::Coordinate& c : mechanism.coordinates()) json["coordinates"].push_back(to_json(c));
  json["inputs"] = mechanism.inputs();
  json["outputs"] = mechanism.outputs();
  if (!systems.empty()) {
    const symbolic::Derivation derivation = symbolic::derive(mechanism);
    json["constraints"] = Json::array();
    for (const symbolic::Expression& phi : derivation.phi) json["constraints"].push_back(phi.text());
    json["velocity"] = to_json(derivation.velocity);
    json["left_out"] = Json::array();
    for (const symbolic::LeftOut& e : left_out)
      json["left_out"].push_back({{"relation", e.relation()},
                                  {"source", e.source()},
                                  {"follows_from", {{"constraints", e.equations}, {"velocity", e.rows}}}});
  }
  json["set"] = set;
  json["systems"] = Json::array();
  for (const symbolic::TrigonometricSystem& system : systems) json["systems"].push_back(to_json(system));
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const Result& result, const std::optional<Interval>& area) {
  const Cover& cover = result.cover;
  Json json;
  json["model"] = result.model;
  json["set"] = result.set;
  json["corank"] = result.options.kernel.empty() ? Json() : Json(result.options.corank);
  json["system"] = {{"variables", result.variables.size()},
                    {"equations", result.equations},
                    {"inequalities", result.inequalities},
                    {"dimension", cover.dimension}};
  Json constants = Json::object();
  for (const ConstantOverride& c : result.options.constants) constants[c.name] = c.expression;
  json["options"] = {{"kernel", result.options.kernel.empty() ? Json() : Json(result.options.kernel)},
                     {"sigma", result.options.sigma.largest()},
                     {"sigma_length", result.options.sigma.length},
                     {"sigma_angle", result.options.sigma.angle},
                     {"kernel_scales", result.options.kernel_scales},
                     {"passive_rates_eliminated", result.options.passive_rates_eliminated},
                     {"tolerance", result.options.tolerance},
                     {"threads", result.options.threads},
                     {"max_boxes", result.options.max_boxes},
                     {"max_solutions", result.options.max_solutions},
                     {"time_limit", result.options.time_limit},
                     {"constants", constants}};
  json["complete"] = cover.complete();
  const std::optional<bool> can_be_assembled = assembled(result);
  json["assembled"] = can_be_assembled ? Json(*can_be_assembled) : Json();
  json["sample"] = sample_json(result);
  json["nearly_solved"] = result.nearly_solved;
  json["stopped"] = result.stopped.empty() ? Json() : Json(result.stopped);
  json["boxes"]["processed"] = cover.statistics.processed;
  const auto counts = cover.counts();
  for (const Verdict verdict : kVerdictsInOrder)
    json["boxes"][to_string(verdict)] = counts[static_cast<std::size_t>(verdict)];
  json["parts_of_sheets"] = parts_of_sheets(result);
  json["undecided_reasons"] = Json::object();
  for (const auto& [reason, n] : undecided_reasons(cover)) json["undecided_reasons"][to_string(reason)] = n;
  json["observed_dimension"] = cover.observed_dimension > 0 ? Json(cover.observed_dimension) : Json();
  json["seems_of_corank"] = result.seems_of_corank > 0 ? Json(result.seems_of_corank) : Json();
  json["self_motions"] = Json::array();
  for (std::size_t k = 0; k < cover.self_motions.size(); ++k) {
    Json relations = Json::array();
    for (const Polynomial& f : cover.self_motions[k].relations) relations.push_back(relation_text(result, f));
    json["self_motions"].push_back({{"dimension", cover.self_motions[k].dimension},
                                    {"boxes", boxes_on(cover, k)},
                                    {"relations", relations},
                                    {"text", motion_sentence(result, k)}});
  }
  json["boundary_reasons"] = Json::array();
  for (const DomainNotes::Reason& reason : result.domain.boundary)
    json["boundary_reasons"].push_back({{"reason", reason.text}, {"boxes", reason.boxes}});
  json["range_ends"] = Json::array();
  for (const DomainNotes::End& end : result.domain.ends)
    json["range_ends"].push_back({{"variable", end.coordinate}, {"reached", end.reached}});
  json["ranges_found"] = Json::object();
  for (const int j : result.domain.found) {
    const ResultVariable& v = result.variables[j];
    json["ranges_found"][v.name] = ends(v.domain);
  }
  json["tolerances"] = Json::object();
  for (const ResultVariable& v : result.variables)
    if (v.kind == VariableKind::parameter) json["tolerances"][v.name] = ends(v.domain);
  json["points"] = nullptr;
  if (cover.dimension == 0) {
    json["points"] = Json::array();
    for (const CoverBox& point : cover.points) {
      Json entry = {{"values", Json::object()}, {"verdict", to_string(point.verdict)}};
      for (const Value& v : values(result, point, static_cast<int>(result.variables.size())))
        entry["values"][v.name] = ends(v.value);
      if (cover.types.asked != 0) {
        const bool known = holds_a_solution(point);
        entry["types"] = type_names(known ? point.types.proven : TypeSet{});
        entry["typed"] = known && point.types.settle(cover.types.of_set);
      }
      if (const ExactPoint* exact = exact_point(result, point)) entry["exact"] = exact_json(result, *exact);
      const std::size_t i = &point - cover.points.data();
      if (i < cover.decimals.size() && !cover.decimals[i].empty())
        for (std::size_t v = 0; v < result.variables.size(); ++v)
          entry["decimals"][result.variables[v].name] = cover.decimals[i][v];
      if (i < result.states.size()) add_state(entry, result.states[i]);
      json["points"].push_back(std::move(entry));
    }
  }
  const std::string meaning = locus_sentence(result);
  json["meaning"] = meaning.empty() ? Json() : Json(meaning);
  const auto distance = node_distance(result);
  json["node_distance"] = distance ? Json(*distance) : Json();
  json["kernel"] = kernel_json(result);
  if (!result.outputs.empty()) json["boundary"] = passages_json(result);
  if (area) json["area"] = ends(*area);
  json["free_coordinates"] = result.free_coordinates;
  if (!result.parts.empty()) json["parts"] = parts_json(result);
  json["types"] = types_json(cover);
  if (cover.types.left_out > 0) json["left_out"] = cover.types.left_out;
  json["seconds"] = {{"total", cover.statistics.seconds_total},
                     {"search", cover.statistics.seconds_search},
                     {"certify", cover.statistics.seconds_certify}};
  json["version"] = result.version;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::result
