// Expressions, equations and matrices in MathML Core, which browsers set without any help: for pages that load nothing.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Presentation elements without <math> around them.
std::string mathml(const Expression& e);
std::string mathml(const Relation& relation);
std::string mathml_name(const std::string& name);
/// An <mtable class="matrix">; its parentheses are the style's to draw, for few fonts have tall ones.
std::string mathml(const ExpressionMatrix& matrix);
/// `<math>…</math>` around it, on a line of its own where `block`.
std::string math(const std::string& inside, bool block = false);

}  // namespace corank::symbolic
