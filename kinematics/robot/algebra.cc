#include "corank/kinematics/robot/algebra.h"

#include <cmath>
#include <numbers>

#include "corank/symbolic/algebra/polynomial_expander.h"
#include "corank/symbolic/model/evaluate.h"

namespace corank::kinematics {

using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

// A number, a name, products and sums of two of them.
bool is_short(const ex& e) {
  std::size_t leaves = 0;
  bool plain = true;
  for (GiNaC::const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i) {
    if (i->nops() == 0) ++leaves;
    if (is_a<GiNaC::function>(*i) || is_a<GiNaC::power>(*i)) plain = false;
  }
  return leaves <= (plain ? 3 : 2);
}

std::size_t terms(const ex& sum) { return is_a<GiNaC::add>(sum) ? sum.nops() : 1; }

// sin² as 1 − cos².
struct SquaredSines : GiNaC::map_function {
  ex operator()(const ex& e) override {
    const ex inner = e.map(*this);
    if (!is_a<GiNaC::power>(inner) || !inner.op(1).is_equal(2) || !is_a<GiNaC::function>(inner.op(0))) return inner;
    const auto function = ex_to<GiNaC::function>(inner.op(0));
    return function.get_name() == "sin" ? 1 - GiNaC::pow(GiNaC::cos(function.op(0)), 2) : inner;
  }
};

}  // namespace

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(const ex& s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
ex dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec operator*(const Mat& m, const Vec& a) { return {dot(m[0], a), dot(m[1], a), dot(m[2], a)}; }

Mat transpose(const Mat& m) {
  Mat t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = m[j][i];
  return t;
}

Mat operator*(const Mat& a, const Mat& b) {
  const Mat columns = transpose(b);
  return transpose({a * columns[0], a * columns[1], a * columns[2]});
}

Mat identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

Algebra::Algebra(const Robot& robot) {
  symbolic::PolynomialExpander values;  // words the faults
  for (const symbolic::Constant& constant : robot.constants) {
    const symbolic::ConstantValue& value = values.define(constant);
    add_constant(constant.name, value.exact());
    if (value.sign().value_or(0) != 0) continue;
    zeros_[constants_.at(constant.name)] = 0;
    note(constants_.at(constant.name), 0);
  }
}

void Algebra::add_constant(const std::string& name, const ExactNumber& value) {
  constants_.emplace(name, GiNaC::realsymbol(name));
  constant_names_.push_back(name);
  exact_.emplace(name, value);
  plain_.emplace(name, value.enclose().mid());
}

ex Algebra::expression(const Expression& e, const SourceLocation& where) const {
  const symbolic::GinacBridge bridge(constant_names_, coordinate_names_);
  GiNaC::exmap own;
  for (const auto& [name, symbol] : constants_) own[bridge.symbol(name)] = symbol;
  for (const auto& [name, symbol] : coordinates_) own[bridge.symbol(name)] = symbol;
  return bridge.to_ginac(e, where).subs(own, GiNaC::subs_options::no_pattern).subs(zeros_, GiNaC::subs_options::no_pattern);
}

ex Algebra::constant(const Expression& e, const SourceLocation& where) const {
  using Kind = Expression::Kind;
  if (e.kind() == Kind::number) return symbolic::exact_decimal(e.name());
  if (e.kind() == Kind::negation) return -constant(e.operands()[0], where);
  return expression(e, where);
}

Vec Algebra::vector(const Vector& v, const SourceLocation& where) const {
  return {constant(v[0], where), constant(v[1], where), constant(v[2], where)};
}

ex Algebra::coordinate(const std::string& name) {
  coordinate_names_.push_back(name);
  return coordinates_.emplace(name, GiNaC::realsymbol(name)).first->second;
}

double Algebra::value(const ex& e) const {
  if (is_a<numeric>(e)) return ex_to<numeric>(e).to_double();
  if (is_a<GiNaC::symbol>(e)) return plain_.at(ex_to<GiNaC::symbol>(e).get_name());
  if (e.is_equal(GiNaC::Pi)) return std::numbers::pi;
  if (is_a<GiNaC::power>(e)) return std::pow(value(e.op(0)), value(e.op(1)));
  if (is_a<GiNaC::function>(e)) return symbolic::function_value(ex_to<GiNaC::function>(e).get_name(), value(e.op(0)));
  double result = is_a<GiNaC::add>(e) ? 0 : 1;
  for (const ex& part : e) is_a<GiNaC::add>(e) ? result += value(part) : result *= value(part);
  return result;
}

std::optional<numeric> Algebra::rational(const ex& constant) const {
  const ExactNumber value = exact(constant);
  if (!value.is_rational()) return std::nullopt;
  const numeric number(value.text().c_str());
  note(constant - number, 0);
  return number;
}

ExactNumber Algebra::exact(const ex& e) const {
  if (is_a<numeric>(e)) return ExactNumber::rational(symbolic::text_of(e));
  if (is_a<GiNaC::symbol>(e)) return exact_.at(ex_to<GiNaC::symbol>(e).get_name());
  if (e.is_equal(GiNaC::Pi)) return ExactNumber::pi();
  if (is_a<GiNaC::power>(e)) {
    const numeric n = ex_to<numeric>(e.op(1));
    if (n.is_integer()) return pow(exact(e.op(0)), n.to_int());
    return pow(ExactNumber::apply(ConstantFunction::sqrt, exact(e.op(0))), (n * 2).to_int());  // all that geometry makes
  }
  if (is_a<GiNaC::function>(e)) {
    const auto function = symbolic::constant_function(e);
    if (!function) throw std::domain_error("no function of constants");
    return ExactNumber::apply(*function, exact(e.op(0)));
  }
  ExactNumber result = is_a<GiNaC::add>(e) ? 0 : 1;
  for (const ex& part : e) result = is_a<GiNaC::add>(e) ? result + exact(part) : result * exact(part);
  return result;
}

void Algebra::note(const ex& constant, int sign) const {
  for (GiNaC::const_preorder_iterator i = constant.preorder_begin(); i != constant.preorder_end(); ++i)
    if (is_a<GiNaC::symbol>(*i)) return void(decisions_.emplace(constant, sign));
}

std::vector<std::pair<ex, int>> Algebra::decisions() const { return {decisions_.begin(), decisions_.end()}; }

int Algebra::sign(const ex& constant) const {
  const int result = sign_by_value(constant);
  note(constant, result);
  return result;
}

int Algebra::sign_by_value(const ex& constant) const {
  constexpr double kPlain = 1e-6;  // far beyond the rounding errors of numbers as robots have them
  constexpr int kBits = 512;
  if (is_a<numeric>(constant)) return ex_to<numeric>(constant).csgn();
  const auto known = signs_.find(constant);
  if (known != signs_.end()) return known->second;
  const double plain = value(constant);
  const int result = std::fabs(plain) > kPlain ? (plain > 0 ? 1 : -1) : exact(constant).sign(kBits).value_or(0);
  signs_.emplace(constant, result);
  return result;
}

bool Algebra::is_zero(const Vec& constants) const {
  return is_zero(constants[0]) && is_zero(constants[1]) && is_zero(constants[2]);
}

ex Algebra::square_root(const ex& square) const {
  constexpr int kMaxDenominator = 1000;
  const double root = std::sqrt(value(square));
  for (int q = 1; q <= kMaxDenominator && root < 1e6; ++q) {
    const double p = std::round(root * q);
    if (std::fabs(root * q - p) > 1e-9 * q) continue;
    const ex rational = numeric(static_cast<long>(p), q);
    if (is_zero(square - rational * rational)) return rational;
    break;
  }
  return GiNaC::sqrt(square);
}

Vec Algebra::unit(const Vec& v) const { return 1 / square_root(dot(v, v).expand()) * v; }

Vec Algebra::perpendicular(const Vec& axis) const {
  const Vec axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec& e : axes)
    if (is_zero(dot(axis, e))) return e;
  // The part across the axis of the coordinate axis that is farthest from it.
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(value(axis[i])) < std::fabs(value(axis[farthest]))) farthest = i;
  const Vec& e = axes[farthest];
  return unit(e - dot(axis, e) / dot(axis, axis) * axis);
}

