#include "corank/report/family_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corank/report/page_words.h"

namespace corank::report {
namespace {

struct Totals {
  std::size_t covers = 0, complete = 0, boxes = 0, proven = 0, border = 0, partial = 0, undecided = 0, pending = 0;
  double finest = HUGE_VAL, coarsest = 0;
};

Totals totals_of(const std::vector<FamilyMember>& members) {
  Totals t;
  for (const FamilyMember& member : members) {
    for (const SetView& view : member.sets) {
      const Cover& cover = view.result.cover;
      ++t.covers;
      t.complete += cover.complete() ? 1 : 0;
      t.boxes += cover.boxes.size();
      t.proven += cover.count(Verdict::regular) + cover.count(Verdict::isolated) + cover.count(Verdict::exact);
      t.border += cover.count(Verdict::boundary);
      t.partial += cover.count(Verdict::partial);
      t.undecided += cover.count(Verdict::undecided);
      t.pending += cover.count(Verdict::pending);
      t.finest = std::min(t.finest, cover.sigma.largest());
      t.coarsest = std::max(t.coarsest, cover.sigma.largest());
    }
  }
  return t;
}

bool has_surface(const FamilyMember& member) {
  return std::any_of(member.sets.begin(), member.sets.end(),
                     [](const SetView& view) { return view.set->is_cspace() && view.result.cover.dimension > 1; });
}

}  // namespace

FamilyWords family_words(const std::vector<FamilyMember>& members, const FamilyOptions& options) {
  const Totals t = totals_of(members);
  FamilyWords words;
  words.proven.push_back(
      fmt::format("Each picture shows one mechanism, whose {} has exactly the value under the picture.", options.constant));
  if (t.complete == t.covers) {
    words.proven.push_back(
        "For each mechanism, every solution in the search domain lies in a box: the rest of the domain is excluded with "
        "outward rounding.");
    if (has_surface(members.front()))
      words.proven.push_back("So the robot cannot reach a place over which there is no box of C-space.");
  } else {
    words.unproven.push_back(
        fmt::format("{} of {} searches ended early and left {} boxes unsearched, which may hold solutions.",
                    grouped(t.covers - t.complete), grouped(t.covers), grouped(t.pending)));
  }
  if (t.proven > 0) {
    words.proven.push_back(
        fmt::format("{} of all {} boxes ({}) are proven to hold solutions: exactly one for every value of their free "
                    "coordinates.",
                    grouped(t.proven), grouped(t.boxes), percentage(t.proven, t.boxes)));
  }
  if (t.border > 0) {
    words.proven.push_back(fmt::format("In {} boxes the same is proven for a piece that may reach beyond the search domain.",
                                       grouped(t.border)));
  }
  if (t.partial > 0)
    words.unproven.push_back(fmt::format("In {} boxes only independent equations are proven to hold.", grouped(t.partial)));
  if (t.undecided > 0) {
    words.unproven.push_back(
        fmt::format("{} boxes are undecided: they may or may not hold solutions.", grouped(t.undecided)));
  }
  words.unproven.push_back(fmt::format("Nothing is claimed about values of {} between those shown.", options.constant));
  const std::string edges =
      t.finest == t.coarsest ? fmt::format("{:g}", t.finest) : fmt::format("{:g} to {:g}", t.finest, t.coarsest);
  words.unproven.push_back(fmt::format(
      "Boxes (σ: {}) may cover a gap that is narrower than they are, and a locus looks as wide as its boxes.", edges));
  return words;
}

}  // namespace corank::report
