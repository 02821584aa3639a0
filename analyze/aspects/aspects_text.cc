#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/clearance/json.h"
#include "corank/analyze/robots/robots_words.h"
#include "corank/certify/angle.h"
#include "corank/core/check.h"
#include "corank/result/values/claim_files.h"
#include "corank/result/values/words.h"

namespace corank::analyze {
namespace {

// With or without those that are defined by the others, and of no interest, such as vectors of a robot's links.
std::vector<CoordinateValue> values(const System& system, const Box& box, bool auxiliary = true) {
  std::vector<CoordinateValue> result;
  for (std::size_t j = 0; j < system.variables.size(); ++j)
    if (const Variable& v = system.variables[j]; v.kind == VariableKind::length && (auxiliary || !v.auxiliary))
      result.push_back({v.name, box[j]});
  for (const Angle& a : system.angles)
    result.push_back({a.name, certify::angle_enclosure(box[a.cosine], box[a.sine], a.range)});
  return result;
}

// "4; 2 within aspect 1, 2 within aspect 2", "not looked for; the aspects are not exact".
std::string cusps_line(const AspectCusps& cusps) {
  std::map<int, int> around;
  int open = 0;
  for (const AspectCusp& c : cusps.list) c.around ? ++around[*c.around] : ++open;
  const bool any = cusps.looked_for[0] || cusps.looked_for[1];
  std::string text = any ? std::to_string(cusps.list.size()) : "not searched for";
  for (std::size_t k = 0; k < 2; ++k)
    if (any && !cusps.looked_for[k])
      text += fmt::format(" {}; {} ones were not searched for", locus_name(1 - k), locus_name(k));
  const char* before = "; ";
  for (const auto& [aspect, count] : around) {
    text += fmt::format("{}{} within aspect {}", before, count, aspect + 1);
    before = ", ";
  }
  if (open > 0) text += fmt::format("{}{} in an aspect that is not known", before, open);
  for (std::size_t k = 0; k < 2; ++k)
    if (cusps.euler_characteristic && cusps.all[k])
      text += fmt::format("; the number of {} ones has the parity of the Euler characteristic {}, as it must", locus_name(k),
                          *cusps.euler_characteristic);
  for (const std::string& reason : cusps.reasons) text += "; " + reason;
  return text;
}

// The other aspects that share outputs with aspect k: of which this is proven, or not known.
std::vector<std::size_t> others(const Aspects& a, std::size_t k, std::optional<bool> shares) {
  std::vector<std::size_t> list;
  for (std::size_t other = 0; other < a.images->share[k].size(); ++other)
    if (other != k && a.images->share[k][other] == shares) list.push_back(other);
  return list;
}

// "; covers an area from 4.36 to 5.83, and shares outputs with 2, 3".
std::string area_words(const Aspects& a, std::size_t k) {
  if (!a.images || k >= a.images->areas.size()) return "";
  constexpr double kRoom = 1e-4;  // more than what the digits round
  const Interval& area = a.images->areas[k];
  std::string text = fmt::format("; covers an area from {:.5g} to {:.5g}", area.lo() * (1 - kRoom), area.hi() * (1 + kRoom));
  const std::vector<std::size_t> shared = others(a, k, true);
  const std::string numbers = result::joined(shared, [](std::size_t other) { return std::to_string(other + 1); });
  return shared.empty() ? text : text + ", shares outputs with " + numbers;
}

bool is_counted(const Pieces& p) { return p.at_most || p.at_least > 0; }

std::string bounds(const Pieces& p) {
  if (p.exact()) return std::to_string(p.at_least);
  if (!is_counted(p)) return fmt::format("not counted ({})", p.reason);
  return p.at_most ? fmt::format("from {} to {} ({})", p.at_least, *p.at_most, p.reason)
                   : fmt::format("at least {} ({})", p.at_least, p.reason);
}

}  // namespace

namespace {

void add_claims(PieceClaims& claims, const Pieces& pieces) {
  claims.at_least = pieces.at_least;
  claims.at_most = pieces.at_most;
  if (claims.at_most) claims.proof = pieces.proof;
  // Of pieces that are not known to differ there may be more.
  for (int i = 0; i < pieces.at_least; ++i)
    claims.members.push_back({pieces.representatives[i], pieces.free[i], pieces.signs[i]});
  for (const PieceMember& member : pieces.beside) {
    ++claims.at_least;
    if (claims.at_most && member.requirements < 0) ++*claims.at_most;
    claims.members.push_back(member);
  }
}

}  // namespace

result::PiecesFile to_file(const study::Question& question, const Aspects& a) {
  CORANK_CHECK(a.cover != nullptr);
  auto file = file_about<result::PiecesFile>(question);
  for (const AspectsPart& part : a.product_of) {
    result::SpacePieces& space = &part == &a.product_of.front() ? file : file.further.emplace_back();
    space.coordinates = part.coordinates;
    space.space = *part.cover;
    for (std::size_t k = 0; k < part.lists.size(); ++k) {
      space.lists[k].factors = part.factors[k];
      add_claims(space.lists[k], part.lists[k]);
    }
  }
  if (!a.product_of.empty()) return file;
  file.space = *a.cover;
  file.lists[0].factors = file.lists[1].factors = a.forward_factors;
  file.lists[2].factors = a.inverse_factors;
  for (const std::string& f : a.inverse_factors)
    if (std::ranges::find(a.forward_factors, f) == a.forward_factors.end()) file.lists[0].factors.push_back(f);
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::string& f : a.further_factors)
      if (std::ranges::find(file.lists[k].factors, f) == file.lists[k].factors.end()) file.lists[k].factors.push_back(f);
  const std::array<const Pieces*, 3> lists{&a.aspects, &a.assembly_modes, &a.working_modes};
  for (std::size_t k = 0; k < lists.size(); ++k) add_claims(file.lists[k], *lists[k]);
  const auto kept = std::min({a.determinant_signs.size(), file.lists[0].members.size(),
                              static_cast<std::size_t>(std::max(0, a.aspects.at_least))});  // then come those beside
  for (std::size_t i = 0; i < kept; ++i) file.lists[0].members[i].determinant_signs = a.determinant_signs[i];
  return file;
}

