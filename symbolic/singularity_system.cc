#include "corank/symbolic/singularity_system.h"

#include <algorithm>
#include <filesystem>
#include <ranges>

#include "corank/core/exact_number.h"
#include "corank/symbolic/found_ranges.h"
#include "corank/symbolic/limits.h"
#include "corank/symbolic/model_file.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

// The place that speaks for the whole model where no line does.
SourceLocation model_place(const Mechanism& mechanism) {
  for (const Constraint& constraint : mechanism.constraints())
    if (!constraint.where.file.empty()) return {constraint.where.file, 0, 0};
  return {mechanism.name(), 0, 0};
}

std::string count(std::size_t n, const std::string& noun) {
  return n == 0 ? "no " + noun + "s" : std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

/// What L has of columns and of rows, in words.
struct Counted {
  std::string column, row;
};

Counted counted(const VelocityEquation& velocity) {
  return velocity.given ? Counted{"rate", "velocity equation"} : Counted{"coordinate", "equation"};
}

/// The inputs, or the outputs: coordinates or rates.
struct Chosen {
  std::vector<std::string> names;
  std::vector<std::size_t> ties;
  std::string noun;
  SourceLocation where;
  std::string examples = " (w @ unit and R @ rotation have theirs)";  // of ties
};

Chosen chosen(const Mechanism& mechanism, const VelocityEquation& velocity, Role role) {
  Chosen result{velocity.names_of(role), velocity.ties(std::span(&role, 1)), to_string(role), {}};
  if (!velocity.given) {
    result.where = role == Role::input ? mechanism.inputs_where() : mechanism.outputs_where();
  } else if (!result.names.empty()) {
    result.noun += " rate";
    result.examples.clear();
    result.where = mechanism.rates()[static_cast<std::size_t>(mechanism.find_rate(result.names[0]))].where;
  }
  return result;
}

// What would do, where the mobility is `wanted`.
std::string wanted_text(const Chosen& chosen, std::size_t wanted) {
  if (chosen.names.size() <= wanted + chosen.ties.size())
    return count(wanted + chosen.ties.size(), chosen.noun) + (chosen.ties.empty() ? "" : " with these ties");
  const std::size_t more = chosen.names.size() - chosen.ties.size() - wanted;
  return count(wanted, chosen.noun) + ", or " + count(more, chosen.ties.empty() ? "equation" : "more equation") + " in " +
         chosen.noun + "s alone that " + (more == 1 ? "ties" : "tie") + " them" + chosen.examples;
}

// Mobility must equal the number of inputs (of outputs) less their ties: otherwise L_y (L_z) is not square, and the
// mechanism is redundant.
void check_mobility(const Mechanism& mechanism, const VelocityEquation& velocity, const Chosen& chosen) {
  const SourceLocation where = chosen.where.line > 0 ? chosen.where : model_place(mechanism);
  const std::size_t equations = velocity.matrix.rows.size(), columns = velocity.matrix.columns.size();
  const Counted words = counted(velocity);
  if (chosen.names.size() == columns && equations > 0)
    throw ModelError(
        where, "every " + words.column + " is an " + chosen.noun + ", so nothing is left to move where they are locked",
        words.column + "s that are no " + chosen.noun + "s");
  const auto mobility = static_cast<long>(columns) - static_cast<long>(equations);
  const long free = static_cast<long>(chosen.names.size()) - static_cast<long>(chosen.ties.size());
  if (free == mobility) return;
  std::string problem = "the mechanism has " + count(columns, words.column) + " and " + count(equations, words.row) +
                        ", so mobility " + std::to_string(mobility) + ", but " + count(chosen.names.size(), chosen.noun);
  if (!chosen.ties.empty())
    problem += " tied by " + count(chosen.ties.size(), "equation") + ", so " + std::to_string(free) + " free";
  if (free > mobility && mobility >= 0) problem += ": a redundant mechanism";
  throw ModelError(where, problem,
                   mobility < 0 ? "no more " + words.row + "s than " + words.column + "s"
                                : wanted_text(chosen, static_cast<std::size_t>(mobility)));
}

void check_chosen(const Mechanism& mechanism, const VelocityEquation& velocity, const SetDefinition& set) {
  for (const Role role : set.locked) {
    if (!velocity.names_of(role).empty()) continue;
    const std::string word = to_string(role);
    throw ModelError(
        model_place(mechanism),
        "the model names no " + word + (velocity.given ? " rates" : "s") + ", which the " + set.name + " singularities need",
        velocity.given ? "a line `name ~ " + word + "` in [RATES]"
                       : std::string("a line [") + (role == Role::input ? "INPUTS" : "OUTPUTS") + "]");
  }
  for (const Role role : {Role::input, Role::output}) {
    const Chosen names = chosen(mechanism, velocity, role);
    if (!names.names.empty()) check_mobility(mechanism, velocity, names);
  }
}

// Whether all of L loses rank is a question only where that is not so everywhere.
void check_whole(const Mechanism& mechanism, const VelocityEquation& velocity, const std::string& name, KernelSide side) {
  const std::size_t equations = velocity.matrix.rows.size(), columns = velocity.matrix.columns.size();
  const Counted words = counted(velocity);
  if (equations > columns) {
    throw ModelError(model_place(mechanism),
                     "the mechanism has " + count(columns, words.column) + " and " + count(equations, words.row) + ", so " +
                         name + " never has full row rank",
                     "no more " + words.row + "s than " + words.column + "s");
  }
  if (side == KernelSide::right && equations < columns) {
    throw ModelError(model_place(mechanism),
                     name + " has " + count(equations, "row") + " and " + count(columns, "column") +
                         ", so every configuration has a right kernel",
                     "the left kernel");
  }
}

// Of one vector with n components, or of several.
std::vector<std::string> kernel_names(const Mechanism& mechanism, std::size_t n, std::size_t vectors) {
  for (std::string prefix = "xi";; prefix += "_") {
    std::vector<std::string> names;
    for (std::size_t v = 0; v < vectors; ++v)
      for (std::size_t i = 0; i < n; ++i)
        names.push_back(prefix + (vectors > 1 ? std::to_string(v + 1) + "_" : "") + std::to_string(i + 1));
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) {
          return mechanism.has_constant(name) || mechanism.find_coordinate(name) >= 0 || mechanism.find_rate(name) >= 0;
        }))
      return names;
  }
}

