#include "corank/symbolic/sets/singularity_system.h"

#include <array>
#include <ranges>
#include <utility>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/sets/limit_on_a_line.h"
#include "corank/symbolic/sets/requirements.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

std::string count(std::size_t n, const std::string& noun) { return n == 0 ? "no " + noun + "s" : counted(n, noun); }

/// What L has of columns and of rows, in words.
struct Counted {
  std::string column, row;
};

Counted words_for(const VelocityEquation& velocity) {
  return velocity.given ? Counted{"rate", "velocity equation"} : Counted{"coordinate", "equation"};
}

/// The inputs, or the outputs: coordinates or rates.
struct Chosen {
  Role role;
  std::vector<std::string> names;
  std::vector<std::size_t> dependencies;
  std::string noun;
  SourceLocation where;
  std::string examples = " (w @ unit and R @ rotation have theirs)";  // of dependencies
};

Chosen chosen(const Mechanism& mechanism, const VelocityEquation& velocity, Role role) {
  Chosen result{role, velocity.names_of(role), velocity.dependencies(std::span(&role, 1)), to_string(role), {}};
  if (!velocity.given) {
    result.where = role == Role::input ? mechanism.inputs_where() : mechanism.outputs_where();
  } else if (!result.names.empty()) {
    result.noun += " rate";
    result.examples.clear();
    result.where = mechanism.rates()[mechanism.find_rate(result.names[0])].where;
  }
  return result;
}

// What would do, where the mobility is `wanted`.
std::string wanted_text(const Chosen& chosen, std::size_t wanted) {
  if (chosen.names.size() <= wanted + chosen.dependencies.size())
    return count(wanted + chosen.dependencies.size(), chosen.noun) +
           (chosen.dependencies.empty() ? "" : " with these dependencies");
  const std::size_t more = chosen.names.size() - chosen.dependencies.size() - wanted;
  return count(wanted, chosen.noun) + ", or " + count(more, chosen.dependencies.empty() ? "equation" : "more equation") +
         " in " + chosen.noun + "s only that " + (more == 1 ? "ties" : "tie") + " them" + chosen.examples;
}

// Inputs less their dependencies are as many as the mobility, or more (redundantly actuated: L_y is tall); outputs as many,
// or less (kinematically redundant: L_z is wide). With fewer inputs or more outputs every configuration would be singular.
void check_mobility(const Mechanism& mechanism, const VelocityEquation& velocity, const Chosen& chosen) {
  const SourceLocation where = chosen.where.line > 0 ? chosen.where : model_place(mechanism);
  const std::size_t equations = velocity.matrix.rows.size(), columns = velocity.matrix.columns.size();
  const Counted words = words_for(velocity);
  if (chosen.names.size() == columns && equations > 0)
    throw ModelError(where, "every " + words.column + " is an " + chosen.noun + ", so nothing can move when they are locked",
                     words.column + "s that are not " + chosen.noun + "s");
  const auto mobility = static_cast<long>(columns) - static_cast<long>(equations);
  const long free = static_cast<long>(chosen.names.size()) - static_cast<long>(chosen.dependencies.size());
  if (mobility >= 0 && (chosen.role == Role::input ? free >= mobility : free <= mobility)) return;
  std::string problem = "the mechanism has " + count(columns, words.column) + " and " + count(equations, words.row) +
                        ", so mobility " + std::to_string(mobility) + ", but " + count(chosen.names.size(), chosen.noun);
  if (!chosen.dependencies.empty())
    problem += " tied by " + count(chosen.dependencies.size(), "equation") + ", so " + std::to_string(free) + " free";
  if (mobility >= 0 && free > mobility) problem += ": they are not independent";
  throw ModelError(
      where, problem,
      mobility < 0 ? "at most as many " + words.row + "s as " + words.column + "s" : wanted_text(chosen, mobility));
}

void check_chosen(const Mechanism& mechanism, const VelocityEquation& velocity, const SetDefinition& set) {
  for (const Role role : set.locked) {
    if (!velocity.names_of(role).empty()) continue;
    const std::string word = to_string(role);
    throw ModelError(
        model_place(mechanism),
        "the model names no " + word + (velocity.given ? " rates" : "s") + ", which the " + set.name + " singularities need",
        velocity.given        ? "a line `name ~ " + word + "` in [RATES]"
        : role == Role::input ? "a line [INPUTS], or `actuated` behind a joint of a robot from parts"
                              : "a line [OUTPUTS]");
  }
  for (const Role role : {Role::input, Role::output}) {
    const Chosen names = chosen(mechanism, velocity, role);
    if (!names.names.empty()) check_mobility(mechanism, velocity, names);
  }
}

