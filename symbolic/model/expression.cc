#include "corank/symbolic/model/expression.h"

#include <algorithm>
#include <numeric>
#include <ostream>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {

struct Expression::Node {
  Kind kind;
  std::string name;
  std::vector<Expression> operands;
  SourceLocation where;
  int depth;  ///< of the tree; bounded, so that every recursion over a tree is
};

Expression Expression::make(Kind kind, std::string name, std::vector<Expression> operands, const SourceLocation& where) {
  int depth = 0;
  for (const Expression& operand : operands) depth = std::max(depth, operand.node_->depth + 1);
  if (depth > kMaxDepth)
    throw ModelError(where, "the expression is nested too deeply",
                     "at most " + std::to_string(kMaxDepth) + " operations inside one another");
  return Expression(std::make_shared<const Node>(Node{kind, std::move(name), std::move(operands), where, depth}));
}

Expression::Expression(int n) {
  static const Expression kZero = number("0"), kOne = number("1");  // of which matrices are full: shared
  *this = n == 0 ? kZero : n == 1 ? kOne : number(std::to_string(n));
}

Expression::Expression(const char* text) : Expression(std::string(text)) {}

Expression::Expression(const std::string& text) : Expression(parse_anonymous_expression(text)) {}

Expression Expression::number(const std::string& decimal, const SourceLocation& where) {
  if (!decimal.empty() && decimal[0] == '-') return node(Kind::negation, {number(decimal.substr(1), where)}, where);
  return make(Kind::number, normal_decimal(decimal, where), {}, where);
}

Expression Expression::symbol(const std::string& name, const SourceLocation& where) {
  if (!is_identifier(name))
    throw ModelError(where, in_quotes(name) + " is not a name", "letters, digits and _, not beginning with a digit");
  if (is_function_name(name)) throw ModelError(where, "the function " + in_quotes(name) + " has no argument", name + "(…)");
  return make(Kind::symbol, name, {}, where);
}

Expression Expression::function(const std::string& name, const Expression& argument, const SourceLocation& where) {
  if (!is_function_name(name))
    throw ModelError(where, "unknown function " + in_quotes(name), "an operator or one of " + function_names());
  return make(Kind::function, name, {argument}, where);
}

Expression Expression::node(Kind kind, std::vector<Expression> operands, const SourceLocation& where) {
  const bool n_ary = kind == Kind::sum || kind == Kind::product;
  if (n_ary && operands.empty()) return kind == Kind::sum ? Expression(0) : Expression(1);
  if (n_ary && operands.size() == 1) return operands[0];
  const std::size_t arity = kind == Kind::negation ? 1 : 2;
  const bool has_operands = n_ary || kind == Kind::quotient || kind == Kind::power || kind == Kind::negation;
  if (!has_operands || (!n_ary && operands.size() != arity))
    throw ModelError(where, "an operation with " + std::to_string(operands.size()) + " operands",
                     has_operands ? std::to_string(arity) + " operands" : "a sum, product, quotient, power or negation");
  return make(kind, "", std::move(operands), where);
}

Expression::Kind Expression::kind() const { return node_->kind; }
const std::string& Expression::name() const { return node_->name; }
const std::vector<Expression>& Expression::operands() const { return node_->operands; }
const SourceLocation& Expression::where() const { return node_->where; }

bool Expression::mentions(const std::string& symbol_name) const {
  if (kind() == Kind::symbol) return name() == symbol_name;
  return std::any_of(operands().begin(), operands().end(), [&](const Expression& e) { return e.mentions(symbol_name); });
}

Expression Expression::substituted(const std::map<std::string, Expression>& values) const {
  if (kind() == Kind::number) return *this;
  if (kind() == Kind::symbol) {
    const auto found = values.find(name());
    return found == values.end() ? *this : found->second;
  }
  std::vector<Expression> parts;
  for (const Expression& operand : operands()) parts.push_back(operand.substituted(values));
  return kind() == Kind::function ? function(name(), parts[0], where()) : node(kind(), std::move(parts), where());
}

