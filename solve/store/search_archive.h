// How the values of a search, and what it is about, are written and read by cereal (solve/store/byte_archive.h).
#pragma once

#include <cereal/types/map.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>

#include "corank/core/exact_number.h"
#include "corank/solve/step/options.h"
#include "corank/solve/store/byte_archive.h"
#include "corank/solve/store/shard.h"

// Each type beside the namespace that it lives in, where the archive looks for it.
namespace corank {

void save(auto& archive, const Interval& x) { archive(x.lo(), x.hi()); }
void load(auto& archive, Interval& x) {
  double lo = 0, hi = 0;
  archive(lo, hi);
  if (!(lo <= hi)) throw solve::ShardError("a part of a search holds an interval without a number");
  x = Interval(lo, hi);
}

// Without its sides (solve/store/packed_found.h).
void serialize(auto& archive, CoverBox& b) {
  archive(b.verdict, b.free, b.region, b.point, b.kernel_at_most, b.motion, b.reason);
}
void serialize(auto& archive, Statistics& s) {
  archive(s.processed, s.newton_steps, s.proofs_tried, s.seconds_total, s.seconds_search, s.seconds_certify);
}
void serialize(auto& archive, Proof::Combination& c) { archive(c.equations, c.dependent, c.y); }
void serialize(auto& archive, Proof& p) { archive(p.roots, p.steps, p.integers, p.reals, p.combinations); }
void save(auto& archive, const ExactNumber& x) { archive(x.prefix()); }
void load(auto& archive, ExactNumber& x) {
  std::string text;
  archive(text);
  x = ExactNumber::from_prefix(text);
}

void serialize(auto& archive, Factor& f) { archive(f.variable, f.power, f.function); }
void serialize(auto& archive, Monomial& m) { archive(m.coefficient, m.enclosure, m.factors); }
void serialize(auto& archive, Polynomial& p) { archive(p.monomials, p.source); }
void serialize(auto& archive, Variable& v) {
  archive(v.name, v.kind, v.lower, v.upper, v.domain, v.lower_implied, v.upper_implied, v.auxiliary);
}
void serialize(auto& archive, Angle& a) { archive(a.name, a.cosine, a.sine, a.range); }
void serialize(auto& archive, PassageForm& f) {
  archive(f.equations, f.columns, f.jacobian, f.hessian, f.slack, f.has_slacks, f.normal, f.multipliers);
}

void serialize(auto& archive, PolynomialMatrix& m) { archive(m.rows, m.columns, m.entries); }

void serialize(auto& archive, System& s) {
  archive(s.name, s.variables, s.equations, s.inequalities, s.claimed, s.implied, s.angles, s.coefficient_tolerance,
          s.configuration_size, s.kernel_vectors, s.kernel_scales, s.passive_rates_eliminated, s.passage, s.singular);
}

void serialize(auto& archive, Elimination& e) { archive(e.variable, e.equation); }
void serialize(auto& archive, SumOfEquations& s) { archive(s.equation, s.other, s.factor); }
void serialize(auto& archive, ImpliedEquation::Multiple& p) { archive(p.equation, p.factor, p.product); }
void serialize(auto& archive, ImpliedEquation& e) { archive(e.parts); }
void serialize(auto& archive, Sigma& s) { archive(s.length, s.angle); }

namespace certify {

void serialize(auto& archive, Preconditioner& p) { archive(p.equations, p.dependent, p.y); }
void serialize(auto& archive, Sheet& s) { archive(s.proven, s.equations, s.motion, s.dependent, s.region, s.image); }
void serialize(auto& archive, Reduction::Definition& d) { archive(d.variable, d.value); }
void serialize(auto& archive, Reduction& r) {
  archive(r.system, r.kept, r.definitions, r.origins, r.given_equations, r.steps, r.tolerant, r.subset, r.consistent);
}

}  // namespace certify

namespace solve {

void serialize(auto& archive, Waiting& w) { archive(w.x, w.share, w.node); }
void serialize(auto& archive, Proven& p) { archive(p.x, p.sheet, p.node); }
void serialize(auto& archive, LocalSolution& s) { archive(s.x, s.rank); }
void serialize(auto& archive, Postponed& p) { archive(p.box, p.near, p.noisy, p.proof, p.step); }
void serialize(auto& archive, Work& w) { archive(w.boxes, w.postpone, w.until); }

void serialize(auto& archive, Options& o) {
  archive(o.sigma, o.sigma_length, o.sigma_angle, o.coarser, o.surfaces_whole, o.threads, o.max_boxes, o.max_found,
          o.max_solutions, o.time_limit, o.memory_limit, o.proof, o.roots);
}

void serialize(auto& archive, Prepared& p) { archive(p.system, p.reduction, p.options); }

}  // namespace solve
}  // namespace corank
