#include "corank/kinematics/draft.h"

#include <algorithm>
#include <cctype>

#include "corank/symbolic/expression_words.h"

namespace corank::kinematics {

using symbolic::CoordinateKind;
using symbolic::Mechanism;
using symbolic::ModelError;

std::string Draft::free_name(const std::string& wanted) {
  std::string name;
  for (const char c : wanted) name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) name.insert(0, "_");
  const auto taken = [&](const std::string& candidate) {
    return symbolic::is_reserved(candidate) || std::find(names_.begin(), names_.end(), candidate) != names_.end() ||
           algebra_.constants().contains(candidate);
  };
  while (taken(name)) name += "_";
  names_.push_back(name);
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
  c.limited =
      c.range && algebra_.sign(algebra_.constant(c.range->upper, c.where) - algebra_.constant(c.range->lower, c.where)) != 0;
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
    names_.push_back(component);
    coordinates_.push_back({i == 0 ? free : component, CoordinateKind::length, {}, false, i == 0, where});
    v[i] = algebra_.coordinate(component);
  }
  return v;
}

bool Draft::equation(const ex& e, const std::string& note, const SourceLocation& where, const std::string& what) {
  const ex clean = algebra_.clean(e);
  if (algebra_.is_constant(clean)) {
    if (algebra_.is_zero(clean)) return false;
    throw ModelError(where, what + " can never close: it stays open by " + std::to_string(algebra_.value(clean)),
                     "geometry that fits together");
  }
  for (const DraftEquation& known : equations_)
    if (!known.inequality && (known.value.is_equal(clean) || known.value.is_equal(-clean))) return false;
  equations_.push_back({clean, false, note, where});
  return true;
}

void Draft::at_least_zero(const ex& e, const std::string& note, const SourceLocation& where) {
  equations_.push_back({algebra_.clean(e), true, note, where});
}

ex Draft::rate(const std::string& name, CoordinateKind kind, symbolic::Role role, const SourceLocation& where) {
  const std::string free = free_name(name);
  rates_.push_back({free, kind, role, where});
  return algebra_.coordinate(free);
}

void Draft::velocity(const ex& e, const std::string& note, const SourceLocation& where) {
  const ex clean = algebra_.clean(e);
  if (!clean.is_zero()) velocity_.push_back({clean, false, note, where});
}

std::string Draft::point(const std::string& wanted, const Vec& at, const std::optional<Vec>& velocity, int dimension) {
  std::string name = wanted;
  const auto taken = [&](const DraftPoint& p) { return p.name == name; };
  for (int k = 2; std::any_of(points_.begin(), points_.end(), taken); ++k) name = wanted + "_" + std::to_string(k);
  points_.push_back({name, at, velocity, static_cast<std::size_t>(dimension)});
  return name;
}

Assembly Draft::assembly() const {
  Mechanism mechanism(robot_.name);
  for (const symbolic::Constant& constant : robot_.constants)
    mechanism.constant(constant.name, constant.value, constant.where);
  for (const symbolic::Constant& constant : algebra_.named_constants()) mechanism.constant(constant.name, constant.value);
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const DraftCoordinate& c = coordinates_[i];
    if (c.unit) {
      mechanism.unit_vector(c.name, c.where);
      i += 2;
      continue;
    }
    if (c.kind == CoordinateKind::angle) {
      c.range ? mechanism.angle(c.name, c.range->lower, c.range->upper, c.where)
              : mechanism.angle(c.name, -symbolic::pi(), symbolic::pi(), c.where);
    } else {
      c.range ? mechanism.length(c.name, c.range->lower, c.range->upper, c.where)
              : mechanism.length_without_range(c.name, c.where);
    }
    if (c.auxiliary) mechanism.mark_auxiliary();
    if (c.limited) mechanism.limit(c.name, c.range->lower, c.range->upper, c.where);
  }
  std::vector<ex> all;
  for (const DraftEquation& e : equations_) all.push_back(e.value);
  for (const DraftEquation& e : velocity_) all.push_back(e.value);
  all.insert(all.end(), inputs_.begin(), inputs_.end());
  all.insert(all.end(), outputs_.begin(), outputs_.end());
  const auto add = [&](const Vec& v, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) all.push_back(algebra_.clean(v[i]));
  };
  for (const DraftPoint& p : points_) {
    add(p.at, p.dimension);
    if (p.velocity && !velocity_.empty()) add(*p.velocity, p.dimension);
  }
  for (const LinkPose& p : poses_) {
    add(p.origin, 3);
    for (const Vec& row : p.axes) add(row, 3);
  }
  for (const JointValue& v : values_) {
    all.push_back(v.value);
    if (v.sine) all.push_back(algebra_.clean(*v.sine));
  }
  const std::vector<Expression> translated = algebra_.translated(all);
  auto next = translated.begin();
  for (const DraftEquation& e : equations_) {
    const Expression left = *next++;
    mechanism.constrain(e.inequality ? left >= Expression(0) : left == Expression(0), e.where, e.note);
  }
  // Rates alone say nothing: an open chain without outputs.
  for (const DraftRate& r : velocity_.empty() ? std::vector<DraftRate>{} : rates_)
    mechanism.rate(r.name, r.kind, r.role, r.where);
  for (const DraftEquation& e : velocity_) mechanism.velocity(*next++ == Expression(0), e.where);
  const auto list = [&](std::size_t n) {
    std::vector<Expression> symbols(next, next + static_cast<std::ptrdiff_t>(n));
    next += static_cast<std::ptrdiff_t>(n);
    return symbols;
  };
  if (const auto inputs = list(inputs_.size()); !inputs.empty()) mechanism.inputs(inputs);
  if (const auto outputs = list(outputs_.size()); !outputs.empty()) mechanism.outputs(outputs);
  for (const symbolic::Constraint& equation : robot_.equations) mechanism.constrain(equation.relation, equation.where);
  Assembly assembly;
  symbolic::Drawing drawing;
  drawing.unit = robot_.unit;
  drawing.parts = parts_;
  for (const DraftPoint& p : points_) {
    symbolic::DrawingPoint& point = drawing.points.emplace_back();
    point.name = p.name;
    point.coordinates = list(p.dimension);
    if (p.velocity && !velocity_.empty()) point.velocity = list(p.dimension);
  }
  mechanism.drawing(drawing);
  for (std::size_t l = 0; l < poses_.size(); ++l) {
    Assembly::LinkPose& pose = assembly.poses.emplace_back();
    pose.link = robot_.links[l].name;
    const std::vector<Expression> entries = list(12);
    std::copy_n(entries.begin(), 3, pose.origin.begin());
    for (std::size_t i = 0; i < 9; ++i) pose.rotation[i / 3][i % 3] = entries[3 + i];
  }
  for (const JointValue& v : values_) {
    Assembly::JointValue& value = assembly.joint_values.emplace_back();
    value.joint = v.joint;
    value.value = *next++;
    if (v.sine) value.sine = *next++;
  }
  assembly.mechanism = std::move(mechanism);
  return assembly;
}

}  // namespace corank::kinematics
