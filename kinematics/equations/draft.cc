#include "corank/kinematics/equations/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {

using symbolic::CoordinateKind;
using symbolic::ModelError;

std::string Draft::identifier(const std::string& name) {
  std::string result;
  for (const char c : name) result += std::isalnum(static_cast<unsigned char>(c)) || c == '_' ? c : '_';
  if (result.empty() || std::isdigit(static_cast<unsigned char>(result[0]))) result.insert(0, "_");
  return result;
}

std::string Draft::free_name(const std::string& wanted) {
  std::string name = identifier(wanted);
  const auto taken = [&](const std::string& candidate) {
    return symbolic::is_reserved(candidate) || names_.contains(candidate) || algebra_.constants().contains(candidate);
  };
  while (taken(name)) name += "_";
  names_.insert(name);
  return name;
}

ex Draft::angle(const std::string& name, const std::optional<Range>& range, const SourceLocation& where) {
  const std::string free = free_name(name);
  coordinates_.push_back({free, CoordinateKind::angle, range, false, false, where});
  return algebra_.coordinate(free);
}

ex Draft::length(const std::string& name, const std::optional<Range>& range, const SourceLocation& where, bool auxiliary) {
  const std::string free = free_name(name);
  coordinates_.push_back({free, CoordinateKind::length, range, auxiliary, false, where});
  return algebra_.coordinate(free);
}

void Draft::limit_last() {
  DraftCoordinate& c = coordinates_.back();
  // A range of one value is a part of the motion that is looked at.
  if (c.range && algebra_.sign(algebra_.constant(c.range->upper, c.where) - algebra_.constant(c.range->lower, c.where)) != 0)
    c.limit = c.range;
}

void Draft::slice(const ex& angle, const Range& range, const std::string& what, const SourceLocation& where) {
  const std::string name = GiNaC::ex_to<GiNaC::symbol>(angle).get_name();
  const auto c = std::ranges::find_if(coordinates_, [&](const DraftCoordinate& d) { return d.name == name; });
  const ex lower = algebra_.constant(range.lower, where), upper = algebra_.constant(range.upper, where);
  bool meets_limit = false;
  if (c->range) {
    const int above = algebra_.sign(lower - algebra_.constant(c->range->lower, where)),
              below = algebra_.sign(algebra_.constant(c->range->upper, where) - upper);
    if (above < 0 || below < 0)
      throw ModelError(where, what + " goes beyond that of '" + name + "'",
                       "a range within [" + c->range->lower.text() + ", " + c->range->upper.text() + "]");
    meets_limit = c->limit && (above == 0 || below == 0);
  }
  if (meets_limit && algebra_.sign(upper - lower) > 0) {  // the limit is one still
    if (const std::optional<Arc> own = arc(range, where))
      at_least_zero(
          GiNaC::cos(angle) * GiNaC::cos(own->middle) + GiNaC::sin(angle) * GiNaC::sin(own->middle) - GiNaC::cos(own->half),
          "slice of " + name, where);
    return;
  }
  c->range = range;
  c->limit.reset();
}

std::optional<Draft::Arc> Draft::arc(const Range& range, const SourceLocation& where) const {
  const ex lower = algebra_.constant(range.lower, where), upper = algebra_.constant(range.upper, where);
  const ex middle = (lower + upper) / 2, half = (upper - lower) / 2;
  return algebra_.sign(half - GiNaC::Pi) < 0 ? std::optional(Arc{middle, half}) : std::nullopt;
}

Draft::JointCoordinate Draft::joint_angle(std::size_t joint, const std::string& name) {
  if (robot_.is_coupled(joint)) return common(joint, true);
  const Joint& of = robot_.joints[joint];
  const ex own = angle(name, of.range(), of.where);
  limit_last();
  return {own};
}

Draft::JointCoordinate Draft::joint_way(std::size_t joint, const std::string& name) {
  if (robot_.is_coupled(joint)) return common(joint, false);
  const Joint& of = robot_.joints[joint];
  const ex own = length(name, of.range(of.kind == JointKind::cylindrical ? 1 : 0), of.where);
  limit_last();
  return {own};
}

