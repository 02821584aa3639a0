#include "corank/analyze/postures/cuspidal.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "corank/analyze/clearance/json.h"
#include "corank/kinematics/equations/six_joints.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/limits.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;

// The ends of a path are within so much of the postures, in radians or the model's unit; and its tube is so many times
// wider, so that the postures themselves are in it.
constexpr double kNear = 1e-9, kWider = 1e3;
constexpr int kMostJoints = 7;  // of an arm whose determinant is factored
constexpr int kMostPairs = 6;   // of one pose

bool is_tree(const kinematics::Robot& robot) {
  return robot.joints.size() + 1 == robot.links.size() && robot.couplings.empty();
}

const kinematics::Output* turned_output(const kinematics::Robot& robot) {
  using Kind = kinematics::Output::Kind;
  const auto found =
      std::ranges::find_if(robot.outputs, [](const auto& o) { return o.kind == Kind::pose || o.kind == Kind::orientation; });
  return found == robot.outputs.end() ? nullptr : &*found;
}

// Coordinates of the model.
std::vector<std::string> inputs_of(const study::Question& question) {
  std::vector<std::string> names = question.model.inputs();
  if (names.empty() && question.assembly)
    for (const kinematics::Joint& j : question.assembly->robot->joints)
      if (j.actuated && question.model.find_coordinate(j.name) >= 0) names.push_back(j.name);
  return names;
}

Expression decimal(double x) { return symbolic::parse_expression(fmt::format("{:.17g}", x), "value"); }

class CuspidalSearch {
 public:
  CuspidalSearch(const study::Question& question, const CuspidalOptions& options, solve::Control& control)
      : question_(question),
        model_(symbolic::limits_as_ranges(question.model)),
        options_(options),
        control_(control),
        inputs_(inputs_of(question)) {
    const kinematics::Robot* robot = question.assembly ? question.assembly->robot.get() : nullptr;
    const bool is_arm = robot && is_tree(*robot);
    result_.of = options.of.value_or(is_arm ? Avoid::inverse : Avoid::forward);
    if (result_.of != Avoid::inverse && result_.of != Avoid::forward)
      throw question_error(question, "a robot is cuspidal with regard to one kind of singularities", "forward or inverse");
    if (inputs_.empty()) throw question_error(question, "it names no inputs", "a robot with motors");
    for (const std::string& name : inputs_) static_cast<void>(coordinate(name));
    if (result_.of == Avoid::forward) {
      given_ = inputs_;
    } else {
      if (robot && question.assembly->space != kinematics::Space::planar) hand_ = turned_output(*robot);
      for (const symbolic::Coordinate& c : model_.coordinates())
        if (is_output(c.name)) given_.push_back(c.name);
    }
    path_options_ = {.avoid = result_.of, .threads = options.threads, .sampling_seconds = options.path_seconds};
    if (is_arm) path_options_.factors_up_to = kMostJoints;
  }

  Cuspidality run() {
    if (const std::string why = told_apart(); !why.empty()) {
      result_.cuspidal = false;
      result_.complete = true;
      result_.reason = why;
      return std::move(result_);
    }
    result_.finder = std::make_shared<PathFinder>(question_, path_options_);
    postures_.emplace(PostureQuestion{.question = question_, .given = given_, .orientation = hand_ != nullptr});
    for (int tries = 0; tries < options_.poses && !control_.ended() && !result_.cuspidal; ++tries) {
      if (options_.progress) options_.progress(result_.poses, result_.same_sign);
      try_pose();
    }
    if (!result_.cuspidal) result_.stopped = solve::stopped_by(control_);
    result_.complete = result_.stopped.empty();
    if (!result_.cuspidal)
      result_.reason = !result_.complete ? "stopped by " + result_.stopped
                       : compared_ == 0  ? "no pose was found at which there are two postures"
                       : result_.same_sign == 0 && not_compared_ > 0
                           ? "no two postures of the same signs were found, but some were not compared"
                       : result_.same_sign == 0
                           ? fmt::format("at {} poses the signs of the determinants tell all postures apart", result_.poses)
                           : "no path was found between postures that no sign tells apart";
    return std::move(result_);
  }

 private:
  // Why three signs tell all postures of a pose apart, where a theorem says so.
  std::string told_apart() const {
    const std::string end = ": three signs tell all postures of a pose apart, and none changes without a singularity";
    if (!hand_ || hand_->kind != kinematics::Output::Kind::pose || hand_->relative_to != 0 || given_.size() != 3) return {};
    const auto arm = kinematics::signed_arm(*question_.assembly->robot, hand_->link);
    if (!arm) return {};
    switch (*arm) {
      case kinematics::SignedArm::spherical_wrist:
        return "the last three axes meet in a point, the first one is perpendicular to the second, which is parallel to the "
               "third" +
               end;
      case kinematics::SignedArm::three_parallel_axes:
        return "axes 2, 3 and 4 are parallel, axis 1 is perpendicular to them, axis 5 to axis 4, and axes 5 and 6 meet" +
               end;
    }
    return {};
  }

