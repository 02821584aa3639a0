#include "corank/symbolic/sets/boundary.h"

#include <algorithm>
#include <memory>
#include <ranges>
#include <utility>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/remembered.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/reached_inequalities.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

using Active = BoundaryPart::Active;

constexpr std::size_t kMostParts = 1000;

/// What the boundary asks of a mechanism: Φ and its derivative, without the coordinates that are held.
struct Outline {
  Mechanism mechanism;  // without a velocity equation of its own
  VelocityEquation velocity;
  std::vector<Expression> phi;
  std::vector<std::size_t> equations{};  // which of the mechanism's equations phi are
  long mobility = 0;
  long dependencies = 0,
       free = 0;  // outputs less dependencies are free: below 0 where more rows are those than there are outputs
};

// Without the columns of passive coordinates that have one value, and the equations in these alone.
void leave_out_held(Outline& o) {
  ExpressionMatrix& m = o.velocity.matrix;
  for (std::size_t j = m.columns.size(); j-- > 0;) {
    const Coordinate& c = o.mechanism.coordinates()[o.mechanism.find_coordinate(m.columns[j])];
    if (m.roles[j] != Role::passive || !is_fixed(c)) continue;
    const auto at = static_cast<std::ptrdiff_t>(j);
    m.columns.erase(m.columns.begin() + at);
    m.roles.erase(m.roles.begin() + at);
    for (auto& row : m.rows) row.erase(row.begin() + at);
  }
  for (std::size_t i = m.rows.size(); i-- > 0;) {
    if (!std::ranges::all_of(m.rows[i], [](const Expression& e) { return same_tree(e, 0); })) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    m.rows.erase(m.rows.begin() + at);
    o.velocity.where.erase(o.velocity.where.begin() + at);
    o.phi.erase(o.phi.begin() + at);
    o.equations.erase(o.equations.begin() + at);
  }
}

void count(Outline& o) {
  const Role output = Role::output;
  o.mobility = std::ssize(o.velocity.matrix.columns) - std::ssize(o.phi);
  o.dependencies = std::ssize(o.velocity.dependencies(std::span(&output, 1)));
  o.free = std::ssize(o.mechanism.outputs()) - o.dependencies;
}

// A coordinate that has one value is held where the outputs are free all the same: else it is one that the mechanism holds,
// such as the orientation of a platform that only translates, or the set is cut there.
Outline outline(const Mechanism& mechanism, const IdleCoordinates& idle) {
  Outline o{without_idle(mechanism.without_rates(), idle), {}, {}};
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
  for (std::size_t row = 0; row < o.phi.size(); ++row) o.equations.push_back(row);
  count(o);
  Outline held = o;
  leave_out_held(held);
  count(held);
  if (held.free <= held.mobility) o = std::move(held);
  if (o.phi.empty() || o.free > o.mobility || o.free < 1)
    throw ModelError(where,
                     "the mechanism has mobility " + std::to_string(o.mobility) +
                         (idle.free.empty() ? "" : " without " + listed(idle.free) + ", which no output depends on") +
                         ", but " + std::to_string(o.free) + " free output" + (o.free == 1 ? "" : "s") + " (" +
                         listed(mechanism.outputs()) + ")",
                     "at least one output, and at most as many as the mobility, as --outputs NAME,NAME chooses them");
  return o;
}

/// What ends the workspace, each with its ends, of which one at a time is met: two of a limit, one of an inequality.
using Ends = std::vector<Active>;

Ends ends_of(const Limit& limit) { return {{limit.coordinate, limit.lower, false}, {limit.coordinate, limit.upper, true}}; }

// All ways to choose one end each of `size` of these from the one with this index on.
void add_choices(const std::vector<Ends>& all, std::size_t from, std::size_t size, std::vector<Active>& chosen,
                 std::vector<BoundaryPart>& parts) {
  if (size == 0) {
    parts.push_back({chosen});
    return;
  }
  for (std::size_t i = from; i + size <= all.size() && parts.size() <= kMostParts; ++i)
    for (const Active& end : all[i]) {
      chosen.push_back(end);
      add_choices(all, i + 1, size - 1, chosen, parts);
      chosen.pop_back();
    }
}

