#include "corank/symbolic/sets/velocity_blocks.h"

#include <algorithm>

#include "corank/core/check.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirements.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

constexpr std::array kInputs{Role::input}, kOutputs{Role::output};
constexpr std::array kChosen{Role::input, Role::output};

Block block_of(std::span<const Role> locked) {
  if (locked.empty()) return Block::all;
  if (std::ranges::equal(locked, kInputs)) return Block::forward;
  if (std::ranges::equal(locked, kOutputs)) return Block::inverse;
  CORANK_CHECK(std::ranges::equal(locked, kChosen));
  return Block::passive;
}

// The rows of dependencies, in the columns of the role alone.
ExpressionMatrix dependent_angles_of(const VelocityEquation& velocity, Role role) {
  ExpressionMatrix result;
  for (const std::size_t i : velocity.dependencies(std::span(&role, 1))) {
    std::vector<Expression>& row = result.rows.emplace_back();
    for (std::size_t j = 0; j < velocity.matrix.columns.size(); ++j)
      if (velocity.matrix.roles[j] == role) row.push_back(velocity.matrix.rows[i][j]);
  }
  if (!result.rows.empty()) result.columns = velocity.names_of(role);
  return result;
}

int rank_at_most(const PolynomialMatrix& m) {
  std::vector<std::vector<std::size_t>> filled(m.rows);
  for (int i = 0; i < m.rows; ++i)
    for (int j = 0; j < m.columns; ++j)
      if (!m.entries[i * m.columns + j].monomials.empty()) filled[i].push_back(j);
  return static_cast<int>(term_rank(filled, m.columns));
}

// Nothing where an entry is none: a sine of a length.
std::optional<std::vector<PolynomialMatrix>> as_polynomials(const Mechanism& mechanism,
                                                            std::span<const ExpressionMatrix> matrices) {
  std::vector<Expression> entries;
  for (const ExpressionMatrix& m : matrices)
    for (const auto& row : m.rows) entries.insert(entries.end(), row.begin(), row.end());
  std::vector<Polynomial> list;
  try {
    list = polynomials(plain_system(mechanism), entries);
  } catch (const ModelError&) {
    return std::nullopt;
  }
  std::vector<PolynomialMatrix> result;
  auto next = list.begin();
  for (const ExpressionMatrix& of : matrices) {
    PolynomialMatrix& m = result.emplace_back();
    m.rows = static_cast<int>(of.rows.size());
    m.columns = static_cast<int>(of.columns.size());
    const auto size = static_cast<std::ptrdiff_t>(m.rows) * m.columns;
    m.entries.assign(std::make_move_iterator(next), std::make_move_iterator(next + size));
    next += size;
  }
  return result;
}

// The types that are worth a word: with inputs and outputs that fit the mobility.
TypeSet asked_types(const VelocityEquation& velocity, int inputs, int outputs) {
  using enum SingularityType;
  const int mobility = static_cast<int>(velocity.matrix.columns.size()) - static_cast<int>(velocity.matrix.rows.size());
  const int free_inputs = inputs - static_cast<int>(velocity.dependencies(kInputs).size()),
            free_outputs = outputs - static_cast<int>(velocity.dependencies(kOutputs).size());
  TypeSet asked = bit(iim);
  const bool held = inputs > 0 && free_inputs >= mobility, chosen = outputs > 0 && free_outputs <= mobility;
  if (!held || !chosen) return asked;
  asked |= static_cast<TypeSet>(bit(ro) | bit(rpm) | bit(io));
  if (free_inputs == mobility) asked |= bit(ii);   // else with actuators that work against each other II is everywhere
  if (free_outputs == mobility) asked |= bit(ri);  // else with motions that leave the output alone RI is
  return asked;
}

