// A kernel vector ξ in equations: its unknowns' names, the rows of M diag(s) ξ = 0, the norm, and the half-space that drops
// −ξ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// The place that speaks for the whole model where no line does.
SourceLocation model_place(const Mechanism& mechanism);

/// xi1 … xin, the prefix made longer until no name of the mechanism is among them; of several vectors xi1_1 …, xi2_1 …
std::vector<std::string> kernel_names(const Mechanism& mechanism, std::size_t n, std::size_t vectors,
                                      std::string prefix = "xi");

/// A scale's text as a number. Throws ModelError where it is not positive: a scale of 0 would make every configuration
/// singular.
Expression positive_number(const std::string& text, const std::string& unknown);
std::vector<Expression> symbols(const std::vector<std::string>& names);
/// s_j ξ_j of each unknown; no scales: all are 1.
std::vector<Expression> scaled(const std::vector<std::string>& unknowns, const std::vector<std::string>& scales);

/// entry · unknown, written short.
Expression times(const Expression& entry, const Expression& unknown);
/// Σ terms_i, term by term.
Expression sum_of(const std::vector<Expression>& terms);
/// Σ entries[j]·unknowns[j], term by term in order; nothing where all entries are 0.
std::optional<Expression> kernel_row(const std::vector<Expression>& entries, const std::vector<Expression>& unknowns);

/// Σ x_i² and Σ x_i y_i, term by term.
Expression square_of(const std::vector<Expression>& x);
Expression dot(const std::vector<Expression>& x, const std::vector<Expression>& y);
/// a·x, a the fixed generic vector of one kernel vector: a_i = 0.3 + 0.7·frac((i + 1)·golden ratio) to four digits, so that
/// no mechanism's symmetry makes a·ξ = 0 on a whole piece of a singularity set.
Expression generic_form(const std::vector<Expression>& x);

}  // namespace corank::symbolic