std::string summary(const Aspects& a) {
  const auto counted = [](const Pieces& p, const char* what) {
    if (!is_counted(p)) return fmt::format("{} {}", result::noun(2, what), bounds(p));
    return bounds(p) + " " + result::noun(p.exact() && p.at_least == 1 ? 1 : 2, what);
  };
  return fmt::format("{}, {}, {}.{}", counted(a.aspects, "aspect"), counted(a.assembly_modes, "assembly mode"),
                     counted(a.working_modes, "working mode"),
                     a.limits.empty() ? "" : fmt::format(" Strictly within {}.", fmt::join(a.limits, ", ")));
}

std::string to_text(const study::Question& question, const Aspects& a) {
  std::string text = question.model.name() + "\n";
  if (!a.reason.empty()) return text + "  not known: " + a.reason + "\n" + stopped_line(a.stopped);
  text += fmt::format("  aspects         {}\n  assembly modes  {}\n  working modes   {}\n", bounds(a.aspects),
                      bounds(a.assembly_modes), bounds(a.working_modes));
  if (a.robots) text += robots_text(*a.robots);
  for (const AspectsPart& part : a.product_of)
    text += fmt::format("  {} {}: {}\n", &part == &a.product_of.front() ? "a product of   " : "           and ",
                        fmt::join(part.coordinates, ", "), bounds(part.lists[0]));
  for (const std::string& r : a.required) text += fmt::format("  required        {}\n", r);
  if (!a.limits.empty()) text += fmt::format("  strictly within {}\n", fmt::join(a.limits, ", "));
  const auto zeros = [](const std::vector<std::string>& factors) {
    constexpr std::size_t kMostCharacters = 400;
    const auto equation = [](const std::string& f) {
      return f.size() <= kMostCharacters ? f + " = 0" : fmt::format("a factor of {} characters is 0", f.size());
    };
    return factors.empty() ? "nowhere" : "where " + result::joined(factors, equation, " or ");
  };
  text += fmt::format("  det L_y = 0 {}\n  det L_z = 0 {}\n", zeros(a.forward_factors), zeros(a.inverse_factors));
  if (a.cusps) text += fmt::format("  cusps           {}\n", cusps_line(*a.cusps));
  constexpr std::size_t kMostShown = 20;
  const std::size_t known = a.aspects.representatives.size();
  if (known > 0) text += "A configuration of each aspect:\n";
  if (a.product_of.empty() && a.aspects.at_most == 0 && a.aspects.cells == 0)
    text += "There is no configuration in the search domain.\n";
  for (std::size_t k = 0; k < std::min(known, kMostShown); ++k) {
    text += fmt::format("  {:>3}", k + 1);
    for (const CoordinateValue& v : values(a.system, a.aspects.representatives[k], false))
      text += fmt::format("  {} {:.4f}", v.name, v.value.mid());
    text += area_words(a, k) + "\n";
  }
  if (known > kMostShown) text += fmt::format("  and {} more: --json\n", known - kMostShown);
  return text + stopped_line(a.stopped);
}

