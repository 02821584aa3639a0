#include "corank/report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corank/report/drawing_tree.h"
#include "corank/report/set_look.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/display_name.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::report {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page's numbers are little-endian");

std::string_view role(const symbolic::Mechanism& mechanism, const symbolic::Coordinate& c) {
  const symbolic::Role role = role_of(mechanism, c.name);
  return role == symbolic::Role::passive && c.auxiliary ? "auxiliary" : to_string(role);
}

Json coordinates(const symbolic::Mechanism& mechanism, const System& system) {
  Json list = Json::array();
  for (const symbolic::Coordinate& c : mechanism.coordinates()) {
    const symbolic::DisplayName shown = symbolic::display_name(c.name);
    Json entry = {{"name", c.name}, {"label", {shown.base, shown.subscript}}, {"role", role(mechanism, c)}};
    if (c.kind == symbolic::CoordinateKind::angle) {
      const auto angle =
          std::find_if(system.angles.begin(), system.angles.end(), [&](const Angle& a) { return a.name == c.name; });
      entry["cosine"] = angle->cosine;
      entry["sine"] = angle->sine;
      entry["range"] = {angle->range.lo(), angle->range.hi()};
    } else {
      const int i = system.find(c.name);
      const Interval& domain = system.variables[static_cast<std::size_t>(i)].domain;
      entry["index"] = i;
      entry["range"] = {domain.lo(), domain.hi()};
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json drawing(const symbolic::Mechanism& mechanism) {
  const symbolic::Drawing& d = mechanism.drawing();
  Json json = {{"dimension", d.dimension()}, {"unit", d.unit}, {"points", Json::array()}, {"parts", Json::array()}};
  const ConstantValues constants = constant_values(mechanism);
  for (const symbolic::DrawingPoint& p : d.points) {
    Json at = Json::array();
    for (const symbolic::Expression& e : p.coordinates) at.push_back(Json::parse(drawing_tree(e, constants)));
    const symbolic::DisplayName shown = symbolic::display_name(p.name);
    json["points"].push_back({{"name", p.name}, {"label", {shown.base, shown.subscript}}, {"at", at}});
    for (const symbolic::Expression& e : p.velocity)
      json["points"].back()["moves"].push_back(Json::parse(drawing_tree(e, constants)));
  }
  for (const symbolic::DrawingPart& part : d.parts) {
    Json points = Json::array();
    for (const std::string& name : part.points) points.push_back(d.find(name));
    Json entry = {{"kind", to_string(part.kind)}, {"points", points}};
    if (part.has_radius()) entry["radius"] = Json::parse(drawing_tree(part.radius, constants));
    if (!part.colour.empty()) entry["colour"] = part.colour;
    json["parts"].push_back(std::move(entry));
  }
  return json;
}

/// Each monomial: [coefficient, variable, power, function, variable, power, function …], function 0 x, 1 sin x, 2 cos x.
Json polynomials(const std::vector<Polynomial>& list) {
  Json json = Json::array();
  for (const Polynomial& polynomial : list) {
    Json monomials = Json::array();
    for (const Monomial& m : polynomial.monomials) {
      Json entry = {m.coefficient.enclose().mid()};
      for (const Factor& f : m.factors) {
        entry.push_back(f.variable);
        entry.push_back(f.power);
        entry.push_back(static_cast<int>(f.function));
      }
      monomials.push_back(std::move(entry));
    }
    json.push_back(std::move(monomials));
  }
  return json;
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
  const auto& points = mechanism.drawing().points;
  return std::any_of(points.begin(), points.end(), [](const symbolic::DrawingPoint& p) { return !p.velocity.empty(); });
}

/// The coordinates that the components of ξ belong to, or the mechanism's own rates, where ξ is a velocity (M ξ = 0) that
/// can be drawn.
Json kernel_columns(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation, const SetView& view) {
  Json columns = Json::array();
  if (view.result.options.kernel != to_string(symbolic::KernelSide::right)) return columns;
  const bool given = derivation.velocity.given;
  if (given && !moves(mechanism)) return columns;
  for (const std::string& name : derivation.velocity.without(view.set->locked).columns)
    columns.push_back(given ? mechanism.find_rate(name) : mechanism.find_coordinate(name));
  return columns;
}

Json points(const result::Result& result) {
  Json list = Json::array();
  for (const CoverBox& point : result.cover.points) {
    Json bounds = Json::array();
    for (const Interval& side : point.box) bounds.push_back({side.lo(), side.hi()});
    list.push_back({{"verdict", to_string(point.verdict)}, {"bounds", bounds}});
  }
  return list;
}

/// Of each self-motion the boxes that lie on it.
Json motions(const Cover& cover) {
  Json list = Json::array();
  for (const SelfMotionRecord& motion : cover.self_motions)
    list.push_back({{"dimension", motion.dimension}, {"boxes", Json::array()}});
  for (std::size_t i = 0; i < cover.boxes.size(); ++i)
    if (cover.boxes[i].motion >= 0) list[static_cast<std::size_t>(cover.boxes[i].motion)]["boxes"].push_back(i);
  return list;
}

Json set_of(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation, const SetView& view) {
  const result::Result& result = view.result;
  Json names = Json::array(), domains = Json::array();
  for (const result::ResultVariable& v : result.variables) {
    names.push_back(v.name);
    domains.push_back({v.domain.lo(), v.domain.hi()});
  }
  const Json columns = kernel_columns(mechanism, derivation, view);
  Json set = Json::parse(set_description(view));
  set.update({{"variables", names},
              {"domains", domains},
              {"configuration", result.configuration_size},
              {"columns", columns},
              {"scales", kernel_scales(result, columns.size())},
              {"equations", polynomials(view.system.equations)},
              {"points", points(result)},
              {"motions", motions(result.cover)}});
  return set;
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kAlphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

namespace {
std::string base64_of(const std::vector<float>& numbers) {
  return base64({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(float)});
}
}  // namespace

float float_below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float float_above(double x) { return -float_below(-x); }

std::string box_payload(const result::Result& result) {
  std::vector<int> all(result.variables.size());
  std::iota(all.begin(), all.end(), 0);
  return box_payload(result, all);
}

std::string box_payload(const result::Result& result, std::span<const int> variables) {
  std::vector<float> numbers;
  numbers.reserve(result.cover.boxes.size() * variables.size() * 2);
  for (const CoverBox& b : result.cover.boxes) {
    for (const int v : variables) {
      const Interval& side = b.box[static_cast<std::size_t>(v)];
      numbers.push_back(float_below(side.lo()));
      numbers.push_back(float_above(side.hi()));
    }
  }
  return base64_of(numbers);
}

std::string script_safe(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) text.replace(at, 1, "\\u003c");
  return text;
}

std::string verdict_payload(const result::Result& result) {
  std::vector<std::uint8_t> bytes;
  for (const CoverBox& b : result.cover.boxes) bytes.push_back(static_cast<std::uint8_t>(b.verdict));
  return base64(bytes);
}

// Of each box the types that its solutions are proven to be of, as bits; nothing where none were asked for.
std::string types_payload(const Cover& cover) {
  if (cover.types.asked == 0) return "";
  std::vector<std::uint8_t> bytes;
  for (const CoverBox& b : cover.boxes) bytes.push_back(holds_a_solution(b) ? b.types.proven : TypeSet{});
  return base64(bytes);
}

// Of a workspace boundary: for each box whether the output can pass, and two floats for each output, where barriers keep it.
std::string passages_payload(const Cover& cover) {
  std::vector<std::uint8_t> bytes;
  for (const CoverBox& b : cover.boxes) bytes.push_back(static_cast<std::uint8_t>(b.passage));
  return base64(bytes);
}
std::string sides_payload(const Cover& cover, std::size_t outputs) {
  std::vector<float> numbers;
  for (const CoverBox& b : cover.boxes)
    for (std::size_t j = 0; j < outputs; ++j)
      numbers.push_back(b.passage == Passage::barrier && b.side.size() == outputs ? static_cast<float>(b.side[j]) : 0.0F);
  return base64_of(numbers);
}

std::string set_description(const SetView& view) {
  Json locked = Json::array();
  for (const symbolic::Role role : view.set->locked) locked.push_back(to_string(role));
  const Cover& cover = view.result.cover;
  const std::vector<std::string>& outputs = view.result.outputs;  // of a workspace boundary
  Json passage;
  if (!outputs.empty())
    passage = {{"of", passages_payload(cover)}, {"outputs", outputs}, {"sides", sides_payload(cover, outputs.size())}};
  return Json{{"name", view.set->name},
              {"title", look(*view.set).member},
              {"singular", view.set->is_singular()},
              {"locked", locked},
              {"layer", look(*view.set).layer},
              {"dot", look(*view.set).dot},
              {"dimension", cover.dimension},
              {"sigma", cover.sigma.largest()},
              {"types", types_payload(cover)},
              {"passage", passage},
              {"complete", cover.complete()},
              {"count", cover.boxes.size()}}
      .dump();
}

std::string set_style() {
  std::string light, dark, classes;
  for (const symbolic::SetDefinition& set : symbolic::set_definitions()) {
    light += fmt::format("--set-{}: {}; ", set.name, look(set).on_light);
    dark += fmt::format("--set-{}: {}; ", set.name, look(set).on_dark);
    // C-space is seen through.
    classes +=
        fmt::format(".{0} {{ --set: var(--set-{0}); --swatch: color-mix(in srgb, var(--set-{0}) {1}%, transparent); }}\n",
                    set.name, set.is_cspace() ? 45 : 100);
  }
  return fmt::format(":root {{ {}}}\n:root[data-theme=\"dark\"] {{ {}}}\n{}", light, dark, classes);
}

std::string page_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<SetView>& views) {
  const System cspace = algebrize(singularity_system(mechanism, symbolic::SingularitySet::cspace));
  Json verdicts = Json::array(), sets = Json::array();
  for (int v = 0; v < kVerdicts; ++v) verdicts.push_back(to_string(static_cast<Verdict>(v)));
  for (const SetView& view : views) sets.push_back(set_of(mechanism, derivation, view));
  Json model = {{"model", mechanism.name()},
                {"verdicts", verdicts},
                {"coordinates", coordinates(mechanism, cspace)},
                {"drawing", drawing(mechanism)},
                {"constraints", polynomials(cspace.equations)},
                {"sets", sets}};
  for (const symbolic::Rate& rate : mechanism.rates()) model["rates"].push_back(rate.name);
  return script_safe(model.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace corank::report