// Makes the inequalities that are reached equations.
void reach(Outline& o, const BoundaryPart& part) {
  for (const Active& active : part.active) {
    if (!active.inequality) continue;
    o.mechanism.reach(*active.inequality);
    const Constraint& equation = o.mechanism.constraints().back();
    o.equations.push_back(o.mechanism.equations().size() - 1);
    o.phi.push_back(equation.relation.lhs - equation.relation.rhs);
    ExpressionMatrix& m = o.velocity.matrix;
    m.rows.push_back(std::move(derivatives(o.mechanism, m.columns, {o.phi.back()}).front().first));
    o.velocity.where.push_back(equation.where);
  }
}

Outline outline(const Mechanism& mechanism, const BoundaryPart& part) {
  Outline o = outline(mechanism, part.idle);
  reach(o, part);
  return o;
}

KernelQuestion question(const Outline& o, const BoundaryPart& part) {
  const SetDefinition& set = definition(SingularitySet::boundary);
  KernelQuestion kernel{set, set.matrix, o.velocity.without(set.locked), o.velocity.where, KernelSide::left, {}, {}};
  kernel.drop(o.velocity.dependencies(set.locked));
  std::vector<std::size_t> multiplied = o.equations, dropped;
  for (const std::size_t row : kernel.dropped | std::views::reverse)
    multiplied.erase(multiplied.begin() + static_cast<std::ptrdiff_t>(row));
  for (std::size_t row = 0; row < o.mechanism.equations().size(); ++row)
    if (!std::ranges::binary_search(multiplied, row)) dropped.push_back(row);
  kernel.dropped = std::move(dropped);
  ExpressionMatrix& m = kernel.matrix;
  for (const Active& active : part.active) {
    if (active.inequality) continue;
    const auto at = std::ranges::find(m.columns, active.name) - m.columns.begin();
    m.columns.erase(m.columns.begin() + at);
    m.roles.erase(m.roles.begin() + at);
    for (auto& row : m.rows) row.erase(row.begin() + at);
  }
  return kernel;
}

// Φ's derivatives, and those of λᵀΦ, as polynomials in the configuration's variables and, behind them, in λ: what the forms
// of all parts are made of.
struct SecondOrder {
  int variables = 0;                       // of the configuration
  std::vector<std::string> coordinates{};  // z first, then the outputs
  std::size_t of_z = 0;
  std::vector<Polynomial> jacobian{};  // by z, row by row
  std::vector<Polynomial> gradient{};  // of λᵀΦ, by all coordinates
  std::vector<Polynomial> hessian{};   // by z_j and z_k for k ≥ j, row by row

  std::size_t place(const std::string& coordinate) const {
    return static_cast<std::size_t>(std::ranges::find(coordinates, coordinate) - coordinates.begin());
  }
  const Polynomial& second(std::size_t j, std::size_t k) const {  // j ≤ k
    return hessian[j * of_z - j * (j + 1) / 2 + k];
  }
};

// Nothing where a derivative is no polynomial, since it holds a sine of a length.
std::shared_ptr<const SecondOrder> found_second_order(const Outline& o, TrigonometricSystem system) {
  SecondOrder result;
  for (const Coordinate& c : o.mechanism.coordinates())
    if (role_of(o.mechanism, c.name) != Role::output) result.coordinates.push_back(c.name);
  result.of_z = result.coordinates.size();
  const auto& outputs = o.mechanism.outputs();
  result.coordinates.insert(result.coordinates.end(), outputs.begin(), outputs.end());
  const std::vector<std::string> lambda = kernel_names(o.mechanism, o.phi.size(), 1, "lambda");
  system.kernel_unknowns = lambda;
  std::vector<Expression> values = symbols(lambda);
  {
    const GinacLock lock;
    std::vector<std::string> names = names_of(system.coordinates);
    names.insert(names.end(), lambda.begin(), lambda.end());
    const GinacBridge bridge(names_of(system.constants), std::move(names));
    GiNaC::ex value = 0;
    for (std::size_t i = 0; i < o.phi.size(); ++i) value += bridge.to_ginac(values[i], {}) * bridge.to_ginac(o.phi[i], {});
    std::vector<GiNaC::ex> first;
    for (const std::string& name : result.coordinates) first.push_back(value.diff(bridge.symbol(name)));
    const auto add = [&](const GiNaC::ex& e) { values.push_back(bridge.to_expression(e)); };
    for (std::size_t i = 0; i < o.phi.size(); ++i)
      for (std::size_t j = 0; j < result.of_z; ++j) add(first[j].diff(bridge.symbol(lambda[i])));
    for (const GiNaC::ex& e : first) add(e);
    for (std::size_t j = 0; j < result.of_z; ++j)
      for (std::size_t k = j; k < result.of_z; ++k) add(first[j].diff(bridge.symbol(result.coordinates[k])));
  }
  std::vector<Polynomial> all;
  try {
    all = polynomials(system, values);
  } catch (const ModelError&) {
    return nullptr;
  }
  auto next = std::make_move_iterator(all.begin());
  const auto take = [&next](std::size_t n) {
    std::vector<Polynomial> list(next, next + static_cast<std::ptrdiff_t>(n));
    next += static_cast<std::ptrdiff_t>(n);
    return list;
  };
  result.variables = take(lambda.size())[0].monomials[0].factors[0].variable;
  result.jacobian = take(o.phi.size() * result.of_z);
  result.gradient = take(result.coordinates.size());
  result.hessian = take(result.of_z * (result.of_z + 1) / 2);
  return std::make_shared<const SecondOrder>(std::move(result));
}

