#include "corank/check/pieces.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "corank/check/distinct.h"
#include "corank/check/inertia.h"
#include "corank/check/krawczyk.h"
#include "corank/check/pieces_bound.h"
#include "corank/check/solution.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostFunctions = 12;
constexpr std::size_t kMostCells = 400'000;

// With an equation more for each variable of one value: so many fewer than variables as the set has dimensions.
System with_single_values(System system) {
  for (std::size_t j = 0; j < system.variables.size(); ++j) {
    const Variable& v = system.variables[j];
    if (v.kind != VariableKind::length || !(v.lower == v.upper)) continue;
    Polynomial value{{Monomial(1, {Factor{static_cast<int>(j)}})}, ""};
    if (!v.lower.is_zero()) value.monomials.emplace_back(-v.lower, std::vector<Factor>{});
    system.equations.push_back(std::move(value));
  }
  return system;
}

// Bit k: function k.
using Mask = std::uint32_t;

struct Cell {
  std::size_t box = 0;
  Sides sides;
  Box hull;  // in doubles
  Mask positive = 0, mixed = 0;
};

class PieceCheck {
 public:
  PieceCheck(const Problem& problem, const Problem& reduced, const Cover& cover, const PieceFunctions& functions,
             const PieceClaims& claims, int threads)
      : problem_(problem), reduced_(reduced), cover_(cover), functions_(functions), claims_(claims), threads_(threads) {
    std::vector<int> place(static_cast<std::size_t>(problem.size()));
    std::iota(place.begin(), place.end(), 0);
    for (const Polynomial& g : functions.functions) rows_.emplace_back(Terms(g, 0), place);
    for (std::size_t m = 0; m < matrices_.size(); ++m)
      for (const Polynomial& entry : functions.matrices[m].entries) matrices_[m].emplace_back(Terms(entry, 0), place);
  }

  PieceReport run() {
    if (!functions_match()) return fail("its functions are not the factors of the model's determinants"), std::move(report_);
    if (rows_.size() > kMostFunctions) return fail("there are too many functions"), std::move(report_);
    if (claims_.at_least < 0 || static_cast<std::size_t>(claims_.at_least) != claims_.members.size())
      return fail("there is not one member of each piece that is claimed"), std::move(report_);
    for (std::size_t k = 0; k < claims_.members.size(); ++k) check_member(k);
    if (report_.failures.empty()) check_distinct_members();
    if (!report_.failures.empty()) return std::move(report_);
    bool bounded = false;
    for (const int halvings : {4, 8, 11, 14, 17}) {
      std::vector<Cell> cells;
      if (!divide(halvings, cells)) break;
      report_.cells = cells.size();
      report_.at_least = count(cells);
      if (report_.at_least >= claims_.at_least) break;
      // Cells take long: first, may there be so many at all?
      if (!std::exchange(bounded, true)) bound();
      if (report_.at_most && *report_.at_most < claims_.at_least) break;
    }
    if (report_.at_least < claims_.at_least)
      fail("at least " + std::to_string(claims_.at_least) + " pieces are claimed, " + std::to_string(report_.at_least) +
           " shown");
    if (claims_.at_most && *claims_.at_most < report_.at_least)
      fail("at most " + std::to_string(*claims_.at_most) + " pieces are claimed, and there are more");
    if (report_.failures.empty() && !bounded) bound();
    if (report_.failures.empty() && report_.at_most && *report_.at_most < report_.at_least)
      fail("at least " + std::to_string(report_.at_least) + " pieces and at most " + std::to_string(*report_.at_most) +
           " are shown: these contradict each other");
    return std::move(report_);
  }

 private:
  void fail(std::string what) { report_.failures.push_back(std::move(what)); }

  void bound() {
    report_.unbounded = "the file has no proof of it";
    if (!claims_.proof) return;
    PieceBound found = bound_pieces(problem_, reduced_, cover_, rows_, *claims_.proof, threads_);
    report_.at_most = found.at_most;
    report_.unbounded = std::move(found.reason);
    report_.cells_of_bound = found.cells;
    report_.links = found.links;
    report_.bounded = claims_.at_most && found.at_most && *found.at_most <= *claims_.at_most;
  }

  // Each is a multiple of one of the others, either way.
  bool functions_match() const {
    const auto within = [](const std::vector<Polynomial>& list, const std::vector<Polynomial>& others) {
      return std::all_of(list.begin(), list.end(), [&](const Polynomial& f) {
        const Terms terms(f, 0);
        return !terms.list().empty() && std::any_of(others.begin(), others.end(),
                                                    [&](const Polynomial& g) { return terms.is_multiple_of(Terms(g, 0)); });
      });
    };
    return within(functions_.functions, functions_.factors) && within(functions_.factors, functions_.functions);
  }

  bool is_end(const Condition& c) const {
    if (c.implied) return false;
    if (c.variable < 0) return true;
    const Variable& v = problem_.system().variables[static_cast<std::size_t>(c.variable)];
    return !(v.kind == VariableKind::length && v.lower == v.upper);
  }

