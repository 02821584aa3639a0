#include "corank/check/map.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "corank/check/distinct.h"
#include "corank/check/krawczyk.h"
#include "corank/check/parallel.h"
#include "corank/check/requirement.h"
#include "corank/check/search.h"
#include "corank/check/sheets.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kPlane = 2;  // parameters that have a side in each cell
constexpr int kMostSteps = 12;     // of Newton's, until two solutions over one value are told apart
constexpr std::size_t kMostOverlaps = 100;
// Parts of a search: of a cell by itself; of what a group of cells, each counted so often, leaves to one of them.
constexpr int kPartsOfStanding = 256;  // of a sheet, until a requirement is known to be met or violated
constexpr std::size_t kFewParts = 20, kPartsOfGroup = 20, kMostPartsOfGroup = 40'000, kMostPartsAlone = 3000;

class MapCheck {
 public:
  MapCheck(const System& system, const std::vector<int>& parameters, int copies,
           const std::vector<Requirement>& requirements, const MapClaims& claims, const Options& options, MapReport& report)
      : system_(system),
        parameters_(parameters),
        copies_(copies),
        requirements_(requirements),
        claims_(claims),
        options_(options),
        problem_(system, claims.reduction, StopFlag(options.ended)),
        lengths_(problem_.lengths()),
        report_(report) {
    report_.cells.resize(claims.cells.size());
    for (int k = 0; k < problem_.size(); ++k)
      (std::ranges::find(parameters, problem_.kept()[k]) == parameters.end() ? unknowns_ : places_).push_back(k);
  }

  void run() {
    report_.stage = "the cells";
    for (const int p : parameters_)
      if (problem_.place(p) < 0) return fail("the reduction eliminates a parameter");
    for (std::size_t c = 0; c < claims_.cells.size(); ++c)
      if (const std::string fault = shape_fault(claims_.cells[c]); !fault.empty()) fail(c, fault);
    if (!report_.failures.empty()) return;
    check_overlaps();
    std::vector<std::string> faults(claims_.cells.size());
    const bool finished = parallel(arena_, faults.size(), [&](std::size_t c) { faults[c] = check_cell(c); });
    for (std::size_t c = 0; c < faults.size(); ++c)
      if (!faults[c].empty()) fail(c, faults[c]);
    if (!finished) throw Stopped{};
    report_.stage = "the search for more solutions";
    std::vector<std::size_t> open;
    for (std::size_t c = 0; c < report_.cells.size(); ++c)
      if (report_.cells[c].at_least && !report_.cells[c].complete) open.push_back(c);
    search(open, {problem_.domain()});
  }

 private:
  void fail(const std::string& what) { report_.failures.push_back(what); }
  void fail(std::size_t cell, const std::string& what) { fail("cell " + std::to_string(cell + 1) + ": " + what); }

  // Of parameter k, over a cell or several.
  Interval side(const Box& cell, std::size_t k) const {
    return k < kPlane ? cell[k] : system_.variables[parameters_[k]].domain;
  }

  std::string shape_fault(const MapCellClaim& cell) const {
    if (cell.sides.size() != kPlane) return "it does not have one side for each parameter";
    for (std::size_t k = 0; k < kPlane; ++k)
      if (!system_.variables[parameters_[k]].domain.contains(cell.sides[k])) return "it is not within the map";
    if (cell.standing != Standing::open && requirements_.empty())
      return "it claims something of requirements, but the model has no requirements";
    if (cell.count < 0 || static_cast<std::int64_t>(cell.sheets.size()) != std::int64_t{cell.count} * copies_)
      return "it does not have as many sheets as it claims solutions";
    for (const MapSheet& sheet : cell.sheets) {
      if (sheet.box.size() != system_.variables.size() || sheet.region.size() != sheet.box.size())
        return "a sheet does not have one side for each variable";
      for (std::size_t k = 0; k < parameters_.size(); ++k)
        if (sheet.box[parameters_[k]] != side(cell.sides, k)) return "a sheet is not over the cell, or not of every robot";
    }
    return {};
  }

  // Shares of the plane are sums over cells.
  void check_overlaps() {
    std::vector<const Box*> boxes;
    for (const MapCellClaim& cell : claims_.cells) boxes.push_back(&cell.sides);
    const auto apart = [&](std::size_t a, std::size_t b) {
      problem_.stop().poll();
      for (std::size_t k = 0; k < kPlane; ++k) {
        const Interval &x = (*boxes[a])[k], &y = (*boxes[b])[k];
        if (x.hi() <= y.lo() || y.hi() <= x.lo()) return true;
      }
      return false;
    };
    for (const auto& [a, b] : meeting_pairs(boxes, apart, kMostOverlaps))
      fail(b, "it overlaps cell " + std::to_string(a + 1));
  }

