#include "corank/symbolic/sets/algebrizer.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/expression_range.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/polynomial_expander.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/angle_range.h"

namespace corank::symbolic {
namespace {

bool mentions(const Relation& relation, const std::vector<std::string>& names) {
  return std::ranges::any_of(
      names, [&](const std::string& name) { return relation.lhs.mentions(name) || relation.rhs.mentions(name); });
}

class Algebrizer {
 public:
  explicit Algebrizer(const TrigonometricSystem& system) : in_(system) {}
  System run();
  std::vector<Polynomial> polynomials(const std::vector<Expression>& expressions);

 private:
  void add_names();
  void add_constant(const Constant& constant);
  void add_coordinates();
  void add_parameter(const Constant& constant);
  /// Does the expression depend on a constant that is known within a tolerance only? Its name; empty: it does not.
  std::string toleranced_in(const Expression& e) const;
  void require_exact(const Expression& e, const std::string& what, const SourceLocation& where) const;
  /// The coordinate, with ends that hold for every value of the parameters.
  Coordinate with_fixed_ends(const Coordinate& coordinate);
  void add_length(const Coordinate& coordinate);
  void add_angle(const Coordinate& coordinate);
  void add_dependent_angle(const DependentAngle& dependent);
  void add_kernel_unknowns();
  void add_equation(const TrigonometricSystem::Equation& equation);
  void add_inequality(const TrigonometricSystem::Equation& inequality);
  int add_variable(const std::string& name, VariableKind kind, const ConstantRange& range);
  ConstantRange range_of(const Coordinate& coordinate);
  /// lhs − rhs.
  ExpandedPolynomial difference(const TrigonometricSystem::Equation& equation);
  std::string fresh_name(std::string name);

