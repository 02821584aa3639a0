#include "corank/analyze/aspects.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <set>

#include "corank/analyze/limits.h"
#include "corank/analyze/piece_places.h"
#include "corank/analyze/topology_with_ends.h"
#include "corank/certify/determinant.h"
#include "corank/certify/meeting.h"
#include "corank/core/box.h"
#include "corank/core/box_tree.h"
#include "corank/core/rounding.h"
#include "corank/solve/solve.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/determinant_factors.h"

namespace corank::analyze {
namespace {

using Signs = std::vector<int>;

// Parts of cells, joined to pieces.
class PieceCounter {
 public:
  PieceCounter(SignCells& cells, solve::Control& control) : cells_(cells), test_(cells.system()), control_(control) {
    add_parts();
    std::vector<const Box*> sides;
    for (const SignCell& cell : cells_.cells()) sides.push_back(&cell.sides);
    if (!sides.empty()) tree_.emplace(sides, sides.front()->size());
  }

  Pieces count() {
    Pieces result;
    result.cells = cells_.cells().size();
    if (!tree_) {
      result.at_most = 0;
      return result;
    }
    proven_ = boost::disjoint_sets_with_storage<>(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) proven_.make_set(p);
    for (std::size_t c = 0; c < cells_.cells().size() && !control_.ended(); ++c) {
      join_over_border(c);
      control_.report(c, cells_.cells().size());
    }
    join_touching();
    join_at_ends();
    keep_proof(result.proof);
    upper_bound(result);
    lower_bound(result);
    return result;
  }

 private:
  enum class Kind { connected, passage, unknown };
  struct Part {
    std::size_t cell;
    Signs signs;
    Kind kind;
    bool holds_solution;  // proven
    std::optional<Box> solution{};
  };

  void add_part(std::size_t cell, Signs signs, Kind kind, bool holds) {
    part_of_[cell].emplace(signs, parts_.size());
    parts_.push_back({cell, std::move(signs), kind, holds});
  }

  void add_parts() {
    const UpwardRounding rounding;
    part_of_.resize(cells_.cells().size());
    for (std::size_t c = 0; c < cells_.cells().size(); ++c) {
      const SignCell& cell = cells_.cells()[c];
      const std::vector<Signs> choices = cells_.choices(cell);
      crowded_ = crowded_ || choices.empty();
      for (const Signs& signs : choices) {
        int part = 0;
        if (cell.mixed.empty()) part = 1;
        if (cell.mixed.size() == 1) part = cells_.part_of_one(cell, signs[static_cast<std::size_t>(cell.mixed.front())]);
        if (part == 0) part = cells_.part_by_outflow(cell, signs);
        if (part > 0) add_part(c, signs, Kind::connected, true);
        if (part == 0) add_part(c, signs, cell.resolved ? Kind::passage : Kind::unknown, false);
      }
    }
  }

  bool is_in(const Box& point, std::size_t c) const {
    const SignCell& cell = cells_.cells()[c];
    if (!contains(cells_.region(cell), point)) return false;
    for (const int f : cells_.free(cell))
      if (!cell.sides[static_cast<std::size_t>(f)].contains(point[static_cast<std::size_t>(f)])) return false;
    return true;
  }

  // All parts that hold the point, a solution over values of the variables `held`, are of one piece. Those of cells that end
  // there, but for rounding, may be.
  void join_at(const Box& point, const std::vector<int>& held) {
    constexpr double kGap = 1e-9;
    const Signs signs = cells_.signs(point);
    if (std::find(signs.begin(), signs.end(), 0) != signs.end()) return;
    std::optional<std::size_t> first;
    std::vector<std::size_t> near;
    Box around = point;
    for (std::size_t j = 0; j < around.size(); ++j)
      around[j] += Interval(-kGap, kGap) * Interval(cells_.system().variables[j].size);
    tree_->for_each_overlapping(around, 0, [&](std::size_t c) {
      const auto part = part_of_[c].find(signs);
      if (part == part_of_[c].end()) return;
      Part& p = parts_[part->second];
      const bool inside = is_in(point, c);
      if (inside) p.holds_solution = true;
      if (inside && !p.solution) p.solution = point;
      if (p.kind != Kind::connected) return;
      if (!inside) {
        near.push_back(part->second);
        return;
      }
      if (first && proven_.find_set(*first) != proven_.find_set(part->second)) {
        proven_.union_set(*first, part->second);
        joined_.push_back({*first, part->second, {link(point, held)}, {}});
      }
      first = part->second;
    });
    if (!first) return;
    for (const std::size_t q : near)
      if (proven_.find_set(*first) != proven_.find_set(q)) ends_.push_back({*first, q, point});
  }

