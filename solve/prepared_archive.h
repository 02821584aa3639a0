// The same of what a search is about: systems, reductions, options.
#pragma once

#include <cereal/types/variant.hpp>

#include "corank/core/exact_number_prefix.h"
#include "corank/solve/prepared.h"
#include "corank/solve/search_archive.h"

namespace corank {

template <class Archive>
void save(Archive& archive, const ExactNumber& x) {
  archive(to_prefix(x));
}
template <class Archive>
void load(Archive& archive, ExactNumber& x) {
  std::string text;
  archive(text);
  x = from_prefix(text);
}

template <class Archive>
void serialize(Archive& archive, Factor& f) {
  archive(f.variable, f.power, f.function);
}

template <class Archive>
void serialize(Archive& archive, Monomial& m) {
  archive(m.coefficient, m.enclosure, m.factors);
}

template <class Archive>
void serialize(Archive& archive, Polynomial& p) {
  archive(p.monomials, p.source);
}

template <class Archive>
void serialize(Archive& archive, Variable& v) {
  archive(v.name, v.kind, v.lower, v.upper, v.domain, v.lower_implied, v.upper_implied, v.auxiliary);
}

template <class Archive>
void serialize(Archive& archive, Angle& a) {
  archive(a.name, a.cosine, a.sine, a.range);
}

template <class Archive>
void serialize(Archive& archive, PassageForm& f) {
  archive(f.equations, f.columns, f.jacobian, f.hessian, f.slack, f.normal, f.multipliers);
}

template <class Archive>
void serialize(Archive& archive, System& s) {
  archive(s.name, s.variables, s.equations, s.inequalities, s.claimed, s.implied, s.angles, s.coefficient_tolerance,
          s.configuration_size, s.kernel_vectors, s.kernel_scales, s.passive_rates_eliminated, s.passage);
}

template <class Archive>
void serialize(Archive& archive, Elimination& e) {
  archive(e.variable, e.equation);
}

template <class Archive>
void serialize(Archive& archive, SumOfEquations& s) {
  archive(s.equation, s.other, s.factor);
}

template <class Archive>
void serialize(Archive& archive, ImpliedEquation::Part& p) {
  archive(p.equation, p.factor, p.product);
}

template <class Archive>
void serialize(Archive& archive, ImpliedEquation& e) {
  archive(e.parts);
}

template <class Archive>
void serialize(Archive& archive, Sigma& s) {
  archive(s.length, s.angle);
}

namespace certify {

template <class Archive>
void serialize(Archive& archive, Reduction::Definition& d) {
  archive(d.variable, d.value);
}

template <class Archive>
void serialize(Archive& archive, Reduction& r) {
  archive(r.system, r.kept, r.definitions, r.origins, r.given_equations, r.steps, r.tolerant, r.subset, r.consistent);
}

}  // namespace certify

namespace solve {

template <class Archive>
void serialize(Archive& archive, Options& o) {
  archive(o.sigma, o.sigma_length, o.sigma_angle, o.coarser, o.threads, o.max_boxes, o.max_found, o.max_solutions,
          o.time_limit, o.memory_limit, o.proof, o.roots);
}

template <class Archive>
void serialize(Archive& archive, Prepared& p) {
  archive(p.system, p.reduction, p.options);
}

}  // namespace solve
}  // namespace corank
