#include "corank/result/locus_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corank/core/exact_number.h"
#include "corank/result/tallies.h"
#include "corank/result/words.h"
#include "corank/symbolic/model_error.h"
#include "corank/symbolic/node_system.h"
#include "corank/symbolic/velocity_equation.h"

namespace corank::result {
namespace {

using symbolic::LocusPart;

struct Words {
  const char *locus, *modes, *locked;
};

Words words_of(const symbolic::SetDefinition& set) {
  return set.locked.front() == symbolic::Role::input ? Words{"forward", "assembly modes", "inputs"}
                                                     : Words{"inverse", "postures", "outputs"};
}

std::string cusps_text(const Words& words, std::size_t proven, std::size_t open, bool complete, bool none) {
  if (proven > 0) {
    return fmt::format("it is proven that around {} {} can change without {} {} singularity",
                       proven == 1 ? "this cusp" : fmt::format("these {} cusps", proven), words.modes,
                       *words.locus == 'i' ? "an" : "a", words.locus);
  }
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

// Boxes that are about a point: those on a self-motion, of which there is none in the list of points, are not.
std::size_t with_points(const Cover& cover) {
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

// Such a coordinate that is not among the locked ones: the theorem says nothing then. Its name, or "" where there is none.
std::string held_and_not_locked(const Result& result, symbolic::Role locked) {
  const std::vector<std::string> held = held_coordinates(result);
  if (held.empty()) return "";
  try {
    const symbolic::Mechanism model = model_of(result);
    for (const std::string& name : held)
      if (role_of(model, name) != locked) return name;
    return "";
  } catch (const symbolic::ModelError&) {  // one that was built in C++ has no text
    return held.front();
  }
}

}  // namespace

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
    if (const std::string held = held_and_not_locked(result, set.locked.front()); proven > 0 && !held.empty()) {
      text = fmt::format(
          "{0} of the equations of {1}s, with {2} held; it is proven that {3} a {1} only if no coordinate except {4} is "
          "held",
          counted(proven, "solution"), kind, held, proven == 1 ? "it is" : "each is", words.locked);
    }
    if (open > 0) text += fmt::format("; at {} this is open", counted(open, "more place"));
    if (along > 0)
      text += fmt::format("; in {} the equations hold, or may hold, along larger sets, about which nothing is said",
                          counted(along, "box"));
    if (!cover.complete() && proven + open > 0) text += "; what was not searched may hold more";
  } else {
    text = fmt::format("{}s along a set of dimension {}; what follows from them is not proven", kind, cover.dimension);
  }
  if (nodes) {
    text += fmt::format(
        "; pairs of configurations closer than {} were not searched for (a length counts in units of its typical size, an "
        "angle by its sine and cosine)",
        symbolic::kNodeDistance);
  }
  return text;
}

}  // namespace corank::result