// Hundreds of parts ask for the same.
std::shared_ptr<const SecondOrder> second_order(const Outline& o) {
  using Asked = std::pair<TrigonometricSystem, std::vector<std::string>>;
  static Remembered<Asked, std::shared_ptr<const SecondOrder>> remembered(2);
  const auto alike = [](const Asked& a, const Asked& b) { return are_alike(a.first, b.first) && a.second == b.second; };
  std::vector<std::string> names = o.velocity.matrix.columns;  // which of them are held says which equations there are
  names.insert(names.end(), o.mechanism.outputs().begin(), o.mechanism.outputs().end());
  return remembered.of({plain_system(o.mechanism), std::move(names)}, alike,
                       [&o](const Asked& asked) { return found_second_order(o, asked.first); });
}

Polynomial constant(int value) {
  Polynomial p;
  if (value != 0) p.monomials.push_back(Monomial(value, {}));
  return p;
}

// n = e_i, and u_i is the limit less τ² (upper), or plus τ².
PassageForm form_of_output(const Mechanism& mechanism, const Active& active) {
  PassageForm form;
  for (const std::string& output : mechanism.outputs()) form.normal.push_back(constant(output == active.name));
  form.slack.push_back(constant(active.upper ? 1 : -1));
  return form;
}

}  // namespace

std::string BoundaryPart::text() const {
  std::string text;
  for (const Active& a : active)
    text += (text.empty() ? "" : ", ") + a.name +
            (a.inequality ? " reached" : std::string(" at its ") + (a.upper ? "upper" : "lower") + " limit");
  if (text.empty()) text = "no limit";
  return component && !component->name.empty() ? text + ": " + component->name : text;
}

std::vector<BoundaryPart> boundary_parts(const Mechanism& mechanism) {
  const IdleCoordinates idle = idle_coordinates(mechanism.without_rates());
  const Outline o = outline(mechanism, idle);
  const std::size_t most = o.mobility - o.free + 1;
  std::vector<Ends> others, of_outputs;
  for (const Limit& limit : effective_limits(mechanism))
    if (std::ranges::find(o.velocity.matrix.columns, limit.coordinate) != o.velocity.matrix.columns.end())
      (role_of(mechanism, limit.coordinate) == Role::output ? of_outputs : others).push_back(ends_of(limit));
  for (ReachedInequality& reached : reached_inequalities(o.mechanism, o.velocity.matrix))
    (reached.of_outputs ? of_outputs : others).push_back({std::move(reached.end)});
  std::vector<BoundaryPart> parts;
  std::vector<Active> chosen;
  for (std::size_t size = 0; size <= std::min(most, others.size()); ++size) add_choices(others, 0, size, chosen, parts);
  if (parts.size() > kMostParts)
    throw ModelError({mechanism.name(), 0, 0},
                     "its limits and inequalities make more than " + std::to_string(kMostParts) + " parts of the boundary",
                     "fewer of them, or more outputs");
  for (const Ends& ends : of_outputs)
    for (const Active& end : ends) parts.push_back({{end}, true, false});
  const bool has_inequalities = std::ranges::any_of(
      o.mechanism.constraints(), [](const Constraint& c) { return c.relation.kind != Relation::Kind::equal; });
  if (has_inequalities)
    std::erase_if(parts, [&](const BoundaryPart& part) {
      return !part.active.empty() && (is_settled(o.mechanism, part.active) || is_impossible(o.mechanism, part.active));
    });
  if (!idle.free.empty())
    for (BoundaryPart& part : parts) part.idle = idle;
  return parts;
}

