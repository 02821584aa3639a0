#include "corank/symbolic/singularity_system.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "corank/core/exact_number.h"
#include "corank/symbolic/found_ranges.h"
#include "corank/symbolic/ginac_bridge.h"
#include "corank/symbolic/ginac_lock.h"
#include "corank/symbolic/model_file.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<const Constraint*> assembly_constraints(const Mechanism& mechanism) {
  std::vector<const Constraint*> result;
  for (const Constraint& constraint : mechanism.constraints())
    if (constraint.relation.kind == Relation::Kind::equal) result.push_back(&constraint);
  return result;
}

// The place that speaks for the whole model where no line does.
SourceLocation model_place(const Mechanism& mechanism) {
  for (const Constraint& constraint : mechanism.constraints())
    if (!constraint.where.file.empty()) return {constraint.where.file, 0, 0};
  return {mechanism.name(), 0, 0};
}

std::string count(std::size_t n, const std::string& noun) {
  return n == 0 ? "no " + noun + "s" : std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

bool is_number(const Expression& e, const char* digits) { return e.kind() == Kind::number && e.name() == digits; }

// lhs − rhs as written.
Expression residual(const Relation& relation) {
  return is_number(relation.rhs, "0") ? relation.lhs : relation.lhs - relation.rhs;
}

ExpressionMatrix columns_where(const ExpressionMatrix& matrix, const std::vector<bool>& keep) {
  ExpressionMatrix result;
  result.rows.resize(matrix.rows.size());
  for (std::size_t j = 0; j < matrix.columns.size(); ++j) {
    if (!keep[j]) continue;
    result.columns.push_back(matrix.columns[j]);
    for (std::size_t i = 0; i < matrix.rows.size(); ++i) result.rows[i].push_back(matrix.rows[i][j]);
  }
  return result;
}

// Equations in the chosen coordinates alone: their rows have no entry in the other columns.
std::vector<std::size_t> zero_rows(const ExpressionMatrix& matrix) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; !matrix.columns.empty() && i < matrix.rows.size(); ++i)
    if (std::all_of(matrix.rows[i].begin(), matrix.rows[i].end(), [](const Expression& e) { return is_number(e, "0"); }))
      rows.push_back(i);
  return rows;
}

// Lemma (doc/theory.md): a matrix and the same without rows of zeros have the same right kernel.
ExpressionMatrix without_rows(const ExpressionMatrix& matrix, const std::vector<std::size_t>& rows) {
  ExpressionMatrix result{matrix.columns, {}};
  for (std::size_t i = 0; i < matrix.rows.size(); ++i)
    if (!std::binary_search(rows.begin(), rows.end(), i)) result.rows.push_back(matrix.rows[i]);
  return result;
}

/// The inputs, or the outputs.
struct Chosen {
  const std::vector<std::string>& names;
  const std::vector<std::size_t>& ties;
  std::string noun;
  const SourceLocation& where;
};

// What would do, where the mobility is `wanted`.
std::string wanted_text(const Chosen& chosen, std::size_t wanted) {
  if (chosen.names.size() <= wanted + chosen.ties.size())
    return count(wanted + chosen.ties.size(), chosen.noun) + (chosen.ties.empty() ? "" : " with these ties");
  const std::size_t more = chosen.names.size() - chosen.ties.size() - wanted;
  return count(wanted, chosen.noun) + ", or " + count(more, chosen.ties.empty() ? "equation" : "more equation") + " in " +
         chosen.noun + "s alone that " + (more == 1 ? "ties" : "tie") + " them (w @ unit and R @ rotation have theirs)";
}

