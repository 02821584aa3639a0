// Postures for each row of a table of poses, and how somebody else's solutions compare with them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corank/analyze/postures/postures.h"

namespace corank::analyze {

/// Lines of values, separated by commas, under a line of names. Text after % or # is a comment.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<int> lines;  ///< of the rows, in the text

  int column(const std::string& name) const;  ///< −1: there is none
};
/// Throws ModelError with the line, where a row has another number of values than there are names.
Table parse_table(const std::string& text, const std::string& file);

/// Columns of a table of poses that are no coordinates: a quaternion w + xi + yj + zk, of any length but 0.
inline constexpr std::array<const char*, 4> kQuaternion{"qw", "qx", "qy", "qz"};

struct PoseRow {
  std::vector<symbolic::Expression> values;
  std::optional<Rotation> orientation;
};
/// The question that the table's columns ask, and its rows. Throws ModelError with file and line.
PostureQuestion question_of(const Table& poses, const study::Question& question, const std::string& orientation_of);
std::vector<PoseRow> rows_of(const Table& poses, const std::string& file);

/// Of each row. Once the control has ended, rows are left without an answer: not complete, nothing found, but what stopped
/// it. The answers do not depend on the number of threads.
std::vector<Postures> find_all(const PostureFinder& finder, const std::vector<PoseRow>& rows, int threads,
                               solve::Control& control,
                               const std::function<void(std::size_t done, std::size_t all)>& progress = {});

/// How other solutions compare with those that are proven. Two are the same if all joints are, within a tolerance; angles
/// modulo whole turns.
struct Comparison {
  std::size_t agreed = 0;  ///< of the others
  struct Difference {
    std::size_t pose = 0;  ///< from 0
    std::vector<double> values;
  };
  std::vector<Difference> missing;  ///< proven postures that are not among the others
  std::vector<Difference> wrong;    ///< others that are proven to be no postures
  std::vector<Difference> open;     ///< others of which this is not known: at their pose not all postures are known
};
/// `others`: has a column "pose", the number of the row from 1, and one for each joint. Throws ModelError.
Comparison compare(const PostureFinder& finder, const std::vector<Postures>& proven, const Table& others,
                   const std::string& file, double tolerance);

/// pose, at_least, at_most, posture, and a column for each joint: a line for each posture; without any, a line for the pose.
std::string to_csv(const PostureFinder& finder, const std::vector<Postures>& postures);
/// {"model", "given", "poses": [{"postures", "proven", "at_least", "at_most", "families", "complete", …}]}, and with a
/// comparison "against": {"agreed", "missing", "wrong", "open"}, each of the last three a list of {"pose", "values"}.
std::string to_json(const PostureFinder& finder, const std::vector<Postures>& postures, const Comparison* comparison);
/// What ended the search of the first row that was ended early; empty where none was.
std::string stopped_by(const std::vector<Postures>& postures);
/// How many poses have how many postures; the comparison, where there is one.
std::string to_table(const PostureFinder& finder, const std::vector<Postures>& postures, const Comparison* comparison);

}  // namespace corank::analyze