Expression times(const Expression& entry, const Expression& unknown) {
  if (same_tree(entry, Expression(1))) return unknown;
  if (entry.kind() == Kind::negation) return -times(entry.operands()[0], unknown);
  return entry * unknown;
}

// A scale of 0 would make every configuration singular.
Expression positive_number(const std::string& text, const std::string& unknown) {
  bool positive = false;
  try {
    positive = ExactNumber::rational(text).sign() == 1;
  } catch (const std::exception&) {  // no number
  }
  if (!positive) throw ModelError({"scale of " + unknown, 0, 0}, "'" + text + "' is no scale", "a positive rational number");
  return parse_expression(text, "scale of " + unknown);
}

// s_j ξ_j of each unknown.
std::vector<Expression> scaled(const std::vector<std::string>& unknowns, const std::vector<std::string>& scales) {
  std::vector<Expression> result;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const Expression unknown = Expression::symbol(unknowns[j]);
    const bool plain = scales.empty() || scales[j] == "1";
    result.push_back(plain ? unknown : positive_number(scales[j], unknowns[j]) * unknown);
  }
  return result;
}

// Σ entries[j]·s_j ξ_j, term by term in order; nothing where all entries are 0.
std::optional<Expression> kernel_row(const std::vector<Expression>& entries, const std::vector<Expression>& unknowns) {
  std::vector<Expression> terms;
  for (std::size_t j = 0; j < entries.size(); ++j)
    if (!same_tree(entries[j], Expression(0))) terms.push_back(times(entries[j], unknowns[j]));
  if (terms.empty()) return std::nullopt;
  return Expression::node(Kind::sum, terms);
}

// Component i of the fixed generic vector a of one kernel vector: 0.3 + 0.7·frac((i + 1)·golden ratio) to four digits, so
// that no mechanism's symmetry makes a·ξ = 0 on a whole piece of a singularity set.
Expression generic_component(std::size_t i) {
  const unsigned long fraction = (i + 1) * 618'034UL % 1'000'000UL;
  const std::string digits = std::to_string(3000 + 7 * fraction / 1000);  // in 3000 … 9999
  return Expression::number("0." + digits);
}

// Component i of a_j, of several vectors: 3/100 more than the inverse of i + 29 j + 1 modulo 97, in hundredths. The sequence
// above would not do: its differences repeat, and a_1 and a_2 were orthogonal to the same kernels. Few digits keep the
// numbers small in which exact points are sought.
Expression generic_component(std::size_t j, std::size_t i) {
  constexpr unsigned long kPrime = 97;
  const unsigned long k = (i + 29 * j) % (kPrime - 1) + 1;
  unsigned long inverse = 1;
  while (inverse * k % kPrime != 1) ++inverse;
  const std::string digits = std::to_string(100 + 3 + inverse).substr(1);
  return Expression::number("0." + digits);
}