  // Points on the border of X_F: the middles of its faces and, where a function is mixed, its corners and a row of points
  // on each face.
  void join_over_border(std::size_t c) {
    const UpwardRounding rounding;
    const SignCell& cell = cells_.cells()[c];
    const std::vector<int>& frees = cells_.free(cell);
    std::vector<double> along{0.5};
    if (!cell.mixed.empty() && frees.size() > 1) along = {0.5, 0, 0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1};
    Box at = cell.sides;
    for (std::size_t face = 0; face < frees.size(); ++face)
      for (const bool upper : {false, true})
        for (const double share : along) {
          for (std::size_t f = 0; f < frees.size(); ++f) {
            const Interval& side = cell.sides[static_cast<std::size_t>(frees[f])];
            const double inside = std::clamp(side.lo() + share * (side.hi() - side.lo()), side.lo(), side.hi());
            at[static_cast<std::size_t>(frees[f])] = Interval(f != face ? inside : upper ? side.hi() : side.lo());
          }
          join_at(cells_.solution_over(cell, at), frees);
        }
  }

  // Where two cells end at one point, a small piece about it may meet both.
  void join_at_ends() {
    constexpr int kTries = 8;  // for two pieces
    const UpwardRounding rounding;
    std::map<std::pair<std::size_t, std::size_t>, int> tries;
    for (const End& end : ends_) {
      const std::size_t a = proven_.find_set(end.part), b = proven_.find_set(end.other);
      if (a == b || control_.ended() || ++tries[std::minmax(a, b)] > kTries) continue;
      for (const double radius : {1e-3, 1e-5, 1e-7}) {
        const certify::Sheet piece = test_.sheet_about(end.point, radius);
        if (!piece.proven || cells_.signs(piece.region) != parts_[end.part].signs) continue;
        const std::optional<PieceLink> here = meeting(piece.region, cells_.cells()[parts_[end.part].cell]);
        const std::optional<PieceLink> there = meeting(piece.region, cells_.cells()[parts_[end.other].cell]);
        if (!here || !there) continue;
        proven_.union_set(end.part, end.other);
        joined_.push_back({end.part, end.other, {*here, *there}, SheetBridge{free_of(piece), piece.region}});
        break;
      }
    }
  }

  // Connected parts of like signs that touch and are not joined yet: points of the one's X_F next to the other, more and
  // more of them.
  void join_touching() {
    constexpr int kRows = 4;
    for (int row = 0; row < kRows; ++row)
      for_each_pair([&](std::size_t p, std::size_t q) {
        if (parts_[p].kind != Kind::connected || parts_[q].kind != Kind::connected) return;
        const UpwardRounding rounding;
        for (const auto& [from, to] : {std::pair(p, q), std::pair(q, p)})
          if (proven_.find_set(p) != proven_.find_set(q)) join_next_to(parts_[from].cell, parts_[to].cell, 4 << row);
      });
  }

  // At `count` + 1 points along each free side, those on the other free sides' ends and middles.
  void join_next_to(std::size_t c, std::size_t d, int count) {
    const SignCell& cell = cells_.cells()[c];
    const std::vector<int>& frees = cells_.free(cell);
    Box near = cell.sides;
    for (std::size_t j = 0; j < near.size(); ++j)
      if (!near[j].intersect(cells_.cells()[d].sides[j])) return;
    Box at = cell.sides;
    for (const int along : frees)
      for (int k = 0; k <= count; ++k)
        for (const double others : {0.0, 0.5, 1.0}) {
          for (const int f : frees) {
            const auto j = static_cast<std::size_t>(f);
            const double share = f == along ? static_cast<double>(k) / count : others;
            at[j] = Interval(std::clamp(near[j].lo() + share * near[j].width(), near[j].lo(), near[j].hi()));
          }
          join_at(cells_.solution_over(cell, at), frees);
        }
  }

  // A solution that is proven to be in the piece and in the cell.
  std::optional<PieceLink> meeting(const Box& piece, const SignCell& cell) {
    Box common = cells_.region(cell);
    for (const int f : cells_.free(cell)) common[static_cast<std::size_t>(f)] = cell.sides[static_cast<std::size_t>(f)];
    for (std::size_t j = 0; j < common.size(); ++j)
      if (!common[j].intersect(piece[j])) return std::nullopt;
    const std::optional<certify::Sheet> at = test_.sheet_in(common, common);
    if (!at) return std::nullopt;
    return link(at->image, free_of(*at));
  }