  const TrigonometricSystem& in_;
  System out_;
  PolynomialExpander expander_;
  std::set<std::string> names_;
  std::map<std::string, std::pair<std::string, std::string>> names_of_angles_;  // of their cosines and sines
  std::vector<Polynomial> angle_equations_, chords_;
  std::vector<std::string> special_angles_;  // of one value, or dependent
  std::vector<const Constant*> parameters_;
  std::map<std::string, Expression> following_;  // constants that depend on a parameter, in parameters
};

std::string equation_text(const TrigonometricSystem::Equation& equation) {
  constexpr std::size_t kLongest = 160;
  const std::string text = equation.relation.text();
  return "`" + (text.size() > kLongest ? text.substr(0, kLongest) + "…" : text) + "`";
}

// A coefficient beyond double precision's range would make every enclosure useless.
void require_bounded(const Polynomial& polynomial, const TrigonometricSystem::Equation& equation) {
  for (const Monomial& monomial : polynomial.monomials)
    if (!monomial.enclosure.is_bounded())
      throw ModelError(equation.where,
                       "the coefficient " + in_quotes(monomial.coefficient.text()) + " of the equation " +
                           equation_text(equation) + " is too large",
                       "coefficients within double precision's range");
}

ConstantRange Algebrizer::range_of(const Coordinate& coordinate) {
  const std::string what = "the range of " + in_quotes(coordinate.name);
  for (const Expression& end : {coordinate.lower, coordinate.upper}) require_exact(end, what, coordinate.where);
  ConstantRange range{expander_.constant(coordinate.lower, what, coordinate.where),
                      expander_.constant(coordinate.upper, what, coordinate.where)};
  const std::string text = coordinate.range_text();
  try {
    if ((range.upper - range.lower).sign() == -1)
      throw ModelError(coordinate.where, what + ", " + text + ", is empty", "a lower bound of at most the upper one");
    if (!range.lower.exact().enclose().is_bounded() || !range.upper.exact().enclose().is_bounded())
      throw ModelError(coordinate.where, what + ", " + text + ", is unbounded", "bounds within double precision's range");
  } catch (const std::domain_error& error) {
    throw ModelError(coordinate.where, what + ", " + text + ", has no real bounds: " + error.what(), "real numbers");
  }
  return range;
}

int Algebrizer::add_variable(const std::string& name, VariableKind kind, const ConstantRange& range) {
  out_.variables.emplace_back(name, kind, range.lower.exact(), range.upper.exact());
  return out_.size() - 1;
}

std::string Algebrizer::fresh_name(std::string name) {
  while (!names_.insert(name).second) name += "_";
  return name;
}

void Algebrizer::add_length(const Coordinate& coordinate) {
  const int variable = add_variable(coordinate.name, VariableKind::length, range_of(coordinate));
  expander_.add_unknown(coordinate.name, variable);
  out_.variables[variable].direction = coordinate.direction;
  out_.variables[variable].within_one = coordinate.within_one;
}

std::string Algebrizer::toleranced_in(const Expression& e) const {
  for (const Constant* parameter : parameters_)
    if (e.mentions(parameter->name)) return parameter->name;
  for (const auto& [name, value] : following_)
    if (e.mentions(name)) return name;
  return {};
}

void Algebrizer::require_exact(const Expression& e, const std::string& what, const SourceLocation& where) const {
  if (const std::string name = toleranced_in(e); !name.empty())
    throw ModelError(where, what + " depends on " + in_quotes(name) + ", which is known within a tolerance only",
                     "numbers and constants without a tolerance");
}

Coordinate Algebrizer::with_fixed_ends(const Coordinate& c) {
  const std::string what = "the range of " + in_quotes(c.name);
  const bool lower_varies = !toleranced_in(c.lower).empty(), upper_varies = !toleranced_in(c.upper).empty();
  if ((!lower_varies && !upper_varies) || c.kind == CoordinateKind::angle) return c;
  if (is_fixed(c)) require_exact(c.lower, what, c.where);  // a value that is held, no range to search in
  const UpwardRounding rounding;
  const auto known = [&](const Expression& e) -> std::optional<Interval> {
    if (toleranced_in(e).empty()) return expander_.constant(e, what, c.where).exact().enclose();
    if (e.kind() != Expression::Kind::symbol) return std::nullopt;
    const auto of_name = std::ranges::find_if(parameters_, [&](const Constant* p) { return p->name == e.name(); });
    if (of_name == parameters_.end()) return std::nullopt;
    const Tolerance& tolerance = *(*of_name)->tolerance;
    return Interval::hull(expander_.constant(tolerance.lower, what, c.where).exact().enclose(),
                          expander_.constant(tolerance.upper, what, c.where).exact().enclose());
  };
  const auto lower = symbolic::range_of(c.lower.substituted(following_), known),
             upper = symbolic::range_of(c.upper.substituted(following_), known);
  if (!lower || !upper || !lower->is_bounded() || !upper->is_bounded())
    throw ModelError(c.where, what + ", " + c.range_text() + ", is not bounded within the tolerances", "bounds in numbers");
  Coordinate wide = with_range(c, Interval::hull(*lower, *upper));
  if (!lower_varies) wide.lower = c.lower;
  if (!upper_varies) wide.upper = c.upper;
  return wide;
}

void Algebrizer::add_constant(const Constant& c) {
  const std::string what = "the tolerance of " + in_quotes(c.name);
  if (c.tolerance) {
    require_exact(c.tolerance->lower, what, c.where);
    require_exact(c.tolerance->upper, what, c.where);
    const ConstantValue lower = expander_.constant(c.tolerance->lower, what, c.where),
                        upper = expander_.constant(c.tolerance->upper, what, c.where);
    const std::optional<int> sign = (upper - lower).sign();
    if (sign == -1)
      throw ModelError(c.where, what + ", " + c.tolerance->text() + ", is empty",
                       "a positive tolerance, or the lower end first");
    if (sign != 0) {
      parameters_.push_back(&c);
      return;
    }
  }
  if (!toleranced_in(c.value).empty()) {
    following_.emplace(c.name, c.value.substituted(following_));
  } else {
    expander_.define(c);
  }
}

// A variable of its own, behind the coordinates. The ends of a tolerance are no ends of the mechanism.
void Algebrizer::add_parameter(const Constant& c) {
  const Coordinate range{c.name, CoordinateKind::length, c.tolerance->lower, c.tolerance->upper, c.where};
  add_length(range);
  Variable& v = out_.variables.back();
  v.kind = VariableKind::parameter;
  v.auxiliary = v.lower_implied = v.upper_implied = true;
}

void Algebrizer::add_angle(const Coordinate& coordinate) {
  const ConstantRange range = range_of(coordinate);
  AngleRange condition;
  try {
    condition = angle_range(range);
  } catch (const std::domain_error& error) {
    throw ModelError(coordinate.where, "the range of " + in_quotes(coordinate.name) + " cannot be used: " + error.what(),
                     "radians");
  }
  Angle angle;
  angle.name = coordinate.name;
  const auto& [cosine, sine] = names_of_angles_.at(coordinate.name);
  angle.cosine = add_variable(cosine, VariableKind::cosine, condition.cosine);
  angle.sine = add_variable(sine, VariableKind::sine, condition.sine);
  angle.range = Interval(range.lower.exact().enclose().lo(), range.upper.exact().enclose().hi());
  const auto c = ExpandedPolynomial::variable(angle.cosine), s = ExpandedPolynomial::variable(angle.sine);
  if (condition.value) {
    expander_.add_fixed_angle(coordinate.name, range.lower);
    special_angles_.push_back(coordinate.name);
    angle_equations_.push_back((c - condition.value->cosine).compile("value of " + coordinate.name));
    angle_equations_.push_back((s - condition.value->sine).compile("value of " + coordinate.name));
  } else if (in_.dependent_angle && in_.dependent_angle->angle == coordinate.name) {
    expander_.add_dependent_angle(*in_.dependent_angle);
  } else {
    expander_.add_angle(coordinate.name, angle.cosine, angle.sine);
    angle_equations_.push_back((pow(c, 2) + pow(s, 2) - 1).compile("circle of " + coordinate.name));
  }
  if (condition.chord) {
    const auto& [cos_m, sin_m, cos_h] = *condition.chord;
    chords_.push_back((cos_m * c + sin_m * s - cos_h).compile("range of " + coordinate.name));
  }
  out_.angles.push_back(std::move(angle));
}

// In place of the circle, on which the other angle is.
void Algebrizer::add_dependent_angle(const DependentAngle& dependent) {
  const Expression angle = Expression::symbol(dependent.angle);
  const auto own = std::ranges::find_if(out_.angles, [&](const Angle& a) { return a.name == dependent.angle; });
  for (const auto& [function, variable] : {std::pair("cos", own->cosine), std::pair("sin", own->sine)}) {
    const ExpandedPolynomial value =
        expander_.polynomial(Expression::function(function, {angle}), dependent.text(), {in_.name, 0, 0});
    angle_equations_.push_back((ExpandedPolynomial::variable(variable) - value).compile(dependent.text()));
  }
  special_angles_.insert(special_angles_.end(), {dependent.angle, dependent.other});
}

void Algebrizer::add_kernel_unknowns() {
  for (const std::string& name : in_.kernel_unknowns)
    expander_.add_unknown(name, add_variable(name, VariableKind::kernel, {-1, 1}));
  for (const std::string& name : in_.second_unknowns)
    expander_.add_unknown(name, add_variable(name, VariableKind::auxiliary, {-1, 1}));
  for (const auto& [name, lower, upper] : in_.further_unknowns)
    expander_.add_unknown(name, add_variable(name, VariableKind::auxiliary, {lower, upper}));
}

ExpandedPolynomial Algebrizer::difference(const TrigonometricSystem::Equation& equation) {
  const std::string what = equation_text(equation);
  const Relation relation = following_.empty() ? equation.relation : equation.relation.substituted(following_);
  const ExpandedPolynomial lhs = expander_.polynomial(relation.lhs, what, equation.where);
  const ExpandedPolynomial rhs = expander_.polynomial(relation.rhs, what, equation.where);
  try {
    return lhs - rhs;
  } catch (const std::exception& error) {
    throw ModelError(equation.where, "the equation " + what + " is too large: " + error.what(), "a smaller polynomial");
  }
}

void Algebrizer::add_equation(const TrigonometricSystem::Equation& equation) {
  Polynomial polynomial = difference(equation).compile(equation.source);
  if (polynomial.monomials.empty()) {
    // A kernel row that the constants make zero says nothing about xi, and where an angle has one value, or
    // depends on another, an equation may say nothing there. Any other equation of the model that says nothing is a mistake.
    if (equation.of_kernel || mentions(equation.relation, special_angles_)) return;
    throw ModelError(equation.where, "the equation " + equation_text(equation) + " always holds",
                     "an equation between unknowns");
  }
  if (polynomial.degree() == 0) {
    const ExactNumber& value = polynomial.monomials[0].coefficient;
    throw ModelError(equation.where,
                     "the equation " + equation_text(equation) + " contains no unknown and " +
                         (value.sign() ? "can never hold: " : "cannot be decided: ") + value.text() + " = 0",
                     "an equation between unknowns");
  }
  require_bounded(polynomial, equation);
  out_.equations.push_back(std::move(polynomial));
}

void Algebrizer::add_inequality(const TrigonometricSystem::Equation& inequality) {
  ExpandedPolynomial gap = difference(inequality);
  if (inequality.relation.kind == Relation::Kind::less_equal) gap = -gap;
  Polynomial polynomial = gap.compile(inequality.source);
  if (polynomial.degree() == 0) {
    const std::optional<int> sign = polynomial.monomials.empty() ? 0 : polynomial.monomials[0].coefficient.sign();
    if (sign && *sign >= 0) return;
    throw ModelError(inequality.where,
                     "the inequality " + equation_text(inequality) + " contains no unknown and " +
                         (sign ? "can never hold" : "cannot be decided"),
                     "an inequality between unknowns");
  }
  require_bounded(polynomial, inequality);
  out_.inequalities.push_back(std::move(polynomial));
}

void Algebrizer::add_names() {
  for (const Constant& constant : in_.constants) names_.insert(constant.name);
  const std::vector<Coordinate>& all = in_.coordinates_of_whole.empty() ? in_.coordinates : in_.coordinates_of_whole;
  for (const Coordinate& coordinate : all) names_.insert(coordinate.name);
  names_.insert(in_.kernel_unknowns.begin(), in_.kernel_unknowns.end());
  names_.insert(in_.second_unknowns.begin(), in_.second_unknowns.end());
  for (const auto& unknown : in_.further_unknowns) names_.insert(unknown.name);
  for (const Coordinate& c : all)
    if (c.kind == CoordinateKind::angle) {
      std::string cosine = fresh_name("c_" + c.name);
      names_of_angles_.emplace(c.name, std::pair(std::move(cosine), fresh_name("s_" + c.name)));
    }
}

void Algebrizer::add_coordinates() {
  for (const Constant& constant : in_.constants) add_constant(constant);
  for (const Coordinate& coordinate : in_.coordinates) {
    const auto first = out_.variables.size();
    coordinate.kind == CoordinateKind::angle ? add_angle(coordinate) : add_length(with_fixed_ends(coordinate));
    for (auto v = first; v < out_.variables.size(); ++v) out_.variables[v].auxiliary = coordinate.auxiliary;
  }
  if (in_.dependent_angle) add_dependent_angle(*in_.dependent_angle);
  for (const Constant* parameter : parameters_) add_parameter(*parameter);
}

System Algebrizer::run() {
  out_.name = in_.name;
  add_names();
  add_coordinates();
  out_.configuration_size = out_.size();
  out_.kernel_vectors = in_.corank;
  out_.kernel_scales = in_.kernel_scales;
  out_.passive_rates_eliminated = in_.passive_rates_eliminated;
  add_kernel_unknowns();
  expander_.length_functions().start(out_.size());

  // The configuration's own equations and its angles' first, the kernel's after them.
  for (const auto& equation : in_.equations)
    if (!equation.of_kernel) add_equation(equation);
  out_.equations.insert(out_.equations.end(), angle_equations_.begin(), angle_equations_.end());
  for (const auto& equation : in_.equations)
    if (equation.of_kernel && !equation.is_dependent_angle) add_equation(equation);
  for (const auto& inequality : in_.inequalities) add_inequality(inequality);
  for (const auto& claim : in_.claimed) out_.claimed.push_back(difference(claim).compile(claim.source));
  out_.inequalities.insert(out_.inequalities.end(), chords_.begin(), chords_.end());
  expander_.length_functions().settle(out_, [this](const std::string& name) { return fresh_name(name); });
  try {
    out_.validate();
  } catch (const std::invalid_argument& error) {
    throw ModelError({in_.name, 0, 0}, error.what());
  }
  return std::move(out_);
}

std::vector<Polynomial> Algebrizer::polynomials(const std::vector<Expression>& expressions) {
  add_names();
  add_coordinates();
  add_kernel_unknowns();
  const int variables = out_.size();
  expander_.length_functions().start(variables);
  std::vector<Polynomial> result;
  for (const Expression& expression : expressions) {
    const std::string what = in_quotes(expression.text());
    const Expression own = expression.substituted(following_);
    result.push_back(expander_.polynomial(own, what, {in_.name, 0, 0}).compile(what));
    for (const Monomial& monomial : result.back().monomials)
      for (const Factor& factor : monomial.factors)
        if (factor.variable >= variables)
          throw ModelError({in_.name, 0, 0}, what + " holds a sine or cosine of a length", "a polynomial in lengths");
  }
  return result;
}

// Whatever GiNaC and CLN throw becomes a ModelError.
template <typename Make>
auto guarded(const TrigonometricSystem& system, const Make& make) {
  const GinacLock lock;
  try {
    return make(Algebrizer(system));
  } catch (const ModelError&) {
    throw;
  } catch (const InvariantError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw ModelError({system.name, 0, 0}, std::string("the system cannot be made polynomial: ") + error.what());
  }
}

}  // namespace

System algebrize(const TrigonometricSystem& system) {
  return guarded(system, [](Algebrizer algebrizer) { return algebrizer.run(); });
}

std::vector<Polynomial> polynomials(const TrigonometricSystem& system, const std::vector<Expression>& expressions) {
  return guarded(system, [&](Algebrizer algebrizer) { return algebrizer.polynomials(expressions); });
}

}  // namespace corank::symbolic
