#include "corank/analyze/postures/postures.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>

#include "corank/certify/angle.h"
#include "corank/core/check.h"
#include "corank/kinematics/equations/six_joints.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;
using symbolic::ModelError;

constexpr double kFine = 1e-10;  // σ of a posture: what follows from it is to have many digits
constexpr std::uint64_t kMostToNarrow = 10'000;
constexpr const char* kAxes[] = {"_x", "_y", "_z"};

Expression number(const ExactNumber& x) { return symbolic::parse_expression(x.text(), "number"); }

kinematics::Pose pose_of(const Rotation& rotation, const std::array<Expression, 3>& position) {
  kinematics::Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.rotation[i] = rotation[i], pose.translation[i] = position[i];
  return pose;
}

// Boxes that hold one solution each, as narrow as doubles make them, or nearly; as they are where that search says anything
// else.
std::vector<CoverBox> narrowed(solve::Prepared prepared, const std::vector<CoverBox>& isolated,
                               const solve::Control& control) {
  if (isolated.empty()) return isolated;  // no roots would be all of the domain
  prepared.options.sigma = std::max(kFine, solve::smallest_sigma(prepared.system).largest());
  for (const CoverBox& point : isolated) prepared.options.roots.push_back(point.box);
  solve::Control own(control.rest(0, kMostToNarrow));
  Cover cover = solve::solve(prepared, own);
  const bool same = cover.points.size() == isolated.size() && std::ranges::all_of(cover.points, [](const CoverBox& point) {
                      return point.verdict == Verdict::isolated;
                    });
  return same ? std::move(cover.points) : isolated;
}

Interval whole_turn() { return {-std::numbers::pi, std::nextafter(std::numbers::pi, 4.0)}; }

}  // namespace

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

struct PostureFinder::Parts {
  PostureQuestion question;
  std::optional<std::size_t> hand;                   // the link whose orientation is given, in the robot
  std::array<std::optional<std::size_t>, 3> origin;  // its position's components among the given coordinates
  std::optional<kinematics::SixJoints> six;

  const kinematics::Robot* robot() const {
    return question.question.assembly ? question.question.assembly->robot.get() : nullptr;
  }
  bool is_whole_pose() const {
    return hand && question.given.size() == 3 && std::ranges::all_of(origin, [](const auto& k) { return k.has_value(); });
  }
  ModelError error(const std::string& problem, const std::string& expected) const {
    return question_error(question.question, problem, expected);
  }
  void find_hand();

  using Values = std::vector<Expression>;
  symbolic::Mechanism hand_held(const Values& values, const Rotation& orientation) const;
  symbolic::Mechanism coordinates_held(const Values& values, const std::optional<Rotation>& orientation) const;
  std::vector<CoordinateValue> values_of(const System& system, const Box& box) const;
  void check_value(const symbolic::Mechanism& model, const std::string& name, const Expression& value) const;
  void check_dimension(const System& reduced) const;
};

