#include "corank/symbolic/sets/decomposition.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/certify/compiled_system.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/velocity/exact_matrix.h"
#include "corank/symbolic/velocity/known_values.h"
#include "corank/symbolic/velocity/passive_rates.h"

namespace corank::symbolic {
namespace {

constexpr std::size_t kMostRows = 3;  // of a block whose determinant is a condition of points though it is no product
constexpr std::size_t kMostConditionTerms = 200;  // of a condition: longer ones make wide enclosures
constexpr std::size_t kMostTermsInJoints = 2000;  // but in four joints they are the best there is

// The configurations, whatever the set.
class Space {
 public:
  explicit Space(const Mechanism& mechanism)
      : mechanism_(mechanism), equations_(plain_system(mechanism)), system_(algebrize(equations_)) {}

  // Proven, over the whole search domain: no zero.
  bool vanishes_nowhere(const Expression& condition) const {
    std::vector<Polynomial> value;
    try {
      value = polynomials(equations_, {condition});
    } catch (const ModelError&) {  // a sine of a length
      return false;
    }
    const certify::CompiledSystem compiled(system_, value);
    const UpwardRounding rounding;
    return compiled.evaluate(compiled.value_row(0), system_.domain()).mig() > 0;
  }

  const Mechanism& mechanism() const { return mechanism_; }
  bool is_fixed(const std::string& angle) const { return symbolic::is_fixed(coordinate(angle)); }
  std::size_t index(const std::string& angle) const { return mechanism_.find_coordinate(angle); }

  // Else an equation is a contradiction.
  bool has_system(const DependentAngle& angle) const {
    TrigonometricSystem system = equations_;
    system.dependent_angle = angle;
    try {
      static_cast<void>(algebrize(system));
    } catch (const ModelError&) {
      return false;
    }
    return true;
  }

 private:
  const Coordinate& coordinate(const std::string& name) const { return equations_.coordinates[index(name)]; }
  const Mechanism& mechanism_;
  const TrigonometricSystem equations_;
  const System system_;
};

// sin and cos of one coordinate each, as they stand in a product of two.
struct Wave {
  std::string angle;
  bool is_sine = false;
};

std::optional<Wave> wave_of(const Expression& e) {
  if (e.kind() != Expression::Kind::function || (e.name() != "sin" && e.name() != "cos")) return std::nullopt;
  const Expression& argument = e.operands()[0];
  if (argument.kind() != Expression::Kind::symbol) return std::nullopt;
  return Wave{argument.name(), e.name() == "sin"};
}

struct Product {
  int sign = 1;
  Wave first, second;
};

std::optional<Product> product_of(Expression e) {
  int sign = 1;
  const auto without_sign = [&](const Expression& signed_one) {
    if (signed_one.kind() != Expression::Kind::negation) return signed_one;
    sign = -sign;
    return signed_one.operands()[0];
  };
  e = without_sign(e);
  if (e.kind() != Expression::Kind::product || e.operands().size() != 2) return std::nullopt;
  const auto first = wave_of(without_sign(e.operands()[0])), second = wave_of(e.operands()[1]);
  if (!first || !second || first->angle == second->angle) return std::nullopt;
  return Product{sign, *first, *second};
}

// Of ±(sin a cos b ∓ cos a sin b) and ±(cos a cos b ± sin a sin b), which are sin(a ∓ b) and cos(a ∓ b): a ∓ b is one of two
// values.
std::vector<DependentAngle> dependent_angles_of(const Space& space, const Expression& condition) {
  if (condition.kind() != Expression::Kind::sum || condition.operands().size() != 2) return {};
  const auto p = product_of(condition.operands()[0]);
  auto q = product_of(condition.operands()[1]);
  if (!p || !q) return {};
  if (q->first.angle != p->first.angle) std::swap(q->first, q->second);
  if (q->first.angle != p->first.angle || q->second.angle != p->second.angle) return {};
  if (q->first.is_sine == p->first.is_sine || q->second.is_sine == p->second.is_sine) return {};
  if (space.is_fixed(p->first.angle) || space.is_fixed(p->second.angle)) return {};
  const bool in_order = space.index(p->first.angle) < space.index(p->second.angle);
  const std::string &later = in_order ? p->second.angle : p->first.angle,
                    &earlier = in_order ? p->first.angle : p->second.angle;
  // Sine or cosine of the sum or the difference of both: of products of a sine and a cosine, or of two of a kind.
  const bool is_sine = p->first.is_sine != p->second.is_sine, same = p->sign == q->sign;
  const int sign = is_sine == same ? -1 : 1;  // sin(a + b) = 0: a = −b; cos(a − b) = 0: a = b ± π/2
  std::vector<DependentAngle> angles;
  for (const int quarters : {0, 2}) angles.push_back({later, earlier, sign, quarters + (is_sine ? 0 : 1)});
  const bool both = std::ranges::all_of(angles, [&](const DependentAngle& angle) { return space.has_system(angle); });
  return both ? angles : std::vector<DependentAngle>{};
}

class Decomposer {
 public:
  Decomposer(const Mechanism& mechanism, const ExpressionMatrix& matrix, const std::vector<Expression>& phi,
             const Ended& ended)
      : ended_(ended),
        is_points_(mobility(mechanism) < 2),
        space_(mechanism),
        matrix_(mechanism, matrix, phi, ExactMatrix::Shape::wide) {}

