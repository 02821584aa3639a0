#include "corank/result/values/sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "corank/certify/contact.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/exact_number.h"
#include "corank/core/rounding.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::result {
namespace {

bool is_proven_empty(const Result& result) { return result.cover.boxes.empty() && result.cover.complete(); }

// The result that speaks of C-space.
const Result& of_configurations(const Result& result) { return result.assembly.empty() ? result : result.assembly.front(); }

std::string sample_text(const Sample& sample) {
  constexpr int kDigits = 6;
  constexpr std::size_t kMost = 8;
  std::vector<std::string> texts;
  for (const Value& v : values(*sample.of, sample.box, sample.of->configuration_size)) {
    if (texts.size() == kMost) return fmt::format("{} … (all coordinates: --json)", fmt::join(texts, ", "));
    texts.push_back(fmt::format("{} = {:.{}g}", v.name, v.value.mid(), kDigits));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string unknown_text(const Result& result) {
  if (result.assembly.empty())
    return result.stopped.empty() ? "corank did not search for a configuration" : "stopped by " + result.stopped;
  const Result& search = result.assembly.front();
  if (!search.stopped.empty())
    return fmt::format("stopped by {}, after {} boxes", search.stopped, search.cover.statistics.processed);
  return "C-space is not proven to be empty, but no configuration is proven to exist";
}

using certify::Contact;

/// What a contact is with, in the model's own words.
struct Thing {
  std::string reason;  ///< "upper end of x", "range of theta", "m.cuik:9"
  std::string range;   ///< the coordinate whose declared range this is; empty where it is none
};

Thing inequality(const System& system, const Result& result, std::size_t index) {
  const std::string& own = system.inequalities[index].source;
  for (const Angle& angle : system.angles)
    if (own == "range of " + angle.name) return {own, angle.name};
  const auto& sources = result.inequality_sources;
  const std::string& source = sources.size() == system.inequalities.size() ? sources[index] : own;
  return {source.empty() ? fmt::format("inequality {}", index + 1) : source, ""};
}

Thing thing(const System& system, const Result& result, const Contact& contact) {
  const std::size_t index = contact.index;
  if (contact.with == Contact::With::inequality) return inequality(system, result, index);
  for (const Angle& angle : system.angles)
    if (contact.index == angle.cosine || contact.index == angle.sine) return {"range of " + angle.name, angle.name};
  const Variable& v = system.variables[index];
  const bool declared = contact.index < system.configuration_size && v.kind == VariableKind::length;
  return {(contact.with == Contact::With::lower_end ? "lower end of " : "upper end of ") + v.name, declared ? v.name : ""};
}

bool is_of(const System& system, const Result& result) {
  return result.variables.size() == system.variables.size() &&
         std::ranges::all_of(result.cover.boxes, [&](const CoverBox& b) { return b.box.size() == system.variables.size(); });
}

std::string sentence(const char* verb, const std::vector<std::string>& names) {
  const char* const s = names.size() == 1 ? "" : "s";
  return fmt::format("the set {} the end{} of the declared range{} of {}; nothing beyond was searched", verb, s, s,
                     fmt::join(names, ", "));
}

using symbolic::LocusPart;

struct Words {
  const char *locus, *modes, *locked;
};

Words words_of(const symbolic::SetDefinition& set) {
  return set.locked.front() == symbolic::Role::input ? Words{"forward", "assembly modes", "inputs"}
                                                     : Words{"inverse", "postures", "outputs"};
}

std::string cusps_text(const Words& words, std::size_t proven, std::size_t open, bool complete, bool none) {
  if (proven > 0)
    return fmt::format("it is proven that around {} {} can change without {} {} singularity",
                       proven == 1 ? "this cusp" : fmt::format("these {} cusps", proven), words.modes,
                       *words.locus == 'i' ? "an" : "a", words.locus);
  if (open > 0 || !none) return "no cusp is proven";
  if (!complete) return "no cusp was found in the part that was searched";
  return fmt::format("there is no cusp in the search domain; {} may still change without a singularity in another way",
                     words.modes);
}

std::string nodes_text(const Words& words, std::size_t proven, std::size_t open, bool complete, bool none) {
  const std::string crossing =
      fmt::format("two singular configurations with the same {}, whose images are proven to cross", words.locked);
  if (proven > 0) return counted(proven, "node") + ": " + crossing;
  if (open > 0 || !none) return "no node is proven";
  return complete ? "there is no node in the search domain" : "no node was found in the part that was searched";
}

// Boxes about the points in the list. Boxes on a self-motion, or along another larger set, have no point there.
std::size_t with_points(const Cover& cover) {
  if (cover.points.empty()) return 0;
  return how_many(cover.boxes, [](const CoverBox& b) { return b.motion < 0 && b.verdict != Verdict::pending; });
}

// Coordinates with a range of one value.
std::vector<std::string> held_coordinates(const Result& result) {
  std::vector<std::string> names;
  for (const Angle& a : result.angles)
    if (!(a.range.lo() < a.range.hi())) names.push_back(a.name);
  for (int v = 0; v < result.configuration_size; ++v) {
    const ResultVariable& variable = result.variables[v];
    const Interval& x = variable.domain;  // encloses the value
    if (variable.kind == VariableKind::length && x.hi() <= std::nextafter(std::nextafter(x.lo(), HUGE_VAL), HUGE_VAL))
      names.push_back(variable.name);
  }
  return names;
}

// Nothing: one that was built in C++ has no text.
std::optional<symbolic::Mechanism> readable_model(const Result& result) {
  try {
    return model_of(result);
  } catch (const symbolic::ModelError&) {
    return std::nullopt;
  }
}

// Such a coordinate that is not among the locked ones: the theorem says nothing then. Its name, or "" where there is none.
std::string held_and_not_locked(const Result& result, symbolic::Role locked) {
  const std::vector<std::string> held = held_coordinates(result);
  if (held.empty()) return "";
  const auto model = readable_model(result);
  if (!model) return held.front();
  for (const std::string& name : held)
    if (role_of(*model, name) != locked) return name;
  return "";
}

// Of a robot's equations: coordinates with ranges that do not end its workspace, where nothing else is said to limit it.
std::vector<std::string> ranges_without_limits(const Result& result) {
  std::vector<std::string> names;
  const auto model = readable_model(result);
  if (!model || !model->limits().empty()) return names;
  for (const symbolic::Coordinate& c : model->coordinates()) {
    const auto angle = std::ranges::find(result.angles, c.name, &Angle::name);
    const bool is_round = angle != result.angles.end() && angle->range.width() > 6.28;
    if (c.has_range && !c.auxiliary && !is_round && !is_fixed(c) && role_of(*model, c.name) != symbolic::Role::output)
      names.push_back(c.name);
  }
  return names;
}

}  // namespace

std::optional<Sample> sample(const Result& result) {
  if (result.set == symbolic::definition(std::nullopt).name) return std::nullopt;
  const Result& from = of_configurations(result);
  const auto found = std::ranges::find_if(from.cover.boxes, is_surely_within, &CoverBox::verdict);
  if (found == from.cover.boxes.end()) return std::nullopt;
  CoverBox box = *found;
  if (box.region >= 0)
    for (std::size_t j = 0; j < box.box.size(); ++j) box.box[j].intersect(from.cover.regions[box.region][j]);
  for (const int j : box.free) box.box[j] = box.box[j].mid();
  return Sample{&from, std::move(box)};
}

std::optional<bool> assembled(const Result& result) {
  if (sample(result)) return true;
  const Result& from = of_configurations(result);
  const bool of_cspace = !result.assembly.empty() || symbolic::definition(result.set).is_cspace();
  return of_cspace && is_proven_empty(from) ? std::optional(false) : std::nullopt;
}

std::vector<std::string> assembly_sentences(const Result& result) {
  std::vector<std::string> list;
  if (!is_proven_empty(result)) return list;
  if (result.set != symbolic::definition(std::nullopt).name) {
    const auto can = assembled(result);
    list.push_back(!can   ? "it is not known whether the robot can be assembled within its ranges: " + unknown_text(result)
                   : *can ? "the robot can be assembled within its ranges; this configuration is proven to exist: " +
                                sample_text(*sample(result))
                          : "the robot cannot be assembled within its ranges: it is proven that it has no configuration");
  }
  if (symbolic::definition(result.set).of_parts)
    if (const auto names = ranges_without_limits(result); !names.empty())
      list.push_back(fmt::format("no [LIMITS] are declared, so the workspace does not end at the {} of {}",
                                 noun(names.size(), "range"), listed(names)));
  if (result.nearly_solved)
    list.push_back(fmt::format(
        "there are solutions if the coefficients may vary by {0:g} of their size: equations that depend on each other "
        "contradict each other once their decimals are rounded; use --tolerance {0:g}, or write exact numbers such as "
        "sqrt(3)/2",
        kRounding));
  return list;
}

std::vector<std::string> free_coordinates(const symbolic::Mechanism& mechanism, const System& system, bool from_parts,
                                          const std::vector<std::string>& joints) {
  const auto is_value = [&](int v) {  // of the others, wherever they are
    const auto& list = mechanism.coordinates();
    const auto c = std::ranges::find(list, system.variables[v].name, &symbolic::Coordinate::name);
    return c != list.end() && c->kind == symbolic::CoordinateKind::length && (!c->has_range || (from_parts && c->auxiliary));
  };
  const UpwardRounding rounding;
  const std::vector<Polynomial>& equations = system.equations;
  std::vector<std::vector<int>> rows;
  for (const auto* list : {&equations, &system.inequalities})
    for (const Polynomial& f : *list) rows.push_back(certify::variables_of(f));
  std::vector<int> uses(system.variables.size(), 0);
  for (const std::vector<int>& row : rows)
    for (const int v : row) ++uses[v];
  for (bool any = true; std::exchange(any, false);)
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const auto says = [&](int v) { return uses[v] == 1 && is_value(v) && certify::solved_for(equations[i], v); };
      if (std::ranges::none_of(rows[i], says)) continue;
      for (const int v : std::exchange(rows[i], {})) --uses[v];
      any = true;
    }
  std::vector<std::string> result;
  for (const symbolic::Coordinate& c : mechanism.coordinates()) {
    if (!c.has_range || c.direction || c.auxiliary || symbolic::is_fixed(c)) continue;
    const auto angle = std::ranges::find(system.angles, c.name, &Angle::name);
    std::vector<int> own{system.find(c.name)};
    if (angle != system.angles.end()) own = {angle->cosine, angle->sine};
    if (own[0] < 0) {  // left out: free, or given by others
      if (std::ranges::find(joints, c.name) != joints.end()) result.push_back(c.name);
      continue;
    }
    if (system.variables[own[0]].lower == system.variables[own[0]].upper) continue;  // at its limit
    // An angle has its circle, and both may have their ranges.
    std::size_t left = 0;
    bool alone = true;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto is_own = [&](int v) { return std::ranges::find(own, v) != own.end(); };
      if (std::ranges::none_of(rows[i], is_own)) continue;
      const bool is_equation = i < equations.size();
      left += is_equation;
      alone = alone && std::ranges::all_of(rows[i], is_own) &&
              (is_equation || system.inequalities[i - equations.size()].source == "range of " + c.name);
    }
    if (alone && left == own.size() - 1) result.push_back(c.name);
  }
  return result;
}

