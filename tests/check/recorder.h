// A small search that records why a cover is complete, for tests of the replay: contraction by every row and a Newton step,
// then a leaf where that suffices, else a split.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/certify/projection.h"
#include "corank/core/cover.h"
#include "corank/core/rounding.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/step/preconditioner.h"

namespace corank::check {

class Recorder {
 public:
  Recorder(const System& system, const Cover& cover)
      : reduction_(solve::reduce(system)), compiled_(reduction_.system), factory_(compiled_), cover_(cover) {}

  Proof run() {
    const UpwardRounding rounding;
    std::vector<Interval> x;
    for (const Interval& side : reduction_.system.domain()) x.push_back(side);
    proof_.roots = {x};
    visit(x, 0);
    return std::move(proof_);
  }

 private:
  void step(Proof::Step s, std::initializer_list<int> integers = {}, std::initializer_list<double> reals = {}) {
    proof_.steps.push_back(static_cast<std::uint8_t>(s));
    proof_.integers.insert(proof_.integers.end(), integers.begin(), integers.end());
    proof_.reals.insert(proof_.reals.end(), reals.begin(), reals.end());
  }

  // Shrinks x and records how; false: empty.
  bool contract(std::vector<Interval>& x) {
    std::vector<std::uint8_t> changed(x.size());
    for (int row = 0; row < compiled_.rows(); ++row) {
      step(Proof::Step::row, {row});
      if (!certify::project(compiled_, row, x, 0.1, changed.data())) return false;
    }
    keep(x);
    certify::Preconditioner p = factory_.at_midpoint(x);
    Proof::Combination combination{p.equations, p.dependent, {}};
    for (double& y : p.y) combination.y.push_back(static_cast<float>(y)), y = combination.y.back();
    step(Proof::Step::newton, {static_cast<int>(proof_.combinations.size())});
    proof_.combinations.push_back(combination);
    if (certify::NewtonStep(compiled_, p, x, workspace_).outcome().empty) return false;
    keep(x);
    return true;
  }

  void keep(const std::vector<Interval>& x) {
    step(Proof::Step::keep, {static_cast<int>(2 * x.size())});
    for (std::size_t j = 0; j < x.size(); ++j)
      for (const int upper : {0, 1}) {
        proof_.integers.push_back(static_cast<int>(2 * j) + upper);
        proof_.reals.push_back(upper ? x[j].hi() : x[j].lo());
      }
  }

  // A box of the cover whose proof speaks of all of x; −1: none. Where a box's free side ends within x, `variable` and
  // `place` say where.
  int box_of(const std::vector<Interval>& x, int& variable, double& place) const {
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i) {
      const CoverBox& box = cover_.boxes[i];
      const Box& region = box.region < 0 ? box.box : cover_.regions[static_cast<std::size_t>(box.region)];
      bool inside = true, meets = true;
      int cut_variable = -1;
      double cut_place = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const int j = reduction_.kept[k];
        const auto v = static_cast<std::size_t>(j);
        const bool is_free = std::find(box.free.begin(), box.free.end(), j) != box.free.end();
        if (!is_free) inside = inside && region[v].contains(x[k]);
        if (!is_free || box.box[v].contains(x[k])) continue;
        meets = meets && box.box[v].lo() < x[k].hi() && x[k].lo() < box.box[v].hi();
        for (const double end : {box.box[v].lo(), box.box[v].hi()})
          if (x[k].lo() < end && end < x[k].hi()) cut_variable = static_cast<int>(k), cut_place = end;
      }
      if (!inside || !meets) continue;
      if (cut_variable < 0) return static_cast<int>(i);
      variable = cut_variable;
      place = cut_place;
    }
    return -1;
  }

  void visit(std::vector<Interval> x, int depth) {
    if (depth > 60) throw std::runtime_error("the recorder finds no end");
    if (!contract(x)) return step(Proof::Step::empty);
    int variable = -1;
    double place = 0;
    if (const int i = box_of(x, variable, place); i >= 0) return step(Proof::Step::box, {i});
    if (variable < 0) {
      variable = 0;
      for (std::size_t j = 1; j < x.size(); ++j)
        if (x[j].width() > x[static_cast<std::size_t>(variable)].width()) variable = static_cast<int>(j);
      place = x[static_cast<std::size_t>(variable)].lo() + 0.47 * x[static_cast<std::size_t>(variable)].width();
    }
    step(Proof::Step::split, {variable}, {place});
    const Interval side = x[static_cast<std::size_t>(variable)];
    for (const Interval& part : {Interval(side.lo(), place), Interval(place, side.hi())}) {
      x[static_cast<std::size_t>(variable)] = part;
      visit(x, depth + 1);
    }
  }

  const certify::Reduction reduction_;
  const certify::CompiledSystem compiled_;
  solve::PreconditionerFactory factory_;
  certify::NewtonWorkspace workspace_;
  const Cover& cover_;
  Proof proof_;
};

}  // namespace corank::check
