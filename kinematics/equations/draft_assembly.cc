// A draft in the model language: the mechanism, and what its solutions mean.
#include <algorithm>

#include "corank/kinematics/equations/draft.h"

namespace corank::kinematics {

using symbolic::CoordinateKind;
using symbolic::Mechanism;

namespace {

// Lengths of irrational directions make equations of millions of terms, and printing them would take longer than all else.
bool can_be_read(const ex& e) {
  constexpr std::ptrdiff_t kMostTerms = 1000;
  std::ptrdiff_t terms = 0;
  for (auto at = e.preorder_begin(); at != e.preorder_end(); ++at)
    if (++terms > kMostTerms) return false;
  return true;
}

}  // namespace

// Unit vectors come first in Φ, in the order of the coordinates.
symbolic::LeftOut Draft::left_out(const DraftLeftOut& e, std::optional<Expression> value) const {
  symbolic::LeftOut result{std::move(value), e.equation.note, e.equation.where};
  for (const Numbered& n : e.from)
    (n.origin == Origin::velocity ? result.rows : result.equations)
        .push_back(n.index + (n.origin == Origin::equation ? unit_vectors_ : 0) + 1);
  for (auto* numbers : {&result.equations, &result.rows}) std::sort(numbers->begin(), numbers->end());
  return result;
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
    const bool is_angle = c.kind == CoordinateKind::angle;
    const Range range = c.range.value_or(is_angle ? Range{-symbolic::pi(), symbolic::pi()} : Range{});
    mechanism.coordinate({c.name, c.kind, range.lower, range.upper, c.where, c.auxiliary, c.range || is_angle});
    if (c.limit) mechanism.limit(c.name, c.limit->lower, c.limit->upper, c.where);
  }
  const Algebra::Translation text(algebra_);
  const auto texts = [&](const auto& list, std::size_t n) {
    std::vector<Expression> result;
    for (std::size_t i = 0; i < n; ++i) result.push_back(text(algebra_.clean(list[i])));
    return result;
  };
  for (const DraftEquation& e : equations_) {
    const Expression left = text(e.value);
    mechanism.constrain(e.inequality ? left >= Expression(0) : left == Expression(0), e.where, e.note);
  }
  // Rates alone say nothing: an open chain without outputs.
  for (const symbolic::Rate& r : velocity_.empty() ? std::vector<symbolic::Rate>{} : rates_)
    mechanism.rate(r.name, r.kind, r.role, r.where);
  for (const DraftEquation& e : velocity_) mechanism.velocity(text(e.value) == Expression(0), e.where);
  Assembly assembly;
  for (const DraftLeftOut& e : left_out_)
    assembly.left_out.push_back(
        left_out(e, can_be_read(e.equation.value) ? std::optional(text(e.equation.value)) : std::nullopt));
  if (!inputs_.empty()) mechanism.inputs(texts(inputs_, inputs_.size()));
  if (!outputs_.empty()) mechanism.outputs(texts(outputs_, outputs_.size()));
  for (const symbolic::Constraint& equation : robot_.equations) mechanism.constrain(equation.relation, equation.where);
  symbolic::Drawing drawing;
  drawing.unit = robot_.unit;
  drawing.parts = parts_;
  for (const DraftPoint& p : points_) {
    symbolic::DrawingPoint& point = drawing.points.emplace_back();
    point.name = p.name;
    point.coordinates = texts(p.at, p.dimension);
    if (p.velocity && !velocity_.empty()) point.velocity = texts(*p.velocity, p.dimension);
  }
  mechanism.drawing(drawing);
  for (const symbolic::RequirementLine& r : robot_.requirements) mechanism.require(r.text, r.where);
  const auto vector = [&](const Vec& v) {
    return Vector{text(algebra_.clean(v[0])), text(algebra_.clean(v[1])), text(algebra_.clean(v[2]))};
  };
  for (std::size_t l = 0; l < poses_.size(); ++l) {
    const auto& [origin, axes] = poses_[l];
    assembly.poses.push_back({robot_.links[l].name, vector(origin), {vector(axes[0]), vector(axes[1]), vector(axes[2])}});
  }
  for (const auto& [joint, value, sine] : values_)
    assembly.joint_values.push_back({joint, text(value), sine ? std::optional(text(algebra_.clean(*sine))) : std::nullopt});
  assembly.mechanism = std::move(mechanism);
  for (std::size_t p = 0; p < branches_.parallelograms().size(); ++p) {
    const auto angle = taken_apart_.find(p);
    const auto& [name, ways] = angle == taken_apart_.end() ? std::pair<std::string, std::size_t>{} : angle->second;
    assembly.parallelograms.push_back({branches_.parallelograms()[p].sides, name, ways > 2});
  }
  return assembly;
}

}  // namespace corank::kinematics