// Mobility must equal the number of inputs (of outputs) less their ties: otherwise L_y (L_z) is not square, and the
// mechanism is redundant.
void check_mobility(const Mechanism& mechanism, std::size_t equations, const Chosen& chosen) {
  const SourceLocation where = chosen.where.line > 0 ? chosen.where : model_place(mechanism);
  if (chosen.names.size() == mechanism.coordinates().size() && equations > 0)
    throw ModelError(where, "every coordinate is an " + chosen.noun + ", so nothing is left to move where they are locked",
                     "coordinates that are no " + chosen.noun + "s");
  const auto mobility = static_cast<long>(mechanism.coordinates().size()) - static_cast<long>(equations);
  const long free = static_cast<long>(chosen.names.size()) - static_cast<long>(chosen.ties.size());
  if (free == mobility) return;
  std::string problem = "the mechanism has " + count(mechanism.coordinates().size(), "coordinate") + " and " +
                        count(equations, "equation") + ", so mobility " + std::to_string(mobility) + ", but " +
                        count(chosen.names.size(), chosen.noun);
  if (!chosen.ties.empty())
    problem += " tied by " + count(chosen.ties.size(), "equation") + ", so " + std::to_string(free) + " free";
  if (free > mobility && mobility >= 0) problem += ": a redundant mechanism";
  throw ModelError(
      where, problem,
      mobility < 0 ? "no more equations than coordinates" : wanted_text(chosen, static_cast<std::size_t>(mobility)));
}

void check_chosen(const Mechanism& mechanism, const Derivation& derivation, SingularitySet set) {
  const bool forward = set == SingularitySet::forward;
  const std::string noun = forward ? "input" : "output";
  if ((forward ? mechanism.inputs() : mechanism.outputs()).empty()) {
    throw ModelError(model_place(mechanism),
                     "the model names no " + noun + "s, which the " + to_string(set) + " singularities need",
                     std::string("a line [") + (forward ? "INPUTS" : "OUTPUTS") + "]");
  }
  const std::size_t equations = derivation.phi.size();
  if (!mechanism.inputs().empty())
    check_mobility(mechanism, equations, {mechanism.inputs(), derivation.input_ties, "input", mechanism.inputs_where()});
  if (!mechanism.outputs().empty())
    check_mobility(mechanism, equations, {mechanism.outputs(), derivation.output_ties, "output", mechanism.outputs_where()});
}

// Of one vector with n components, or of several.
std::vector<std::string> kernel_names(const Mechanism& mechanism, std::size_t n, std::size_t vectors) {
  for (std::string prefix = "xi";; prefix += "_") {
    std::vector<std::string> names;
    for (std::size_t v = 0; v < vectors; ++v)
      for (std::size_t i = 0; i < n; ++i)
        names.push_back(prefix + (vectors > 1 ? std::to_string(v + 1) + "_" : "") + std::to_string(i + 1));
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) {
          return mechanism.has_constant(name) || mechanism.find_coordinate(name) >= 0;
        }))
      return names;
  }
}