Draft::JointCoordinate Draft::common(std::size_t joint, bool turns) {
  const Couplings::Place& place = *couplings_.of(joint);
  const Couplings::Train& train = couplings_.trains()[place.train];
  std::optional<ex>& shared = common_[place.train];
  if (!shared) {
    const Joint& driver = robot_.joints[train.driver];
    const std::string name = train.parts == 1 ? driver.name : driver.name + "_over_" + std::to_string(train.parts);
    shared = turns ? angle(name, common_range(train), driver.where) : length(name, common_range(train), driver.where);
    limit_last();
  }
  return {place.multiple * *shared, place.offset};
}

/// Where all joints that move together are within their ranges: what these leave of the coordinate, counted from 0 on
/// through whole turns. Nothing where that is a turn or more.
std::optional<Range> Draft::common_range(const Couplings::Train& train) const {
  std::optional<ex> lower, upper;
  for (const std::size_t j : train.joints) {
    const Joint& joint = robot_.joints[j];
    const std::optional<Range> range = joint.range();
    if (!range) continue;
    const Couplings::Place& place = *couplings_.of(j);
    ex low = (algebra_.constant(range->lower, joint.where) - place.offset) / place.multiple;
    ex high = (algebra_.constant(range->upper, joint.where) - place.offset) / place.multiple;
    if (algebra_.sign(place.multiple) < 0) std::swap(low, high);
    if (!lower || algebra_.sign(low - *lower) > 0) lower = algebra_.clean(low);
    if (!upper || algebra_.sign(*upper - high) > 0) upper = algebra_.clean(high);
  }
  if (!lower) return std::nullopt;
  const Joint& driver = robot_.joints[train.driver];
  if (algebra_.sign(*upper - *lower) < 0)
    throw ModelError(driver.where, "the ranges of the joints that follow '" + driver.name + "' leave it no position",
                     "ranges that agree");
  if (driver.kind != JointKind::prismatic && algebra_.sign(*upper - *lower - 2 * GiNaC::Pi) >= 0) return std::nullopt;
  const Algebra::Translation text(algebra_);
  return Range{text(*lower), text(*upper)};
}

ex Draft::symbol_of(std::size_t joint, const ex& own) const {
  return robot_.is_coupled(joint) ? *common_[couplings_.of(joint)->train] : own;
}

ex Draft::rate_of_symbol(std::size_t joint, const ex& own) const {
  if (!robot_.is_coupled(joint)) return own;
  const std::size_t train = couplings_.of(joint)->train;
  return *rate_[train] / couplings_.trains()[train].parts;
}

std::vector<std::size_t> Draft::moving_with(std::size_t joint) const {
  return robot_.is_coupled(joint) ? couplings_.trains()[couplings_.of(joint)->train].joints
                                  : std::vector<std::size_t>{joint};
}

ex Draft::joint_rate(std::size_t joint, const std::string& prefix, CoordinateKind kind, symbolic::Role role) {
  if (!robot_.is_coupled(joint)) return rate(prefix + robot_.joints[joint].name, kind, role, robot_.joints[joint].where);
  const Couplings::Place& place = *couplings_.of(joint);
  const Couplings::Train& train = couplings_.trains()[place.train];
  std::optional<ex>& shared = rate_[place.train];
  const Joint& driver = robot_.joints[train.driver];
  if (!shared) shared = rate(prefix + driver.name, kind, role, driver.where);
  return (place.multiple / train.parts) * *shared;
}

Vec Draft::vector(const std::string& name, const SourceLocation& where) {
  const Range wider{"-11/10", "11/10"};
  Vec v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = length(name + "_" + "xyz"[i], wider, where, true);
  return v;
}

Vec Draft::unit_vector(const std::string& name, const SourceLocation& where) {
  const std::string free = free_name(name);
  Vec v;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string component = free + "_" + "xyz"[i];
    names_.insert(component);
    coordinates_.push_back({i == 0 ? free : component, CoordinateKind::length, {}, false, i == 0, where});
    v[i] = algebra_.coordinate(component);
  }
  know(dot(v, v) - 1, {Origin::unit_vector, unit_vectors_++});
  return v;
}

