#include "corank/report/html/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corank/report/html/template_data.h"
#include "corank/report/pictures/box_payload.h"
#include "corank/report/pictures/set_look.h"
#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::report {
namespace {

using symbolic::Expression;
using Kind = Expression::Kind;

std::string operation(const Expression& e) {
  switch (e.kind()) {
    case Kind::sum: return "+";
    case Kind::product: return "*";
    case Kind::quotient: return "/";
    case Kind::power: return "^";
    case Kind::negation: return "-";
    default: return e.name();
  }
}

// An expression of a drawing: a number, where it has a value without coordinates; "name" for a coordinate; ["+", …],
// ["*", …], ["/", a, b], ["^", a, b], ["-", a], ["sin", a] …
Json tree(const Expression& e, const std::map<std::string, double>& constants) {
  if (const double x = evaluate(e, constants); !std::isnan(x)) return x;
  if (e.kind() == Kind::symbol) return e.name();
  Json node = {operation(e)};
  for (const Expression& operand : e.operands()) node.push_back(tree(operand, constants));
  return node;
}

std::string_view role(const symbolic::Mechanism& mechanism, const symbolic::Coordinate& c) {
  const symbolic::Role role = role_of(mechanism, c.name);
  return role == symbolic::Role::passive && c.auxiliary ? "auxiliary" : to_string(role);
}

Json bounds(const Interval& x) { return {x.lo(), x.hi()}; }

Json coordinates(const symbolic::Mechanism& mechanism, const System& system) {
  return each(mechanism.coordinates(), [&](const symbolic::Coordinate& c) {
    Json entry = {{"name", c.name}, {"label", label(c.name)}, {"role", role(mechanism, c)}};
    if (c.kind == symbolic::CoordinateKind::angle) {
      const auto angle = std::ranges::find_if(system.angles, [&](const Angle& a) { return a.name == c.name; });
      entry.update({{"cosine", angle->cosine}, {"sine", angle->sine}, {"range", bounds(angle->range)}});
    } else {
      const int i = system.find(c.name);
      entry.update({{"index", i}, {"range", bounds(system.variables[i].domain)}});
    }
    return entry;
  });
}

Json drawing(const symbolic::Mechanism& mechanism) {
  const symbolic::Drawing& d = mechanism.drawing();
  const std::map<std::string, double> constants = symbolic::constant_values(mechanism);
  const auto tree_of = [&](const Expression& e) { return tree(e, constants); };
  const auto point = [&](const symbolic::DrawingPoint& p) {
    Json entry = {{"name", p.name}, {"label", label(p.name)}, {"at", each(p.coordinates, tree_of)}};
    if (!p.velocity.empty()) entry["moves"] = each(p.velocity, tree_of);
    return entry;
  };
  const auto part = [&](const symbolic::DrawingPart& p) {
    Json entry = {{"kind", to_string(p.kind)},
                  {"points", each(p.points, [&](const std::string& name) { return d.find(name); })}};
    if (p.has_radius()) entry["radius"] = tree_of(p.radius);
    if (!p.colour.empty()) entry["colour"] = p.colour;
    return entry;
  };
  return {{"dimension", d.dimension()}, {"unit", d.unit}, {"points", each(d.points, point)}, {"parts", each(d.parts, part)}};
}

/// Each monomial: [coefficient, variable, power, function, variable, power, function …], function 0 x, 1 sin x, 2 cos x.
Json polynomials(const std::vector<Polynomial>& list) {
  return each(list, [](const Polynomial& polynomial) {
    return each(polynomial.monomials, [](const Monomial& m) {
      Json entry = {m.coefficient.enclose().mid()};
      for (const Factor& f : m.factors) entry.insert(entry.end(), {f.variable, f.power, static_cast<int>(f.function)});
      return entry;
    });
  });
}

/// What each component of ξ is multiplied by to be a rate.
Json kernel_scales(const result::Result& result, std::size_t columns) {
  Json scales = Json::array();
  for (std::size_t k = 0; k < columns; ++k)
    scales.push_back(k < result.options.kernel_scales.size()
                         ? ExactNumber::rational(result.options.kernel_scales[k]).enclose().mid()
                         : 1.0);
  return scales;
}

/// What is drawn has velocities in the mechanism's own rates.
bool moves(const symbolic::Mechanism& mechanism) {
  return std::ranges::any_of(mechanism.drawing().points, [](const auto& p) { return !p.velocity.empty(); });
}

/// The coordinates that the components of ξ belong to, or the mechanism's own rates, where ξ is a velocity (M ξ = 0) that
/// can be drawn.
Json kernel_columns(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation, const SetView& view) {
  Json columns = Json::array();
  const bool is_right = view.result.options.kernel == to_string(symbolic::KernelSide::right) || view.locked;
  if (!is_right || view.set->of_requirements) return columns;
  const bool given = derivation.velocity.given;
  if (given && !moves(mechanism)) return columns;
  for (const std::string& name : derivation.velocity.without(view.set->locked).columns)
    columns.push_back(given ? mechanism.find_rate(name) : mechanism.find_coordinate(name));
  return columns;
}

Json points(const result::Result& result) {
  return each(result.cover.points, [](const CoverBox& point) {
    return Json{{"verdict", to_string(point.verdict)}, {"bounds", each(point.box, bounds)}};
  });
}

/// Of each self-motion the drawn boxes that lie on it.
Json motions(const SetView& view) {
  Json list = Json::array();
  for (const SelfMotionRecord& motion : view.result.cover.self_motions)
    list.push_back({{"dimension", motion.dimension}, {"boxes", Json::array()}});
  const std::vector<CoverBox>& boxes = view.drawn();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (boxes[i].motion >= 0) list[boxes[i].motion]["boxes"].push_back(i);
  return list;
}

// Of the parts, and which part each box is of; nothing where these are too many, or boxes of several are drawn as one.
Json conditions(const SetView& view) {
  constexpr std::size_t kMostParts = 255;
  if (view.conditions.empty() || view.conditions.size() > kMostParts || !view.hulls.empty()) return {};
  return {{"of", byte_payload(view.drawn(), [](const CoverBox& b) { return b.part; })},
          {"equations", each(view.conditions, [](const std::vector<Polynomial>& list) { return polynomials(list); })}};
}

// The variables that no part has, and the boxes no sides for.
Json variables_left_out(const result::Result& result) {
  Json list = Json::array();
  for (int v = 0; v < result.configuration_size && !result.parts.empty(); ++v)
    if (std::ranges::none_of(result.parts,
                             [&](const result::Result& part) {
                               return std::ranges::find(part.variables, result.variables[v].name,
                                                        &result::ResultVariable::name) != part.variables.end();
                             }) &&
        std::ranges::all_of(result.cover.boxes,
                            [&](const CoverBox& box) { return box.box[v] == result.variables[v].domain; }))
      list.push_back(v);
  return list;
}

}  // namespace