  std::optional<ExpressionMatrix> wide_in_joints() {
    shorten();
    const std::size_t rows = matrix_.size(), columns = matrix_.columns().size();
    if (!matrix_.is_explicit() || rows == 0 || rows >= columns) return std::nullopt;
    ExpressionMatrix result;
    result.columns = matrix_.columns();
    result.roles.assign(columns, Role::passive);
    for (std::size_t i = 0; i < rows; ++i) {
      result.rows.emplace_back();
      for (std::size_t j = 0; j < columns; ++j) result.rows.back().push_back(matrix_.entry(i, j));
    }
    return result;
  }

  std::vector<Component> run() {
    shorten();
    const auto blocks = matrix_.blocks();
    if (!blocks) return {};
    for (const SquareBlock& block : *blocks) {
      const auto factors = factors_of(block);
      if (!factors) {
        add_block(block);
      } else if (factors->fail) {
        return {};
      } else {
        add_conditions(factors->conditions);
      }
    }
    return std::move(components_);
  }

 private:
  void shorten() {
    matrix_.put_into_free_coordinates(ended_);
    matrix_.eliminate_numbers();
    matrix_.leave_out_zero_columns();
  }
  std::string columns_of(const SquareBlock& block) const {
    std::vector<std::string> columns;
    for (const std::size_t j : block.columns) columns.push_back(matrix_.columns()[j]);
    return fmt::format("{}", fmt::join(columns, ", "));
  }

  void add(Component component) {
    if (std::ranges::find(components_, component) == components_.end()) components_.push_back(std::move(component));
  }

  void add_block(const SquareBlock& block) {
    Component component{"block of " + columns_of(block)};
    ExpressionMatrix& b = component.block.emplace();
    for (const std::size_t j : block.columns) b.columns.push_back(matrix_.columns()[j]);
    b.roles.assign(b.columns.size(), Role::passive);
    for (const std::size_t i : block.rows) {
      b.rows.emplace_back();
      for (const std::size_t j : block.columns) b.rows.back().push_back(matrix_.entry(i, j));
    }
    add(std::move(component));
  }

  struct Factors {
    bool fail = false;  // the determinant vanishes everywhere, perhaps of one robot, or they are not all found in time
    std::vector<Expression> conditions{};
  };