void Draft::know(const ex& e, Numbered number) {
  if (!identities_) return;
  identities_->add(e, numbered_.size());
  numbered_.push_back(number);
}

bool Draft::leaves_out(const DraftEquation& e) {
  if (!identities_) return false;
  const auto sources = identities_->sources(e.value);
  if (!sources) return false;
  DraftLeftOut& left = left_out_.emplace_back(DraftLeftOut{e, {}});
  for (const std::size_t number : *sources) left.from.push_back(numbered_[number]);
  return true;
}

bool Draft::equation(const ex& e, const std::string& note, const SourceLocation& where, const std::string& what) {
  const ex clean = algebra_.clean(e);
  if (algebra_.is_constant(clean)) {
    if (algebra_.is_zero(clean)) return false;
    throw ModelError(where, what + " can never close: it stays open by " + std::to_string(algebra_.value(clean)),
                     "geometry that fits together");
  }
  const DraftEquation own{clean, false, note, where};
  for (const ex& same : {clean, ex(-clean)})
    if (const auto other = known_.find(same); other != known_.end()) {
      left_out_.push_back({own, {{Origin::equation, other->second}}});
      return false;
    }
  if (leaves_out(own)) return false;
  known_.emplace(clean, equalities_);
  know(clean, {Origin::equation, equalities_++});
  equations_.push_back(own);
  return true;
}

bool Draft::closing(const std::vector<ex>& loop, const std::optional<LoopBranches>& branches, const std::string& note,
                    const SourceLocation& where, const std::string& what) {
  if (!branches) {
    bool says = false;
    for (const ex& e : loop) says = equation(e, note, where, what) || says;
    return says;
  }
  const auto& sides = branches_.parallelograms()[branches->parallelogram].sides;
  const bool only = branches_.parallelograms().size() == 1;
  const ex which = angle(only ? "crosswise" : "crosswise_" + sides[0], {}, where);
  coordinates_.back().tells_branches = true;
  taken_apart_.emplace(branches->parallelogram, std::pair{coordinates_.back().name, branches->list.size()});
  const ex c = GiNaC::cos(which), s = GiNaC::sin(which);
  // The angle is 0, π; or 0, π/2, π. Each branch has weight 1 at its own angle and 0 at the others.
  const bool two = branches->list.size() == 2;
  const std::vector<ex> weights =
      two ? std::vector<ex>{(1 + c) / 2, (1 - c) / 2} : std::vector<ex>{(c * c + c) / 2, s, (c * c - c) / 2};
  const auto add = [&](const ex& e, bool inequality, const std::string& of) {
    equations_.push_back({algebra_.clean(e), inequality, note + of, where, true});
    if (!inequality) ++equalities_;
  };
  add(two ? s : s * c, false, ", which branch");
  if (!two) add(s + ex(1) / 2, true, ", which branch");
  const auto weighted = [&](auto member, std::size_t i) {
    ex sum = 0;
    for (std::size_t b = 0; b < weights.size(); ++b) {
      const std::vector<ex>& list = branches->list[b].*member;
      sum += weights[b] * (i < list.size() ? list[i] : ex(1));
    }
    return sum;
  };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    add(weighted(&LoopBranches::Branch::zero, i), false, ", in branches");
    loops_.push_back({algebra_.clean(loop[i]), false, note, where});
  }
  std::size_t conditions = 0;
  for (const auto& branch : branches->list) conditions = std::max(conditions, branch.not_negative.size());
  for (std::size_t i = 0; i < conditions; ++i) add(weighted(&LoopBranches::Branch::not_negative, i), true, ", in branches");
  return true;
}