  static PieceLink link(const Box& point, const std::vector<int>& held) {
    PieceLink result{{}, held};
    for (const Interval& side : point) result.point.push_back(side.mid());
    return result;
  }

  std::vector<int> free_of(const certify::Sheet& sheet) const {
    std::vector<int> result;
    for (int j = 0; j < cells_.system().size(); ++j)
      if (std::find(sheet.dependent.begin(), sheet.dependent.end(), j) == sheet.dependent.end()) result.push_back(j);
    return result;
  }

  // Of the links those that join what cells of one sheet do not join by themselves: where one of two that meet is all of one
  // part, no solution needs to be named.
  void keep_proof(PieceProof& proof) {
    const auto sides = [&](const std::vector<int>& free, const Box& box) {
      std::vector<Interval> result;
      for (const int f : free) result.push_back(box[static_cast<std::size_t>(f)]);
      return result;
    };
    const std::vector<CoverBox>& boxes = cells_.cover().boxes;
    for (std::size_t b = cells_.given(); b < boxes.size(); ++b)
      proof.bridges.push_back({boxes[b].free, cells_.cover().regions[static_cast<std::size_t>(boxes[b].region)]});
    for (const SignCell& cell : cells_.cells()) proof.cells.push_back({cell.box, sides(cell.free, cell.sides)});
    boost::disjoint_sets_with_storage<> known(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) known.make_set(p);
    for_each_pair([&](std::size_t p, std::size_t q) {
      const SignCell &a = cells_.cells()[parts_[p].cell], &b = cells_.cells()[parts_[q].cell];
      if (parts_[p].kind != Kind::connected || parts_[q].kind != Kind::connected || a.box != b.box) return;
      if (!a.mixed.empty() && !b.mixed.empty()) return;
      for (const int f : a.free)
        if (!a.sides[static_cast<std::size_t>(f)].overlaps(b.sides[static_cast<std::size_t>(f)])) return;
      known.union_set(p, q);
    });
    for (const Joined& joined : joined_) {
      if (known.find_set(joined.part) == known.find_set(joined.other)) continue;
      known.union_set(joined.part, joined.other);
      proof.links.insert(proof.links.end(), joined.links.begin(), joined.links.end());
      if (!joined.bridge) continue;
      proof.cells.push_back(
          {static_cast<int>(cells_.given() + proof.bridges.size()), sides(joined.bridge->free, joined.bridge->region)});
      proof.bridges.push_back(*joined.bridge);
    }
  }

  // Parts of like signs in cells that touch.
  template <class Visit>
  void for_each_pair(const Visit& visit) {
    for (std::size_t c = 0; c < cells_.cells().size() && !control_.ended(); ++c)
      tree_->for_each_overlapping(cells_.cells()[c].sides, 0.0, [&](std::size_t d) {
        if (d <= c) return;
        for (const auto& [signs, part] : part_of_[c])
          if (const auto other = part_of_[d].find(signs); other != part_of_[d].end()) visit(part, other->second);
      });
  }

  void upper_bound(Pieces& result) {
    bool hidden = control_.ended();
    for (const SignCell& cell : cells_.cells()) result.unresolved += !cell.resolved;
    if (result.unresolved > 0) {
      result.reason = std::to_string(result.unresolved) + " cells next to singularities that are not resolved";
      return;
    }
    // Passages that touch: a piece may hide in them together, but where they share a direction.
    boost::disjoint_sets_with_storage<> clusters(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) clusters.make_set(p);
    for_each_pair([&](std::size_t p, std::size_t q) {
      if (parts_[p].kind == Kind::passage && parts_[q].kind == Kind::passage) clusters.union_set(p, q);
    });
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (parts_[p].kind == Kind::passage) members[clusters.find_set(p)].push_back(p);
    for (const auto& [root, list] : members) {
      std::vector<std::size_t> cells;
      for (const std::size_t p : list) cells.push_back(parts_[p].cell);
      const Signs& signs = parts_[list.front()].signs;  // of all of them
      const auto choice = [&](std::size_t c) { return cells_.choice(cells_.cells()[c], signs); };
      if (cells_.common_directions(cells, choice) == 0) hidden = true;
    }
    std::set<std::size_t> classes;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (parts_[p].kind == Kind::connected) classes.insert(proven_.find_set(p));
    if (!hidden) result.at_most = static_cast<int>(classes.size());
    if (hidden) result.reason = "cells about a crossing of singularity loci in which a piece might hide";
  }