Json set_of(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation, const SetView& view) {
  const result::Result& result = view.result;
  const Json columns = kernel_columns(mechanism, derivation, view);
  Json set = set_description(view);
  set.update({{"variables", each(result.variables, [](const auto& v) { return v.name; })},
              {"domains", each(result.variables, [](const auto& v) { return bounds(v.domain); })},
              {"configuration", result.configuration_size},
              {"angles", each(result.angles,
                              [](const Angle& a) {
                                return Json{a.cosine, a.sine};
                              })},
              {"leftOut", variables_left_out(result)},
              {"columns", columns},
              {"scales", kernel_scales(result, columns.size())},
              {"equations", polynomials(view.system.equations)},
              {"conditions", conditions(view)},
              {"kernel", view.locked && !columns.empty() ? polynomials(view.locked->entries) : Json()},
              {"points", points(result)},
              {"motions", motions(view)}});
  return set;
}

std::string script_safe(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) text.replace(at, 1, "\\u003c");
  return text;
}

Json label(const std::string& name) {
  const symbolic::DisplayName shown = symbolic::display_name(name);
  return {shown.base, shown.subscript};
}

Json verdict_names() {
  Json names = Json::array();
  for (int v = 0; v < kVerdicts; ++v) names.push_back(to_string(static_cast<Verdict>(v)));
  return names;
}

Json set_description(const SetView& view) {
  const Json locked = each(view.set->locked, [](symbolic::Role role) { return to_string(role); });
  const Cover& cover = view.result.cover;
  const std::vector<CoverBox>& boxes = view.drawn();
  const std::string types = cover.types.asked == 0 ? "" : byte_payload(boxes, [](const CoverBox& b) {
    return holds_a_solution(b) ? b.types.proven : TypeSet{};
  });
  const std::vector<std::string>& outputs = view.result.outputs;  // of a workspace boundary
  Json passage;
  if (!outputs.empty())
    passage = {{"of", byte_payload(boxes, [](const CoverBox& b) { return b.passage; })},
               {"outputs", outputs},
               {"sides", sides_payload(boxes, outputs.size())}};
  return {{"name", view.set->name},
          {"title", look(*view.set).member},
          {"singular", view.set->is_singular()},
          {"locked", locked},
          {"layer", look(*view.set).drawn.layer},
          {"dot", look(*view.set).drawn.dot},
          {"dimension", cover.dimension},
          {"sigma", cover.sigma.largest()},
          {"types", types},
          {"passage", passage},
          {"complete", cover.complete()},
          {"count", boxes.size()}};
}

std::string set_style() {
  std::string light, dark, classes;
  for (const symbolic::SetDefinition& set : symbolic::set_definitions()) {
    light += fmt::format("--set-{}: {}; ", set.name, look(set).drawn.paint.on_light);
    dark += fmt::format("--set-{}: {}; ", set.name, look(set).drawn.paint.on_dark);
    // C-space is seen through.
    classes +=
        fmt::format(".{0} {{ --set: var(--set-{0}); --swatch: color-mix(in srgb, var(--set-{0}) {1}%, transparent); }}\n",
                    set.name, set.is_cspace() ? 45 : 100);
  }
  return fmt::format(":root {{ {}}}\n:root[data-theme=\"dark\"] {{ {}}}\n{}", light, dark, classes);
}

std::string page_model_of(const symbolic::Mechanism& mechanism, Json sets) {
  const System cspace = algebrize(singularity_system(mechanism, symbolic::SingularitySet::cspace));
  Json model = {{"model", mechanism.name()},
                {"verdicts", verdict_names()},
                {"coordinates", coordinates(mechanism, cspace)},
                {"drawing", drawing(mechanism)},
                {"constraints", polynomials(cspace.equations)},
                {"sets", std::move(sets)}};
  for (const symbolic::Rate& rate : mechanism.rates()) model["rates"].push_back(rate.name);
  return script_safe(model.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string drawing_model(const symbolic::Mechanism& mechanism, const System& system) {
  const Json model = {{"model", mechanism.name()},
                      {"coordinates", coordinates(mechanism, system)},
                      {"drawing", drawing(mechanism)},
                      {"sets", Json::array()}};
  return script_safe(model.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string page_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<SetView>& views) {
  return page_model_of(mechanism, each(views, [&](const SetView& view) { return set_of(mechanism, derivation, view); }));
}

}  // namespace corank::report
