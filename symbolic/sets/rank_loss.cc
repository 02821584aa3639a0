#include "corank/symbolic/sets/rank_loss.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/arm_boundary.h"
#include "corank/symbolic/sets/dependent_columns.h"
#include "corank/symbolic/sets/joint_zeros.h"

namespace corank::symbolic {
namespace {

using Zeros = JointZeros::Zeros;

/// Joints at multiples of π/2: 0, 1, 2, 3 of them.
using Held = std::map<std::string, int>;
/// Of joints.
using JointValues = std::vector<std::pair<std::string, Expression>>;
constexpr std::size_t kFewRows = 3;

/// {values, conditions = 0}.
struct Loss {
  Held held;
  std::vector<RationalPolynomial> conditions;
};

// Numbers in place of constants' names: what stands beside a joint's sine then tells where it vanishes.
std::unique_ptr<const ExactMatrix> with_values(const Mechanism& mechanism, ExpressionMatrix matrix, const Ended& ended) {
  std::map<std::string, Expression> values;
  for (const Constant& c : mechanism.constants()) values.emplace(c.name, c.value.substituted(values));
  for (auto& row : matrix.rows)
    for (Expression& e : row) e = e.substituted(values);
  auto exact = std::make_unique<ExactMatrix>(mechanism, matrix, std::vector<Expression>{}, ExactMatrix::Shape::wide);
  exact->put_into_free_coordinates(ended);
  return exact;
}

// The product of the joints' ranges but for these values.
std::optional<Component> part_at(const FreeCoordinates& free, const JointValues& values) {
  Component part;
  part.values = values;
  part.name = part.relation();
  const auto moves = [&](const Coordinate& c) {
    return !is_fixed(c) && std::ranges::find(values, c.name, &JointValues::value_type::first) == values.end();
  };
  const auto first = std::ranges::find_if(free.system.coordinates, moves);  // stands in for those that move
  if (first == free.system.coordinates.end()) return std::nullopt;
  return put_in_factor(free, {Expression::symbol(first->name)}, part) ? std::optional(std::move(part)) : std::nullopt;
}

class RankLoss {
 public:
  /// `held`: values of joints that have been put into the matrix.
  RankLoss(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free, const JointValues& held,
           const Ended& ended)
      : mechanism_(mechanism),
        free_(free),
        held_(held),
        ended_(ended),
        matrix_(with_values(mechanism, matrix, ended)),
        zeros_(mechanism, free, *matrix_, ended) {}

  /// By a known left kernel vector, else by all minors. False where that says nothing, or there are too many minors, or
  /// these are too long.
  bool run() {
    try {
      if (std::optional<std::vector<RationalPolynomial>> conditions = rank_conditions(*matrix_, zeros_))
        if (split(std::move(*conditions), {})) return true;
      losses_.clear();
      asked_ = 0;
      std::optional<std::vector<RationalPolynomial>> all = minors();
      return all && split(std::move(*all), {});
    } catch (const DeterminantTooLarge&) {
      return false;
    }
  }

  const ExactMatrix& matrix() const { return *matrix_; }
  const JointZeros& zeros() const { return zeros_; }

  /// None where a kernel vector says it better. A part of a smaller dimension than is expected has conditions that depend on
  /// each other, and its boxes stay undecided. With a kernel vector of three components there are fewer of these; one of six
  /// takes so long that only parts with too many conditions for their joints count.
  std::vector<Component> components() const {
    const std::size_t expected = matrix_->columns().size() - matrix_->size() + 1;
    std::vector<Component> result;
    std::ptrdiff_t good = 0, bad = 0;
    for (const Loss& loss : losses_) {
      if (is_within_another(loss)) continue;
      std::optional<Component> component = component_of(loss);
      if (!component) return {};
      if (loss.held.size() + loss.conditions.size() <= expected) {
        ++good;
      } else if (matrix_->size() <= kFewRows && !loss.conditions.empty()) {
        return {};
      } else if (loss.conditions.size() > zeros_.joints_in(loss.conditions)) {
        ++bad;
      }
      result.push_back(std::move(*component));
    }
    if (good <= bad) return {};
    return result;
  }