  void lower_bound(Pieces& result) {
    boost::disjoint_sets_with_storage<> classes(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) classes.make_set(p);
    std::map<std::size_t, std::size_t> first;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      classes.union_set(p, first.emplace(proven_.find_set(p), p).first->second);
    for_each_pair([&](std::size_t p, std::size_t q) { classes.union_set(p, q); });
    std::map<std::size_t, std::size_t> known;  // a part of each class, one without mixed functions where there is one
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p].holds_solution) continue;
      const auto [place, fresh] = known.emplace(classes.find_set(p), p);
      const auto mixed = [&](std::size_t k) { return cells_.cells()[parts_[k].cell].mixed.size(); };
      if (!fresh && mixed(p) < mixed(place->second)) place->second = p;
    }
    if (control_.ended() || crowded_) {
      // What was not joined yet may be one piece: one of them is shown.
      if (control_.ended()) result.reason = "the analysis was ended by a limit";
      if (control_.ended() && known.size() > 1) known.erase(std::next(known.begin()), known.end());
      result.at_least = known.empty() ? 0 : 1;
    } else {
      result.at_least = static_cast<int>(known.size());
    }
    if (result.at_most && !result.exact()) result.reason = "links or gaps between cells that could not be shown";
    const UpwardRounding rounding;
    std::map<std::size_t, int> numbers;
    for (const auto& [root, p] : known) numbers.emplace(root, static_cast<int>(numbers.size()));
    for (const Part& part : parts_)
      if (const auto n = numbers.find(classes.find_set(static_cast<std::size_t>(&part - parts_.data()))); n != numbers.end())
        result.parts.push_back({part.cell, part.signs, n->second});
    for (const auto& [root, p] : known) {
      const SignCell& cell = cells_.cells()[parts_[p].cell];
      Box at = cell.sides;
      for (const int f : cells_.free(cell))
        at[static_cast<std::size_t>(f)] = Interval(cell.sides[static_cast<std::size_t>(f)].mid());
      const std::optional<Box> point = cell.mixed.empty() ? cells_.solution_over(cell, at) : parts_[p].solution;
      result.representatives.push_back(point.value_or(cell.sides));
      result.free.push_back(cells_.free(cell));
      result.signs.emplace_back(parts_[p].signs.begin(), parts_[p].signs.end() - cells_.limits());
    }
  }

  struct End {
    std::size_t part, other;
    Box point;
  };

  // Two parts, why they are of one piece, and by which sheet of its own, if any.
  struct Joined {
    std::size_t part, other;
    std::vector<PieceLink> links;
    std::optional<SheetBridge> bridge;
  };

  SignCells& cells_;
  certify::MeetingTest test_;
  solve::Control& control_;
  std::vector<Part> parts_;
  std::vector<std::map<Signs, std::size_t>> part_of_;  // of each cell
  std::optional<BoxTree> tree_;
  std::vector<End> ends_;
  std::vector<Joined> joined_;
  bool crowded_ = false;  // some cell's parts are not even listed
  boost::disjoint_sets_with_storage<> proven_;
};

symbolic::ExpressionMatrix block(const study::Question& question, symbolic::SingularitySet set) {
  return symbolic::kernel_question(question.model, set, symbolic::KernelSide::left).matrix;
}

// Of the determinant of a square matrix at each of the boxes.
std::vector<int> signs_of_determinant(const symbolic::TrigonometricSystem& equations, const System& system,
                                      const symbolic::ExpressionMatrix& matrix, const std::vector<Box>& boxes) {
  std::vector<symbolic::Expression> entries;
  for (const auto& row : matrix.rows) entries.insert(entries.end(), row.begin(), row.end());
  const certify::CompiledSystem compiled(system, symbolic::polynomials(equations, entries));
  const int n = static_cast<int>(matrix.rows.size());
  const UpwardRounding rounding;
  std::vector<int> result;
  for (const Box& box : boxes) {
    certify::IntervalMatrix values(n, n);
    for (int k = 0; k < n * n; ++k)
      values.entries[static_cast<std::size_t>(k)] = compiled.evaluate(compiled.value_row(k), box);
    const Interval value = certify::determinant(values);
    result.push_back(value.lo() > 0 ? 1 : value.hi() < 0 ? -1 : 0);
  }
  return result;
}

}  // namespace

Pieces pieces(SignCells& cells, solve::Control& control) { return PieceCounter(cells, control).count(); }