  // Nothing: a kernel vector describes the block better.
  std::optional<Factors> factors_of(const SquareBlock& block) const {
    Factors result;
    try {
      const RationalPolynomial value = matrix_.modulo_circles(matrix_.determinant(block));
      if (value.is_zero()) return Factors{.fail = true};
      const auto factors = value.factors(ended_);
      if (!factors) return Factors{.fail = true};
      for (const RationalPolynomial& factor : *factors) {
        const RationalPolynomial on_cspace = matrix_.in_free_coordinates(matrix_.modulo_circles(factor), ended_);
        if (on_cspace.is_zero()) return Factors{.fail = true};
        const auto simple = on_cspace.factors(ended_);
        if (!simple) return Factors{.fail = true};
        for (const RationalPolynomial& f : *simple) {
          if (f.size() > (matrix_.is_explicit() ? kMostTermsInJoints : kMostConditionTerms)) return std::nullopt;
          auto condition = matrix_.condition(f);
          if (!condition && !space_.vanishes_nowhere(matrix_.expression(f))) return Factors{.fail = true};
          if (condition && !space_.vanishes_nowhere(*condition)) result.conditions.push_back(std::move(*condition));
        }
      }
    } catch (const DeterminantTooLarge&) {
      return std::nullopt;
    }
    // GiNaC's order, and so FLINT's, is another in each process.
    std::ranges::sort(result.conditions, [](const Expression& a, const Expression& b) {
      return std::pair(a.text().size(), a.text()) < std::pair(b.text().size(), b.text());
    });
    const bool is_short = block.rows.size() <= kMostRows || result.conditions.size() != 1;
    if (!is_short && is_points_ && !matrix_.is_explicit()) return std::nullopt;
    return result;
  }

  // No other part's.
  std::string name_of(const Expression& condition) const {
    const std::string name = name_of_condition(space_.mechanism(), condition);
    if (name.ends_with(" = 0")) return name;
    const auto is_alike = [&name](const Component& c) { return c.name == name || c.name.rfind(name + " (", 0) == 0; };
    const auto alike = std::ranges::count_if(components_, is_alike);
    return alike == 0 ? name : fmt::format("{} ({})", name, alike + 1);
  }

  void add_conditions(const std::vector<Expression>& conditions) {
    for (const Expression& condition : conditions) {
      const std::vector<DependentAngle> angles = dependent_angles_of(space_, condition);
      for (const DependentAngle& angle : angles) add({angle.text(), angle});
      if (!angles.empty()) continue;
      add({name_of(condition), {}, {condition}});
    }
  }

  const Ended& ended_;
  const bool is_points_;
  const Space space_;
  ExactMatrix matrix_;
  std::vector<Component> components_;
};

}  // namespace

namespace {

// Nothing where M is tall, or there are two.
std::optional<Decomposer> decomposer(const Mechanism& mechanism, const KernelQuestion& kernel, const Ended& ended) {
  ExpressionMatrix matrix = kernel.matrix;
  std::vector<Expression> phi = residuals(mechanism);
  put_in_known_values(mechanism, matrix, phi);
  // A row of zeros, which a dependency has, says nothing about the kernel.
  std::erase_if(matrix.rows, [](const std::vector<Expression>& row) {
    return std::ranges::all_of(row, [](const Expression& e) { return same_tree(e, 0); });
  });
  if (!kernel.also.empty() || matrix.rows.size() > matrix.columns.size()) return std::nullopt;
  PassiveRates passive = eliminate_passive_rates(mechanism, matrix);
  return std::optional<Decomposer>(std::in_place, mechanism, passive.eliminated.empty() ? matrix : passive.matrix, phi,
                                   ended);
}

}  // namespace

std::string name_of_condition(const Mechanism& mechanism, const Expression& condition) {
  constexpr std::size_t kLongestName = 60;
  constexpr std::size_t kMostNames = 6;  // of coordinates
  if (std::string text = condition.text(); text.size() <= kLongestName) return text + " = 0";
  std::vector<std::string> names;
  for (const Coordinate& c : mechanism.coordinates())
    if (condition.mentions(c.name)) names.push_back(c.name);
  if (names.size() > kMostNames) {
    names.resize(kMostNames);
    names.emplace_back("...");
  }
  return fmt::format("condition on {}", fmt::join(names, ", "));
}

std::vector<Component> decompose(const Mechanism& mechanism, const KernelQuestion& kernel, const Ended& ended) {
  std::optional<Decomposer> of = decomposer(mechanism, kernel, ended);
  return of ? of->run() : std::vector<Component>{};
}

std::optional<ExpressionMatrix> wide_in_joints(const Mechanism& mechanism, const KernelQuestion& kernel,
                                               const Ended& ended) {
  std::optional<Decomposer> of = decomposer(mechanism, kernel, ended);
  return of ? of->wide_in_joints() : std::nullopt;
}

}  // namespace corank::symbolic