std::string free_text(const Result& result) {
  return result.free_coordinates.empty() ? "" : ", for every " + listed(result.free_coordinates);
}

void describe_domain(const symbolic::Mechanism& mechanism, const System& system, Result& result) {
  result.domain = {};
  if (!is_of(system, result)) return;
  for (const symbolic::Coordinate& c : mechanism.coordinates())
    if (!c.has_range)
      if (const int j = system.find(c.name); j >= 0) result.domain.found.push_back(j);

  std::map<std::string, bool> ends;  // reached
  std::map<std::string, std::size_t> reasons;
  std::size_t others = 0;
  std::vector<std::string> of_box;
  const auto is_left_out = [&](const CoverBox& b, const std::string& coordinate) {
    return b.part >= 0 && !result.parts.empty() && !has_coordinate(result.parts[b.part], coordinate);
  };
  certify::visit_contacts(system, result.cover, [&](const CoverBox& b, const std::vector<Contact>& contacts) {
    of_box.clear();
    for (const Contact& contact : contacts) {
      const Thing with = thing(system, result, contact);
      if (!with.range.empty() && is_left_out(b, with.range)) continue;  // it has its whole range there
      if (!with.range.empty()) ends[with.range] = ends[with.range] || contact.reached;
      if (std::ranges::find(of_box, with.reason) == of_box.end()) of_box.push_back(with.reason);
    }
    if (b.verdict != Verdict::boundary) return;
    for (const std::string& reason : of_box) ++reasons[reason];
    if (of_box.empty()) ++others;
  });
  const auto is_limited = [&](const std::string& name) {
    return std::any_of(mechanism.limits().begin(), mechanism.limits().end(),
                       [&](const symbolic::Limit& limit) { return limit.coordinate == name; });
  };
  for (const symbolic::Coordinate& c : mechanism.coordinates()) {
    const auto end = ends.find(c.name);
    if (end == ends.end() || !c.has_range || is_limited(c.name)) continue;
    if (c.auxiliary && !end->second) continue;  // as a link's vector: the ends of its range are out of its reach
    result.domain.ends.push_back({c.name, end->second});
  }
  for (const auto& [reason, boxes] : reasons) result.domain.boundary.push_back({reason, boxes});
  if (others > 0) result.domain.boundary.push_back({"rounding", others});
  std::ranges::stable_sort(result.domain.boundary, [](const auto& a, const auto& b) { return a.boxes > b.boxes; });
}

