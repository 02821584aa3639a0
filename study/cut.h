// Results of surfaces and solids keep their proven sheets, or parts of them, whole (solve::Options::surfaces_whole), and
// those of arms may be about some joints alone. Who wants boxes cuts them.
#pragma once

#include <cstdint>
#include <functional>

#include "corank/result/values/result.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::study {

/// Are its sheets whole, wider than a picture of them should show, and can they be cut? Or do parts have no sides for an
/// arm's outputs, and would be surfaces at most with them?
bool is_whole(const result::Result& result);

/// The same set in boxes no wider than the options' σ, by default a share of the set's size (solve::recut), with their
/// labels; where parts lack outputs (is_whole), with all coordinates that these depend on. A proof of completeness stays
/// behind. Where the control ends the run, Result::stopped says so: what is not cut by then is `pending`, but a set, or a
/// part of it, of which nothing was cut stays whole. Throws result::ResultFileError where the equations' coefficients
/// carry a tolerance, so that the search itself depends on σ, or where another version of corank has made the result.
result::Result cut(result::Result result, const solve::Options& options, solve::Control& control);

/// cut() for a page of at most this many boxes, where the sheets alone are nearly as many of 5/4 of their number; 0: any
/// number. Where they do not fit σ is doubled, up to five times, within one limit of time; then the sheets stay whole.
result::Result cut_for_page(const result::Result& whole, solve::Options options, std::uint64_t most,
                            const solve::Control::Limits& limits,
                            const std::function<void(const solve::SearchProgress&)>& progress = {});

}  // namespace corank::study