  void check_member(std::size_t k) {
    const PieceMember& member = claims_.members[k];
    const std::string name = "member " + std::to_string(k + 1) + ": ";
    std::vector<double> point = midpoint(member.box);
    std::string fault;
    const Sides x = solution_near(problem_, point, member.free, fault);
    if (!fault.empty()) return fail(name + fault);
    for (std::size_t j = 0; j < x.size(); ++j)
      if (!x[j].inside(member.box[j])) return fail(name + "its solution is not shown to lie in its box");
    for (const Condition& c : problem_.conditions())
      if (is_end(c) && !c.row.value(x).is_positive()) return fail(name + "it is not shown to lie within the limits");
    if (member.signs.size() != rows_.size()) return fail(name + "it does not have one sign for each function");
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      const Enclosure value = rows_[g].value(x);
      if (!(member.signs[g] == 1 ? value.is_positive() : member.signs[g] == -1 && value.is_negative()))
        return fail(name + "the sign of function " + std::to_string(g + 1) + " is not what it says");
    }
    for (std::size_t m = 0; m < matrices_.size(); ++m) {
      if (member.determinant_signs[m] == 0) continue;
      const auto columns = static_cast<std::size_t>(functions_.matrices[m].columns);
      std::vector<Sides> values;
      for (std::size_t e = 0; e < matrices_[m].size(); ++e) {
        if (e % columns == 0) values.emplace_back();
        values.back().push_back(matrices_[m][e].value(x));
      }
      if (values.size() != columns || determinant_sign(std::move(values)) != member.determinant_signs[m])
        return fail(name + "the sign of a determinant is not what it says");
    }
    members_.push_back(x);
    ++report_.members;
  }

  // No configuration stands for two pieces.
  void check_distinct_members() {
    std::vector<Box> hulls(members_.size());
    std::vector<const Box*> boxes;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      for (const Enclosure& side : members_[k]) hulls[k].emplace_back(side.lo(), side.hi());
      boxes.push_back(&hulls[k]);
    }
    const auto apart = [&](std::size_t a, std::size_t b) {
      problem_.stop().poll();
      for (std::size_t j = 0; j < members_[a].size(); ++j)
        if (!members_[a][j].overlaps(members_[b][j])) return true;
      return false;
    };
    for (const auto& [a, b] : meeting_pairs(boxes, apart, 1))
      fail("members " + std::to_string(std::min(a, b) + 1) + " and " + std::to_string(std::max(a, b) + 1) +
           " are one configuration: it cannot stand for two pieces");
  }

  // Shrinks the cell to its solutions and finds the functions' signs; false: it has none in the domain.
  bool examine(Cell& cell) const {
    const CoverBox& box = cover_.boxes[cell.box];
    std::vector<int> dependent;
    for (int j = 0; j < problem_.size(); ++j)
      if (std::find(box.free.begin(), box.free.end(), j) == box.free.end()) dependent.push_back(j);
    Krawczyk newton(problem_.equations(), problem_.size());
    bool linear = false;
    for (int step = 0; step < 2; ++step) {
      if (!newton.set(dependent, cell.sides, Krawczyk::Center::polished)) break;
      const Sides image = newton.image(cell.sides);
      for (std::size_t a = 0; a < image.size(); ++a)
        if (!cell.sides[static_cast<std::size_t>(dependent[a])].intersect(image[a])) return false;
      linear = true;
    }
    for (const Condition& c : problem_.conditions())
      if (is_end(c) && c.row.value(cell.sides).is_negative()) return false;
    cell.positive = cell.mixed = 0;
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      Enclosure value = rows_[g].value(cell.sides);
      if (linear && value.has_zero() && !value.intersect(newton.value_at_zeros(rows_[g], cell.sides))) return false;
      if (value.has_zero()) cell.mixed |= Mask{1} << g;
      if (value.is_positive()) cell.positive |= Mask{1} << g;
    }
    cell.hull.clear();
    for (const Enclosure& side : cell.sides) cell.hull.emplace_back(side.lo(), side.hi());
    return true;
  }

  bool divide(int halvings, std::vector<Cell>& cells) const {
    const std::vector<double> lengths = domain_lengths(problem_.system());
    for (std::size_t b = 0; b < cover_.boxes.size(); ++b) {
      Cell whole;
      whole.box = b;
      for (const Interval& side : cover_.boxes[b].box) whole.sides.emplace_back(side);
      std::vector<std::pair<Cell, int>> open;
      open.emplace_back(std::move(whole), 0);
      while (!open.empty()) {
        problem_.stop().poll();
        auto [cell, depth] = std::move(open.back());
        open.pop_back();
        if (!examine(cell)) continue;
        if (cells.size() + open.size() > kMostCells) return false;
        std::size_t along = cell.sides.size();
        for (const int f : cover_.boxes[b].free)
          if (const auto j = static_cast<std::size_t>(f);
              along == cell.sides.size() || cell.sides[j].width() * lengths[along] > cell.sides[along].width() * lengths[j])
            along = j;
        const double from = cell.sides[along].lo(), middle = cell.sides[along].mid(), to = cell.sides[along].hi();
        if (cell.mixed == 0 || depth == halvings || !(from < middle && middle < to)) {
          cells.push_back(std::move(cell));
          continue;
        }
        open.emplace_back(cell, depth + 1);
        open.back().first.sides[along] = Enclosure(from, middle);
        cell.sides[along] = Enclosure(middle, to);
        open.emplace_back(std::move(cell), depth + 1);
      }
    }
    return true;
  }

  // Calls visit for each choice of signs that a cell leaves open.
  template <class Visit>
  static void for_each_choice(Mask mixed, Mask positive, const Visit& visit) {
    for (Mask open = mixed;; open = (open - 1) & mixed) {
      visit(positive | open);
      if (open == 0) return;
    }
  }

  int count(const std::vector<Cell>& cells) const {
    std::vector<std::size_t> parent;
    const auto find = [&](std::size_t k) {
      while (parent[k] != k) k = parent[k] = parent[parent[k]];
      return k;
    };
    std::vector<std::map<Mask, std::size_t>> parts(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for_each_choice(cells[c].mixed, cells[c].positive, [&](Mask signs) {
        parts[c].emplace(signs, parent.size());
        parent.push_back(parent.size());
      });
    std::vector<const Box*> hulls;
    for (const Cell& cell : cells) hulls.push_back(&cell.hull);
    const auto join = [&](std::size_t a, std::size_t b) {
      problem_.stop().poll();
      for (const auto& [signs, part] : parts[a])
        if (const auto other = parts[b].find(signs); other != parts[b].end()) parent[find(part)] = find(other->second);
      return true;
    };
    meeting_pairs(hulls, join, 1);
    // A member lies in one of the cells that it overlaps, whichever that is.
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      Mask signs = 0;
      for (std::size_t g = 0; g < rows_.size(); ++g)
        if (claims_.members[k].signs[g] > 0) signs |= Mask{1} << g;
      std::optional<std::size_t> first;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto part = parts[c].find(signs);
        if (part == parts[c].end()) continue;
        bool overlaps = true;
        for (std::size_t j = 0; overlaps && j < members_[k].size(); ++j)
          overlaps = members_[k][j].overlaps(cells[c].sides[j]);
        if (!overlaps) continue;
        if (first) parent[find(*first)] = find(part->second);
        first = part->second;
      }
      if (first) at.push_back(*first);
    }
    std::set<std::size_t> classes;
    for (const std::size_t part : at) classes.insert(find(part));
    return static_cast<int>(classes.size());
  }

  const Problem& problem_;
  const Problem& reduced_;
  const Cover& cover_;
  const PieceFunctions& functions_;
  const PieceClaims& claims_;
  int threads_;
  std::vector<Row> rows_;
  std::array<std::vector<Row>, 2> matrices_;
  std::vector<Sides> members_;
  PieceReport report_;
};

}  // namespace

