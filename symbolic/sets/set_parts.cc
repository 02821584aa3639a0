#include "corank/symbolic/sets/set_parts.h"

#include <algorithm>
#include <functional>

#include "corank/core/check.h"
#include "corank/symbolic/algebra/remembered.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/arm_boundary.h"
#include "corank/symbolic/sets/free_fold.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/part_names.h"
#include "corank/symbolic/sets/rank_loss.h"
#include "corank/symbolic/sets/velocity_blocks.h"

namespace corank::symbolic {

std::string text(const SetPart& part) {
  if (const auto* component = std::get_if<Component>(&part)) return component->name;
  if (const auto* requirement = std::get_if<RequirementPart>(&part)) return requirement->name;
  return std::get<BoundaryPart>(part).text();
}

const Component* component_of(const SetPart& part) {
  if (const auto* limits = std::get_if<BoundaryPart>(&part)) return limits->component ? &*limits->component : nullptr;
  return std::get_if<Component>(&part);
}

bool is_named(const SetPart& part, const std::string& name) {
  const auto* component = std::get_if<Component>(&part);
  return text(part) == name || (component && !name.empty() && component->former_name == name);
}

std::vector<std::string> joints(const SetPart& part) {
  const Component* component = component_of(part);
  std::vector<std::string> names = component ? component->joints : std::vector<std::string>();
  if (const auto* limits = std::get_if<BoundaryPart>(&part))
    names.insert(names.end(), limits->idle.free.begin(), limits->idle.free.end());
  return names;
}

namespace {

// False where some part has a kernel vector, or a condition that is not about joints.
bool leave_out_coordinates(const FreeCoordinates& free, std::vector<Component>& parts) {
  const auto is_put = [&](Component& part) { return !part.block && put_in_factor(free, {}, part); };
  return !parts.empty() && std::ranges::all_of(parts, is_put);
}

// Of a set of dimension 2 or more. A part in which links turn freely is without their angles; one whose condition vanishes
// doubly on a stratum becomes two parts, the stratum and the rest.
std::vector<Component> simplified(const Mechanism& mechanism, std::vector<Component> parts, const Ended& ended) {
  if (algebrize(plain_system(mechanism)).dimension() < 3) return parts;
  std::vector<Component> result;
  for (Component& part : parts) {
    if (part.dependent_angle)
      if (auto factor = without_free_fold(mechanism, *part.dependent_angle)) {
        part.factor = std::make_shared<const TrigonometricSystem>(std::move(*factor));
        part.joints = {part.dependent_angle->other};
      }
    const bool has_one = part.conditions.size() == 1;
    if (auto turn = has_one ? without_free_turn(mechanism, part.conditions.front()) : std::nullopt) {
      part.factor = std::make_shared<const TrigonometricSystem>(std::move(turn->system));
      part.joints = {std::move(turn->angle)};
      part.condition_in_factor = true;
    } else if (has_one) {
      part.stratum = double_stratum(mechanism, part.conditions.front(), ended);
    }
    if (part.stratum) {
      Component on = part;
      on.name = part.stratum->text();
      if (std::ranges::find(result, on) == result.end()) result.push_back(std::move(on));
      part.is_rest = true;
      part.name += ", elsewhere";
    }
    result.push_back(std::move(part));
  }
  return result;
}

// Of an arm with more joints than outputs, where M loses row rank: M's left kernel in the joints that it depends on. Of a
// curve the whole says more.
std::vector<Component> lost_rank(const Mechanism& mechanism, const KernelQuestion& kernel, const FreeCoordinates& free,
                                 const Ended& ended) {
  std::optional<ExpressionMatrix> matrix = wide_in_joints(mechanism, kernel, ended);
  if (!matrix) return {};
  const long joints = std::ranges::count_if(free.system.coordinates, std::not_fn(is_fixed)),
             conditions = std::ssize(matrix->columns) - std::ssize(matrix->rows) + 1;
  if (joints - conditions < 2) return {};
  if (std::vector<Component> parts = rank_losses(mechanism, *matrix, free, ended); !parts.empty()) return parts;
  Component part;
  part.block = std::move(matrix);
  if (!put_in_factor(free, {}, part)) return {};
  part.name = "a kernel vector in " + listed(names_of(part.factor->coordinates));
  return {std::move(part)};
}

// C-space of an arm of many joints is the product of their ranges and of what inequalities leave of some. One joint stands
// in for those that no inequality is about: without a coordinate there is nothing to solve.
std::vector<Component> space_of_joints(const std::optional<FreeCoordinates>& free) {
  constexpr long kLeastFree = 5;
  if (!free) return {};
  std::vector<std::string> moving;
  for (const Coordinate& c : free->system.coordinates)
    if (!is_fixed(c)) moving.push_back(c.name);
  if (std::ssize(moving) < kLeastFree) return {};
  Component all;
  all.name = "every value of the joints";
  CORANK_CHECK(put_in_factor(*free, {Expression::symbol(moving.front())}, all));
  return {std::move(all)};
}

// Of an arm with a large set in its joints, if that can be done. `in_joints`: it has to.
std::vector<Component> components(const Mechanism& mechanism, const KernelQuestion& kernel, const Ended& ended,
                                  const std::optional<FreeCoordinates>* known = nullptr, bool in_joints = false) {
  std::vector<Component> parts = decompose(mechanism, kernel, ended);
  const bool is_wide = kernel.matrix.columns.size() > kernel.matrix.rows.size();
  if (parts.empty() && !is_wide) return parts;
  const std::optional<FreeCoordinates> free = known != nullptr ? *known : free_coordinates(mechanism);
  const bool many = free && (in_joints || is_large(*free));
  if (parts.empty()) return many ? lost_rank(mechanism, kernel, *free, ended) : parts;
  std::vector<Component> short_ones = parts;
  const bool leaves_out = many && leave_out_coordinates(*free, short_ones);
  parts = leaves_out ? std::move(short_ones) : simplified(mechanism, std::move(parts), ended);
  name_by_values(mechanism, parts);
  return parts;
}

// The part, once for each of its components in place of λ.
std::vector<BoundaryPart> with_components(const BoundaryPart& part, std::vector<Component> components) {
  std::vector<BoundaryPart> result;
  for (Component& component : components) {
    result.push_back(part);
    result.back().has_multipliers = false;
    result.back().component = std::move(component);
  }
  return result;
}

// Of an arm's boundary, in joints. Nothing where that cannot be.
std::vector<BoundaryPart> in_joints(const ArmBoundary& arm, BoundaryPart part, const Ended& ended) {
  const std::optional<ArmBoundary::Question> asked = arm.question(part, ended);
  if (!asked) return {};
  const std::optional<FreeCoordinates> free = asked->free;
  const ExpressionMatrix& m = asked->kernel.matrix;
  if (asked->is_everywhere && m.columns.size() >= m.rows.size()) {  // more than a surface
    std::optional<Component> product = product_at_limits(*free, part);
    return product ? with_components(part, {std::move(*product)}) : std::vector<BoundaryPart>{};
  }
  std::vector<Component> all{Component{}};
  if (!asked->is_everywhere) {
    all = components(asked->joints, asked->kernel, ended, &free, true);
    if (all.empty()) all = {Component{.name = "a kernel vector", .block = m}};
  }
  for (Component& component : all)
    if (!put_in_factor(*free, passage_functions(*asked->motion, component), component)) return {};
  part.motion = asked->motion;
  return with_components(part, std::move(all));
}

// Of a workspace's boundary. `free`: of the mechanism.
std::vector<BoundaryPart> without_multipliers(const Mechanism& mechanism, const std::optional<FreeCoordinates>& free,
                                              BoundaryPart part, const Ended& ended) {
  KernelQuestion kernel = boundary_kernel(mechanism, part);
  part.has_multipliers = kernel.matrix.columns.size() >= kernel.matrix.rows.size();
  if (free && !part.has_multipliers) part.component = product_at_limits(*free, part);
  if (!part.active.empty()) return {part};  // the many would take long
  if (free) put_into_joints(mechanism, *free, kernel);
  std::vector<Component> conditions = components(mechanism, kernel, ended, &free);
  if (conditions.empty() || std::ranges::any_of(conditions, [](const Component& c) { return c.block.has_value(); }))
    return {part};
  return with_components(part, std::move(conditions));
}

struct WithOutputs {
  TrigonometricSystem factor;       // as Component::factor
  std::vector<std::string> joints;  // as Component::joints
};

// Of a part about the coordinates `own`; nothing where it has its outputs, or would be more than a surface.
std::optional<WithOutputs> with_outputs(const Mechanism& mechanism, const std::vector<std::string>& own) {
  constexpr int kSurface = 2;
  const auto has = [&](const std::string& name) { return std::ranges::find(own, name) != own.end(); };
  if (std::ranges::all_of(mechanism.outputs(), has)) return std::nullopt;
  const IdleCoordinates idle = idle_coordinates(mechanism, own);
  TrigonometricSystem system = plain_system(without_idle(mechanism, idle));
  if (algebrize(system).dimension() - 1 > kSurface) return std::nullopt;
  return WithOutputs{std::move(system), idle.free};
}

// Few boxes: each can be asked for its types.
bool has_labels(const SetPart& part, const System& compiled) {
  const auto* component = std::get_if<Component>(&part);
  return component && !component->block && !component->factor && compiled.dimension() <= 1;
}

std::vector<SetPart> found_boundary(const Mechanism& mechanism, const Ended& ended) {
  std::vector<SetPart> result;
  std::vector<BoundaryPart> parts = boundary_parts(mechanism);
  const Mechanism moving = without_idle(mechanism.without_rates(), parts.front().idle);
  const std::optional<FreeCoordinates> free = free_coordinates(moving);
  const std::optional<ArmBoundary> arm = ArmBoundary::of(moving, free, ended);
  for (BoundaryPart& part : parts) {
    std::vector<BoundaryPart> all;
    if (part.of_output)
      all = {std::move(part)};
    else if (arm)
      all = in_joints(*arm, part, ended);
    if (all.empty()) all = without_multipliers(moving, free, std::move(part), ended);
    for (BoundaryPart& one : all) result.emplace_back(std::move(one));
  }
  return result;
}

// To cut and to check a result asks for all parts again with each of them.
std::vector<SetPart> boundary(const Mechanism& mechanism, const Ended& ended) {
  if (ended) return found_boundary(mechanism, ended);
  using Asked = std::pair<TrigonometricSystem, std::vector<std::string>>;
  static Remembered<Asked, std::vector<SetPart>> remembered(2);
  std::vector<std::string> words{mechanism.name()};
  for (const Coordinate& c : mechanism.coordinates()) words.emplace_back(to_string(role_of(mechanism, c.name)));
  for (const Limit& limit : mechanism.limits()) words.push_back(limit.coordinate + limit.text());
  const auto alike = [](const Asked& x, const Asked& y) { return are_alike(x.first, y.first) && x.second == y.second; };
  return remembered.of({plain_system(mechanism), std::move(words)}, alike,
                       [&](const Asked&) { return found_boundary(mechanism, {}); });
}

}  // namespace

std::vector<SetPart> set_parts(const Mechanism& mechanism, SingularitySet set, const Ended& ended,
                               const std::optional<FreeCoordinates>* free) {
  const auto as_parts = [](auto list) { return std::vector<SetPart>(list.begin(), list.end()); };
  if (definition(set).of_parts) return boundary(mechanism, ended);
  if (definition(set).of_requirements) return as_parts(requirement_parts(mechanism));
  if (definition(set).is_cspace()) return as_parts(space_of_joints(free != nullptr ? *free : free_coordinates(mechanism)));
  return as_parts(components(mechanism, kernel_question(mechanism, set), ended, free));
}

bool can_have_outputs(const Mechanism& mechanism, const std::vector<std::string>& own) {
  return with_outputs(mechanism, own).has_value();
}

bool add_outputs(const Mechanism& mechanism, SetPart& part) {
  auto* component = std::get_if<Component>(&part);
  if (!component || !component->factor) return false;
  std::optional<WithOutputs> with = with_outputs(mechanism, names_of(component->factor->coordinates));
  if (!with) return false;
  component->factor = std::make_shared<const TrigonometricSystem>(std::move(with->factor));
  component->joints = std::move(with->joints);
  return true;
}

void add_claims(const Mechanism& mechanism, SingularitySet set, const SetPart& part, const TrigonometricSystem& equations,
                System& compiled) {
  if (const auto* limits = std::get_if<BoundaryPart>(&part))
    compiled.passage = limits->motion ? passage_form_in_joints(*limits, equations, compiled)
                                      : passage_form(mechanism, *limits, equations, compiled);
  if (has_labels(part, compiled)) compiled.singular = singular_matrix(mechanism, set);
}

SetEquations::SetEquations(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side)
    : whole_(mechanism), mechanism_(mechanism), set_(set) {
  if (definition(set).has_kernel()) kernel_.emplace(kernel_question(mechanism, set, side));
}

SetEquations::SetEquations(const Mechanism& mechanism, SingularitySet set, SetPart part)
    : whole_(mechanism), mechanism_(mechanism), set_(set), part_(std::move(part)) {
  const auto* limits = std::get_if<BoundaryPart>(&*part_);
  if (limits) mechanism_ = mechanism_of(mechanism, *limits);
  const Component* component = component_of(*part_);
  if (limits && limits->has_multipliers) {
    kernel_.emplace(boundary_kernel(whole_, *limits));
  } else if (const auto* requirement = std::get_if<RequirementPart>(&*part_)) {
    kernel_.emplace(kernel_question(mechanism_, *requirement));
  } else if (component && component->block) {
    const std::vector<SourceLocation> where(component->block->rows.size(), SourceLocation{mechanism.name(), 0, 0});
    const bool is_wide = component->block->columns.size() > component->block->rows.size();
    const KernelSide side = is_wide ? KernelSide::left : KernelSide::right;
    kernel_.emplace(KernelQuestion{definition(set), "B", *component->block, where, side, {}});
  }
}

void SetEquations::eliminate_passive_rates() {
  if (kernel_) kernel_.emplace(without_passive_rates(mechanism_, *kernel_));
}

std::vector<std::string> SetEquations::scales() const {
  const Component* component = part_ ? component_of(*part_) : nullptr;
  if (component && component->factor) return {};  // the outputs' rates have one unit, or are few
  if (kernel_) return kernel_scales(mechanism_, *kernel_);
  return part_ ? std::vector<std::string>{} : kernel_scales(mechanism_, set_);
}

TrigonometricSystem SetEquations::system(const std::vector<std::string>& scales, int corank) const {
  if (!part_ && !kernel_) return singularity_system(mechanism_, set_, std::nullopt, scales, corank);
  const Component* component = part_ ? component_of(*part_) : nullptr;
  TrigonometricSystem system = component && component->factor ? *component->factor : plain_system(mechanism_);
  if (kernel_) system = with_kernel(std::move(system), mechanism_, *kernel_, scales, corank);
  if ((component && component->factor) || mechanism_.coordinates().size() < whole_.coordinates().size())
    system.coordinates_of_whole = whole_.coordinates();
  if (!kernel_) system.name += std::string(" ") + definition(set_).name;
  if (!part_) return system;
  if (const auto* limits = std::get_if<BoundaryPart>(&*part_)) set_at_limits(*limits, system);
  if (component) {
    if (component->stratum && !component->is_rest) {
      put_on(*component->stratum, mechanism_, system);
    } else {
      add_condition(*component, system);
      if (component->stratum) put_beside(*component->stratum, mechanism_, system);
    }
  }
  return system;
}

void SetEquations::set_at_limits(const BoundaryPart& part, TrigonometricSystem& system) const {
  for (const BoundaryPart::Active& active : part.active) {
    if (active.inequality) continue;
    const bool is_there = hold(system.coordinates, active.name, active.value);
    CORANK_CHECK(is_there);
  }
  system.name += ": " + part.text();
}

void SetEquations::add_condition(const Component& part, TrigonometricSystem& system) const {
  const SourceLocation where{mechanism_.name(), 0, 0};
  const auto has = [&](const std::string& name) {
    return std::ranges::find(system.coordinates, name, &Coordinate::name) != system.coordinates.end();
  };
  if (part.dependent_angle && has(part.dependent_angle->angle)) system.dependent_angle = part.dependent_angle;
  if (system.dependent_angle) system.equations.push_back({part.dependent_angle->relation(), part.name, where, true, true});
  if (part.condition_in_factor) return;
  for (const Expression& e : part.conditions) system.equations.push_back({e == Expression(0), part.name, where, true});
}

System SetEquations::compiled(const std::vector<std::string>& scales) const {
  const TrigonometricSystem equations = system(scales);
  System compiled = algebrize(equations);
  if (part_) add_claims(whole_, set_, *part_, equations, compiled);
  return compiled;
}

}  // namespace corank::symbolic