Expression times(const Expression& entry, const Expression& unknown) {
  if (is_number(entry, "1")) return unknown;
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
    if (!is_number(entries[j], "0")) terms.push_back(times(entries[j], unknowns[j]));
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

/// What add_kernel is about.
struct KernelQuestion {
  const ExpressionMatrix& matrix;
  std::string name;  ///< of the matrix
  KernelSide side;
  const std::vector<std::string>& scales;
  int corank;
};

// The unknowns of each vector; fills in what the system says of them.
std::vector<std::vector<Expression>> add_unknowns(TrigonometricSystem& system, const Mechanism& mechanism,
                                                  const KernelQuestion& kernel) {
  const std::size_t n = kernel.side == KernelSide::right ? kernel.matrix.columns.size() : kernel.matrix.rows.size();
  if (kernel.corank < 1 || static_cast<std::size_t>(kernel.corank) > n) {
    throw ModelError(model_place(mechanism),
                     "a corank of " + std::to_string(kernel.corank) + ", but a kernel vector of " + kernel.name + " has " +
                         count(n, "component"),
                     "a corank from 1 to " + std::to_string(n));
  }
  const auto vectors = static_cast<std::size_t>(kernel.corank);
  system.corank = kernel.corank;
  system.kernel_unknowns = kernel_names(mechanism, n, vectors);
  system.kernel_scales = kernel.scales;
  if (!kernel.scales.empty() && kernel.scales.size() != n) {
    throw ModelError(model_place(mechanism), std::to_string(kernel.scales.size()) + " scales of the kernel vector",
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
      system.equations.push_back({sum_of(products) == Expression(0), name(i) + " orthogonal to " + name(j), where});
      system.equations.push_back({dot_generic(i, j) == Expression(0), "choice of " + name(j), where});
    }
    std::vector<Expression> squares;
    for (const Expression& x : xi[j]) squares.push_back(pow(x, 2));
    system.equations.push_back({sum_of(squares) == Expression(1), "norm of " + name(j), where});
    system.inequalities.push_back({dot_generic(j, j) >= Expression(0), "half-space of " + name(j), where});
  }
}

void add_kernel(TrigonometricSystem& system, const Mechanism& mechanism, const KernelQuestion& kernel) {
  const ExpressionMatrix& matrix = kernel.matrix;
  const bool right = kernel.side == KernelSide::right;
  const std::vector<std::vector<Expression>> xi = add_unknowns(system, mechanism, kernel);
  const std::size_t rows = matrix.rows.size(), columns = matrix.columns.size(), n = xi[0].size();
  const std::vector<const Constraint*> constraints = assembly_constraints(mechanism);
  for (std::size_t v = 0; v < xi.size(); ++v) {
    const auto first = system.kernel_unknowns.begin() + static_cast<std::ptrdiff_t>(v * n);
    const std::vector<Expression> rates = scaled({first, first + static_cast<std::ptrdiff_t>(n)}, kernel.scales);
    const std::string vector = xi.size() == 1 ? "xi" : "xi" + std::to_string(v + 1);
    for (std::size_t i = 0; i < (right ? rows : columns); ++i) {
      std::vector<Expression> entries;
      if (right) {
        entries = matrix.rows[i];
      } else {
        for (const auto& row : matrix.rows) entries.push_back(row[i]);
      }
      const std::string source =
          "row " + std::to_string(i + 1) + " of " + kernel.name + (right ? "" : "^T") + " " + vector + " = 0";
      // A row of zeros says nothing about xi.
      if (const auto lhs = kernel_row(entries, rates))
        system.equations.push_back({*lhs == Expression(0), source, right ? constraints[i]->where : model_place(mechanism)});
    }
  }
  add_normalization(system, model_place(mechanism), xi);
}

template <typename Word, std::size_t N>
std::optional<Word> find_word(const std::array<Word, N>& words, const std::string& text) {
  for (const Word word : words)
    if (text == to_string(word)) return word;
  return std::nullopt;
}

}  // namespace

const char* to_string(SingularitySet set) {
  switch (set) {
    case SingularitySet::cspace: return "cspace";
    case SingularitySet::forward: return "forward";
    case SingularitySet::inverse: return "inverse";
    case SingularitySet::cspace_singular: return "cspace-singular";
  }
  return "?";
}

const char* to_string(KernelSide side) { return side == KernelSide::right ? "right" : "left"; }

std::string set_with_corank(const std::string& set, int corank) {
  return corank == 1 ? set : set + " singularities of corank " + std::to_string(corank);
}

std::optional<SingularitySet> singularity_set_from_string(const std::string& text) {
  using enum SingularitySet;
  return find_word(std::array{cspace, forward, inverse, cspace_singular}, text);
}

std::optional<KernelSide> kernel_side_from_string(const std::string& text) {
  return find_word(std::array{KernelSide::right, KernelSide::left}, text);
}

