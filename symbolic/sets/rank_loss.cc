#include "corank/symbolic/sets/rank_loss.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <numeric>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/arm_boundary.h"
#include "corank/symbolic/sets/joint_zeros.h"

namespace corank::symbolic {
namespace {

using Zeros = JointZeros::Zeros;

/// Joints at multiples of π/2: 0, 1, 2, 3 of them.
using Held = std::map<std::string, int>;

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

class RankLoss {
 public:
  RankLoss(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free, const Ended& ended)
      : mechanism_(mechanism),
        free_(free),
        ended_(ended),
        matrix_(with_values(mechanism, matrix, ended)),
        zeros_(mechanism, free, *matrix_, ended) {}

  /// False where there are too many minors, or these are too long.
  bool run() {
    try {
      const std::optional<std::vector<RationalPolynomial>> all = minors();
      return all && split(*all, {});
    } catch (const DeterminantTooLarge&) {
      return false;
    }
  }

  /// None where a kernel vector says it better. A part of a smaller dimension than is expected has conditions that depend on
  /// each other, and its boxes stay undecided. With a kernel vector of three components there are fewer of these; one of six
  /// takes so long that only parts with too many conditions for their joints count.
  std::vector<Component> components() const {
    constexpr std::size_t kFewRows = 3;
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
    // The largest first. FLINT's order is another in each process.
    std::ranges::sort(result, {},
                      [](const Component& c) { return std::pair(c.values.size() + c.conditions.size(), c.relation()); });
    std::map<std::string, int> alike;
    for (Component& c : result)
      if (const int number = ++alike[c.name]; number > 1) c.name += " (" + std::to_string(number) + ")";
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
    std::erase_if(lists, [&](const Zeros& z) { return std::ranges::find(z.factors, factor) != z.factors.end(); });
  };
  const auto only_has = [](const Zeros& z) { return z.values.empty() && z.factors.size() == 1; };
  for (auto one = lists.begin(); (one = std::ranges::find_if(lists, only_has)) != lists.end();)
    add_condition(RationalPolynomial(one->factors.front()));
  if (!lists.empty())  // factors of all
    for (const RationalPolynomial& factor : std::vector(lists.front().factors)) {
      const auto has = [&](const Zeros& z) { return std::ranges::find(z.factors, factor) != z.factors.end(); };
      if (!std::ranges::all_of(lists, has)) continue;
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
  for (const auto& [joint, quarters] : loss.held) part.values.emplace_back(joint, *zeros_.value_of({joint, quarters}));
  part.name = part.relation();
  for (const RationalPolynomial& f : loss.conditions) {
    std::optional<Expression> condition = matrix_->condition(f);
    if (!condition) return std::nullopt;
    part.conditions.push_back(std::move(*condition));
  }
  std::ranges::sort(part.conditions, {}, [](const Expression& e) { return std::pair(e.text().size(), e.text()); });
  for (const Expression& condition : part.conditions)
    part.name += (part.name.empty() ? "" : ", ") + name_of_condition(mechanism_, condition);
  std::vector<Expression> functions;
  if (part.conditions.empty()) {  // a joint stands in for those that move
    const auto moves = [&](const Coordinate& c) { return !is_fixed(c) && !loss.held.contains(c.name); };
    const auto first = std::ranges::find_if(free_.system.coordinates, moves);
    if (first == free_.system.coordinates.end()) return std::nullopt;
    functions.push_back(Expression::symbol(first->name));
  }
  return put_in_factor(free_, std::move(functions), part) ? std::optional(std::move(part)) : std::nullopt;
}

}  // namespace

std::vector<Component> rank_losses(const Mechanism& mechanism, const ExpressionMatrix& matrix, const FreeCoordinates& free,
                                   const Ended& ended) {
  RankLoss loss(mechanism, matrix, free, ended);
  return loss.run() ? loss.components() : std::vector<Component>{};
}

}  // namespace corank::symbolic
