// Derivations and systems as text for people (text, latex) and for programs (cuik).
#pragma once

#include <span>
#include <string>

#include "corank/core/system.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Φ, Φ_q or the L that the model gives, L_y, L_z and the system, aligned, in trigonometric form. Of a set in parts the
/// first system; of each other one the ranges and equations that the first has not, and the numbers of those that it has.
std::string to_text(const Derivation& derivation, std::span<const TrigonometricSystem> systems);
/// The same as a LaTeX fragment (amsmath).
std::string to_latex(const Derivation& derivation, std::span<const TrigonometricSystem> systems);
/// A compiled system as a .cuik file of polynomial equations that read_model accepts; every coefficient is exact (a finite
/// decimal, or a quotient or an expression where there is none).
std::string to_cuik(const System& system);

/// A mechanism as text of the model language, for people to read on: one thing to a line, names aligned.
/// parse_model reads it back as an equal mechanism: the same names, kinds, ranges, trees of expressions and order of
/// everything, with the constants' values as they are now. What the language has no words for is left out or a comment: the
/// mechanism's name, notes of constraints, a unit of length that is no name. Requires what validate() asks for.
std::string to_model(const Mechanism& mechanism);

}  // namespace corank::symbolic
