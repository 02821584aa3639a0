#include "corank/analyze/postures/postures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>

#include "corank/analyze/postures/posture_parts.h"
#include "corank/core/check.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;
using symbolic::ModelError;

Expression number(const ExactNumber& x) { return symbolic::parse_expression(x.text(), "number"); }

}  // namespace

std::array<std::string, 3> position_names(const kinematics::Output& output) {
  return {output.name + "_x", output.name + "_y", output.name + "_z"};
}

Rotation rotation_of(const std::array<ExactNumber, 4>& q) {
  const auto& [w, x, y, z] = q;
  const ExactNumber n = w * w + x * x + y * y + z * z;
  if (n.is_zero()) throw std::invalid_argument("a quaternion that is 0 is no rotation");
  const auto entry = [&](const ExactNumber& e) { return number(e / n); };
  return {{{entry(w * w + x * x - y * y - z * z), entry(2 * (x * y - w * z)), entry(2 * (x * z + w * y))},
           {entry(2 * (x * y + w * z)), entry(w * w - x * x + y * y - z * z), entry(2 * (y * z - w * x))},
           {entry(2 * (x * z - w * y)), entry(2 * (y * z + w * x)), entry(w * w - x * x - y * y + z * z)}}};
}

int Postures::at_least() const {
  return static_cast<int>(std::ranges::count_if(found, [](const Posture& p) { return p.proven; }));
}

std::optional<int> Postures::at_most() const {
  if (!complete || !families.empty()) return std::nullopt;
  return static_cast<int>(found.size());
}

void PostureFinder::Parts::find_hand() {
  const std::string expected = "a robot from parts, one link of which has its pose or its orientation in space as output";
  if (!robot() || !robot()->equations.empty()) throw error("its equations do not say which orientation is meant", expected);
  if (question.question.assembly->space == kinematics::Space::planar)
    throw error("in a plane an orientation is an angle", "its value among the others");
  std::vector<std::string> links;
  const auto wanted = [&](const kinematics::Output& o) {
    const std::string& link = robot()->links[o.link].name;
    return question.orientation_of.empty() || link == question.orientation_of || o.name == question.orientation_of;
  };
  for (std::size_t k = 0; k < robot()->outputs.size(); ++k) {
    const kinematics::Output& o = robot()->outputs[k];
    if (o.kind != kinematics::Output::Kind::pose && o.kind != kinematics::Output::Kind::orientation) continue;
    const std::string& link = robot()->links[o.link].name;
    if (std::ranges::count(links, link) == 0) links.push_back(link);
    if (!wanted(o) || (hand && o.kind == kinematics::Output::Kind::orientation)) continue;
    hand = o.link;
    turned = k;
  }
  if (!hand)
    throw error("no such link has its orientation as output",
                links.empty() ? expected : fmt::format("one of {}", fmt::join(links, ", ")));
  if (question.orientation_of.empty() && links.size() > 1)
    throw error("several links have their orientation as output", fmt::format("one of them: {}", fmt::join(links, ", ")));
  const kinematics::Output& chosen = robot()->outputs[turned];
  if (chosen.relative_to != 0)
    throw error("the orientation is that of one link in another's frame", "an orientation in the world");
  if (chosen.kept) throw error("the model keeps the orientation of " + chosen.name, "no orientation beside that");
}

void PostureFinder::Parts::find_position() {
  // A joint between the ground and the hand would have nothing left to move.
  for (const kinematics::Joint& j : robot()->joints)
    if (std::min(j.ends[0].link, j.ends[1].link) == 0 && std::max(j.ends[0].link, j.ends[1].link) == *hand) return;
  for (const kinematics::Output& o : robot()->outputs) {
    using Kind = kinematics::Output::Kind;
    if (o.link != *hand || o.relative_to != 0 || (o.kind != Kind::pose && o.kind != Kind::position)) continue;
    const std::array<std::string, 3> names_of_it = position_names(o);
    std::array<std::size_t, 3> found{};
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto given = std::ranges::find(question.given, names_of_it[i]);
      all = all && given != question.given.end();
      found[i] = given - question.given.begin();
    }
    if (!all) continue;
    position = found;
    hand_point = o.point;
    return;
  }
}

