// A draft in the model language: the mechanism, and what its solutions mean.
#include <algorithm>

#include "corank/kinematics/draft.h"

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
    if (c.kind == CoordinateKind::angle) {
      c.range ? mechanism.angle(c.name, c.range->lower, c.range->upper, c.where)
              : mechanism.angle(c.name, -symbolic::pi(), symbolic::pi(), c.where);
    } else {
      c.range ? mechanism.length(c.name, c.range->lower, c.range->upper, c.where)
              : mechanism.length_without_range(c.name, c.where);
    }
    if (c.auxiliary) mechanism.mark_auxiliary();
    if (c.limit) mechanism.limit(c.name, c.limit->lower, c.limit->upper, c.where);
  }
  std::vector<ex> all;
  for (const DraftEquation& e : equations_) all.push_back(e.value);
  for (const DraftEquation& e : velocity_) all.push_back(e.value);
  for (const DraftLeftOut& e : left_out_)
    if (can_be_read(e.equation.value)) all.push_back(e.equation.value);
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
  for (const symbolic::Rate& r : velocity_.empty() ? std::vector<symbolic::Rate>{} : rates_)
    mechanism.rate(r.name, r.kind, r.role, r.where);
  for (const DraftEquation& e : velocity_) mechanism.velocity(*next++ == Expression(0), e.where);
  Assembly assembly;
  for (const DraftLeftOut& e : left_out_)
    assembly.left_out.push_back(left_out(e, can_be_read(e.equation.value) ? std::optional(*next++) : std::nullopt));
  const auto list = [&](std::size_t n) {
    std::vector<Expression> symbols(next, next + static_cast<std::ptrdiff_t>(n));
    next += static_cast<std::ptrdiff_t>(n);
    return symbols;
  };
  if (const auto inputs = list(inputs_.size()); !inputs.empty()) mechanism.inputs(inputs);
  if (const auto outputs = list(outputs_.size()); !outputs.empty()) mechanism.outputs(outputs);
  for (const symbolic::Constraint& equation : robot_.equations) mechanism.constrain(equation.relation, equation.where);
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
  for (std::size_t p = 0; p < branches_.parallelograms().size(); ++p) {
    const auto angle = taken_apart_.find(p);
    const auto& [name, ways] = angle == taken_apart_.end() ? std::pair<std::string, std::size_t>{} : angle->second;
    assembly.parallelograms.push_back({branches_.parallelograms()[p].sides, name, ways > 2});
  }
  return assembly;
}

}  // namespace corank::kinematics
