#include "corank/check/pieces.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "corank/check/classes.h"
#include "corank/check/distinct.h"
#include "corank/check/inertia.h"
#include "corank/check/krawczyk.h"
#include "corank/check/pieces_bound.h"
#include "corank/check/requirement.h"
#include "corank/check/sheets.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostFunctions = 12;
constexpr std::size_t kMostCells = 400'000;

// With an equation more for each variable of one value: fewer than variables, by the set's dimension.
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
  int depth = 0;
  Box hull{};  // in doubles
  Mask positive = 0, mixed = 0;
  bool ends = false;      // a limit may be reached in it
  bool contested = true;  // it may hang together with two members
};

class PieceCheck {
 public:
  PieceCheck(const Problem& problem, const Problem& reduced, const Cover& cover, const PieceFunctions& functions,
             const PieceClaims& claims, int threads)
      : problem_(problem),
        reduced_(reduced),
        cover_(cover),
        functions_(functions),
        claims_(claims),
        threads_(threads),
        rows_(rows_of(functions.functions, problem.size())),
        requirement_rows_(rows_of(functions.requirement_functions, problem.size())) {
    for (std::size_t m = 0; m < matrices_.size(); ++m) matrices_[m] = entries_of(functions.matrices[m], problem.size());
  }

  PieceReport run() {
    if (!functions_match()) return fail("its functions are not the factors of the model's determinants"), std::move(report_);
    if (rows_.size() > kMostFunctions) return fail("there are too many functions"), std::move(report_);
    if (claims_.at_least != static_cast<int>(claims_.members.size()))
      return fail("there is not one member of each piece that is claimed"), std::move(report_);
    for (std::size_t k = 0; k < claims_.members.size(); ++k) check_member(k);
    if (report_.failures.empty()) check_distinct_members();
    if (!report_.failures.empty()) return std::move(report_);
    bool bounded = false;
    std::vector<Cell> cells;
    for (std::size_t b = 0; b < cover_.boxes.size(); ++b) {
      problem_.stop().poll();
      const Box& box = cover_.boxes[b].box;
      Cell cell{.box = b, .sides = Sides(box.begin(), box.end())};
      if (examine(cell)) cells.push_back(std::move(cell));
    }
    for (const int halvings : {4, 8, 11, 14, 17}) {
      if (!divide(halvings, cells)) break;
      report_.cells = cells.size();
      report_.at_least = count(cells);
      if (report_.at_least >= claims_.at_least) break;
      // Cells take long: first, may there be this number at all?
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
    report_.at_least = std::max(0, report_.at_least - claims_.members_with(0) - claims_.members_with(-1));
    if (report_.at_most) *report_.at_most -= claims_.members_with(-1);
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
      return std::ranges::all_of(list, [&](const Polynomial& f) {
        const Terms terms(f, 0);
        return !terms.list().empty() &&
               std::ranges::any_of(others, [&](const Polynomial& g) { return terms.is_multiple_of(Terms(g, 0)); });
      });
    };
    return within(functions_.functions, functions_.factors) && within(functions_.factors, functions_.functions);
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
      if (problem_.is_end(c) && !c.row.value(x).is_positive())
        return fail(name + "it is not shown to lie within the limits");
    if (member.signs.size() != rows_.size()) return fail(name + "it does not have one sign for each function");
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      const Enclosure value = rows_[g].value(x);
      if (!(member.signs[g] == 1 ? value.is_positive() : member.signs[g] == -1 && value.is_negative()))
        return fail(name + "the sign of function " + std::to_string(g + 1) + " is not what it says");
    }
    if (member.requirements != 0 && member.requirements != requirements_at(x))
      return fail(name + "what it says of the requirements is not shown");
    for (std::size_t m = 0; m < matrices_.size(); ++m) {
      const PolynomialMatrix& matrix = functions_.matrices[m];
      if (member.determinant_signs[m] == 0) continue;
      if (matrix.rows != matrix.columns || determinant_sign(values(matrices_[m], x)) != member.determinant_signs[m])
        return fail(name + "the sign of a determinant is not what it says");
    }
    members_.push_back(x);
    ++report_.members;
  }

  // Met (1), not met (-1), or not known (0) at the solution.
  int requirements_at(const Sides& x) const {
    const auto form = [&](int function) { return Form{requirement_rows_[function].value(x), {}}; };
    int all = 1;
    for (const Requirement& r : functions_.requirements) {
      const Standing found = standing(r, form, {});
      if (found == Standing::violated) return -1;
      if (found == Standing::open) all = 0;
    }
    return all;
  }

  // No configuration stands for two pieces.
  void check_distinct_members() {
    std::vector<Box> hulls;
    std::vector<const Box*> boxes;
    for (const Sides& x : members_) hulls.emplace_back(x.begin(), x.end());
    for (const Box& hull : hulls) boxes.push_back(&hull);
    const auto told_apart = [&](std::size_t a, std::size_t b) {
      problem_.stop().poll();
      return !overlap(members_[a], members_[b]);
    };
    for (const auto& [a, b] : meeting_pairs(boxes, told_apart, 1))
      fail("members " + std::to_string(std::min(a, b) + 1) + " and " + std::to_string(std::max(a, b) + 1) +
           " are one configuration: it cannot stand for two pieces");
  }

  // Shrinks the cell to its solutions and finds the functions' signs; false: it has none in the domain.
  bool examine(Cell& cell) const {
    const CoverBox& box = cover_.boxes[cell.box];
    const std::vector<int> dependent = all_but(box.free, problem_.size());
    Krawczyk newton(problem_.equations(), problem_.size());
    bool linear = false;
    for (int step = 0; step < 2; ++step) {
      if (!newton.set(dependent, cell.sides, Krawczyk::Center::polished)) break;
      if (!newton.shrink(cell.sides, newton.image(cell.sides))) return false;
      linear = true;
    }
    const auto bound = [&](const Row& row, Enclosure& value) {
      value = row.value(cell.sides);
      return !(linear && value.has_zero()) || value.intersect(newton.value_at_zeros(row, cell.sides));
    };
    Enclosure value;
    cell.ends = false;
    for (const Condition& c : problem_.conditions()) {
      if (!problem_.is_end(c)) continue;
      if (!bound(c.row, value) || value.is_negative()) return false;
      cell.ends = cell.ends || !value.is_positive();
    }
    cell.positive = cell.mixed = 0;
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      if (!bound(rows_[g], value)) return false;
      if (value.has_zero()) cell.mixed |= Mask{1} << g;
      if (value.is_positive()) cell.positive |= Mask{1} << g;
    }
    cell.hull = Box(cell.sides.begin(), cell.sides.end());
    return true;
  }

  // The contested ones.
  bool divide(int halvings, std::vector<Cell>& cells) const {
    const std::vector<double> lengths = domain_lengths(problem_.system());
    std::vector<Cell> open;
    std::swap(open, cells);
    while (!open.empty()) {
      problem_.stop().poll();
      Cell cell = std::move(open.back());
      open.pop_back();
      if (cells.size() + open.size() > kMostCells) return false;
      const bool whole = !cell.contested || (cell.mixed == 0 && !cell.ends) || cell.depth >= halvings;
      auto halves = whole ? std::nullopt : halved(cell.sides, cover_.boxes[cell.box].free, lengths);
      if (!halves) cells.push_back(std::move(cell));
      if (!halves) continue;
      for (Sides& half : *halves) {
        Cell child{.box = cell.box, .sides = std::move(half), .depth = cell.depth + 1};
        if (examine(child)) open.push_back(std::move(child));
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

  int count(std::vector<Cell>& cells) const {
    std::vector<std::map<Mask, std::size_t>> parts(cells.size());
    std::size_t number = 0;
    for (std::size_t c = 0; c < cells.size(); ++c)
      for_each_choice(cells[c].mixed, cells[c].positive, [&](Mask signs) { parts[c].emplace(signs, number++); });
    Classes classes(number);
    std::vector<const Box*> hulls;
    for (const Cell& cell : cells) hulls.push_back(&cell.hull);
    const auto join = [&](std::size_t a, std::size_t b) {
      problem_.stop().poll();
      for (const auto& [signs, part] : parts[a])
        if (const auto other = parts[b].find(signs); other != parts[b].end()) classes.unite(part, other->second);
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
        if (!overlap(members_[k], cells[c].sides)) continue;
        if (first) classes.unite(*first, part->second);
        first = part->second;
      }
      if (first) at.push_back(*first);
    }
    std::map<std::size_t, int> pieces;  // of each how many members it has
    for (const std::size_t part : at) ++pieces[classes.of(part)];
    for (std::size_t c = 0; c < cells.size(); ++c)
      cells[c].contested = std::ranges::any_of(parts[c], [&](const auto& part) {
        const auto piece = pieces.find(classes.of(part.second));
        return piece != pieces.end() && piece->second > 1;
      });
    return static_cast<int>(pieces.size());
  }

  const Problem& problem_;
  const Problem& reduced_;
  const Cover& cover_;
  const PieceFunctions& functions_;
  const PieceClaims& claims_;
  int threads_;
  std::vector<Row> rows_, requirement_rows_;
  std::array<RowMatrix, 2> matrices_;
  std::vector<Sides> members_;
  PieceReport report_;
};

}  // namespace