ex Algebra::named(const ex& constant) {
  if (is_short(constant)) return constant;
  for (const int simple : {0, 1, -1}) {
    if (sign_by_value(constant - simple) != 0) continue;
    note(constant - simple, 0);
    return simple;
  }
  const auto known = names_of_.find(constant);
  if (known != names_of_.end()) return known->second;
  const auto negative = names_of_.find((-constant).expand());
  if (negative != names_of_.end()) return -negative->second;
  std::string name;
  do name = "k" + std::to_string(++numbered_);
  while (constants_.contains(name));
  add_constant(name, exact(constant));
  named_.emplace_back(name, constant);
  names_of_.emplace(constant, constants_.at(name));
  return constants_.at(name);
}

std::vector<symbolic::Constant> Algebra::named_constants() const {
  const Translation text(*this);
  std::vector<symbolic::Constant> result;
  for (const auto& [name, value] : named_) result.push_back({name, text(value), {}});
  return result;
}

bool Algebra::is_constant(const ex& e) const {
  for (GiNaC::const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i)
    if (is_a<GiNaC::symbol>(*i) && coordinates_.contains(ex_to<GiNaC::symbol>(*i).get_name())) return false;
  return true;
}

ex Algebra::clean(const ex& e) const {
  const ex plain = collected(e);
  SquaredSines squares;
  const ex replaced = squares(plain);
  if (replaced.is_equal(plain)) return plain;
  const ex other = collected(replaced);
  return terms(other) < terms(plain) ? other : plain;
}

ex Algebra::collected(const ex& e) const {
  const ex sum = e.expand();
  std::map<ex, ex, GiNaC::ex_is_less> coefficients;  // of each product of coordinates
  for (const ex& term : symbolic::parts_of<GiNaC::add>(sum)) {
    ex coefficient = 1, product = 1;
    for (const ex& f : symbolic::parts_of<GiNaC::mul>(term)) (is_constant(f) ? coefficient : product) *= f;
    coefficients[product] += coefficient;
  }
  GiNaC::exvector kept;  // added at once: one by one takes quadratic time
  for (const auto& [product, coefficient] : coefficients)
    if (sign_by_value(coefficient) != 0) {
      kept.push_back(coefficient * product);
    } else if (!coefficient.is_zero()) {
      note(coefficient, 0);
    }
  return GiNaC::add(kept);
}

Algebra::Translation::Translation(const Algebra& algebra) : bridge_(algebra.constant_names_, algebra.coordinate_names_) {
  for (const auto* symbols : {&algebra.constants_, &algebra.coordinates_})
    for (const auto& [name, symbol] : *symbols) theirs_[symbol] = bridge_.symbol(name);
}

}  // namespace corank::kinematics