  std::string check_cell(std::size_t c) {
    const MapCellClaim& cell = claims_.cells[c];
    for (std::size_t k = 0; k < cell.sheets.size(); ++k) {
      const CoverBox box{.box = cell.sheets[k].box, .verdict = Verdict::regular, .free = parameters_};
      if (const std::string fault = check_sheet(problem_, problem_.equations(), box, cell.sheets[k].region); !fault.empty())
        return "sheet " + std::to_string(k + 1) + ": " + fault;
    }
    for (std::size_t k = 0; k < cell.sheets.size(); ++k)
      for (std::size_t other = 0; other < k; ++other)
        if (!differ(cell, cell.sheets[other], cell.sheets[k]))
          return "sheets " + std::to_string(other + 1) + " and " + std::to_string(k + 1) + " may be the same";
    if (!has_standing(cell)) return std::string("it is not shown that the requirements are ") + to_string(cell.standing);
    const bool complete = has_no_more(cell, {problem_.domain()}, kFewParts);
    const std::scoped_lock lock(mutex_);
    report_.sheets += cell.sheets.size();
    report_.cells[c] = {true, complete, true};
    return {};
  }

  bool has_standing(const MapCellClaim& cell) const {
    // Is it so of all of the sheet's zeros? No further part is looked at once one contradicts.
    const auto shown = [&](const Requirement& requirement, const MapSheet& sheet, int most_parts) {
      bool contradicted = false;
      const bool ended =
          shown_in_parts(problem_.kept(sheet.box), places_, lengths_, most_parts, problem_.stop(), [&](Sides& x) {
            const Standing found = standing_over(requirement, x);
            contradicted = contradicted || (found != Standing::open && found != cell.standing);
            return contradicted || found == cell.standing;
          });
      return ended && !contradicted;
    };
    if (cell.standing == Standing::open) return true;
    if (cell.standing == Standing::satisfied)
      return std::ranges::all_of(requirements_, [&](const Requirement& r) {
        return std::ranges::all_of(cell.sheets, [&](const MapSheet& sheet) { return shown(r, sheet, kPartsOfStanding); });
      });
    for (int most = 1; most <= kPartsOfStanding; most *= 4)
      for (const Requirement& r : requirements_)
        for (const MapSheet& sheet : cell.sheets)
          if (shown(r, sheet, most)) return true;
    return false;
  }

  // Of the sheet's zeros over these values of the parameters; x holds them, and is tightened.
  Standing standing_over(const Requirement& requirement, Sides& x) const {
    if (problem_.contradiction()) return Standing::open;
    Krawczyk newton(problem_.equations(), problem_.size());
    if (!newton.set(unknowns_, x, Krawczyk::Center::polished) || !newton.shrink(x, newton.image(x))) return Standing::open;
    if (!newton.shrink(x, newton.image(x))) return Standing::open;
    Sides offsets;
    for (const int p : places_) offsets.push_back(x[p] - Enclosure(newton.center()[p]));
    return standing(
        requirement,
        [&](int variable) {
          if (const int place = problem_.place(variable); place >= 0) return newton.form_of_variable(place, x, places_);
          const auto value = std::ranges::find(problem_.values(), variable, &Problem::Value::variable);
          return newton.form_at_zeros(value->row, x, places_);
        },
        offsets);
  }

  // What the boxes have over these values of the parameters.
  std::vector<Sides> over(const Box& sides, const std::vector<Sides>& boxes) const {
    std::vector<Sides> parts;
    for (const Sides& x : boxes) {
      Sides part = x;
      bool some = true;
      for (std::size_t k = 0; k < parameters_.size(); ++k)
        some = some && part[problem_.place(parameters_[k])].intersect(Enclosure(side(sides, k)));
      if (some) parts.push_back(std::move(part));
    }
    return parts;
  }

  // Are the zeros over the cell that are in the domain, all of which lie in the boxes, those of its sheets, which are
  // confirmed?
  bool has_no_more(const MapCellClaim& cell, const std::vector<Sides>& open, std::size_t most) {
    if (problem_.contradiction()) return true;
    std::vector<Sides> images, regions;
    for (const MapSheet& sheet : cell.sheets) {
      images.push_back(problem_.kept(sheet.box));
      regions.push_back(problem_.kept(sheet.region));
    }
    const auto known = [&](const Sides& part) {
      for (std::size_t k = 0; k < images.size(); ++k)
        if (!apart(part, regions[k]) && is_of_sheet(part, images[k], regions[k])) return true;
      return false;
    };
    std::size_t parts = 0;
    const bool shown = Search(problem_).has_none_but(over(cell.sides, open), known, most, parts);
    const std::scoped_lock lock(mutex_);
    report_.boxes += parts;
    return shown;
  }