Derivation derive(const Mechanism& mechanism) {
  mechanism.validate();
  const GinacLock lock;
  std::vector<std::string> constants, coordinates;
  for (const Constant& constant : mechanism.constants()) constants.push_back(constant.name);
  for (const Coordinate& coordinate : mechanism.coordinates()) coordinates.push_back(coordinate.name);
  const GinacBridge bridge(constants, coordinates);

  Derivation result;
  result.phi_q.columns = coordinates;
  for (const Constraint* constraint : assembly_constraints(mechanism)) {
    const std::string text = constraint->relation.text();
    const GiNaC::ex phi = bridge.to_ginac(constraint->relation.lhs, constraint->where) -
                          bridge.to_ginac(constraint->relation.rhs, constraint->where);
    if (!bridge.mentions_coordinate(phi)) {
      const bool number = GiNaC::is_a<GiNaC::numeric>(phi);
      throw ModelError(constraint->where,
                       "the equation `" + text + "` " +
                           (!number         ? "is about constants only"
                            : phi.is_zero() ? "holds always"
                                            : "can never hold"),
                       "an equation between coordinates");
    }
    result.phi.push_back(residual(constraint->relation));
    std::vector<Expression>& row = result.phi_q.rows.emplace_back();
    for (const std::string& coordinate : coordinates) {
      try {
        row.push_back(bridge.to_expression(phi.diff(bridge.symbol(coordinate))));
      } catch (const std::exception& error) {
        throw ModelError(constraint->where,
                         "the equation `" + text + "` cannot be differentiated by " + coordinate + ": " + error.what());
      }
    }
  }
  std::vector<bool> in_l_y, in_l_z, in_l_p;
  for (const std::string& coordinate : coordinates) {
    in_l_y.push_back(!contains(mechanism.inputs(), coordinate));
    in_l_z.push_back(!contains(mechanism.outputs(), coordinate));
    in_l_p.push_back(in_l_y.back() && in_l_z.back());
  }
  result.l_y = columns_where(result.phi_q, in_l_y);
  result.l_z = columns_where(result.phi_q, in_l_z);
  result.l_p = columns_where(result.phi_q, in_l_p);
  if (!mechanism.inputs().empty()) result.input_ties = zero_rows(result.l_y);
  if (!mechanism.outputs().empty()) result.output_ties = zero_rows(result.l_z);
  return result;
}

TrigonometricSystem plain_system(const Mechanism& mechanism) {
  mechanism.validate();
  TrigonometricSystem system;
  system.name = mechanism.name();
  system.constants = mechanism.constants();
  system.coordinates = mechanism.coordinates();
  for (const Constraint& constraint : mechanism.constraints()) {
    const bool equation = constraint.relation.kind == Relation::Kind::equal;
    auto& list = equation ? system.equations : system.inequalities;
    const std::string number = (equation ? "equation " : "inequality ") + std::to_string(list.size() + 1);
    // The file without its folders: results must not depend on where a model lies.
    const SourceLocation line{std::filesystem::path(constraint.where.file).filename().string(), constraint.where.line, 0};
    const std::string note = constraint.note.empty() ? "" : " (" + constraint.note + ")";
    list.push_back({constraint.relation, (line.line > 0 ? line.text() : number) + note, constraint.where});
  }
  find_ranges(system);
  return system;
}

TrigonometricSystem singularity_system(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side,
                                       const std::vector<std::string>& scales, int corank) {
  TrigonometricSystem system = plain_system(mechanism);
  system.name += std::string(" ") + to_string(set) + (corank > 1 ? " corank " + std::to_string(corank) : "");
  if (set == SingularitySet::cspace) {
    if (corank != 1)
      throw ModelError(model_place(mechanism), "C-space has no kernel, so no corank", "forward, inverse or cspace-singular");
    return system;
  }
  const Derivation derivation = derive(mechanism);
  const std::size_t equations = derivation.phi.size(), coordinates = mechanism.coordinates().size();
  if (set == SingularitySet::cspace_singular) {
    if (equations > coordinates) {
      throw ModelError(model_place(mechanism),
                       "the mechanism has " + count(coordinates, "coordinate") + " and " + count(equations, "equation") +
                           ", so Phi_q never has full row rank",
                       "no more equations than coordinates");
    }
    if (side == KernelSide::right && equations < coordinates) {
      throw ModelError(model_place(mechanism),
                       "Phi_q has " + count(equations, "row") + " and " + count(coordinates, "column") +
                           ", so every configuration has a right kernel",
                       "the left kernel");
    }
    add_kernel(system, mechanism, {derivation.phi_q, "Phi_q", side.value_or(KernelSide::left), scales, corank});
    return system;
  }
  check_chosen(mechanism, derivation, set);
  const bool forward = set == SingularitySet::forward;
  const ExpressionMatrix& matrix = forward ? derivation.l_y : derivation.l_z;
  // A right kernel passes rows of zeros over; a left one would have an unknown that nothing is asked of.
  const bool left = side == KernelSide::left;
  const ExpressionMatrix kept =
      left ? without_rows(matrix, forward ? derivation.input_ties : derivation.output_ties) : matrix;
  add_kernel(system, mechanism, {kept, forward ? "L_y" : "L_z", side.value_or(KernelSide::right), scales, corank});
  return system;
}

}  // namespace corank::symbolic
