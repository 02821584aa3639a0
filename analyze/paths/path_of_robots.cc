#include "corank/analyze/paths/path_of_robots.h"

#include <algorithm>

#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_value.h"

namespace corank::analyze {
namespace {

constexpr int kEffort = 4000;  // cells of a piece that are tried

// The file's nodes in the system's variables: a tolerance that the file's robots do not have is in no section.
std::vector<TubeNode> nodes_in(const System& system, const result::PathFile& file) {
  const std::size_t n = file.variables.size();
  std::vector<TubeNode> result;
  for (const TubeNode& node : file.tube.nodes) {
    TubeNode own{{}, node.values, {}};
    for (std::size_t i = 0; i <= node.values.size(); ++i)
      for (const Variable& v : system.variables) {
        const auto at = std::ranges::find(file.variables, v.name) - file.variables.begin();
        const bool there = at < static_cast<std::ptrdiff_t>(n);
        if (i < node.values.size()) own.rows.push_back(there ? node.rows[i * n + at] : 0.0);
        if (i == node.values.size()) own.box.push_back(there ? node.box[at] : v.domain);
      }
    result.push_back(std::move(own));
  }
  return result;
}

bool has_its_variables(const System& system, const result::PathFile& file) {
  const auto known = [&](const Variable& v) { return std::ranges::find(file.variables, v.name) != file.variables.end(); };
  const auto own = std::ranges::count_if(system.variables, [&](const Variable& v) { return known(v); });
  return own + std::ranges::count_if(system.variables, [&](const Variable& v) { return v.is_parameter() && !known(v); }) ==
             system.size() &&
         own == std::ssize(file.variables);
}

}  // namespace

PathOfRobots::PathOfRobots(const study::Question& question, Avoid avoid, const result::PathFile& file)
    : space_(question, avoid, 0),
      avoid_(avoid),
      prover_(space_.system(), space_.matrices(), space_.ranks(), space_.distances()),
      compiled_(space_.system()),
      domain_(space_.system()) {
  const System& system = space_.system();
  if (!has_its_variables(system, file) || static_cast<int>(file.tube.nodes.front().values.size()) != space_.dimension())
    throw question_error(question, "the path is one of another mechanism", "a path of this model");
  nodes_ = nodes_in(system, file);
  for (int j = 0; j < system.size(); ++j) {
    const Variable& v = system.variables[j];
    if (!v.is_parameter()) continue;
    const auto constant = std::ranges::find(question.model.constants(), v.name, &symbolic::Constant::name);
    parameters_.push_back(j);
    drawn_values_.push_back(symbolic::exact_value(question.model, constant->value, v.name));
    drawn_.push_back(drawn_values_.back().enclose());
    tolerances_.push_back(v.domain);
  }
  families_.resize(nodes_.size() - 1);
}

SolutionFamily& PathOfRobots::family(std::size_t piece) {
  if (!families_[piece]) {
    std::vector<int> free = parameters_;
    free.push_back(space_.size());
    const System system = certify::piece_system(space_.system(), nodes_[piece], nodes_[piece + 1]);
    families_[piece] = std::make_unique<SolutionFamily>(system, free);
  }
  return *families_[piece];
}

Box PathOfRobots::free_sides(const std::vector<Interval>& robots, const Interval& t) const {
  Box box(space_.size() + 1, Interval());
  for (std::size_t k = 0; k < parameters_.size(); ++k) box[parameters_[k]] = robots[k];
  box.back() = t;
  return box;
}

// The pieces hang together, and with the drawn robot's path, at p = v (SolutionFamily::cover, whose theorem holds of two
// pieces' boxes as well).
bool PathOfRobots::cover(const std::vector<Interval>& robots, std::vector<std::vector<SolutionFamily::Cell>>& cells,
                         const solve::Control& control) {
  const auto keeps = [&](const Box& image) {
    const UpwardRounding rounding;
    return prover_.is_free(configuration(image));
  };
  cells.assign(families_.size(), {});
  for (std::size_t k = 0; k < families_.size(); ++k) {
    Values middle = points_[k];
    for (std::size_t j = 0; j < middle.size(); ++j) middle[j] = (middle[j] + points_[k + 1][j]) / 2;
    int effort = kEffort;
    if (!family(k).cover(free_sides(robots, Interval(0.0, 1.0)), middle, keeps, cells[k], effort, control)) return false;
    std::optional<Box> start = family(k).solution(free_sides(drawn_, Interval(0.0)), points_[k]);
    if (!start || !holds(cells[k], *start)) return false;
    if (k == 0) {
      if (!drawn_cells_.empty() && !holds(drawn_cells_[0], *start)) return false;
    } else {
      start->back() = Interval(1.0);
      if (!holds(cells[k - 1], *start)) return false;
    }
  }
  return true;
}

std::string PathOfRobots::drawn(const solve::Control& control) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t piece = std::min(k, families_.size() - 1);
    Values x = midpoint(nodes_[k].box);
    for (std::size_t j = 0; j < parameters_.size(); ++j) x[parameters_[j]] = drawn_[j].mid();
    x.push_back(k == piece ? 0 : 1);
    if (!family(piece).approach(x)) return "a node of the path is no configuration of the robot as drawn";
    points_.push_back(x);
  }
  for (std::size_t j = 0; j < parameters_.size(); ++j) nodes_[0].box[parameters_[j]] = drawn_[j];
  const std::optional<Box> start = family(0).solution(free_sides(drawn_, Interval(0.0)), points_[0]);
  bool meets = start.has_value();
  for (int j = 0; meets && j < space_.size(); ++j) meets = (*start)[j].overlaps(nodes_[0].box[j]);
  if (!meets) return "the path does not begin in a configuration of the robot as drawn";
  {
    const UpwardRounding rounding;
    signs_ = space_.signs(configuration(*start));
  }
  std::vector<std::vector<SolutionFamily::Cell>> cells;
  if (!cover(drawn_, cells, control)) return "the path is not proven for the robot as drawn";
  drawn_cells_ = std::move(cells);
  return "";
}

bool PathOfRobots::all_follow(const solve::Control& control) {
  std::vector<std::vector<SolutionFamily::Cell>> cells;
  return cover(tolerances_, cells, control);
}

}  // namespace corank::analyze