// Σ terms_i, term by term.
Expression sum_of(const std::vector<Expression>& terms) { return Expression::node(Kind::sum, terms); }

// The unknowns of each vector; fills in what the system says of them.
std::vector<std::vector<Expression>> add_unknowns(TrigonometricSystem& system, const Mechanism& mechanism,
                                                  const KernelQuestion& kernel) {
  const std::size_t n = kernel.side == KernelSide::right ? kernel.matrix.columns.size() : kernel.matrix.rows.size();
  if (system.corank < 1 || static_cast<std::size_t>(system.corank) > n) {
    throw ModelError(model_place(mechanism),
                     "a corank of " + std::to_string(system.corank) + ", but a kernel vector of " + kernel.name + " has " +
                         count(n, "component"),
                     "a corank from 1 to " + std::to_string(n));
  }
  const auto vectors = static_cast<std::size_t>(system.corank);
  system.kernel_unknowns = kernel_names(mechanism, n, vectors);
  if (!system.kernel_scales.empty() && system.kernel_scales.size() != n) {
    throw ModelError(model_place(mechanism), std::to_string(system.kernel_scales.size()) + " scales of the kernel vector",
                     std::to_string(n));
  }
  std::vector<std::vector<Expression>> xi(vectors);
  for (std::size_t i = 0; i < vectors * n; ++i) xi[i / n].push_back(Expression::symbol(system.kernel_unknowns[i]));
  return xi;
}

// ξⁱ·ξʲ = δ_ij, a_i·ξʲ = 0 for i < j and a_j·ξʲ ≥ 0; every set of c-dimensional kernels' configurations is whole
// (singularity_system.h).
void add_normalization(TrigonometricSystem& system, const SourceLocation& where,
                       const std::vector<std::vector<Expression>>& xi) {
  const auto name = [&](std::size_t j) { return xi.size() == 1 ? std::string("xi") : "xi" + std::to_string(j + 1); };
  const auto dot_generic = [&](std::size_t i, std::size_t j) {  // a_i·ξʲ
    std::vector<Expression> terms;
    for (std::size_t k = 0; k < xi[j].size(); ++k)
      terms.push_back((xi.size() == 1 ? generic_component(k) : generic_component(i, k)) * xi[j][k]);
    return sum_of(terms);
  };
  for (std::size_t j = 0; j < xi.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      std::vector<Expression> products;
      for (std::size_t k = 0; k < xi[j].size(); ++k) products.push_back(xi[i][k] * xi[j][k]);
      system.equations.push_back({sum_of(products) == Expression(0), name(i) + " orthogonal to " + name(j), where, true});
      system.equations.push_back({dot_generic(i, j) == Expression(0), "choice of " + name(j), where, true});
    }
    std::vector<Expression> squares;
    for (const Expression& x : xi[j]) squares.push_back(pow(x, 2));
    system.equations.push_back({sum_of(squares) == Expression(1), "norm of " + name(j), where, true});
    system.inequalities.push_back({dot_generic(j, j) >= Expression(0), "half-space of " + name(j), where, true});
  }
}

// How a row came about, behind its name.
std::string words(const PassiveRates::RowNote& note) {
  std::string text;
  for (const std::string& rate : note.free_of) text += (text.empty() ? "" : ", ") + rate;
  if (!text.empty()) text = ", without the rate" + std::string(note.free_of.size() > 1 ? "s" : "") + " of " + text;
  return note.gives.empty() ? text : text + ", gives the rate of " + note.gives;
}

void add_kernel(TrigonometricSystem& system, const Mechanism& mechanism, const KernelQuestion& kernel) {
  const bool right = kernel.side == KernelSide::right;
  const PassiveRates& passive = kernel.passive;
  const ExpressionMatrix& matrix = passive.eliminated.empty() ? kernel.matrix : passive.matrix;
  const std::vector<std::vector<Expression>> xi = add_unknowns(system, mechanism, kernel);
  const std::size_t rows = matrix.rows.size(), columns = matrix.columns.size(), n = xi[0].size();
  for (std::size_t v = 0; v < xi.size(); ++v) {
    const auto first = system.kernel_unknowns.begin() + static_cast<std::ptrdiff_t>(v * n);
    const std::vector<Expression> rates = scaled({first, first + static_cast<std::ptrdiff_t>(n)}, system.kernel_scales);
    const std::string vector = xi.size() == 1 ? "xi" : "xi" + std::to_string(v + 1);
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
  std::vector<std::vector<Expression>> left = xi;  // of which it asks that they are not all 0
  for (auto& v : left)
    for (const std::size_t j : passive.eliminated | std::views::reverse) v.erase(v.begin() + static_cast<std::ptrdiff_t>(j));
  add_normalization(system, model_place(mechanism), left);
}

}  // namespace