Mechanism mechanism_of(const Mechanism& mechanism, const BoundaryPart& part) {
  Mechanism result = without_idle(mechanism.without_rates(), part.idle);
  for (const Active& active : part.active)
    if (active.inequality) result.reach(*active.inequality);
  return result;
}

KernelQuestion boundary_kernel(const Mechanism& mechanism, const BoundaryPart& part) {
  return question(outline(mechanism, part), part);
}

std::optional<PassageForm> passage_form(const Mechanism& mechanism, const BoundaryPart& part,
                                        const TrigonometricSystem& system, const System& compiled) {
  const Outline o = outline(mechanism, part);
  if (o.dependencies > 0 || (part.component && part.component->factor)) return std::nullopt;
  if (part.of_output && !part.active.front().inequality) return form_of_output(mechanism, part.active.front());
  const std::shared_ptr<const SecondOrder> all = second_order(o);
  if (!all || compiled.configuration_size != all->variables) return std::nullopt;
  const std::vector<std::string> columns = question(o, part).matrix.columns, sizes = coordinate_sizes(o.mechanism);
  const std::size_t rows = o.phi.size();
  std::vector<std::size_t> z;
  std::vector<ExactNumber> by;  // columns times the sizes of their coordinates: S is the form of ker Φ_z in another basis
  for (const std::string& name : columns) {
    z.push_back(all->place(name));
    by.push_back(ExactNumber::rational(sizes[o.mechanism.find_coordinate(name)]));
  }
  std::vector<ExactNumber> scales(rows, ExactNumber(1));
  for (std::size_t i = 0; i < system.kernel_scales.size(); ++i) scales[i] = ExactNumber::rational(system.kernel_scales[i]);
  // λ stands behind the configuration, or else behind all variables, and is a multiple of the system's unknowns.
  const int first = part.has_multipliers ? all->variables : compiled.size();
  const UpwardRounding rounding;
  const auto value = [&](Polynomial f, const ExactNumber& factor) {
    for (Monomial& m : f.monomials) {
      ExactNumber coefficient = m.coefficient * factor;
      for (Factor& x : m.factors)
        if (const int i = x.variable - all->variables; i >= 0) {
          coefficient = coefficient * scales[static_cast<std::size_t>(i)];
          x.variable = first + i;
        }
      m = Monomial(std::move(coefficient), std::move(m.factors));
    }
    return f;
  };
  PassageForm form;
  form.equations = static_cast<int>(rows);
  form.columns = static_cast<int>(columns.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < z.size(); ++j)
      form.jacobian.push_back(value(all->jacobian[i * all->of_z + z[j]], scales[i] * by[j]));
  for (std::size_t j = 0; j < z.size(); ++j)
    for (std::size_t k = j; k < z.size(); ++k)
      form.hessian.push_back(value(all->second(std::min(z[j], z[k]), std::max(z[j], z[k])), by[j] * by[k]));
  // A coordinate is at its lower limit plus τ², or at its upper one less τ². Where an inequality is reached, its row says
  // g = 0 with g ≥ 0 or g ≤ 0, and g − τ² or g + τ² has −λ_g or λ_g as derivative by τ².
  const auto is_inequality = [](const Active& active) { return active.inequality.has_value(); };
  auto multiplier = all->variables + std::ssize(o.phi) - std::ranges::count_if(part.active, is_inequality);
  for (const Active& active : part.active) {
    if (!active.inequality) {
      form.slack.push_back(value(all->gradient[all->place(active.name)], ExactNumber(active.upper ? -1 : 1)));
      continue;
    }
    Polynomial lambda;
    lambda.monomials.push_back(Monomial(1, {{static_cast<int>(multiplier++), 1}}));
    form.slack.push_back(value(lambda, ExactNumber(active.inequality->kind == Relation::Kind::greater_equal ? -1 : 1)));
  }
  for (const std::string& u : mechanism.outputs())
    form.normal.push_back(value(all->gradient[all->place(u)], ExactNumber(1)));
  for (int i = 0; part.has_multipliers && i < form.equations; ++i) form.multipliers.push_back(first + i);
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