Aspects aspects(study::Question question, const AspectsOptions& options, solve::Control& control) {
  Aspects result;
  question.set = symbolic::SingularitySet::cspace;
  const symbolic::TrigonometricSystem equations = study::equations(question);
  result.system = study::system(question, equations);
  const symbolic::ExpressionMatrix l_y = block(question, symbolic::SingularitySet::forward);
  const symbolic::ExpressionMatrix l_z = block(question, symbolic::SingularitySet::inverse);
  std::vector<symbolic::Expression> forward, inverse;
  const Ended ended = [&control] { return control.ended(); };
  try {
    forward = symbolic::determinant_factors(question.model, l_y, ended);
    inverse = symbolic::determinant_factors(question.model, l_z, ended);
  } catch (const symbolic::DeterminantTooLarge& error) {
    result.reason = error.what();
    return result;
  }
  for (const auto& e : forward) result.forward_factors.push_back(e.text());
  for (const auto& e : inverse) result.inverse_factors.push_back(e.text());

  solve::Options search;
  search.threads = options.threads;
  search.proof = options.certificate;
  search.proof_of_parts = false;
  const std::vector<Interval> domain = result.system.domain();
  search.sigma = 2 * std::max_element(domain.begin(), domain.end(),
                                      [](const Interval& a, const Interval& b) { return a.width() < b.width(); })
                         ->width() +
                 2;  // sheets are not cut
  const Cover cover = solve::solve(solve::prepare(result.system, search, control), control);
  for (const CoverBox& box : cover.boxes)
    if (box.verdict != Verdict::regular && box.verdict != Verdict::boundary) {
      result.reason = "C-space is not shown to be smooth in the search domain";
      return result;
    }
  result.system = with_single_values(std::move(result.system));
  if (!cover.complete() || static_cast<int>(result.system.equations.size()) + cover.dimension != result.system.size()) {
    result.reason = control.ended() ? "the analysis was ended by a limit" : "C-space could not be covered";
    return result;
  }
  if (options.certificate) result.cover = std::make_shared<const Cover>(cover);
  std::vector<symbolic::Expression> both = forward;
  std::vector<LocusFactors> loci{{true, forward}, {false, inverse}};
  for (std::size_t k = 0; k < forward.size(); ++k) loci[0].functions.push_back(k);
  for (const auto& e : inverse) {
    const auto same = std::find_if(forward.begin(), forward.end(), [&](const auto& f) { return same_tree(e, f); });
    loci[1].functions.push_back(same == forward.end() ? both.size() : static_cast<std::size_t>(same - forward.begin()));
    if (same == forward.end()) both.push_back(e);
  }
  std::vector<Polynomial> ends;
  const std::vector<Limit> touched = limits(result.system, cover);
  for (const Limit& limit : touched) ends.push_back(limit.function);
  std::uint64_t processed = 0;
  if (!touched.empty())
    for (const Limit& limit : without_unreached(result.system, touched, {.threads = options.threads}, processed, control))
      result.limits.push_back(limit.name);
  const auto count = [&](const std::vector<symbolic::Expression>& functions, bool first) {
    SignCells cells(result.system, cover, symbolic::polynomials(equations, functions), ends);
    cells.refine(options.halvings, options.rounds, control);
    Pieces found = pieces(cells, control);
    const bool plane = cover.dimension == 2 && options.images.size() == 2 && found.exact();
    const int x = plane ? result.system.find(options.images[0]) : -1, y = plane ? result.system.find(options.images[1]) : -1;
    if (first && x >= 0 && y >= 0) result.images = images(cells, found, x, y, options.rows, control);
    if (first && !options.drawn.empty()) result.drawing = draw(cells, found, options.drawn, ended);
    if (first && options.cusps) result.cusps = aspect_cusps(question, loci, cells, found, options.threads, control);
    if (first && options.placed) result.places = piece_places(cells, found, options.placed->boxes, control);
    return found;
  };
  result.aspects = count(both, true);
  if (result.cusps && cover.dimension == 2 && result.limits.empty())
    check_parity(question, options.threads, control, *result.cusps);
  const std::vector<Box>& at = result.aspects.representatives;
  const std::vector<int> y = signs_of_determinant(equations, result.system, l_y, at);
  const std::vector<int> z = signs_of_determinant(equations, result.system, l_z, at);
  for (std::size_t k = 0; k < at.size(); ++k) result.determinant_signs.push_back({y[k], z[k]});
  result.assembly_modes = count(forward, false);
  result.working_modes = count(inverse, false);
  return result;
}

}  // namespace corank::analyze
