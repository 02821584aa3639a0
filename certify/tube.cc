#include "corank/certify/tube.h"

#include <algorithm>
#include <cmath>

#include "corank/certify/meeting.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr int kHalvings = 5;  // of a box in which a matrix is to have its rank, and bodies their distance

System without_inequalities(System system) {
  system.inequalities.clear();
  system.claimed.clear();
  system.implied.clear();
  system.passage.reset();
  return system;
}

// All sides but free ones.
bool has_spare_room(const Sheet& sheet) {
  constexpr double kSpare = 0.06;
  for (const int j : sheet.dependent) {
    const Interval &outer = sheet.region[j], &inner = sheet.image[j];
    const double spare = kSpare * outer.width();
    if (inner.lo() - outer.lo() < spare || outer.hi() - inner.hi() < spare) return false;
  }
  return true;
}

std::vector<Interval> inflated(std::vector<Interval> x) {
  constexpr double kRoom = 0.25, kTiny = 1e-11;
  for (std::size_t j = 0; j + 1 < x.size(); ++j) {
    const double room = kRoom * x[j].width() + kTiny * (1 + x[j].mag());
    x[j] += Interval(-room, room);
  }
  return x;
}

void add_term(Polynomial& f, double coefficient, Factors factors) {
  if (coefficient != 0) f.monomials.emplace_back(ExactNumber::dyadic(coefficient), std::move(factors));
}

}  // namespace

System piece_system(System system, const TubeNode& a, const TubeNode& b) {
  System result = without_inequalities(std::move(system));
  const int n = result.size();
  result.variables.emplace_back("t", VariableKind::auxiliary, ExactNumber(0), ExactNumber(1));
  const auto at = [](int v) { return Factors{{v}}; };
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    // (1 − t)(T·x − c) + t (T'·x − c') term by term: the coefficients are those doubles.
    Polynomial f;
    for (int j = 0; j < n; ++j) {
      const std::size_t k = i * n + j;
      add_term(f, a.rows[k], at(j));
      if (a.rows[k] == b.rows[k]) continue;
      const ExactNumber change = ExactNumber::dyadic(b.rows[k]) - ExactNumber::dyadic(a.rows[k]);
      f.monomials.emplace_back(change, Factors{{j}, {n}});
    }
    add_term(f, -a.values[i], {});
    const ExactNumber change = ExactNumber::dyadic(a.values[i]) - ExactNumber::dyadic(b.values[i]);
    if (!change.is_zero()) f.monomials.emplace_back(change, at(n));
    result.equations.push_back(std::move(f));
  }
  return result;
}

TubeProver::TubeProver(const System& system, const std::vector<PolynomialMatrix>& matrices, std::vector<int> ranks,
                       const KeptDistances& distances)
    : bare_(without_inequalities(system)), compiled_(system), domain_(system), distances_(system, distances) {
  CORANK_CHECK(matrices.size() == ranks.size());
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    bounds_.emplace_back(system, matrices[k]);
    most_.push_back(matrices[k].columns - ranks[k]);
  }
}

Sheet TubeProver::prove(const TubeNode& a, const TubeNode& b, std::vector<Interval> x) {
  CORANK_CHECK(UpwardRounding::active());
  const CompiledSystem compiled(piece_system(bare_, a, b));
  if (compiled.equations() != compiled_.unknowns()) return {};
  compiled_.free_parameters(x);
  const std::vector<int> dependent = all_but(compiled_.parameters(), bare_.size());
  return newton_prove(compiled, midpoint_preconditioner(compiled, midpoint(x), dependent), x, workspace_);
}

std::optional<Box> TubeProver::node(const std::vector<double>& rows, const std::vector<double>& values,
                                    const std::vector<double>& near) {
  constexpr double kRadius = 1e-11, kRoom = 1e-14;
  const TubeNode node{rows, values, {}};
  std::vector<Interval> x;
  for (const double c : near) x.emplace_back(c - kRadius * (1 + std::fabs(c)), c + kRadius * (1 + std::fabs(c)));
  x.emplace_back(0.0);
  Sheet sheet = prove(node, node, std::move(x));
  if (!sheet.proven) return std::nullopt;
  sheet.image.pop_back();
  // A little room, for whoever proves it again with another Y.
  for (Interval& side : sheet.image) side += Interval(-1, 1) * Interval(kRoom * (1 + side.mag()));
  compiled_.free_parameters(sheet.image);
  return std::move(sheet.image);
}

std::optional<Box> TubeProver::piece(const TubeNode& a, const TubeNode& b) {
  Box x = a.box;
  include(x, b.box);
  x.emplace_back(0.0, 1.0);
  // Proven in a box with room to spare, for whoever proves it again with another Y. A side that is as wide as the others
  // make it follows them one step later.
  constexpr int kTries = 6;
  for (int tries = 0; tries < kTries; ++tries) {
    Sheet sheet = prove(a, b, x);
    if (!sheet.proven) return std::nullopt;
    if (has_spare_room(sheet)) {
      sheet.region.pop_back();
      compiled_.free_parameters(sheet.region);
      if (!contains(sheet.region, a.box) || !contains(sheet.region, b.box)) return std::nullopt;
      return std::move(sheet.region);
    }
    x = inflated(std::move(sheet.image));
  }
  return std::nullopt;
}

bool TubeProver::is_free(const Box& piece, double r, const std::vector<double>& sizes) const {
  CORANK_CHECK(UpwardRounding::active() && sizes.size() == piece.size());
  Box box = piece;
  for (std::size_t j = 0; j < box.size(); ++j) box[j] += Interval(-r, r) * Interval(sizes[j]);
  compiled_.free_parameters(box);  // of robots outside their tolerances nothing is said
  return is_free(box);
}

bool TubeProver::is_free(const Box& box) const {
  CORANK_CHECK(UpwardRounding::active());
  if (domain_.locate(compiled_, box) != Location::inside) return false;
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    if (bounds_[k].at_most(box, kHalvings) > most_[k]) return false;
  return distances_.holds(box, kHalvings);
}

bool TubeProver::joins(const Box& a, const Box& b, const Box& within) {
  MeetingTest test(bare_);
  double reach = 0;  // of both boxes from the middle of the first, in the units of sheet_about
  for (const int j : all_but(compiled_.parameters(), bare_.size())) {
    const Interval side = Interval::hull(a[j], b[j]) - Interval(a[j].mid());
    reach = std::max(reach, side.mag() / compiled_.scales()[j]);
  }
  for (const double radius : {1e-9, 1e-7, 1e-5, 1e-4, 1.1 * reach, 2 * reach}) {
    const Sheet piece = test.sheet_about(a, radius);
    if (piece.proven && contains(piece.region, a) && contains(piece.region, b) && contains(within, piece.region))
      return true;
  }
  return false;
}

}  // namespace corank::certify
