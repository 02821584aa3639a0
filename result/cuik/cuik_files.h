// The CUIK suite's files. doc/cuik.md describes them for users.
//
// Solutions, RESULT.sol, in the suite's layout: a header of parameters and equations, one box to a line,
//
//   1 : <S> { 2  x[-1,0.5] y[0,1] } % regular, free x
//
// statistics and an end mark. What CUIK's own reader takes from a file is every "{ n [a,b] … [a,b] }", with any text in
// between; nothing else that we write holds a brace, so it finds our boxes and passes over our verdicts. `<S>` is its mark
// for a box that is proven to hold a solution.
//
// Parameters, NAME.param: "SIGMA = 0.1", one after the other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/core/system.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/result.h"

namespace corank::result {

/// A CUIK file with a fault: what() is "file:line: what is wrong; expected what".
class CuikFileError : public ResultFileError {
 public:
  CuikFileError(const std::string& file, int line, const std::string& problem, const std::string& expectation);
  int line() const { return line_; }

 private:
  int line_;
};

/// The text of a file with this extension. Throws ResultFileError where it cannot be read.
std::string read_cuik_text(const std::filesystem::path& path, const std::string& extension);

struct SolBox {
  Box box;
  std::optional<Verdict> verdict;  ///< nothing where the file says nothing, as the CUIK suite's own
  std::vector<std::string> free;   ///< names of the free variables
};

/// The boxes of a file. Invariant: all boxes have the same number of sides, n, and variables holds n distinct names or none.
struct SolFile {
  std::vector<std::string> variables;
  std::vector<SolBox> boxes;

  int size() const {
    return boxes.empty() ? static_cast<int>(variables.size()) : static_cast<int>(boxes.front().box.size());
  }
  /// Index of a variable, given by its name or its number from 1; −1 where there is none.
  int find(const std::string& name_or_number) const;
};

/// The boxes of a text, bit for bit those of the result where it comes from to_sol; bounds of other programs are taken as
/// printed, to the nearest double. The lines "Newton [… { … }" of the CUIK suite's files are approximate points and no
/// boxes: they are passed over. Throws CuikFileError, never anything else, whatever the text (tests/fuzz).
SolFile parse_sol(std::string_view text, const std::string& file);
/// Throws CuikFileError, or ResultFileError where the file cannot be read.
SolFile read_sol(const std::filesystem::path& path);

/// The result in that layout. Auxiliary variables are left out, as the CUIK suite does: the others keep its numbering.
/// Bounds have 17 digits, or 18 where needed: rounded outward, and read back as the same doubles.
std::string to_sol(const Result& result);
/// Boxes alone, without header, as the CUIK suite's tools write them.
std::string to_sol(const SolFile& boxes);

/// The boxes of a result, all variables or only those that to_sol writes.
SolFile boxes_of(const Result& result, bool with_auxiliary = true);

/// "[-0.10000000000000001,0.5]".
std::string outward_interval_text(const Interval& x);

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
