#include "corank/symbolic/sets/boundary.h"

#include <algorithm>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

using Active = BoundaryPart::Active;

constexpr std::size_t kMostParts = 1000;

/// What the boundary asks of a mechanism: Φ and its derivative.
struct Outline {
  Mechanism mechanism;  // without a velocity equation of its own
  VelocityEquation velocity;
  std::vector<Expression> phi;
  long mobility = 0;
  long dependencies = 0,
       free = 0;  // outputs less dependencies are free: below 0 where more rows are those than there are outputs
};

Outline outline(const Mechanism& mechanism) {
  Outline o{mechanism.without_rates(), {}, {}};
  const SourceLocation where{mechanism.name(), 0, 0};
  if (mechanism.outputs().empty()) {
    const bool by_rates = std::ranges::any_of(mechanism.rates(), [](const Rate& r) { return r.role == Role::output; });
    throw by_rates ? ModelError(where, "the model's outputs are rates, as of an orientation: no space with a boundary",
                                "coordinates as outputs: a position, a direction or a joint")
                   : ModelError(where, "the model names no outputs, over which the boundary lies",
                                "a line [OUTPUTS], or --outputs NAME,NAME");
  }
  Derivation derivation = derive(o.mechanism);
  o.velocity = std::move(derivation.velocity);
  o.phi = std::move(derivation.phi);
  o.mobility = std::ssize(o.velocity.matrix.columns) - std::ssize(o.phi);
  const Role output = Role::output;
  o.dependencies = std::ssize(o.velocity.dependencies(std::span(&output, 1)));
  o.free = std::ssize(mechanism.outputs()) - o.dependencies;
  if (o.phi.empty() || o.free > o.mobility || o.free < 1)
    throw ModelError(where,
                     "the mechanism has mobility " + std::to_string(o.mobility) + ", but " + std::to_string(o.free) +
                         " free output" + (o.free == 1 ? "" : "s") + " (" + listed(mechanism.outputs()) + ")",
                     "at least one output, and at most as many as the mobility");
  return o;
}

// All ways to choose `size` of the limits from the one with this index on, each with a side.
void add_choices(const std::vector<Limit>& limits, std::size_t from, std::size_t size, std::vector<Active>& chosen,
                 std::vector<BoundaryPart>& parts) {
  if (size == 0) {
    parts.push_back({chosen});
    if (parts.size() > kMostParts)
      throw ModelError(limits.front().where, "these limits make more than " + std::to_string(kMostParts) + " parts",
                       "fewer limits, or more outputs");
    return;
  }
  for (std::size_t i = from; i + size <= limits.size(); ++i)
    for (const bool upper : {false, true}) {
      chosen.push_back({limits[i].coordinate, upper ? limits[i].upper : limits[i].lower, upper});
      add_choices(limits, i + 1, size - 1, chosen, parts);
      chosen.pop_back();
    }
}

KernelQuestion question(const Outline& o, const BoundaryPart& part) {
  const SetDefinition& set = definition(SingularitySet::boundary);
  KernelQuestion kernel{set, set.matrix, o.velocity.without(set.locked), o.velocity.where, KernelSide::left, {}, {}};
  kernel.drop(o.velocity.dependencies(set.locked));
  ExpressionMatrix& m = kernel.matrix;
  for (const Active& active : part.active) {
    const auto at = std::ranges::find(m.columns, active.coordinate) - m.columns.begin();
    m.columns.erase(m.columns.begin() + at);
    m.roles.erase(m.roles.begin() + at);
    for (auto& row : m.rows) row.erase(row.begin() + at);
  }
  return kernel;
}

// λᵀΦ and its derivatives.
class Lagrangian {
 public:
  Lagrangian(const Outline& o, const TrigonometricSystem& system)
      : bridge_(names_of(system.constants), with(names_of(system.coordinates), system.kernel_unknowns)) {
    const std::vector<Expression> lambda = scaled(system.kernel_unknowns, system.kernel_scales);
    for (std::size_t i = 0; i < o.phi.size(); ++i)
      value_ += bridge_.to_ginac(lambda[i], {}) * bridge_.to_ginac(o.phi[i], {});
  }

  Expression by(const std::string& a) const { return bridge_.to_expression(value_.diff(bridge_.symbol(a))); }
  Expression by(const std::string& a, const std::string& b) const {
    return bridge_.to_expression(value_.diff(bridge_.symbol(a)).diff(bridge_.symbol(b)));
  }

 private:
  static std::vector<std::string> with(std::vector<std::string> names, const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
  }

  GinacBridge bridge_;
  GiNaC::ex value_ = 0;
};