  bool is_output(const std::string& name) const {
    if (std::ranges::count(question_.model.outputs(), name) > 0) return true;
    if (!question_.assembly) return false;
    for (const kinematics::Output& o : question_.assembly->robot->outputs)
      if (std::ranges::count(position_names(o), name) > 0) return true;
    return false;
  }

  double any_value(const symbolic::Coordinate& c) {
    double lower = -std::numbers::pi, upper = std::numbers::pi;
    if (c.has_range) {
      lower = symbolic::exact_value(model_, c.lower, c.name).enclose().mid();
      upper = symbolic::exact_value(model_, c.upper, c.name).enclose().mid();
    }
    return std::round(1e6 * std::uniform_real_distribution<double>(lower, upper)(random_)) / 1e6;
  }

  const symbolic::Coordinate& coordinate(const std::string& name) const {
    const int index = model_.find_coordinate(name);
    if (index < 0) throw unknown_coordinate(question_, name);
    const symbolic::Coordinate& c = model_.coordinates()[index];
    if (is_fixed(c))
      throw question_error(question_, "the range of '" + name + "' has one value, so the robot is not free to move",
                           "the whole robot");
    return c;
  }

  // Values of the given coordinates, and an orientation, for which there is a configuration, if it is an arm; else any.
  bool choose_pose(std::vector<Expression>& values, std::optional<Rotation>& orientation) {
    result_.given.clear();
    if (result_.of == Avoid::forward) {
      for (const std::string& name : given_) take(name, any_value(coordinate(name)), values);
      return true;
    }
    std::vector<NamedValue> joints;
    for (const std::string& name : inputs_) joints.push_back({name, decimal(any_value(coordinate(name)))});
    std::vector<Box> boxes;
    try {
      boxes = result_.finder->ends(joints, control_);
    } catch (const EndError&) {
    }
    if (boxes.empty()) return false;
    const Box& box = boxes.front();
    const System& system = result_.finder->system();
    std::map<std::string, double> at;
    for (int j = 0; j < system.configuration_size; ++j) at[system.variables[j].name] = box[j].mid();
    for (const CoordinateValue& v : coordinate_values(system, box)) at[v.name] = v.value.mid();
    for (const std::string& name : given_) take(name, at.at(name), values);
    if (!hand_) return true;
    for (const symbolic::Constant& c : question_.model.constants()) at[c.name] = symbolic::evaluate(c.value, at);
    const std::string& link = question_.assembly->robot->links[hand_->link].name;
    const auto pose = std::ranges::find(question_.assembly->poses, link, &kinematics::Assembly::LinkPose::link);
    Eigen::Matrix3d r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r(i, j) = symbolic::evaluate(pose->rotation[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], at);
    const Eigen::Quaterniond q(r);
    result_.quaternion = {q.w(), q.x(), q.y(), q.z()};
    std::array<ExactNumber, 4> exact;
    for (std::size_t k = 0; k < 4; ++k) exact[k] = ExactNumber::dyadic((*result_.quaternion)[k]);
    orientation = rotation_of(exact);
    return true;
  }

  void take(const std::string& name, double value, std::vector<Expression>& values) {
    values.push_back(symbolic::parse_expression(ExactNumber::dyadic(value).text(), name));
    result_.given.push_back({name, Interval(value)});
  }

  void try_pose() {
    std::vector<Expression> values;
    std::optional<Rotation> orientation;
    if (!choose_pose(values, orientation)) return;
    ++result_.poses;
    const Postures found = postures_->find(values, orientation, control_);
    result_.most = std::max(result_.most, found.found.size());
    if (!found.at_most()) ++not_compared_;
    // Where each is in the space of paths, and the signs there.
    std::vector<std::optional<Box>> ends;
    std::vector<std::vector<int>> signs;
    for (const Posture& posture : found.found) {
      ends.push_back(posture.proven ? end_at(posture, values) : std::nullopt);
      signs.emplace_back();
      if (ends.back())
        for (const PathFinder::Sign& s : result_.finder->signs(*ends.back())) signs.back().push_back(s.sign);
    }
    int tried = 0;
    for (std::size_t a = 0; a < ends.size(); ++a)
      for (std::size_t b = a + 1; b < ends.size() && !control_.ended(); ++b) {
        const auto is_open = [&](std::size_t k) { return !ends[k] || std::ranges::count(signs[k], 0) > 0; };
        if (is_open(a) || is_open(b)) {
          ++not_compared_;
          continue;
        }
        ++compared_;
        if (signs[a] != signs[b]) continue;
        ++result_.same_sign;
        if (tried++ >= kMostPairs) return;
        Path path = result_.finder->find(*ends[a], *ends[b], control_);
        if (path.status != Path::Status::path || !path.tube || path.tube->radius() < kWider * kNear) continue;
        result_.cuspidal = true;
        result_.from = found.found[a].values;
        result_.to = found.found[b].values;
        result_.path = std::move(path);
        return;
      }
  }

