// The page of a path, as corank path and corank cuspidal write it.
#pragma once

#include <string>

#include "corank/report/html/path_page.h"
#include "corank/solve/step/control.h"
#include "corank/study/question.h"

namespace corank::app {

/// Its portraits show C-space, as a background, and the forward and inverse singularities, as far as these are found within
/// a few seconds each. `line`: what a user types for the same path; `tube`: the file with its proof; empty: none.
void write_path_page(const std::string& file, const study::Question& question, const report::PathView& view,
                     const std::string& line, const std::string& tube, int threads, const solve::Control& control);

}  // namespace corank::app