// Rows times the scales of λ, columns times the sizes of their coordinates: N stays regular, and S is the form of ker Φ_z
// in another basis.
void take_out_units(const Mechanism& mechanism, const std::vector<std::string>& columns,
                    const std::vector<std::string>& scales, PassageForm& form) {
  const std::vector<std::string> sizes = coordinate_sizes(mechanism);
  const UpwardRounding rounding;
  std::vector<ExactNumber> by;
  for (const std::string& name : columns) by.push_back(ExactNumber::rational(sizes[mechanism.find_coordinate(name)]));
  const auto multiply = [](Polynomial& f, const ExactNumber& factor) { f = certify::sum({}, factor, f); };
  std::size_t entry = 0;
  for (int i = 0; i < form.equations; ++i) {
    const ExactNumber row = scales.empty() ? ExactNumber(1) : ExactNumber::rational(scales[i]);
    for (const ExactNumber& column : by) multiply(form.jacobian[entry++], row * column);
  }
  entry = 0;
  for (std::size_t j = 0; j < by.size(); ++j)
    for (std::size_t k = j; k < by.size(); ++k) multiply(form.hessian[entry++], by[j] * by[k]);
}

Polynomial constant(int value) {
  Polynomial p;
  if (value != 0) p.monomials.push_back(Monomial(value, {}));
  return p;
}

// n = e_i, and u_i is the limit less τ² (upper), or plus τ².
PassageForm form_of_output(const Mechanism& mechanism, const Active& active) {
  PassageForm form;
  for (const std::string& output : mechanism.outputs()) form.normal.push_back(constant(output == active.coordinate));
  form.slack.push_back(constant(active.upper ? 1 : -1));
  return form;
}

}  // namespace

std::string BoundaryPart::text() const {
  std::string text;
  for (const Active& a : active)
    text += (text.empty() ? "" : ", ") + a.coordinate + " at its " + (a.upper ? "upper" : "lower") + " limit";
  return text.empty() ? "no limit" : text;
}

std::vector<BoundaryPart> boundary_parts(const Mechanism& mechanism) {
  const Outline o = outline(mechanism);
  const std::size_t most = o.mobility - o.free + 1;
  std::vector<Limit> others, of_outputs;
  for (const Limit& limit : effective_limits(mechanism))
    (role_of(mechanism, limit.coordinate) == Role::output ? of_outputs : others).push_back(limit);
  std::vector<BoundaryPart> parts;
  std::vector<Active> chosen;
  for (std::size_t size = 0; size <= std::min(most, others.size()); ++size) add_choices(others, 0, size, chosen, parts);
  for (const Limit& limit : of_outputs)
    for (const bool upper : {false, true})
      parts.push_back({{{limit.coordinate, upper ? limit.upper : limit.lower, upper}}, true});
  return parts;
}

KernelQuestion boundary_kernel(const Mechanism& mechanism, const BoundaryPart& part) {
  return question(outline(mechanism), part);
}

std::optional<PassageForm> passage_form(const Mechanism& mechanism, const BoundaryPart& part,
                                        const TrigonometricSystem& system) {
  const Outline o = outline(mechanism);
  if (o.dependencies > 0) return std::nullopt;
  if (part.of_output) return form_of_output(mechanism, part.active.front());
  const KernelQuestion kernel = question(o, part);
  PassageForm form;
  form.equations = static_cast<int>(kernel.matrix.rows.size());
  form.columns = static_cast<int>(kernel.matrix.columns.size());
  std::vector<Expression> jacobian, hessian, slack, normal;
  for (const auto& row : kernel.matrix.rows) jacobian.insert(jacobian.end(), row.begin(), row.end());
  {
    const GinacLock lock;
    const Lagrangian lagrangian(o, system);
    const std::vector<std::string>& z = kernel.matrix.columns;
    for (std::size_t j = 0; j < z.size(); ++j)
      for (std::size_t k = j; k < z.size(); ++k) hessian.push_back(lagrangian.by(z[j], z[k]));
    for (const Active& active : part.active)
      slack.push_back(active.upper ? -lagrangian.by(active.coordinate) : lagrangian.by(active.coordinate));
    for (const std::string& u : mechanism.outputs()) normal.push_back(lagrangian.by(u));
  }
  try {
    form.jacobian = polynomials(system, jacobian);
    form.hessian = polynomials(system, hessian);
    form.slack = polynomials(system, slack);
    form.normal = polynomials(system, normal);
  } catch (const ModelError&) {  // sines of lengths, which are no polynomials in the system's own variables
    return std::nullopt;
  }
  take_out_units(o.mechanism, kernel.matrix.columns, system.kernel_scales, form);
  // Unknowns stand behind the configuration's variables.
  const int before = configurations(mechanism).size();
  for (int i = 0; i < form.equations; ++i) form.multipliers.push_back(before + i);
  return form;
}

System configurations(const Mechanism& mechanism) {
  System system = algebrize(plain_system(mechanism));
  const int n = system.configuration_size;
  system.variables.resize(n);
  const auto beyond = [n](const Polynomial& f) {
    for (const Monomial& m : f.monomials)
      for (const Factor& x : m.factors)
        if (x.variable >= n) return true;
    return false;
  };
  for (auto* list : {&system.equations, &system.inequalities, &system.claimed}) std::erase_if(*list, beyond);
  return system;
}

}  // namespace corank::symbolic