bool same_tree(const Expression& a, const Expression& b) {
  if (a.node_ == b.node_) return true;
  return a.kind() == b.kind() && a.name() == b.name() &&
         std::equal(a.operands().begin(), a.operands().end(), b.operands().begin(), b.operands().end(), same_tree);
}

bool same_relation(const Relation& a, const Relation& b) {
  return a.kind == b.kind && same_tree(a.lhs, b.lhs) && same_tree(a.rhs, b.rhs);
}

// a + b + c in C++ is (a + b) + c and means one sum of three, as it does in a file; a + (b + c) keeps its parentheses.
Expression Expression::appended(Kind kind, const Expression& a, const Expression& b) {
  if (a.kind() != kind) return node(kind, {a, b}, a.where());
  std::vector<Expression> operands;
  operands.reserve(a.operands().size() + 1);
  operands = a.operands();
  operands.push_back(b);
  return node(kind, std::move(operands), a.where());
}

Expression operator+(const Expression& a, const Expression& b) { return Expression::appended(Expression::Kind::sum, a, b); }
Expression operator-(const Expression& a, const Expression& b) { return Expression::appended(Expression::Kind::sum, a, -b); }
Expression operator-(const Expression& a) { return Expression::node(Expression::Kind::negation, {a}, a.where()); }
Expression operator*(const Expression& a, const Expression& b) {
  return Expression::appended(Expression::Kind::product, a, b);
}
Expression operator/(const Expression& a, const Expression& b) {
  return Expression::node(Expression::Kind::quotient, {a, b}, a.where());
}

Expression pow(const Expression& base, const Expression& exponent) {
  return Expression::node(Expression::Kind::power, {base, exponent}, base.where());
}
Expression sqrt(const Expression& x) { return Expression::function("sqrt", x, x.where()); }
Expression sin(const Expression& x) { return Expression::function("sin", x, x.where()); }
Expression cos(const Expression& x) { return Expression::function("cos", x, x.where()); }
Expression tan(const Expression& x) { return Expression::function("tan", x, x.where()); }
Expression pi() { return Expression::symbol("pi"); }

Expression degrees(const std::string& decimal, const SourceLocation& where) {
  constexpr std::size_t kFewDigits = 10;  // whose fraction is reduced by machine numbers
  const Expression circle = Expression::symbol("pi", where);
  if (decimal.size() > kFewDigits || decimal.find('e') != std::string::npos) {
    return Expression::node(
        Expression::Kind::quotient,
        {Expression::node(Expression::Kind::product, {Expression::number(decimal, where), circle}, where), Expression(180)},
        where);
  }
  long long numerator = 0, denominator = 180;
  bool behind_point = false;
  for (const char c : decimal) {
    if (c == '.') {
      behind_point = true;
      continue;
    }
    numerator = 10 * numerator + (c - '0');
    if (behind_point) denominator *= 10;
  }
  const long long common = std::gcd(numerator, denominator);
  numerator /= common, denominator /= common;
  if (numerator == 0) return Expression::number("0", where);
  const Expression top = numerator == 1
                             ? circle
                             : Expression::node(Expression::Kind::product,
                                                {Expression::number(std::to_string(numerator), where), circle}, where);
  if (denominator == 1) return top;
  return Expression::node(Expression::Kind::quotient, {top, Expression::number(std::to_string(denominator), where)}, where);
}

Relation operator==(const Expression& lhs, const Expression& rhs) { return {lhs, Relation::Kind::equal, rhs}; }
Relation operator<=(const Expression& lhs, const Expression& rhs) { return {lhs, Relation::Kind::less_equal, rhs}; }
Relation operator>=(const Expression& lhs, const Expression& rhs) { return {lhs, Relation::Kind::greater_equal, rhs}; }

std::ostream& operator<<(std::ostream& out, const Expression& e) { return out << e.text(); }
std::ostream& operator<<(std::ostream& out, const Relation& r) { return out << r.text(); }

}  // namespace corank::symbolic