// All values beside the position are those of joints that can be held.
void PostureFinder::Parts::find_locked() {
  kinematics::Robot held = *robot();
  std::vector<std::pair<std::size_t, std::size_t>> list;
  for (std::size_t k = 0; k < question.given.size(); ++k) {
    if (std::ranges::count(*position, k) > 0) continue;
    const int joint = held.find_joint(question.given[k]);
    if (joint < 0 || !held.lock(joint, 0)) return;
    list.emplace_back(joint, k);
  }
  locked = std::move(list);
}

kinematics::Robot PostureFinder::Parts::robot_at(const Values& values) const {
  kinematics::Robot held = *robot();
  for (const auto& [joint, k] : locked) held.lock(joint, values[k]);
  return held;
}

void PostureFinder::Parts::find_names() {
  const symbolic::Mechanism& model = question.question.model;
  const auto is_free = [&](const std::string& name) {
    return model.find_coordinate(name) >= 0 && std::ranges::count(question.given, name) == 0;
  };
  if (six) {
    for (const auto& angle : six->angles) names.push_back(angle.joint);
  } else if (hand) {  // whatever else the equations with this orientation are written in
    for (std::size_t j = 0; j < robot()->joints.size(); ++j)
      if (robot()->is_asked_for(j) && is_free(robot()->joints[j].name)) names.push_back(robot()->joints[j].name);
  } else {
    for (const symbolic::Coordinate& c : model.coordinates())
      if (!c.auxiliary && is_free(c.name)) names.push_back(c.name);
  }
}

PostureFinder::PostureFinder(PostureQuestion question) {
  auto parts = std::make_unique<Parts>();
  parts->question = std::move(question);
  Parts& p = *parts;
  const symbolic::Mechanism& model = p.question.question.model;
  study::require_exact_constants(model, "corank postures");
  for (const std::string& name : p.question.given) {
    if (model.find_coordinate(name) < 0) throw unknown_coordinate(p.question.question, name);
    if (std::ranges::count(p.question.given, name) > 1) throw p.error("'" + name + "' has two values", "one");
  }
  p.freedom = static_cast<int>(model.coordinates().size()) - static_cast<int>(model.equations().size()) -
              static_cast<int>(std::ranges::count_if(model.coordinates(), symbolic::is_fixed)) -
              static_cast<int>(p.question.given.size()) - (p.question.orientation ? 3 : 0);
  if (p.freedom > 0)
    throw p.error(fmt::format("these values leave {} of freedom", symbolic::counted(p.freedom, "degree")),
                  fmt::format("values of {}", symbolic::counted(p.freedom, "more coordinate")));
  if (p.question.orientation) {
    p.find_hand();
    p.find_position();
    if (p.position) p.find_locked();
  }
  if (p.is_whole_pose() && p.locked.empty()) p.six = kinematics::six_joints(*p.robot(), *p.hand);
  p.find_names();
  parts_ = std::move(parts);
}

PostureFinder::~PostureFinder() = default;
PostureFinder::PostureFinder(PostureFinder&&) noexcept = default;
const PostureQuestion& PostureFinder::question() const { return parts_->question; }

std::string PostureFinder::way() const {
  return parts_->six ? "six joints" : parts_->is_whole_pose() ? "hand held" : "coordinates held";
}

// Of the hand's frame.
std::array<Expression, 3> PostureFinder::Parts::origin_at(const Values& values, const Rotation& orientation) const {
  std::array<Expression, 3> origin;
  for (std::size_t i = 0; i < 3; ++i) {
    origin[i] = values[(*position)[i]];
    for (std::size_t j = 0; j < 3; ++j) origin[i] = origin[i] - orientation[i][j] * hand_point[j];
  }
  return origin;
}

symbolic::Mechanism PostureFinder::Parts::six_held(const Values& values, const Rotation& orientation) const {
  symbolic::Mechanism model = six->mechanism;
  const std::array<Expression, 3> origin = origin_at(values, orientation);
  for (std::size_t k = 0; k < 9; ++k) model.set_constant(kinematics::kHandPose[k], orientation[k / 3][k % 3]);
  for (std::size_t i = 0; i < 3; ++i) model.set_constant(kinematics::kHandPose[9 + i], origin[i]);
  return model;
}

symbolic::Mechanism PostureFinder::Parts::hand_held(const Values& values, const Rotation& orientation) const {
  kinematics::Robot held = robot_at(values);
  std::erase_if(held.outputs, [&](const kinematics::Output& o) { return o.link == *hand; });
  held.fix(held.links[0].name, held.links[*hand].name, {orientation, origin_at(values, orientation)});
  return kinematics::assemble(held).mechanism;
}