void PostureFinder::Parts::find_hand() {
  const std::string expected = "a robot from parts, one link of which has its pose or its orientation in space as output";
  if (!robot()) throw error("its equations do not say which orientation is meant", expected);
  std::string names;
  const kinematics::Output* chosen = nullptr;
  for (const kinematics::Output& o : robot()->outputs) {
    using Kind = kinematics::Output::Kind;
    if (o.kind != Kind::pose && o.kind != Kind::orientation) continue;
    const std::string& link = robot()->links[o.link].name;
    names += (names.empty() ? "" : ", ") + link;
    if (question.orientation_of.empty() ? chosen == nullptr
                                        : link == question.orientation_of || o.name == question.orientation_of)
      chosen = &o;
  }
  if (!chosen) throw error("no such link has its orientation as output", names.empty() ? expected : "one of " + names);
  if (question.orientation_of.empty() && names.find(", ") != std::string::npos)
    throw error("several links have their orientation as output", "one of them: " + names);
  if (chosen->relative_to != 0)
    throw error("the orientation is that of one link in another's frame", "an orientation in the world");
  if (chosen->kept) throw error("the model keeps the orientation of " + chosen->name, "no orientation beside that");
  hand = chosen->link;
  if (chosen->kind != kinematics::Output::Kind::pose) return;
  bool at_origin = true;
  for (const Expression& e : chosen->point) at_origin = at_origin && same_tree(e, Expression(0));
  for (std::size_t i = 0; at_origin && i < 3; ++i) {
    const auto given = std::ranges::find(question.given, chosen->name + kAxes[i]);
    if (given != question.given.end()) origin[i] = given - question.given.begin();
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
  if (p.question.orientation) p.find_hand();
  if (p.is_whole_pose()) p.six = kinematics::six_joints(*p.robot(), *p.hand);
  parts_ = std::move(parts);
}

PostureFinder::~PostureFinder() = default;
PostureFinder::PostureFinder(PostureFinder&&) noexcept = default;
const PostureQuestion& PostureFinder::question() const { return parts_->question; }

std::string PostureFinder::way() const {
  return parts_->six ? "six joints" : parts_->is_whole_pose() ? "hand held" : "coordinates held";
}

symbolic::Mechanism PostureFinder::Parts::hand_held(const Values& values, const Rotation& orientation) const {
  kinematics::Robot held = *robot();
  std::erase_if(held.outputs, [&](const kinematics::Output& o) { return o.link == *hand; });
  held.fix(held.links[0].name, held.links[*hand].name,
           pose_of(orientation, {values[*origin[0]], values[*origin[1]], values[*origin[2]]}));
  return kinematics::assemble(held).mechanism;
}

symbolic::Mechanism PostureFinder::Parts::coordinates_held(const Values& values,
                                                           const std::optional<Rotation>& orientation) const {
  symbolic::Mechanism model = question.question.model;
  if (orientation) {
    kinematics::Robot kept = *robot();
    for (kinematics::Output& o : kept.outputs)
      if (o.link == *hand) o.kept = pose_of(*orientation, {0, 0, 0});
    model = kinematics::assemble(kept).mechanism;
  }
  model = symbolic::limits_as_ranges(std::move(model));
  for (std::size_t k = 0; k < values.size(); ++k) {
    check_value(model, question.given[k], values[k]);
    model.set_range(question.given[k], values[k], values[k]);
  }
  return model;
}

void PostureFinder::Parts::check_value(const symbolic::Mechanism& model, const std::string& name,
                                       const Expression& value) const {
  const symbolic::Coordinate& c = model.coordinates()[model.find_coordinate(name)];
  if (!c.has_range) return;
  const auto number = [&](const Expression& e) { return symbolic::exact_value(model, e, name).enclose(); };
  const Interval range = Interval::hull(number(c.lower), number(c.upper)), at = number(value);
  const double turn = 2 * std::numbers::pi;
  const bool angle = c.kind == symbolic::CoordinateKind::angle;
  if (angle && range.width() >= turn * (1 - 1e-12)) return;
  const double turns = angle ? turn * std::floor((at.mid() - range.lo()) / turn + 1e-12) : 0;
  if (at.hi() - turns < range.lo() || at.lo() - turns > range.hi())
    throw error(fmt::format("{} = {:.9g} is outside its range [{:.9g}, {:.9g}]", name, at.mid(), range.lo(), range.hi()),
                "a value in it");
}

void PostureFinder::Parts::check_dimension(const System& reduced) const {
  const int freedom = reduced.size() - static_cast<int>(reduced.equations.size());
  if (freedom > 0)
    throw error(fmt::format("these values leave {} degree{} of freedom", freedom, freedom == 1 ? "" : "s"),
                fmt::format("values of {} more coordinate{}", freedom, freedom == 1 ? "" : "s"));
  if (freedom < 0)
    throw error(fmt::format("these values are {} more than the robot has degrees of freedom", -freedom), "fewer values");
}

std::vector<CoordinateValue> PostureFinder::Parts::values_of(const System& system, const Box& box) const {
  std::vector<CoordinateValue> all = coordinate_values(system, box);
  if (!six) {
    std::erase_if(all, [&](const CoordinateValue& v) { return std::ranges::count(question.given, v.name) > 0; });
    return all;
  }
  std::vector<CoordinateValue> joints;
  for (const kinematics::SixJoints::Angle& angle : six->angles) {
    if (!angle.coordinate.empty()) {
      joints.push_back(*std::ranges::find(all, angle.coordinate, &CoordinateValue::name));
      continue;
    }
    Interval range = whole_turn();
    const auto value = [&](const Expression& e) { return symbolic::exact_value(six->mechanism, e, angle.joint).enclose(); };
    if (angle.range) range = Interval::hull(value(angle.range->lower), value(angle.range->upper));
    joints.push_back(
        {angle.joint, certify::angle_enclosure(box[system.find(angle.cosine)], box[system.find(angle.sine)], range)});
  }
  return joints;
}

std::vector<std::string> PostureFinder::names() const {
  std::vector<std::string> names;
  if (parts_->six) {
    for (const auto& angle : parts_->six->angles) names.push_back(angle.joint);
    return names;
  }
  for (const symbolic::Coordinate& c : parts_->question.question.model.coordinates())
    if (!c.auxiliary && std::ranges::count(parts_->question.given, c.name) == 0) names.push_back(c.name);
  return names;
}

bool PostureFinder::is_angle(const std::string& name) const {
  if (parts_->six) return true;
  const symbolic::Mechanism& model = parts_->question.question.model;
  return model.coordinates()[model.find_coordinate(name)].kind == symbolic::CoordinateKind::angle;
}

Postures PostureFinder::find(const std::vector<Expression>& values, const std::optional<Rotation>& orientation,
                             solve::Control& control, int threads) const {
  const auto start = std::chrono::steady_clock::now();
  const Parts& p = *parts_;
  CORANK_CHECK(values.size() == p.question.given.size() && orientation.has_value() == p.question.orientation);
  symbolic::Mechanism model;
  if (p.six) {
    model = p.six->mechanism;
    for (std::size_t k = 0; k < 9; ++k) model.set_constant(kinematics::kHandPose[k], (*orientation)[k / 3][k % 3]);
    for (std::size_t i = 0; i < 3; ++i) model.set_constant(kinematics::kHandPose[9 + i], values[*p.origin[i]]);
  } else {
    model = p.is_whole_pose() ? p.hand_held(values, *orientation) : p.coordinates_held(values, orientation);
  }
  const symbolic::TrigonometricSystem equations =
      model.is_plain_system() ? symbolic::plain_system(model)
                              : symbolic::singularity_system(model, symbolic::SingularitySet::cspace);
  const System system = symbolic::algebrize(equations);
  const solve::Prepared prepared = solve::prepare(system, {.sigma = solve::kWhole, .threads = threads}, control);
  if (prepared.reduction.consistent && !control.ended()) p.check_dimension(prepared.reduction.system);
  const Cover cover = solve::solve(prepared, control);
  Postures result;
  result.processed = cover.statistics.processed;
  result.complete = cover.complete();
  std::map<int, PostureFamily> families;  // by their self-motion
  const auto include_values = [&](PostureFamily& family, const Box& box) {
    std::vector<CoordinateValue> at = p.values_of(system, box);
    if (family.values.empty()) family.values = at;
    for (std::size_t k = 0; k < at.size(); ++k) family.values[k].value = Interval::hull(family.values[k].value, at[k].value);
  };
  std::vector<CoverBox> isolated;
  for (const CoverBox& point : cover.points) {
    if (point.verdict == Verdict::isolated) {
      isolated.push_back(point);
    } else if (point.verdict == Verdict::exact || point.verdict == Verdict::boundary) {
      result.found.push_back({p.values_of(system, point.box), point.verdict == Verdict::exact});
    } else {
      include_values(result.families.emplace_back(), point.box);
    }
  }
  for (const CoverBox& point : narrowed(prepared, isolated, control))
    result.found.push_back({p.values_of(system, point.box)});
  // Undecided boxes along a set are no points.
  const bool in_points =
      std::ranges::any_of(cover.points, [](const CoverBox& point) { return point.verdict == Verdict::undecided; });
  std::optional<PostureFamily> undecided;
  for (const CoverBox& box : cover.boxes) {
    if (box.verdict == Verdict::pending) result.complete = false;
    if (!in_points && (box.verdict == Verdict::undecided || box.verdict == Verdict::partial)) {
      if (!undecided) undecided.emplace().dimension = cover.observed_dimension;
      include_values(*undecided, box.box);
    }
    if (box.free.empty()) continue;
    PostureFamily& family = families[box.motion];
    family.dimension = static_cast<int>(box.free.size());
    family.proven = true;
    include_values(family, box.box);
  }
  for (auto& [motion, family] : families) result.families.push_back(std::move(family));
  if (undecided) result.families.push_back(std::move(*undecided));
  const auto key = [](const Posture& posture) {
    std::vector<double> middle;
    for (const CoordinateValue& v : posture.values) middle.push_back(v.value.mid());
    return middle;
  };
  std::ranges::sort(result.found, [&](const Posture& a, const Posture& b) { return key(a) < key(b); });
  if (const auto ending = control.ending()) result.stopped = to_string(*ending);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace corank::analyze