// Whether all of L loses rank is a question only where that is not so everywhere.
void check_whole(const Mechanism& mechanism, const VelocityEquation& velocity, const std::string& name, KernelSide side) {
  const std::size_t equations = velocity.matrix.rows.size(), columns = velocity.matrix.columns.size();
  const Counted words = words_for(velocity);
  if (equations > columns)
    throw ModelError(model_place(mechanism),
                     "the mechanism has " + count(columns, words.column) + " and " + count(equations, words.row) + ", so " +
                         name + " never has full row rank",
                     "at most as many " + words.row + "s as " + words.column + "s");
  if (side == KernelSide::right && equations < columns)
    throw ModelError(model_place(mechanism),
                     name + " has " + count(equations, "row") + " and " + count(columns, "column") +
                         ", so every configuration has a right kernel",
                     "the left kernel");
}

// A matrix that is not square has one kernel everywhere; the other tells where it loses rank.
KernelSide side_of(const Mechanism& mechanism, const KernelQuestion& kernel, std::size_t dependencies,
                   std::optional<KernelSide> asked) {
  const std::size_t rows = kernel.matrix.rows.size() - dependencies, columns = kernel.matrix.columns.size();
  const KernelSide only = rows > columns ? KernelSide::right : KernelSide::left;
  if (rows == columns || kernel.set.locked.empty()) {
    if (asked && kernel.set.one_side && *asked != kernel.set.side)
      throw ModelError(model_place(mechanism),
                       std::string("the set ") + kernel.set.name + " does not have a " + to_string(*asked) + " kernel",
                       std::string("the ") + to_string(kernel.set.side) + " kernel");
    return asked.value_or(kernel.set.side);
  }
  const std::string shape = kernel.name + " has " + count(rows, "row") +
                            (dependencies > 0 ? " (without those of dependencies)" : "") + " and " +
                            count(columns, "column");
  if (kernel.set.type && kernel.set.side != only) {
    const bool passive = kernel.set.type == SingularityType::rpm;
    throw ModelError(model_place(mechanism),
                     shape +
                         (passive                     ? ""
                          : only == KernelSide::right ? " (a redundantly actuated mechanism)"
                                                      : " (a kinematically redundant mechanism)") +
                         ", so every configuration is one of the set " + kernel.set.name,
                     passive                     ? "more equations between inputs, outputs and passive joints"
                     : only == KernelSide::right ? "the set ro"
                                                 : "the set io");
  }
  if (asked && *asked != only)
    throw ModelError(model_place(mechanism), shape + ", so every configuration has a " + to_string(*asked) + " kernel",
                     std::string("the ") + to_string(only) + " kernel");
  return only;
}

// About the columns that are left where those of these roles are locked.
KernelQuestion question_of(const Mechanism& mechanism, const VelocityEquation& velocity, const SetDefinition& set,
                           std::span<const Role> locked, const std::string& name, std::optional<KernelSide> side) {
  KernelQuestion kernel{set, name, velocity.without(locked), velocity.where, {}, {}};
  const std::vector<std::size_t> dependencies = velocity.dependencies(locked);
  if (locked.empty()) {
    check_whole(mechanism, velocity, kernel.name, side.value_or(set.side));
  } else {
    check_chosen(mechanism, velocity, set);
  }
  if (kernel.matrix.columns.empty())
    throw ModelError(model_place(mechanism),
                     "there are no passive " + words_for(velocity).column + "s, so " + name + " has no columns",
                     "passive " + words_for(velocity).column + "s");
  kernel.side = side_of(mechanism, kernel, dependencies.size(), side);
  // Lemma (doc/theory.md): a matrix and the same without rows of zeros have the same right kernel, which passes them over; a
  // left one would have an unknown that nothing is asked of.
  if (kernel.side == KernelSide::right) return kernel;
  kernel.drop(dependencies);
  return kernel;
}

bool is_on_a_line(const KernelQuestion& kernel) { return kernel.at_limit && kernel.at_limit->on_a_line; }

KernelQuestion at_limits(const SetDefinition& set, LimitCompanion limit, std::optional<KernelSide> side) {
  constexpr std::array kInputs{Role::input};
  const VelocityEquation velocity = derive(limit.mechanism).velocity;
  auto shared = std::make_shared<const LimitCompanion>(std::move(limit));
  if (!shared->on_a_line) {
    KernelQuestion kernel = question_of(shared->mechanism, velocity, set, kInputs, set.matrix, side);
    kernel.at_limit = std::move(shared);
    return kernel;
  }
  if (side == KernelSide::left)
    throw ModelError(model_place(shared->mechanism), "the limit of an effort or an error has no left kernel",
                     "the right kernel");
  KernelQuestion kernel{set, "A", velocity.without(kInputs), velocity.where, KernelSide::right, {}};
  kernel.at_limit = std::move(shared);
  return kernel;
}