std::optional<symbolic::Mechanism> PostureFinder::Parts::coordinates_held(const Values& values,
                                                                          const std::optional<Rotation>& orientation) const {
  symbolic::Mechanism model = question.question.model;
  if (orientation) {
    kinematics::Robot kept = *robot();
    kept.outputs[turned].kept = kinematics::Pose{*orientation, {0, 0, 0}};
    model = kinematics::assemble(kept).mechanism;
  }
  model = symbolic::limits_as_ranges(std::move(model));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!is_in_range(model, question.given[k], values[k])) return std::nullopt;
    model.set_range(question.given[k], values[k], values[k]);
  }
  return model;
}

bool PostureFinder::Parts::is_in_range(const symbolic::Mechanism& model, const std::string& name, const Expression& value) {
  const symbolic::Coordinate& c = model.coordinates()[model.find_coordinate(name)];
  if (!c.has_range) return true;
  const Interval range = range_of(model, name, c.lower, c.upper), at = symbolic::exact_value(model, value, name).enclose();
  const double turn = 2 * std::numbers::pi;
  const bool angle = c.kind == symbolic::CoordinateKind::angle;
  if (angle && range.width() >= turn * (1 - 1e-12)) return true;
  const double turns = angle ? turn * std::floor((at.mid() - range.lo()) / turn + 1e-12) : 0;
  return at.hi() - turns >= range.lo() && at.lo() - turns <= range.hi();
}

std::vector<std::string> PostureFinder::names() const { return parts_->names; }

bool PostureFinder::is_angle(const std::string& name) const {
  if (parts_->six) return true;
  const symbolic::Mechanism& model = parts_->question.question.model;
  return model.coordinates()[model.find_coordinate(name)].kind == symbolic::CoordinateKind::angle;
}

std::optional<symbolic::Mechanism> PostureFinder::Parts::model_at(const Values& asked,
                                                                  const std::optional<Rotation>& turn) const {
  // In numbers: a value may name the model's constants, and nothing else.
  const auto exact = [&](const Expression& e, const std::string& name) {
    return number(symbolic::exact_value(question.question.model, e, name));
  };
  Values values;
  for (std::size_t k = 0; k < asked.size(); ++k) values.push_back(exact(asked[k], question.given[k]));
  std::optional<Rotation> orientation = turn;
  if (orientation)
    for (auto& row : *orientation)
      for (Expression& e : row) e = exact(e, "the orientation");
  if (!is_whole_pose()) return coordinates_held(values, orientation);
  for (const auto& [joint, k] : locked)
    if (!is_in_range(question.question.model, question.given[k], values[k])) return std::nullopt;
  return six ? six_held(values, *orientation) : hand_held(values, *orientation);
}

symbolic::Mechanism PostureFinder::equations(const std::vector<Expression>& values, const Rotation& orientation) const {
  const Parts& p = *parts_;
  if (!p.six)
    throw p.error("its postures have no equations in six angles",
                  "an arm of six revolute joints, with the position and the orientation of its hand");
  return p.six_held(values, orientation);
}

Postures PostureFinder::find(const std::vector<Expression>& values, const std::optional<Rotation>& orientation,
                             solve::Control& control, int threads) const {
  const auto start = std::chrono::steady_clock::now();
  std::optional<Parts> of_locked;
  if (!parts_->locked.empty()) {
    of_locked = *parts_;
    of_locked->six = kinematics::six_joints(parts_->robot_at(values), *parts_->hand);
  }
  const Parts& p = of_locked ? *of_locked : *parts_;
  CORANK_CHECK(values.size() == p.question.given.size() && orientation.has_value() == p.question.orientation);
  Postures result;
  const std::optional<symbolic::Mechanism> model = p.model_at(values, orientation);
  if (!model) {  // a value is outside its range
    result.complete = true;
    return result;
  }
  const symbolic::TrigonometricSystem equations =
      model->is_plain_system() ? symbolic::plain_system(*model)
                               : symbolic::singularity_system(*model, symbolic::SingularitySet::cspace);
  const solve::Prepared prepared =
      solve::prepare(symbolic::algebrize(equations), {.sigma = solve::kWhole, .threads = threads}, control);
  const Cover cover = solve::solve(prepared, control);
  result.processed = cover.statistics.processed;
  result.complete = cover.complete();
  p.take(prepared, cover, control, result);
  if (!result.complete) result.stopped = solve::stopped_by(control);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace corank::analyze
