#include "corank/analyze/postures/posture_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <mutex>
#include <numbers>
#include <sstream>

#include "corank/core/check.h"
#include "corank/core/threads.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;
using symbolic::ModelError;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");  // so that an empty last one counts
  for (std::string cell; std::getline(stream, cell, ',');) cells.emplace_back(symbolic::trimmed(cell));
  return cells;
}

double number_of(const std::string& text, const symbolic::SourceLocation& where) {
  double value = 0;
  const bool has_plus = text.starts_with('+') && !text.starts_with("+-");
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data() + has_plus, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    throw ModelError(where, "'" + text + "' is no number", "a number");
  return value;
}

// Is the value, but for whole turns of an angle, so near the interval?
bool is_near(double value, const Interval& at, bool is_angle, double tolerance) {
  double d = value - at.mid();
  if (is_angle) d = std::remainder(d, 2 * std::numbers::pi);
  return std::fabs(d) <= tolerance + at.width() / 2;
}

}  // namespace

int Table::column(const std::string& name) const {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

Table parse_table(const std::string& text, const std::string& file) {
  Table table;
  const std::string mark = "\xef\xbb\xbf";  // of UTF-8, which some programs put first
  std::istringstream stream(text.starts_with(mark) ? text.substr(mark.size()) : text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    line = line.substr(0, line.find_first_of("%#"));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::vector<std::string> cells = cells_of(line);
    if (table.names.empty()) {
      table.names = std::move(cells);
      for (const std::string& name : table.names)
        if (std::ranges::count(table.names, name) > 1)
          throw ModelError({file, number, 1}, "the column '" + name + "' occurs twice", "each name once");
      continue;
    }
    if (cells.size() != table.names.size())
      throw ModelError({file, number, 1}, fmt::format("{} values under {} names", cells.size(), table.names.size()),
                       "as many values as names, separated by commas");
    table.rows.push_back(std::move(cells));
    table.lines.push_back(number);
  }
  if (table.names.empty()) throw ModelError({file, 1, 1}, "the table is empty", "a line of names, and lines of values");
  return table;
}

PostureQuestion question_of(const Table& poses, const study::Question& question, const std::string& orientation_of) {
  PostureQuestion asked{.question = question, .given = {}, .orientation_of = orientation_of};
  for (const std::string& name : poses.names)
    if (std::ranges::find(kQuaternion, name) == kQuaternion.end()) asked.given.push_back(name);
  asked.orientation = asked.given.size() < poses.names.size();
  return asked;
}

std::vector<PoseRow> rows_of(const Table& poses, const std::string& file) {
  std::array<int, 4> columns{};
  for (std::size_t k = 0; k < 4; ++k) columns[k] = poses.column(kQuaternion[k]);
  const bool turned = std::ranges::any_of(columns, [](int c) { return c >= 0; });
  if (turned && std::ranges::any_of(columns, [](int c) { return c < 0; }))
    throw ModelError({file, 1, 1}, "the quaternion is not complete", "the columns qw, qx, qy and qz");
  std::vector<PoseRow> rows;
  for (std::size_t i = 0; i < poses.rows.size(); ++i) {
    const symbolic::SourceLocation where{file, poses.lines[i], 1};
    PoseRow& row = rows.emplace_back();
    for (std::size_t j = 0; j < poses.names.size(); ++j)
      if (std::ranges::find(kQuaternion, poses.names[j]) == kQuaternion.end())
        row.values.push_back(
            symbolic::parse_expression(poses.rows[i][j], file + ", line " + std::to_string(poses.lines[i])));
    if (!turned) continue;
    try {
      std::array<ExactNumber, 4> q;
      for (std::size_t k = 0; k < 4; ++k) q[k] = ExactNumber::rational(poses.rows[i][columns[k]]);
      row.orientation = rotation_of(q);
    } catch (const std::invalid_argument& error) {
      throw ModelError(where, std::string("the quaternion: ") + error.what(), "four numbers, not all 0");
    }
  }
  return rows;
}

std::vector<Postures> find_all(const PostureFinder& finder, const std::vector<PoseRow>& rows, int threads,
                               solve::Control& control,
                               const std::function<void(std::size_t done, std::size_t all)>& progress) {
  std::vector<Postures> all(rows.size());
  std::mutex mutex;
  std::size_t done = 0;
  ThreadArena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, rows.size(), std::size_t{1},
        [&](std::size_t i) {
          if (control.ended()) {
            all[i].stopped = solve::stopped_by(control);
            return;
          }
          solve::Control own(control.rest(0, 0));
          all[i] = finder.find(rows[i].values, rows[i].orientation, own);
          const std::lock_guard lock(mutex);
          if (progress) progress(++done, rows.size());
        },
        tbb::simple_partitioner());
  });
  return all;
}

std::string stopped_by(const std::vector<Postures>& postures) {
  const auto at = std::ranges::find_if(postures, [](const Postures& p) { return !p.stopped.empty(); });
  return at == postures.end() ? "" : at->stopped;
}

Comparison compare(const PostureFinder& finder, const std::vector<Postures>& proven, const Table& others,
                   const std::string& file, double tolerance) {
  const std::vector<std::string> names = finder.names();
  const int pose = others.column("pose");
  std::vector<int> columns;
  for (const std::string& name : names) columns.push_back(others.column(name));
  if (pose < 0 || std::ranges::any_of(columns, [](int c) { return c < 0; }))
    throw ModelError({file, 1, 1}, "a column is missing", fmt::format("pose, {}", fmt::join(names, ", ")));
  std::vector<bool> angles;
  for (const std::string& name : names) angles.push_back(finder.is_angle(name));
  Comparison result;
  std::vector<std::vector<bool>> seen;
  for (const Postures& p : proven) seen.emplace_back(p.found.size(), false);
  for (std::size_t i = 0; i < others.rows.size(); ++i) {
    const symbolic::SourceLocation where{file, others.lines[i], 1};
    if (std::ranges::all_of(columns, [&](int c) { return others.rows[i][c].empty(); })) continue;  // a pose without any
    const double number = number_of(others.rows[i][pose], where);
    if (!(number >= 1 && number <= static_cast<double>(proven.size())) || number != std::floor(number))
      throw ModelError(where, "there is no pose " + others.rows[i][pose], fmt::format("one of 1 to {}", proven.size()));
    Comparison::Difference other{static_cast<std::size_t>(number) - 1, {}};
    for (const int c : columns) other.values.push_back(number_of(others.rows[i][c], where));
    const Postures& at = proven[other.pose];
    bool agreed = false;
    for (std::size_t k = 0; k < at.found.size(); ++k) {
      bool equal = true;
      for (std::size_t j = 0; j < names.size() && equal; ++j)
        equal = is_near(other.values[j], at.found[k].values[j].value, angles[j], tolerance);
      if (equal) seen[other.pose][k] = agreed = true;
    }
    if (agreed)
      ++result.agreed;
    else
      (at.at_most() ? result.wrong : result.open).push_back(std::move(other));
  }
  for (std::size_t p = 0; p < proven.size(); ++p)
    for (std::size_t k = 0; k < proven[p].found.size(); ++k) {
      if (seen[p][k] || !proven[p].found[k].proven) continue;
      Comparison::Difference& lost = result.missing.emplace_back(Comparison::Difference{p, {}});
      for (const CoordinateValue& v : proven[p].found[k].values) lost.values.push_back(v.value.mid());
    }
  return result;
}

}  // namespace corank::analyze
