// Aspects of all robots within their tolerances: those of the one that was drawn, and whether every robot has as many.
#pragma once

#include <functional>

#include "corank/analyze/aspects/aspects.h"

namespace corank::analyze {

using AspectsOfOne = std::function<Aspects(study::Question, const AspectsOptions&, solve::Control&)>;

/// `of_one`: counts the aspects of a robot without tolerances.
Aspects aspects_of_robots(study::Question question, const AspectsOptions& options, const AspectsOfOne& of_one,
                          solve::Control& control);

/// Those of aspects, assembly modes and working modes that are exact.
ExactNumbers exact_numbers_of(const Aspects& aspects);

}  // namespace corank::analyze