std::string to_json(const study::Question& question, const Aspects& a) {
  const auto bounds = [&](const Pieces& p) { return Json{{"at_least", p.at_least}, {"at_most", or_null(p.at_most)}}; };
  const auto number = [](const Pieces& p) { return p.exact() ? Json(p.at_least) : Json(); };
  Json json;
  json["model"] = question.model.name();
  json["aspects"] = bounds(a.aspects);
  json["assembly_modes"] = number(a.assembly_modes);
  json["working_modes"] = number(a.working_modes);
  json["bounds"] = {{"assembly_modes", bounds(a.assembly_modes)}, {"working_modes", bounds(a.working_modes)}};
  for (const AspectsPart& part : a.product_of)
    json["product_of"].push_back({{"coordinates", part.coordinates}, {"aspects", bounds(part.lists[0])}});
  json["factors"] = {{"forward", a.forward_factors}, {"inverse", a.inverse_factors}};
  if (a.robots) json["robots"] = robots_json(*a.robots);
  json["require"] = a.required;
  json["limits"] = a.limits;
  json["representatives"] = Json::array();
  for (std::size_t k = 0; k < a.aspects.representatives.size(); ++k) {
    const Box& at = a.aspects.representatives[k];
    Json entry = {{"values", ends_of(values(a.system, at))}, {"signs", a.aspects.signs[k]}};
    const auto sign = [&](std::size_t d) {
      return a.determinant_signs[k][d] != 0 ? Json(a.determinant_signs[k][d]) : Json();
    };
    entry["det_L_y"] = sign(0);
    entry["det_L_z"] = sign(1);
    if (a.images && k < a.images->areas.size()) {
      entry["area"] = ends_of(a.images->areas[k]);
      entry["shares_outputs_with"] = others(a, k, true);
      entry["may_share_outputs_with"] = others(a, k, std::nullopt);
    }
    json["representatives"].push_back(entry);
  }
  json["cusps"] = nullptr;
  if (a.cusps) {
    if (a.cusps->looked_for[0] || a.cusps->looked_for[1]) json["cusps"] = Json::array();
    for (const AspectCusp& c : a.cusps->list) {
      json["cusps"].push_back({{"locus", locus_name(c.forward ? 0 : 1)},
                               {"values", ends_of(values(a.system, c.at))},
                               {"around", or_null(c.around)},
                               {"between", or_null(c.between)}});
    }
    json["cusps_of"] = Json::array();
    for (std::size_t k = 0; k < 2; ++k)
      if (a.cusps->looked_for[k]) json["cusps_of"].push_back(locus_name(k));
    json["cusps_not_known"] = a.cusps->reasons;
    json["euler_characteristic"] = or_null(a.cusps->euler_characteristic);
  }
  json["reason"] = !a.reason.empty() ? a.reason : a.aspects.reason;
  json["complete"] = a.stopped.empty();
  json["stopped"] = or_null(a.stopped);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