std::vector<Expression> kernel_components(const TrigonometricSystem& system) {
  return scaled(system.kernel_unknowns, system.kernel_scales);
}

TrigonometricSystem plain_system(const Mechanism& mechanism) {
  mechanism.validate();
  TrigonometricSystem system;
  system.name = mechanism.name();
  system.constants = mechanism.constants();
  system.coordinates = mechanism.coordinates();
  keep_limits(mechanism, system.coordinates);
  const auto add = [](std::vector<TrigonometricSystem::Equation>& list, const Constraint& constraint,
                      const std::string& word) {
    const std::string number = word + " " + std::to_string(list.size() + 1);
    // The file without its folders: results must not depend on where a model lies.
    const SourceLocation line{std::filesystem::path(constraint.where.file).filename().string(), constraint.where.line, 0};
    const std::string note = constraint.note.empty() ? "" : " (" + constraint.note + ")";
    list.push_back({constraint.relation, (line.line > 0 ? line.text() : number) + note, constraint.where, false});
  };
  for (const Constraint& constraint : mechanism.constraints()) {
    if (constraint.relation.kind == Relation::Kind::equal) {
      add(system.equations, constraint, "equation");
    } else {
      add(system.inequalities, constraint, "inequality");
    }
  }
  for (const Constraint& constraint : mechanism.implied()) add(system.claimed, constraint, "implied equation");
  find_ranges(system);
  return system;
}

KernelQuestion kernel_question(const Mechanism& mechanism, const VelocityEquation& velocity, SingularitySet set,
                               std::optional<KernelSide> side) {
  KernelQuestion kernel{definition(set),
                        matrix_name(definition(set), velocity),
                        velocity.without(definition(set).locked),
                        velocity.where,
                        {},
                        {}};
  kernel.side = side.value_or(kernel.set.side);
  if (kernel.set.locked.empty()) {
    check_whole(mechanism, velocity, kernel.name, kernel.side);
  } else {
    check_chosen(mechanism, velocity, kernel.set);
  }
  // Lemma (doc/theory.md): a matrix and the same without rows of zeros have the same right kernel, which passes them over; a
  // left one would have an unknown that nothing is asked of.
  if (kernel.side == KernelSide::right) return kernel;
  kernel.dropped = velocity.ties(kernel.set.locked);
  for (const std::size_t row : kernel.dropped | std::views::reverse) {
    kernel.matrix.rows.erase(kernel.matrix.rows.begin() + static_cast<std::ptrdiff_t>(row));
    kernel.where.erase(kernel.where.begin() + static_cast<std::ptrdiff_t>(row));
  }
  return kernel;
}

KernelQuestion without_passive_rates(const Mechanism& mechanism, KernelQuestion kernel) {
  if (kernel.side == KernelSide::right) kernel.passive = eliminate_passive_rates(mechanism, kernel.matrix);
  return kernel;
}

TrigonometricSystem singularity_system(const Mechanism& mechanism, const KernelQuestion& kernel,
                                       const std::vector<std::string>& scales, int corank) {
  TrigonometricSystem system = plain_system(mechanism);
  system.name += std::string(" ") + kernel.set.name + (corank > 1 ? " corank " + std::to_string(corank) : "");
  system.kernel_scales = scales;
  system.corank = corank;
  system.passive_rates_eliminated = !kernel.passive.eliminated.empty();
  add_kernel(system, mechanism, kernel);
  return system;
}

TrigonometricSystem singularity_system(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side,
                                       const std::vector<std::string>& scales, int corank) {
  if (definition(set).has_kernel())
    return singularity_system(mechanism, kernel_question(mechanism, derive(mechanism).velocity, set, side), scales, corank);
  if (corank != 1)
    throw ModelError(model_place(mechanism), std::string(definition(set).title) + " has no kernel, so no corank",
                     names_of_sets(true));
  TrigonometricSystem system = plain_system(mechanism);
  system.name += std::string(" ") + definition(set).name;
  return system;
}

}  // namespace corank::symbolic