TypeSet types_of(const SetDefinition& set, Block block, KernelSide side, const ExpressionMatrix& matrix) {
  using enum SingularityType;
  if (set.type) return bit(*set.type);
  if (block == Block::all) return bit(iim);
  const auto right = static_cast<TypeSet>(bit(rpm) | (block == Block::forward ? bit(ro) : bit(ri))),
             left = static_cast<TypeSet>(bit(iim) | (block == Block::forward ? bit(ii) : bit(io)));
  if (matrix.rows.size() == matrix.columns.size()) return static_cast<TypeSet>(right | left);
  return side == KernelSide::right ? right : left;
}

}  // namespace

std::optional<VelocityBlocks> velocity_blocks(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side,
                                              int corank) {
  if (!definition(set).has_kernel() || definition(set).of_requirements) return std::nullopt;
  const VelocityEquation velocity = derive(mechanism).velocity;
  VelocityBlocks blocks;
  blocks.inputs = static_cast<int>(velocity.names_of(Role::input).size());
  blocks.outputs = static_cast<int>(velocity.names_of(Role::output).size());
  blocks.passive = static_cast<int>(velocity.names_of(Role::passive).size());
  blocks.asked = asked_types(velocity, blocks.inputs, blocks.outputs);
  const std::array<ExpressionMatrix, kBlocks> matrices{velocity.without({}),
                                                       velocity.without(kInputs),
                                                       velocity.without(kOutputs),
                                                       velocity.without(kChosen),
                                                       dependent_angles_of(velocity, Role::input),
                                                       dependent_angles_of(velocity, Role::output)};
  std::optional<std::vector<PolynomialMatrix>> found = as_polynomials(mechanism, matrices);
  if (!found) return std::nullopt;
  for (std::size_t b = 0; b < matrices.size(); ++b) {
    blocks.matrices[b] = std::move((*found)[b]);
    blocks.at_most[b] = rank_at_most(blocks.matrices[b]);
  }
  const auto lower = [&](const KernelQuestion& kernel, std::span<const Role> locked) {
    const Block block = block_of(locked);
    const std::size_t unknowns = kernel.side == KernelSide::right ? kernel.matrix.columns.size() : kernel.matrix.rows.size();
    int& most = blocks.at_most[static_cast<std::size_t>(block)];
    most = std::min(most, static_cast<int>(unknowns) - corank);
    ExpressionMatrix square = kernel.matrix;
    if (kernel.side == KernelSide::right) square.rows.resize(square.rows.size() - velocity.dependencies(locked).size());
    blocks.of_set |= types_of(kernel.set, block, kernel.side, square);
  };
  const KernelQuestion kernel = kernel_question(mechanism, set, side);
  lower(kernel, kernel.set.locked);
  for (const KernelQuestion& second : kernel.also) lower(second, second.set.also_locked);
  blocks.of_set &= blocks.asked;
  return blocks;
}

std::optional<PolynomialMatrix> locked_polynomials(const Mechanism& mechanism, SingularitySet set) {
  const SetDefinition& asked = definition(set);
  const ExpressionMatrix matrix = asked.of_requirements ? derive(at_requirements(mechanism)).velocity.without(kInputs)
                                                        : derive(mechanism).velocity.without(asked.locked);
  std::optional<std::vector<PolynomialMatrix>> found = as_polynomials(mechanism, std::span(&matrix, 1));
  if (!found) return std::nullopt;
  return std::move(found->front());
}

std::optional<PolynomialMatrix> singular_matrix(const Mechanism& mechanism, SingularitySet set) {
  const KernelQuestion kernel = kernel_question(mechanism, set);
  std::optional<std::vector<PolynomialMatrix>> found = as_polynomials(mechanism, std::span(&kernel.matrix, 1));
  if (!found) return std::nullopt;
  PolynomialMatrix& m = found->front();
  if (kernel.side == KernelSide::right) return std::move(m);
  PolynomialMatrix transposed{m.columns, m.rows, {}};
  for (int j = 0; j < m.columns; ++j)
    for (int i = 0; i < m.rows; ++i) transposed.entries.push_back(std::move(m.entries[i * m.columns + j]));
  return transposed;
}

}  // namespace corank::symbolic
