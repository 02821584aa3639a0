#include "corank/symbolic/model/model_builder.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

Expression negated(Expression e, int signs) {
  for (int i = 0; i < signs; ++i) e = -e;
  return e;
}

Expression node_of(Kind kind, std::vector<Expression>& operands) {
  const SourceLocation where = operands.front().where();
  Expression result = Expression::node(kind, std::move(operands), where);
  operands.clear();
  return result;
}

// "0", "0.0", "0e3".
bool is_written_as_zero(const Expression& e) {
  const std::string text = e.text();
  return e.kind() == Kind::number && text.substr(0, text.find('e')).find_first_not_of("0.") == std::string::npos;
}

}  // namespace

void ExpressionBuilder::operand(Expression e) {
  Frame& frame = frames_.back();
  frame.chain.push_back({std::move(e), frame.exponent_signs});
  frame.exponent_signs = 0;
}

void ExpressionBuilder::symbol(const std::string& name, const SourceLocation& where) {
  operand(name == "deg" ? degrees("1", where) : Expression::symbol(name, where));
}

void ExpressionBuilder::open(const SourceLocation& where, const std::string& function,
                             const SourceLocation& function_where) {
  if (frames_.size() > kMaxNesting)
    throw ModelError(where, "the parentheses are nested too deeply",
                     "at most " + std::to_string(kMaxNesting) + " inside one another");
  Frame& frame = frames_.emplace_back();
  frame.parenthesis = where;
  frame.function = function;
  frame.function_where = function_where;
}

void ExpressionBuilder::close() {
  const std::string function = frames_.back().function;
  const SourceLocation where = frames_.back().function_where;
  const Expression inside = end();
  operand(function.empty() ? inside : Expression::function(function, inside, where));
}

void ExpressionBuilder::sign(SignOf what) {
  Frame& frame = frames_.back();
  ++(what == SignOf::exponent ? frame.exponent_signs : what == SignOf::factor ? frame.factor_signs : frame.term_signs);
}

void ExpressionBuilder::end_power() {
  Frame& frame = frames_.back();
  Expression result = frame.chain.back().operand;  // x ^ y ^ z is x ^ (y ^ z)
  for (std::size_t i = frame.chain.size() - 1; i > 0; --i)
    result = pow(frame.chain[i - 1].operand, negated(std::move(result), frame.chain[i].signs));
  frame.chain.clear();
  result = negated(std::move(result), frame.factor_signs);
  frame.factor_signs = 0;
  if (frame.divides) result = node_of(Kind::product, frame.factors) / result;
  frame.divides = false;
  frame.factors.push_back(std::move(result));
}

void ExpressionBuilder::end_term() {
  Frame& frame = frames_.back();
  frame.terms.push_back(negated(node_of(Kind::product, frame.factors), frame.term_signs));
  frame.term_signs = 0;
}

Expression ExpressionBuilder::end() {
  Expression sum = node_of(Kind::sum, frames_.back().terms);
  frames_.pop_back();
  return sum;
}

std::optional<SourceLocation> ExpressionBuilder::open_parenthesis() const {
  if (frames_.size() < 2) return std::nullopt;
  return frames_.back().parenthesis;
}

void ModelBuilder::finish_tolerance(ToleranceForm form, const std::string& percent) {
  const Expression first = values.at(0);
  if (form == ToleranceForm::range) {
    tolerance = {first, values.at(1)};
    values = {(first + values.at(1)) / 2};
    return;
  }
  // Of a number that is written with a minus the share is negative.
  const Expression size = first.kind() == Kind::negation ? first.operands()[0] : first;
  if (form == ToleranceForm::percent && is_written_as_zero(size))
    throw ModelError(size.where(), "a tolerance in percent of 0 has width 0", "a width, such as 0 ± 0.01");
  const Expression change = form == ToleranceForm::percent ? size * Expression::number(percent) / 100 : values.at(1);
  tolerance = {first - change, first + change};
  values = {first};
}

void ModelBuilder::finish_constant() {
  mechanism.constant(declared, values.at(0), declared_where, tolerance);
  values.clear();
  tolerance.reset();
}

void ModelBuilder::finish_variable() {
  if (values.empty() && kind == CoordinateKind::angle) values = {-pi(), pi()};
  const bool has_range = !values.empty();
  if (!has_range) values = {0, 0};
  mechanism.coordinate({declared, kind, values.at(0), values.at(1), declared_where, auxiliary, has_range});
  values.clear();
}

void ModelBuilder::finish_composite(Composite::Kind composite) {
  const bool unit = composite == Composite::Kind::unit;
  unit ? mechanism.unit_vector(declared, declared_where) : mechanism.rotation(declared, declared_where);
  if (auxiliary) mechanism.mark_auxiliary(unit ? 3 : 9);
}

void ModelBuilder::finish_equation() {
  const Relation read{values.at(0), relation, values.at(1)};
  if (!inequality_name.empty() && (of_rates || implied || relation == Relation::Kind::equal))
    throw ModelError(equation_where, "an equation has the name " + in_quotes(inequality_name),
                     "a name of an inequality, or none");
  of_rates  ? mechanism.velocity(read, equation_where)
  : implied ? mechanism.imply(read, equation_where)
            : mechanism.constrain(read, equation_where, inequality_name);
  values.clear();
}

void ModelBuilder::finish_point() {
  std::vector<Expression> velocity;
  if (point_coordinates > 0) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(point_coordinates);
    velocity.assign(first, values.end());
    values.erase(first, values.end());
  }
  drawing.points.push_back({declared, std::move(values), declared_where, std::move(velocity)});
  values.clear();
  point_coordinates = 0;
}

void ModelBuilder::finish(const SourceLocation& end) {
  const bool is_empty = mechanism.constants().empty() && drawing.empty() && inputs.empty() && outputs.empty();
  const bool has_equations = !mechanism.constraints().empty();
  if (mechanism.coordinates().empty() && !has_equations && is_empty)
    throw ModelError(end, "the model is empty", "sections such as [SYSTEM VARS] and [SYSTEM EQS]");
  if (mechanism.coordinates().empty()) throw ModelError(end, "the model has no variables", "at least one, in [SYSTEM VARS]");
  if (!has_equations && mechanism.rates().empty())
    throw ModelError(end, "the model has no equations", "at least one, in [SYSTEM EQS]");
  mechanism.inputs(inputs);
  mechanism.outputs(outputs);
  for (const Limit& l : limits) mechanism.limit(l.coordinate, l.lower, l.upper, l.where);
  mechanism.drawing(std::move(drawing));
  mechanism.validate();
}

}  // namespace corank::symbolic