 private:
  std::optional<std::vector<RationalPolynomial>> minors() const {
    constexpr std::size_t kMost = 60;
    const std::size_t rows = matrix_->size(), columns = matrix_->columns().size();
    SquareBlock block{std::vector<std::size_t>(rows), {}};
    std::iota(block.rows.begin(), block.rows.end(), std::size_t{0});
    std::vector<RationalPolynomial> result;
    std::vector<bool> chosen(columns, false);
    std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(rows), true);
    do {
      block.columns.clear();
      for (std::size_t j = 0; j < columns; ++j)
        if (chosen[j]) block.columns.push_back(j);
      if (result.size() == kMost || is_over(ended_)) return std::nullopt;
      result.push_back(matrix_->determinant(block));
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    return result;
  }

  /// All of them vanish: adds where that is. False where it is not found.
  bool split(std::vector<RationalPolynomial> all, const Held& held);
  // The one found first, of two that are the same.
  bool is_within_another(const Loss& loss) const {
    return std::ranges::any_of(losses_, [&](const Loss& other) {
      const auto has = [&](const RationalPolynomial& f) {
        return std::ranges::find(loss.conditions, f) != loss.conditions.end();
      };
      const std::size_t size = other.held.size() + other.conditions.size(), own = loss.held.size() + loss.conditions.size();
      return (size < own || (size == own && &other < &loss)) && std::ranges::includes(loss.held, other.held) &&
             std::ranges::all_of(other.conditions, has);
    });
  }
  std::optional<Component> component_of(const Loss& loss) const;