constexpr const char* kStem = "xi";

// Component i of a_j, of several vectors: 3/100 more than the inverse of i + 29 j + 1 modulo 97, in hundredths. The sequence
// above would not do: its differences repeat, and a_1 and a_2 were orthogonal to the same kernels. Few digits keep the
// numbers small in which exact points are sought.
Expression generic_component_of(std::size_t j, std::size_t i) {
  constexpr unsigned long kPrime = 97;
  const unsigned long k = (i + 29 * j) % (kPrime - 1) + 1;
  unsigned long inverse = 1;
  while (inverse * k % kPrime != 1) ++inverse;
  const std::string digits = std::to_string(100 + 3 + inverse).substr(1);
  return Expression::number("0." + digits);
}

// The unknowns of each vector; fills in what the system says of them.
std::vector<std::vector<Expression>> add_unknowns(TrigonometricSystem& system, const Mechanism& mechanism,
                                                  const KernelQuestion& kernel, const std::string& stem) {
  const std::size_t n = kernel.side == KernelSide::right ? kernel.matrix.columns.size() : kernel.matrix.rows.size();
  if (system.corank < 1 || std::cmp_greater(system.corank, n))
    throw ModelError(model_place(mechanism),
                     "a corank of " + std::to_string(system.corank) + ", but a kernel vector of " + kernel.name + " has " +
                         count(n, "component"),
                     "a corank from 1 to " + std::to_string(n));
  const bool second = stem != kStem;
  std::vector<std::string>& unknowns = second ? system.second_unknowns : system.kernel_unknowns;
  unknowns = kernel_names(mechanism, n, system.corank, stem);
  if (!second && !system.kernel_scales.empty() && system.kernel_scales.size() != n)
    throw ModelError(model_place(mechanism), std::to_string(system.kernel_scales.size()) + " scales of the kernel vector",
                     std::to_string(n));
  std::vector<std::vector<Expression>> xi;
  for (auto first = unknowns.begin(); first != unknowns.end(); first += n) xi.push_back(symbols({first, first + n}));
  return xi;
}

// ξⁱ·ξʲ = δ_ij, a_i·ξʲ = 0 for i < j and a_j·ξʲ ≥ 0; every set of c-dimensional kernels' configurations is whole
// (singularity_system.h).
void add_normalization(TrigonometricSystem& system, const SourceLocation& where,
                       const std::vector<std::vector<Expression>>& xi, const std::string& stem) {
  const auto name = [&](std::size_t j) { return xi.size() == 1 ? stem : stem + std::to_string(j + 1); };
  const auto dot_generic = [&](std::size_t i, std::size_t j) {  // a_i·ξʲ
    if (xi.size() == 1) return generic_form(xi[j]);
    std::vector<Expression> a;
    for (std::size_t k = 0; k < xi[j].size(); ++k) a.push_back(generic_component_of(i, k));
    return dot(a, xi[j]);
  };
  for (std::size_t j = 0; j < xi.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      system.equations.push_back({dot(xi[i], xi[j]) == Expression(0), name(i) + " orthogonal to " + name(j), where, true});
      system.equations.push_back({dot_generic(i, j) == Expression(0), "choice of " + name(j), where, true});
    }
    system.equations.push_back({square_of(xi[j]) == Expression(1), "norm of " + name(j), where, true});
    system.inequalities.push_back({dot_generic(j, j) >= Expression(0), "half-space of " + name(j), where, true});
  }
}

// How a row came about, behind its name.
std::string words(const PassiveRates::RowNote& note) {
  std::string text;
  if (const std::size_t n = note.free_of.size())
    text = std::string(", without the rate") + (n > 1 ? "s" : "") + " of " + joined(note.free_of);
  return note.gives.empty() ? text : text + ", gives the rate of " + note.gives;
}

