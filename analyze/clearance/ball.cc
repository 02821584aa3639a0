#include "corank/analyze/clearance/ball.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <regex>
#include <set>

#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::analyze {
namespace {

using symbolic::Coordinate;
using symbolic::CoordinateKind;
using symbolic::Expression;
using symbolic::Mechanism;
using symbolic::ModelError;

class BallMaker {
 public:
  BallMaker(const study::Question& question, const BallOptions& options) : question_(question), options_(options) {
    for (const symbolic::Limit& limit : effective_limits(question_.model)) limited_.insert(limit.coordinate);
    question_.model = center_model_ = model_ = limits_as_ranges(question_.model);
    constants_ = symbolic::constant_values(model_);
  }

  Ball make();

 private:
  ModelError error(const std::string& problem, const std::string& expectation) const {
    return question_error(question_, problem, expectation);
  }
  bool is_in_ball(const std::string& name) const { return std::ranges::find(options_.in, name) != options_.in.end(); }
  bool is_output_angle(const std::string& name) const {
    const std::vector<std::string>& outputs = question_.model.outputs();
    return coordinate(name).kind == CoordinateKind::angle && std::ranges::find(outputs, name) != outputs.end();
  }
  const NamedRange* given_range(const std::string& name) const {
    const auto given = std::ranges::find_if(options_.ranges, [&](const NamedRange& r) { return r.name == name; });
    return given == options_.ranges.end() ? nullptr : &*given;
  }
  const Coordinate& coordinate(const std::string& name) const;
  double value(const Expression& e) const;
  const Expression& value_at(const std::string& name) const;
  bool is_full_circle(const Coordinate& c) const {
    return c.kind == CoordinateKind::angle && value(c.upper) - value(c.lower) > 2 * std::numbers::pi - 1e-12;
  }
  // Of an angle's values that differ by whole turns the first one in its declared range, if any is.
  double turned(const Coordinate& c, double at) const;
  // Refuses a value outside the declared range.
  void check_value(const NamedValue& v) const;
  // Keeps an angle in its declared range by an inequality.
  static void keep_in_range(Mechanism& model, const Coordinate& c);
  // Keeps the coordinate in [lower, upper] and in its declared range.
  void narrow(Mechanism& model, const Coordinate& c, const Expression& lower, const Expression& upper) const;
  void add_center(const std::string& name);
  void limit_orientation();
  Rotation orientation() const;

  // The ball may reach as far as that, where it meets the end.
  void meet(double distance, const char* side, const std::string& what);

