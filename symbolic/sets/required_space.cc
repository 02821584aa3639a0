#include "corank/symbolic/sets/required_space.h"

#include <algorithm>

#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/requirement_conditions.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

// R.
ExpressionMatrix bordered(const VelocityCondition& c) {
  const std::size_t columns = c.form.size(), size = columns + c.rows.size();
  ExpressionMatrix result;
  for (std::size_t k = 0; k < size; ++k) result.columns.push_back("r" + std::to_string(k + 1));
  result.rows.assign(size, std::vector<Expression>(size, 0));
  for (std::size_t j = 0; j < columns; ++j) {
    result.rows[j][j] = c.form[j];
    for (std::size_t i = 0; i < c.rows.size(); ++i) result.rows[j][columns + i] = result.rows[columns + i][j] = c.rows[i][j];
  }
  return result;
}

class Builder {
 public:
  Builder(const Mechanism& mechanism, const Ended& ended) : mechanism_(mechanism), ended_(ended) {}

  RequiredSpace run() {
    RequirementTranslator translator(mechanism_, {});
    for (const RequirementLine& line : mechanism_.requirements()) {
      const Conditions conditions = translator.run(line);
      refuse_distances(line, conditions);
      for (const VelocityCondition& c : conditions.of_velocities) add(line, as_form(line, c));
      if (conditions.excess) add(line, -*conditions.excess);
    }
    return std::move(out_);
  }

 private:
  void add(const RequirementLine& line, const Expression& function) {
    out_.inequalities.push_back({function >= Expression(0), line.text, line.where});
  }

  void add(const RequirementLine& line, const VelocityCondition& c) {
    ExactMatrix matrix(mechanism_, bordered(c), residuals(mechanism_));
    matrix.eliminate_numbers();
    RationalPolynomial g = matrix.modulo_circles(matrix.determinant());
    if (matrix.is_explicit()) g = matrix.in_free_coordinates(g, ended_);
    if (g.is_zero()) throw at_limit(line);
    std::vector<Expression> odd;
    for (const RationalPolynomial& factor : g.factors(ended_).value_or(std::vector<RationalPolynomial>{})) {
      const RationalPolynomial square = factor.power(2);
      for (auto rest = g.divided_by(square); rest; rest = g.divided_by(square)) g = *rest;
      const bool even = !g.divided_by(factor);
      std::optional<Expression> function = matrix.condition(factor);
      if (!function) {  // of constants, whose values may make it 0
        if (exact_value(mechanism_, matrix.expression(factor), line.text).sign().value_or(0) == 0) throw at_limit(line);
        continue;
      }
      if (even)
        add_function(*function);
      else
        odd.push_back(std::move(*function));
    }
    if (odd.size() > 1) {
      for (const Expression& function : odd) add_function(function);
      return;
    }
    const Expression b = c.rows.size() % 2 == 0 ? matrix.expression(g) : -matrix.expression(g);
    if (matrix.condition(g)) return add(line, b);
    const int sign = exact_value(mechanism_, b, line.text).sign().value_or(0);
    if (sign == 0) throw at_limit(line);
    if (sign < 0)
      throw ModelError(line.where, "the requirement " + in_quotes(line.text) + " is met at no configuration",
                       "one that is met at some of them");
  }

  static ModelError at_limit(const RequirementLine& line) {
    return {line.where, "the requirement " + in_quotes(line.text) + " is at its limit at all configurations",
            "one that is met at some of them"};
  }

  void add_function(const Expression& function) {
    const auto same = [&](const Expression& known) { return same_tree(known, function); };
    if (std::ranges::none_of(out_.functions, same)) out_.functions.push_back(function);
  }

  const Mechanism& mechanism_;
  const Ended& ended_;
  RequiredSpace out_;
};

}  // namespace

RequiredSpace required_space(const Mechanism& mechanism, const Ended& ended) { return Builder(mechanism, ended).run(); }

}  // namespace corank::symbolic