bool PiecesReport::verified() const {
  return failures.empty() && !interrupted && space.verified() &&
         std::ranges::all_of(lists, [](const PieceReport& r) { return r.failures.empty(); });
}

bool PiecesReport::covered() const { return verified() && space.complete(); }

bool PiecesReport::complete() const {
  return covered() && std::ranges::all_of(lists, [](const PieceReport& r) { return r.bounded; });
}

PiecesReport check_pieces(const System& system, const Cover& cover, const std::vector<PieceClaims>& claims,
                          const std::vector<PieceFunctions>& functions, const Options& options) {
  const StopFlag stop(options.ended);
  PiecesReport report;
  const auto fail = [&](std::string what) { report.failures.push_back(std::move(what)); };
  report.interrupted = !finishes([&] {
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
    if (report.failures.empty() && !std::ranges::all_of(cover.boxes, [&](const CoverBox& b) { return spans(cover, b); }))
      fail("a box has no solution for every value of its free variables");
    if (!report.failures.empty()) return;
    report.stage = "the pieces";
    const Problem reduced(system, cover.reduction, stop);
    for (std::size_t k = 0; k < claims.size(); ++k)
      report.lists.push_back(PieceCheck(problem, reduced, cover, functions[k], claims[k], options.threads).run());
  });
  return report;
}

}  // namespace corank::check