  // The configuration at which the posture's coordinates have the middles of its values.
  std::optional<Box> end_at(const Posture& posture, const std::vector<Expression>& values) {
    std::vector<NamedValue> at;
    const auto add = [&](const CoordinateValue& v) {
      if (v.value.width() < kNear) at.push_back({v.name, decimal(v.value.mid())});
    };
    const std::vector<std::string> own = result_.of == Avoid::inverse ? inputs_ : question_.model.outputs();
    for (const CoordinateValue& v : posture.values)
      if (std::ranges::count(own, v.name) > 0) add(v);
    if (result_.of == Avoid::forward)
      for (std::size_t k = 0; k < given_.size(); ++k) at.push_back({given_[k], values[k]});
    for (const CoordinateValue& v : posture.values)
      if (std::ranges::count(own, v.name) == 0) add(v);
    try {
      std::vector<Box> boxes = result_.finder->ends(at, control_);
      if (boxes.size() != 1) return std::nullopt;
      for (const CoordinateValue& v : coordinate_values(result_.finder->system(), boxes.front())) {
        const auto own_value = std::ranges::find(posture.values, v.name, &CoordinateValue::name);
        if (own_value == posture.values.end()) continue;
        const double apart = v.value.mid() - own_value->value.mid();
        if (std::fabs(std::remainder(apart, 2 * std::numbers::pi)) > 10 * kNear && std::fabs(apart) > 10 * kNear)
          return std::nullopt;
      }
      return std::move(boxes.front());
    } catch (const EndError&) {
    }
    return std::nullopt;
  }

  const study::Question& question_;
  const symbolic::Mechanism model_;  // its limits are ranges
  const CuspidalOptions& options_;
  solve::Control& control_;
  const std::vector<std::string> inputs_;
  PathOptions path_options_;
  Cuspidality result_;
  const kinematics::Output* hand_ = nullptr;
  std::vector<std::string> given_;
  std::optional<PostureFinder> postures_;
  std::size_t compared_ = 0, not_compared_ = 0;  // pairs of postures
  std::mt19937 random_{2022};
};

}  // namespace

Cuspidality cuspidality(const study::Question& question, const CuspidalOptions& options, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  study::require_exact_constants(question.model, "corank cuspidal");
  Cuspidality result = CuspidalSearch(question, options, control).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string to_text(const Cuspidality& c, const std::string& model) {
  std::string text = fmt::format("{}: ", model);
  if (c.cuspidal == false) return text + fmt::format("not cuspidal, proven: {}\n", c.reason);
  const std::string poses = result::counted(c.poses, "pose") + " tried";
  if (!c.cuspidal) {
    text += fmt::format("open whether it is cuspidal, without {}: {}\n", in_words(c.of), c.reason);
    return text + fmt::format("{}, at most {}, {:.1f} s\n", poses, result::counted(c.most, "posture"), c.seconds);
  }
  text += fmt::format("cuspidal, proven: two postures joined without {}\n  at\n", in_words(c.of)) + value_lines(c.given);
  if (const auto& q = c.quaternion)
    text +=
        fmt::format("    orientation, a quaternion: {:.9g}, {:.9g}, {:.9g}, {:.9g}\n", (*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  text += "  from\n" + value_lines(c.from) + "  to\n" + value_lines(c.to);
  return text + fmt::format("  path of {}, radius {:.3g}\n{}, {:.1f} s\n",
                            result::counted(c.path->tube->pieces.size(), "piece"), c.path->tube->radius(), poses, c.seconds);
}

std::string to_json(const Cuspidality& c, const std::string& model, const std::string& file) {
  Json json = {{"model", model}, {"cuspidal", or_null(c.cuspidal)}, {"of", to_string(c.of)}, {"given", Json::object()}};
  if (c.path)
    for (const CoordinateValue& v : c.given) json["given"][v.name] = v.value.mid();
  json["quaternion"] = c.path && c.quaternion ? Json(*c.quaternion) : Json();
  json["from"] = c.path ? ends_of(c.from) : Json();
  json["to"] = c.path ? ends_of(c.to) : Json();
  json["radius"] = c.path ? Json(c.path->tube->radius()) : Json();
  json["certificate"] = c.path ? or_null(file) : Json();
  json["poses"] = c.poses;
  json["most_postures"] = c.most;
  json["same_sign"] = c.same_sign;
  json["reason"] = or_null(c.reason);
  json["complete"] = c.complete;
  json["stopped"] = or_null(c.stopped);
  json["seconds"] = c.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