std::array<bool, 3> Draft::moving(const Output& output, const Vec& value) const {
  std::array<bool, 3> moves{};
  const bool all_asked = output.asked[0] && output.asked[1] && output.asked[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const ex clean = algebra_.clean(value[i]);
    moves[i] = output.asked[i] && !algebra_.is_constant(clean);
    if (!output.asked[i] || moves[i] || (all_asked && !output.ranges[i])) continue;
    throw ModelError(output.where,
                     std::string("the component ") + "xyz"[i] + " of the output '" + output.name +
                         "' cannot move: it is always " + fmt::format("{:.9g}", algebra_.value(clean)),
                     "components that the robot can move");
  }
  return moves;
}

void Draft::output_of_joint(const Output& output, const std::optional<ex>& coordinate) {
  if (!coordinate)
    throw ModelError(output.where, "the joint '" + robot_.joints[output.joint].name + "' has no coordinate",
                     "a revolute or prismatic joint, or a rod of variable length");
  outputs_.push_back(symbol_of(output.joint, *coordinate));
}

void Draft::output_components(const Output& output, const Vec& value, bool may_rest) {
  const std::array<bool, 3> moves = moving(output, value);
  if (!may_rest && moves == std::array<bool, 3>{})
    throw ModelError(output.where, "the output '" + output.name + "' does not move", "a point of a link that moves");
  for (std::size_t i = 0; i < 3; ++i) {
    if (!moves[i]) continue;
    const ex coordinate = length(output.name + "_" + "xyz"[i], output.ranges[i], output.where);
    equation(coordinate - value[i], "output", output.where);
    outputs_.push_back(coordinate);
  }
}

void Draft::at_least_zero(const ex& e, const std::string& note, const SourceLocation& where) {
  const ex clean = algebra_.clean(e);
  if (algebra_.is_constant(clean) && algebra_.sign(clean) > 0) return;
  equations_.push_back({clean, true, note, where});
}

ex Draft::rate(const std::string& name, CoordinateKind kind, symbolic::Role role, const SourceLocation& where) {
  const std::string free = free_name(name);
  rates_.push_back({free, kind, role, where});
  return algebra_.coordinate(free);
}

void Draft::velocity(const ex& e, const std::string& note, const SourceLocation& where) {
  const ex clean = algebra_.clean(e);
  const DraftEquation own{clean, false, note, where};
  if (clean.is_zero() || leaves_out(own)) return;
  know(clean, {Origin::velocity, velocity_.size()});
  velocity_.push_back(own);
}

void Draft::velocity_of_equations() {
  const auto is_in = [](const std::vector<ex>& list, const ex& e) {
    return std::ranges::any_of(list, [&](const ex& other) { return other.is_equal(e); });
  };
  std::vector<std::pair<ex, ex>> rates;  // of each coordinate that does not tell branches
  for (const DraftCoordinate& c : coordinates_) {
    if (c.tells_branches) continue;
    const ex q = algebra_.symbol_of(c.name);
    const symbolic::Role role = is_in(inputs_, q)    ? symbolic::Role::input
                                : is_in(outputs_, q) ? symbolic::Role::output
                                                     : symbolic::Role::passive;
    rates.emplace_back(q, rate((c.kind == CoordinateKind::angle ? "w_" : "v_") + c.name, c.kind, role, c.where));
  }
  const auto differentiate = [&](const DraftEquation& e) {
    ex sum = 0;
    for (const auto& [q, own] : rates) sum += e.value.diff(GiNaC::ex_to<GiNaC::symbol>(q)) * own;
    velocity(sum, e.note, e.where);
  };
  for (const DraftEquation& e : equations_)
    if (!e.inequality && !e.of_branch) differentiate(e);
  for (const DraftEquation& e : loops_) differentiate(e);
}

std::string Draft::point(const std::string& wanted, const Vec& at, const std::optional<Vec>& velocity,
                         std::size_t dimension) {
  std::string name = wanted;
  const auto taken = [&](const DraftPoint& p) { return p.name == name; };
  for (int k = 2; std::ranges::any_of(points_, taken); ++k) name = wanted + "_" + std::to_string(k);
  points_.push_back({name, at, velocity, dimension});
  return name;
}

}  // namespace corank::kinematics