  // What takes long in one cell takes no longer in all that are near: boxes that hold all zeros over these cells are found
  // for all of them, then for each quarter of them.
  void search(const std::vector<std::size_t>& cells, const std::vector<Sides>& open) {
    if (cells.empty()) return;
    if (cells.size() == 1) {
      report_.cells[cells[0]].complete = has_no_more(claims_.cells[cells[0]], open, kMostPartsAlone);
      return;
    }
    Box hull = claims_.cells[cells[0]].sides;
    for (const std::size_t c : cells) include(hull, claims_.cells[c].sides);
    const auto narrow = [&](const Sides& x) { return is_injective(x); };
    std::size_t parts = 0;
    const std::vector<Sides> found =
        Search(problem_).sift(over(hull, open), narrow, std::min(kPartsOfGroup * cells.size(), kMostPartsOfGroup), parts);
    {
      const std::scoped_lock lock(mutex_);
      report_.boxes += parts;
    }
    std::vector<std::vector<std::size_t>> groups;
    for (const auto& half : in_halves(cells, hull[0].width() > hull[1].width() ? 0 : 1))
      for (auto& quarter : in_halves(half, hull[0].width() > hull[1].width() ? 1 : 0)) groups.push_back(std::move(quarter));
    if (!parallel(arena_, groups.size(), [&](std::size_t g) { search(groups[g], found); })) throw Stopped{};
  }

  std::vector<std::vector<std::size_t>> in_halves(std::vector<std::size_t> cells, std::size_t along) const {
    if (cells.size() < 2) return {cells};
    const auto middle = cells.begin() + cells.size() / 2;
    std::nth_element(cells.begin(), middle, cells.end(), [&](std::size_t a, std::size_t b) {
      return claims_.cells[a].sides[along].mid() < claims_.cells[b].sides[along].mid();
    });
    return {{cells.begin(), middle}, {middle, cells.end()}};
  }

  // At most one zero in x for each value of the parameters.
  bool is_injective(const Sides& x) const {
    Krawczyk newton(problem_.equations(), problem_.size());
    return newton.set(unknowns_, x, Krawczyk::Center::middle) && newton.is_injective(x);
  }

  // Is every zero in x, for each value of the parameters in it, the sheet's? In the region there is no other, nor in a hull
  // of the sheet's image and x that holds one at most.
  bool is_of_sheet(const Sides& x, const Sides& image, const Sides& region) const {
    Sides hull = x;
    bool inside = true;
    for (const int u : unknowns_) {
      const std::size_t k = u;
      inside = inside && x[k].inside(region[k]);
      hull[k] = Enclosure::hull(x[k], image[k]);
    }
    return inside || is_injective(hull);
  }

  bool apart(const Sides& x, const Sides& y) const {
    return std::ranges::any_of(unknowns_, [&](int k) { return !x[k].overlaps(y[k]); });
  }

  // Encloses the sheet's zero further, over x's value of the parameters; false: no further.
  bool tighten(Sides& x) const {
    Krawczyk newton(problem_.equations(), problem_.size());
    if (!newton.set(unknowns_, x, Krawczyk::Center::refined)) return false;
    return newton.shrink(x, newton.image(x));
  }

  bool differ(const MapCellClaim& cell, const MapSheet& a, const MapSheet& b) const {
    Sides x = problem_.kept(a.box), y = problem_.kept(b.box);
    if (apart(x, y)) return true;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      const std::size_t place = problem_.place(parameters_[k]);
      x[place] = y[place] = Enclosure(side(cell.sides, k).mid());
    }
    for (int step = 0; step < kMostSteps; ++step) {
      problem_.stop().poll();
      if (!tighten(x) || !tighten(y)) return false;
      if (apart(x, y)) return true;
    }
    return false;
  }

  const System& system_;
  const std::vector<int>& parameters_;
  const int copies_;
  const std::vector<Requirement>& requirements_;
  const MapClaims& claims_;
  const Options& options_;
  const Problem problem_;
  const std::vector<double> lengths_;
  std::vector<int> unknowns_, places_;  // of the others that were kept, and of the parameters, among all that were
  ThreadArena arena_{options_.threads};
  std::mutex mutex_;
  MapReport& report_;
};

std::size_t count(const std::vector<MapCellReport>& cells, bool MapCellReport::*what) {
  return std::ranges::count_if(cells, [&](const auto& c) { return c.*what; });
}

}  // namespace

std::size_t MapReport::at_least() const { return count(cells, &MapCellReport::at_least); }
std::size_t MapReport::completed() const { return count(cells, &MapCellReport::complete); }
bool MapReport::verified() const { return failures.empty() && !interrupted && at_least() == cells.size(); }
bool MapReport::complete() const { return verified() && completed() == cells.size(); }

MapReport check_map(const System& system, const std::vector<int>& parameters, int copies,
                    const std::vector<Requirement>& requirements, const MapClaims& claims, const Options& options) {
  MapReport report;
  report.stage = "the reduction";
  try {
    report.interrupted =
        !finishes([&] { MapCheck(system, parameters, copies, requirements, claims, options, report).run(); });
  } catch (const std::invalid_argument& error) {
    report.failures.push_back(report.stage + ": " + error.what());
  }
  return report;
}

}  // namespace corank::check
