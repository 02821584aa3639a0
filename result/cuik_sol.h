// Solution files, RESULT.sol, in the CUIK suite's layout: a header of parameters and equations, one box to a line,
//
//   1 : <S> { 2  x[-1,0.5] y[0,1] } % regular, free x
//
// statistics and an end mark. What CUIK's own reader takes from a file is every "{ n [a,b] … [a,b] }", with any text in
// between; nothing else that we write holds a brace, so it finds our boxes and passes over our verdicts. `<S>` is its mark
// for a box that is proven to hold a solution. doc/cuik.md describes the format for users.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/result/hdf5_file.h"
#include "corank/result/result.h"

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

}  // namespace corank::result