  study::Question question_;
  const BallOptions& options_;
  std::set<std::string> limited_;
  Mechanism model_, center_model_;
  std::map<std::string, double> constants_;
  Ball ball_;
};

const Coordinate& BallMaker::coordinate(const std::string& name) const {
  const int index = question_.model.find_coordinate(name);
  if (index >= 0) return question_.model.coordinates()[index];
  throw unknown_coordinate(question_, name);
}

double BallMaker::value(const Expression& e) const {
  const double v = symbolic::evaluate(e, constants_);
  if (!std::isfinite(v))
    throw error("'" + e.text() + "' has no value", "a number, or an expression in the model's constants");
  return v;
}

const Expression& BallMaker::value_at(const std::string& name) const {
  for (const NamedValue& v : options_.at)
    if (v.name == name) return v.value;
  throw error("'" + name + "' has no value", "a value for each of the ball's coordinates, as in --at " + name + "=0.5");
}

double BallMaker::turned(const Coordinate& c, double at) const {
  if (c.kind == CoordinateKind::length) return at;
  const double turn = 2 * std::numbers::pi;
  return at - turn * std::floor((at - value(c.lower)) / turn + 1e-12);
}

void BallMaker::check_value(const NamedValue& v) const {
  const Coordinate& c = coordinate(v.name);
  const double at = value(v.value);
  if (!c.has_range || is_full_circle(c)) return;
  const double lower = value(c.lower), upper = value(c.upper), slack = 1e-12 * std::max(1.0, std::fabs(at));
  if (turned(c, at) < lower - slack || turned(c, at) > upper + slack)
    throw error(fmt::format("{} = {:g} is outside its range [{:g}, {:g}]", v.name, at, lower, upper), "a value in it");
}

void BallMaker::keep_in_range(Mechanism& model, const Coordinate& c) {
  const Expression angle = Expression::symbol(c.name), middle = (c.lower + c.upper) / 2, half = (c.upper - c.lower) / 2;
  model.constrain(cos(angle - middle) >= cos(half), c.where, "range of " + c.name);
}

void BallMaker::narrow(Mechanism& model, const Coordinate& c, const Expression& lower, const Expression& upper) const {
  const double lo = value(lower), hi = value(upper);
  if (lo > hi)
    throw error(fmt::format("the range [{:g}, {:g}] of '{}' is empty", lo, hi, c.name), "a lower and an upper end");
  if (!c.has_range || is_full_circle(c)) {
    model.set_range(c.name, lower, upper);
  } else if (c.kind == CoordinateKind::length) {
    const bool above = lo >= value(c.lower), below = hi <= value(c.upper);
    if (hi < value(c.lower) || lo > value(c.upper))
      throw error(fmt::format("the range [{:g}, {:g}] of '{}' does not meet the model's [{:g}, {:g}]", lo, hi, c.name,
                              value(c.lower), value(c.upper)),
                  "one that does");
    model.set_range(c.name, above ? lower : c.lower, below ? upper : c.upper);
  } else {
    // Two ranges of an angle may meet in two pieces: one of them is an inequality.
    model.set_range(c.name, lower, upper);
    if (value(c.upper) > value(c.lower)) keep_in_range(model, c);
  }
}

void BallMaker::meet(double distance, const char* side, const std::string& what) {
  if (!(distance < ball_.room)) return;
  ball_.room = std::max(distance, 0.0);
  ball_.end = fmt::format("the {} {}", side, what);
}

void BallMaker::add_center(const std::string& name) {
  const Coordinate& c = coordinate(name);
  const Expression& at = value_at(name);
  ball_.center.push_back({name, at});
  const double a = value(at);
  const NamedRange* const given = given_range(name);
  if (given) {
    const double below = a - value(given->lower), above = value(given->upper) - a;
    if (below < 0 || above < 0)
      throw error(fmt::format("{} = {:g} is outside the range that is given for it", name, a), "a value in it");
    meet(below, "lower", "end of the range given for " + name);
    meet(above, "upper", "end of the range given for " + name);
  }
  if (c.has_range && !is_full_circle(c)) {
    const std::string what = (limited_.contains(name) ? "limit of " : "end of the range of ") + name;
    const double inside = turned(c, a);
    meet(inside - value(c.lower), "lower", what);
    meet(value(c.upper) - inside, "upper", what);
  }
  center_model_.set_range(name, at, at);
  if (c.kind == CoordinateKind::length) {
    if (given) narrow(model_, c, given->lower, given->upper);
    return;
  }
  const Expression half_turn = symbolic::pi();
  model_.unroll(name, given ? given->lower : at - half_turn, given ? given->upper : at + half_turn);
  if (!is_full_circle(c)) keep_in_range(model_, c);
}

Rotation BallMaker::orientation() const {
  std::vector<std::pair<std::string, Rotation>> found;
  for (const symbolic::Composite& c : question_.model.composites()) {
    if (c.kind != symbolic::Composite::Kind::rotation) continue;
    Rotation r;
    for (std::size_t k = 0; k < 9; ++k) r[k / 3][k % 3] = Expression::symbol(c.components[k]);
    found.emplace_back(c.name, r);
  }
  if (question_.assembly)
    for (const auto& pose : question_.assembly->poses) {
      Rotation r;
      bool moves = false;
      for (std::size_t k = 0; k < 9; ++k) {
        r[k / 3][k % 3] = pose.rotation[k / 3][k % 3];
        for (const Coordinate& c : question_.model.coordinates()) moves = moves || r[k / 3][k % 3].mentions(c.name);
      }
      if (moves) found.emplace_back(pose.link, r);
    }
  std::string names;
  for (const auto& [name, rotation] : found) {
    if (name == options_.orientation_of || (options_.orientation_of.empty() && found.size() == 1)) return rotation;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (found.empty()) throw error("it has no orientation in space", "a rotation matrix, or a robot from parts");
  throw error("the link or the matrix of the orientation is not given", "--orientation-of " + names);
}

// A turn by α at most of R0, trace(R0ᵀR) ≥ 1 + 2 cos α, moves no entry by more than 2 sin(α/2): that follows, and is quicker
// to use.
void BallMaker::limit_orientation() {
  if (!options_.orientation_range) {
    if (options_.orientation) throw error("the orientation has a value and no range", "--orientation-range 15deg");
    return;
  }
  const Expression& alpha = *options_.orientation_range;
  if (value(alpha) < 0) throw error("the range of the orientation is negative", "an angle, such as 15deg");
  bool used = options_.orientation.has_value();
  for (const NamedValue& v : options_.at) {
    if (is_in_ball(v.name) || !is_output_angle(v.name)) continue;
    narrow(model_, coordinate(v.name), v.value - alpha, v.value + alpha);
    used = true;
  }
  if (!used)
    throw error("the range of the orientation has no effect: no angle among the outputs has a value",
                "such a value, or --orientation R");
  if (!options_.orientation || value(alpha) >= std::numbers::pi) return;
  if (!(value(alpha) > 0))
    throw error("an orientation with one value has no range", "a model that keeps it: pose of LINK keeps R");
  const Rotation r = orientation(), &r0 = *options_.orientation;
  std::vector<Expression> trace;
  for (std::size_t k = 0; k < 9; ++k)
    if (!same_tree(r0[k / 3][k % 3], Expression(0))) trace.push_back(r0[k / 3][k % 3] * r[k / 3][k % 3]);
  model_.constrain(Expression::node(Expression::Kind::sum, trace) >= Expression(1) + 2 * cos(alpha), {},
                   "range of the orientation");
  for (std::size_t k = 0; k < 9; ++k) {
    const Expression &e = r[k / 3][k % 3], &e0 = r0[k / 3][k % 3], move = 2 * sin(alpha / 2);
    if (e.kind() != Expression::Kind::symbol) continue;
    model_.constrain(e <= e0 + move, {}, "range of the orientation");
    model_.constrain(e >= e0 - move, {}, "range of the orientation");
  }
}

Ball BallMaker::make() {
  if (symbolic::definition(question_.set).of_parts)
    throw error(
        fmt::format("the set {} has parts, each with equations of its own", symbolic::definition(question_.set).name),
        "a set that one system of equations describes, such as forward or inverse");
  ball_.room = std::numeric_limits<double>::infinity();
  if (options_.in.empty())
    throw error("the ball has no coordinates", "one or more of the model's coordinates, as in --in x,y");
  for (const NamedValue& v : options_.at) check_value(v);
  for (const NamedValue& v : options_.at) study::require_exact_value(question_.model, v.value, v.name);
  for (const NamedRange& r : options_.ranges)
    for (const Expression& end : {r.lower, r.upper})
      study::require_exact_value(question_.model, end, "the range of " + r.name);
  for (const std::string& name : options_.in) {
    if (std::ranges::count(options_.in, name) > 1) throw error("'" + name + "' is twice in the ball", "each once");
    add_center(name);
  }
  for (const NamedRange& r : options_.ranges)
    if (!is_in_ball(r.name)) {
      narrow(model_, coordinate(r.name), r.lower, r.upper);
      narrow(center_model_, coordinate(r.name), r.lower, r.upper);
    }
  for (const NamedValue& v : options_.at) {
    if (is_in_ball(v.name) || given_range(v.name)) continue;
    if (!options_.orientation_range || !is_output_angle(v.name)) model_.set_range(v.name, v.value, v.value);
    center_model_.set_range(v.name, v.value, v.value);
  }
  limit_orientation();
  ball_.question = {.model = model_,
                    .set = question_.set,
                    .kernel = question_.kernel,
                    .corank = question_.corank,
                    .tolerance = question_.tolerance};
  ball_.question.model.set_source_text(symbolic::to_model(ball_.question.model));
  ball_.assembled = center_model_;
  return ball_;
}

constexpr const char* kExpected = "a product of turns about the axes, such as Rz(1/5)*Ry(pi/10)*Rx(3/10)";

// The end of the parentheses that open at `from`; npos where they stay open.
std::size_t closing(const std::string& text, std::size_t from) {
  int depth = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string::npos;
}

}  // namespace

ModelError question_error(const study::Question& question, const std::string& problem, const std::string& expectation) {
  return {{question.model.name(), 0, 0}, problem, expectation};
}

ModelError unknown_coordinate(const study::Question& question, const std::string& name) {
  std::string known;
  for (const Coordinate& c : question.model.coordinates())
    if (!c.auxiliary) known += (known.empty() ? "" : ", ") + c.name;
  return question_error(question, "there is no coordinate '" + name + "'", "one of " + known);
}

std::string Ball::set_name() const { return symbolic::definition(question.set).name; }

std::vector<std::string> Ball::names() const {
  std::vector<std::string> result;
  for (const NamedValue& c : center) result.push_back(c.name);
  return result;
}

std::vector<Expression> Ball::differences() const {
  std::vector<Expression> result;
  for (const NamedValue& c : center) result.push_back(Expression::symbol(c.name) - c.value);
  return result;
}

Mechanism Ball::within(const Expression& radius) const {
  std::vector<Expression> squares;
  for (const Expression& d : differences()) squares.push_back(pow(d, 2));
  Mechanism model = question.model;
  model.constrain(Expression::node(Expression::Kind::sum, squares) <= pow(radius, 2), {}, "the ball");
  model.set_source_text(symbolic::to_model(model));
  return model;
}

Ball make_ball(const study::Question& question, const BallOptions& options) { return BallMaker(question, options).make(); }

Rotation parse_rotation(const std::string& text) {
  std::string rest = std::regex_replace(text, std::regex("\\s"), "");
  const auto refuse = [&] { return ModelError({"orientation", 0, 0}, "'" + text + "' is not a rotation", kExpected); };
  std::optional<kinematics::Pose> result;
  while (!rest.empty()) {
    if (result && rest[0] != '*') throw refuse();
    if (result) rest.erase(0, 1);
    const std::size_t axis = rest.size() > 3 && rest[0] == 'R' && rest[2] == '(' ? std::string("xyz").find(rest[1]) : 3;
    const std::size_t end = axis < 3 ? closing(rest, 2) : std::string::npos;
    if (end == std::string::npos) throw refuse();
    const kinematics::Pose turn =
        kinematics::rotation(static_cast<int>(axis), symbolic::parse_expression(rest.substr(3, end - 3), "orientation"));
    result = result ? *result * turn : turn;
    rest.erase(0, end + 1);
  }
  if (!result) throw refuse();
  return result->rotation;
}

}  // namespace corank::analyze