  const Mechanism& mechanism_;
  const FreeCoordinates& free_;
  const JointValues& held_;
  const Ended& ended_;
  std::unique_ptr<const ExactMatrix> matrix_;
  JointZeros zeros_;
  std::vector<Loss> losses_;
  std::size_t asked_ = 0;
};

bool RankLoss::split(std::vector<RationalPolynomial> all, const Held& held) {
  constexpr std::size_t kMost = 64;
  if (++asked_ > kMost || is_over(ended_)) return false;
  std::vector<Zeros> lists;
  for (RationalPolynomial& f : all) {
    f = matrix_->modulo_circles(f);
    if (f.is_zero()) continue;
    std::optional<Zeros> zeros = zeros_.of(f);
    if (!zeros) return false;
    lists.push_back(std::move(*zeros));
  }
  if (std::ranges::any_of(lists, &Zeros::empty)) return true;
  Loss loss{held, {}};
  const auto add_condition = [&](const RationalPolynomial& factor) {
    if (std::ranges::find(loss.conditions, factor) == loss.conditions.end()) loss.conditions.push_back(factor);
    std::erase_if(lists, [&](const Zeros& z) { return z.has(factor); });
  };
  const auto only_has = [](const Zeros& z) { return z.values.empty() && z.factors.size() == 1; };
  for (auto one = lists.begin(); (one = std::ranges::find_if(lists, only_has)) != lists.end();)
    add_condition(RationalPolynomial(one->factors.front()));
  if (!lists.empty())  // factors of all
    for (const RationalPolynomial& factor : std::vector(lists.front().factors)) {
      if (!std::ranges::all_of(lists, [&](const Zeros& z) { return z.has(factor); })) continue;
      losses_.push_back(loss);
      losses_.back().conditions.push_back(factor);
      for (Zeros& z : lists) std::erase(z.factors, factor);
    }
  if (std::ranges::any_of(lists, &Zeros::empty)) return true;
  if (lists.empty()) {
    const bool is_everywhere = loss.held.empty() && loss.conditions.empty();
    losses_.push_back(std::move(loss));
    return !is_everywhere;
  }
  const Zeros& fewest = *std::ranges::min_element(
      lists, {}, [](const Zeros& z) { return std::pair(z.factors.size(), z.values.size() + z.factors.size()); });
  for (const QuarterTurns& value : fewest.values) {
    std::vector<RationalPolynomial> there;
    for (const RationalPolynomial& f : all) there.push_back(zeros_.at(f, value));
    Held next = held;
    next.emplace(value.joint, value.quarters);
    if (!split(std::move(there), next)) return false;
  }
  for (const RationalPolynomial& factor : fewest.factors) {
    std::vector<RationalPolynomial> there = all;
    there.push_back(factor);
    if (!split(std::move(there), held)) return false;
  }
  return true;
}

std::optional<Component> RankLoss::component_of(const Loss& loss) const {
  Component part;
  part.values = held_;
  for (const auto& [joint, quarters] : loss.held) part.values.emplace_back(joint, *zeros_.value_of({joint, quarters}));
  if (loss.conditions.empty()) return part_at(free_, part.values);
  part.name = part.relation();
  for (const RationalPolynomial& f : loss.conditions) {
    std::optional<Expression> condition = matrix_->condition(f);
    if (!condition) return std::nullopt;
    part.conditions.push_back(std::move(*condition));
  }
  std::ranges::sort(part.conditions, {}, [](const Expression& e) { return std::pair(e.text().size(), e.text()); });
  std::vector<std::pair<std::string, int>> names;  // those of the same joints once
  for (const Expression& condition : part.conditions) {
    const std::string name = name_of_condition(mechanism_, condition);
    const auto known = std::ranges::find(names, name, &std::pair<std::string, int>::first);
    if (known == names.end()) {
      names.emplace_back(name, 1);
    } else {
      ++known->second;
    }
  }
  for (const auto& [name, number] : names)
    part.name += (part.name.empty() ? "" : ", ") +
                 (number == 1 ? name : std::to_string(number) + " conditions" + name.substr(name.find(' ')));
  return put_in_factor(free_, {}, part) ? std::optional(std::move(part)) : std::nullopt;
}

std::optional<Component> with_kernel_vector(ExpressionMatrix matrix, const JointValues& held, const FreeCoordinates& free) {
  Component part;
  part.values = held;
  part.name = part.relation();
  part.block = std::move(matrix);
  if (!put_in_factor(free, {}, part)) return std::nullopt;
  std::vector<Coordinate> moving = part.factor->coordinates;
  std::erase_if(moving, is_fixed);
  part.name += (part.name.empty() ? "" : ", ") + ("a kernel vector in " + listed(names_of(moving)));
  return part;
}

// Nothing where there is no more to say than a kernel vector of the matrix does.
std::vector<Component> losses_of(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free,
                                 const JointValues& held, const Ended& ended, int depth = 0) {
  constexpr int kDeepest = 2;
  RankLoss loss(mechanism, matrix, free, held, ended);
  if (loss.run())
    if (std::vector<Component> parts = loss.components(); !parts.empty()) return parts;
  if (matrix.rows.size() > kFewRows || depth == kDeepest) return {};
  const auto agreeing = agreeing_columns(mechanism, loss.matrix(), loss.zeros(), ended);
  if (!agreeing) return {};
  std::vector<Component> parts;
  bool all = true;
  const auto add = [&](const ExpressionMatrix& m, const JointValues& values) {
    const bool may_have_full_rank = m.columns.size() >= m.rows.size();
    std::vector<Component> own;
    if (may_have_full_rank) own = losses_of(mechanism, m, free, values, ended, depth + 1);
    if (own.empty()) {
      auto part = may_have_full_rank ? with_kernel_vector(m, values, free) : part_at(free, values);
      if (part) own.push_back(std::move(*part));
      all = all && part;
    }
    std::ranges::move(own, std::back_inserter(parts));
  };
  for (const QuarterTurns& value : agreeing->values)
    if (const std::optional<Expression> angle = loss.zeros().value_of(value)) {
      JointValues values = held;
      values.emplace_back(value.joint, *angle);
      add(matrix_at(loss.matrix(), loss.zeros(), value), values);
    }
  add(agreeing->elsewhere, held);
  return all ? parts : std::vector<Component>{};
}

}  // namespace

std::vector<Component> rank_losses(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free,
                                   const Ended& ended) {
  std::vector<Component> parts = losses_of(mechanism, matrix, free, {}, ended);
  // The largest first. FLINT's order is another in each process.
  std::ranges::sort(parts, {}, [](const Component& c) {
    return std::tuple(c.block.has_value(), c.values.size() + c.conditions.size(), c.relation(), c.name);
  });
  std::map<std::string, int> alike;
  for (Component& c : parts)
    if (const int number = ++alike[c.name]; number > 1) c.name += " (" + std::to_string(number) + ")";
  return parts;
}

}  // namespace corank::symbolic