std::vector<std::string> range_end_sentences(const DomainNotes& notes) {
  std::vector<std::string> sentences;
  for (const bool reached : {true, false}) {
    std::vector<std::string> names;
    for (const DomainNotes::End& end : notes.ends)
      if (end.reached == reached) names.push_back(end.coordinate);
    if (!names.empty()) sentences.push_back(sentence(reached ? "reaches" : "may reach", names));
  }
  return sentences;
}

std::optional<double> node_distance(const Result& result) {
  if (symbolic::definition(result.set).part != LocusPart::nodes) return std::nullopt;
  return ExactNumber::rational(symbolic::kNodeDistance).enclose().mid();
}

std::vector<const CoverBox*> proven_cusps(const Result& result) {
  const symbolic::SetDefinition& set = symbolic::definition(result.set);
  std::vector<const CoverBox*> list;
  if (set.part != LocusPart::cusps || result.cover.dimension != 0) return list;
  for (const CoverBox& point : result.cover.points)
    if (point.verdict == Verdict::isolated) list.push_back(&point);
  if (!list.empty() && !held_and_not_locked(result, set.locked.front()).empty()) list.clear();
  return list;
}

std::string locus_sentence(const Result& result) {
  const symbolic::SetDefinition& set = symbolic::definition(result.set);
  if (set.part == LocusPart::all) return "";
  const Words words = words_of(set);
  const bool nodes = set.part == LocusPart::nodes;
  const std::string kind = nodes ? "node" : "cusp";
  std::string text;
  const Cover& cover = result.cover;
  if (cover.dimension == 0 || cover.boxes.empty()) {
    const std::size_t proven = how_many(cover.points, [](const CoverBox& p) { return p.verdict == Verdict::isolated; });
    const std::size_t open = cover.points.size() - proven, along = cover.boxes.size() - with_points(cover);
    text = nodes ? nodes_text(words, proven, open, cover.complete(), along == 0)
                 : cusps_text(words, proven, open, cover.complete(), along == 0);
    if (const std::string held = held_and_not_locked(result, set.locked.front()); proven > 0 && !held.empty())
      text = fmt::format(
          "{0} of the equations of {1}s, with {2} held; it is proven that {3} a {1} only if no coordinate except {4} is "
          "held",
          counted(proven, "solution"), kind, held, proven == 1 ? "it is" : "each is", words.locked);
    if (open > 0) text += fmt::format("; at {} this is open", counted(open, "more place"));
    if (along > 0)
      text += fmt::format("; in {} the equations hold, or may hold, along larger sets, about which nothing is said",
                          counted(along, "box"));
    if (!cover.complete() && proven + open > 0) text += "; what was not searched may hold more";
  } else {
    text = fmt::format("{}s along a set of dimension {}; what follows from them is not proven", kind, cover.dimension);
  }
  if (nodes)
    text += fmt::format(
        "; pairs of configurations closer than {} were not searched for (a length counts in units of its typical size, an "
        "angle by its sine and cosine)",
        symbolic::kNodeDistance);
  return text;
}

}  // namespace corank::result