void add_kernel(TrigonometricSystem& system, const Mechanism& mechanism, const KernelQuestion& kernel,
                const std::string& stem = kStem) {
  const bool right = kernel.side == KernelSide::right;
  const PassiveRates& passive = kernel.passive;
  const ExpressionMatrix& matrix = passive.eliminated.empty() ? kernel.matrix : passive.matrix;
  const std::vector<std::vector<Expression>> xi = add_unknowns(system, mechanism, kernel, stem);
  const std::size_t rows = matrix.rows.size(), columns = matrix.columns.size(), n = xi[0].size();
  for (std::size_t v = 0; v < xi.size(); ++v) {
    const bool second = stem != kStem;
    const auto first = (second ? system.second_unknowns : system.kernel_unknowns).begin() + v * n;
    const std::vector<Expression> rates =
        scaled({first, first + n}, second ? std::vector<std::string>{} : system.kernel_scales);
    const std::string vector = xi.size() == 1 ? stem : stem + std::to_string(v + 1);
    for (std::size_t i = 0; i < (right ? rows : columns); ++i) {
      std::vector<Expression> entries;
      if (right) {
        entries = matrix.rows[i];
      } else {
        for (const auto& row : matrix.rows) entries.push_back(row[i]);
      }
      const std::string source = "row " + std::to_string(i + 1) + " of " + kernel.name + (right ? "" : "^T") + " " + vector +
                                 " = 0" + (passive.eliminated.empty() ? "" : words(passive.notes[i]));
      // A row of zeros says nothing about xi.
      if (const auto lhs = kernel_row(entries, rates))
        system.equations.push_back({*lhs == Expression(0), source, right ? kernel.where[i] : model_place(mechanism), true});
    }
  }
  if (is_on_a_line(kernel))
    return add_limit_on_a_line(system, mechanism, *kernel.at_limit->on_a_line,
                               scaled(system.kernel_unknowns, system.kernel_scales));
  std::vector<std::vector<Expression>> left = xi;  // of which it asks that they are not all 0
  for (auto& v : left)
    for (const std::size_t j : passive.eliminated | std::views::reverse) v.erase(v.begin() + j);
  add_normalization(system, model_place(mechanism), left, stem);
}

}  // namespace

void KernelQuestion::drop(const std::vector<std::size_t>& rows) {
  dropped = rows;
  for (const std::size_t row : rows | std::views::reverse) {
    matrix.rows.erase(matrix.rows.begin() + row);
    where.erase(where.begin() + row);
  }
}

KernelQuestion kernel_question(const Mechanism& mechanism, const RequirementPart& part) {
  return at_limits(definition(SingularitySet::requirements), at_limit(mechanism, part), std::nullopt);
}

KernelQuestion kernel_question(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side) {
  const SetDefinition& asked = definition(set);
  if (asked.of_requirements) {
    const std::vector<RequirementPart> parts = requirement_parts(mechanism);
    if (parts.size() == 1) return at_limits(asked, at_limit(mechanism, parts[0]), side);
    return at_limits(asked, {at_requirements(mechanism), {}}, side);
  }
  const VelocityEquation velocity = derive(mechanism).velocity;
  const char* const name = velocity.given && asked.locked.empty() ? "L" : asked.matrix;
  KernelQuestion kernel = question_of(mechanism, velocity, asked, asked.locked, name, side);
  if (!asked.also_locked.empty())
    kernel.also.push_back(question_of(mechanism, velocity, asked, asked.also_locked, asked.also_matrix, std::nullopt));
  return kernel;
}

KernelQuestion without_passive_rates(const Mechanism& mechanism, KernelQuestion kernel) {
  if (kernel.side == KernelSide::right && !is_on_a_line(kernel))
    kernel.passive = eliminate_passive_rates(mechanism, kernel.matrix);
  return kernel;
}

TrigonometricSystem singularity_system(const Mechanism& mechanism, const KernelQuestion& kernel,
                                       const std::vector<std::string>& scales, int corank) {
  return with_kernel(plain_system(mechanism), mechanism, kernel, scales, corank);
}

TrigonometricSystem with_kernel(TrigonometricSystem system, const Mechanism& mechanism, const KernelQuestion& kernel,
                                const std::vector<std::string>& scales, int corank) {
  if (is_on_a_line(kernel) && corank != 1)
    throw ModelError(model_place(mechanism), "the limit of an effort or an error has no corank", "a corank of 1");
  system.name += std::string(" ") + kernel.set.name + (corank > 1 ? " corank " + std::to_string(corank) : "");
  system.kernel_scales = scales;
  system.corank = corank;
  system.passive_rates_eliminated = !kernel.passive.eliminated.empty();
  add_kernel(system, mechanism, kernel);
  if (!kernel.also.empty() && corank != 1)
    throw ModelError(model_place(mechanism), std::string("the set ") + kernel.set.name + " has two kernels",
                     "a corank of 1");
  for (const KernelQuestion& second : kernel.also) add_kernel(system, mechanism, second, "eta");
  return system;
}

TrigonometricSystem singularity_system(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side,
                                       const std::vector<std::string>& scales, int corank) {
  if (definition(set).has_kernel())
    return singularity_system(mechanism, kernel_question(mechanism, set, side), scales, corank);
  if (corank != 1)
    throw ModelError(model_place(mechanism), std::string("the set ") + definition(set).name + " has no kernel, so no corank",
                     names_of_sets(true));
  if (definition(set).part == LocusPart::cusps) return cusp_system(mechanism, set, scales);
  if (definition(set).part == LocusPart::nodes) return node_system(mechanism, set, scales);
  TrigonometricSystem system = plain_system(mechanism);
  system.name += std::string(" ") + definition(set).name;
  return system;
}

}  // namespace corank::symbolic
