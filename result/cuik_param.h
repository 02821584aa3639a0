// Parameter files of the CUIK suite, NAME.param: "SIGMA = 0.1", one after the other. doc/cuik.md lists every parameter and
// what becomes of it here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/core/system.h"
#include "corank/result/cuik_sol.h"

namespace corank::result {

/// The names of all parameters of the CUIK suite.
const std::vector<std::string>& cuik_parameters();

struct CuikParameters {
  std::optional<double> sigma;        ///< SIGMA > 0: largest edge of a box
  std::optional<double> small_sigma;  ///< SMALL_SIGMA > 0: the same for isolated solutions
  int n_solutions = 0;                ///< N_SOLUTIONS: proven boxes to find; 0: all
  std::vector<std::string> ignored;   ///< the parameters given that have no effect here, each once, in order
};

/// The σ that the parameters ask for, nothing where they have none: SIGMA; SMALL_SIGMA where the solutions are isolated (as
/// many equations as variables), 1e-4 being the CUIK suite's default of it. An over-determined system may have either kind
/// of solutions.
std::optional<double> sigma_for(const CuikParameters& parameters, const System& system);

/// Grammar: NAME = value, with blanks and line ends anywhere; comments %, #, // to the end of the line and /* … */; names in
/// capitals. A value is an expression of numbers, + − * / ^, parentheses, COS SIN TAN EXP LOG SQRT, PI, INF, TRUE, FALSE,
/// ON, OFF and parameters given before, or a word such as LINKS. A parameter given twice has its last value. Throws
/// CuikFileError with the line for anything else, an unknown parameter (with the nearest known name) among it; never
/// anything else, whatever the text (tests/fuzz).
CuikParameters parse_param(std::string_view text, const std::string& file);
/// Throws CuikFileError, or ResultFileError where the file cannot be read.
CuikParameters read_param(const std::filesystem::path& path);

}  // namespace corank::result
