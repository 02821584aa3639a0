#include "corank/result/derivation_json.h"

#include <nlohmann/json.hpp>

#include "corank/symbolic/velocity_equation.h"

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
  return json.dump(2);
}

}  // namespace corank::result