bool PiecesReport::verified() const {
  return failures.empty() && !interrupted && space.verified() &&
         std::all_of(lists.begin(), lists.end(), [](const PieceReport& r) { return r.failures.empty(); });
}

bool PiecesReport::covered() const { return verified() && space.complete(); }

bool PiecesReport::complete() const {
  return covered() && std::all_of(lists.begin(), lists.end(), [](const PieceReport& r) { return r.bounded; });
}

PiecesReport check_pieces(const System& system, const Cover& cover, const std::vector<PieceClaims>& claims,
                          const std::vector<PieceFunctions>& functions, const Options& options) {
  const NearestRounding nearest;
  const StopFlag stop(options.ended);
  PiecesReport report;
  const auto fail = [&](std::string what) { report.failures.push_back(std::move(what)); };
  try {
    report.stage = "the cover";
    report.space = check(system, cover, options);
    if (report.space.interrupted) throw Stopped{};
    for (const Failure& f : report.space.failures)
      fail((f.place == Failure::Place::box ? "box " + std::to_string(f.index + 1) : std::string("the cover")) + ": " +
           f.reason);
    if (report.failures.empty() && !report.space.verified()) fail("something in the cover cannot be checked");
    for (const CoverBox& box : cover.boxes)
      if ((box.verdict != Verdict::regular && box.verdict != Verdict::boundary) || box.motion >= 0)
        fail("a box is neither regular nor at a limit");
    const Problem problem(with_single_values(system), {}, stop);
    if (static_cast<int>(problem.equations().size()) + cover.dimension != problem.size() || cover.dimension < 1)
      fail("the set does not have the dimension that its equations leave");
    if (claims.size() != functions.size()) fail("the lists of pieces are not those of the model");
    if (!report.failures.empty()) return report;
    report.stage = "the pieces";
    const Problem reduced(system, cover.reduction, stop);
    for (std::size_t k = 0; k < claims.size(); ++k)
      report.lists.push_back(PieceCheck(problem, reduced, cover, functions[k], claims[k], options.threads).run());
  } catch (const Stopped&) {
    report.interrupted = true;
  }
  return report;
}

}  // namespace corank::check
