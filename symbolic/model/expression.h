// Expressions as a model's author writes them: exact numbers, names, + − · / ^ and functions. An immutable tree; a regular
// value type; nothing is simplified, so a report can show what was written. GiNaC works on a copy, behind ginac_bridge.h.
#pragma once

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "corank/symbolic/model/model_error.h"

namespace corank::symbolic {

class Expression {
 public:
  enum class Kind { number, symbol, sum, product, quotient, power, negation, function };

  Expression() : Expression(0) {}
  /*implicit*/ Expression(int n);
  Expression(double) = delete;  ///< 0.1 in C++ is not 1/10: write Expression("0.1")
                                /// Parses the model language: "0.90", "y_A", "cos(theta + pi/3)". Throws ModelError.
  /*implicit*/ Expression(const char* text);
  /*implicit*/ Expression(const std::string& text);

  /// "0.90", "1e-3", "2": exact, kept as written (".5", "5.", "1E+3" as "0.5", "5", "1e3"). "-2" gives the negation of 2.
  static Expression number(const std::string& decimal, const SourceLocation& where = {});
  static Expression symbol(const std::string& name, const SourceLocation& where = {});
  static Expression function(const std::string& name, const Expression& argument, const SourceLocation& where = {});
  /// Sums and products of any number of operands (of one: the operand itself; of none: 0, 1), binary quotients and powers,
  /// the unary negation. a − b is the sum of a and the negation of b. Throws ModelError beyond kMaxDepth.
  static Expression node(Kind kind, std::vector<Expression> operands, const SourceLocation& where = {});

  /// Trees are at most this deep, so that every recursion over a tree is bounded.
  static constexpr int kMaxDepth = 1000;

  Kind kind() const;
  /// The number as written, never negative; the symbol's or the function's name; empty for other kinds.
  const std::string& name() const;
  const std::vector<Expression>& operands() const;
  const SourceLocation& where() const;
  /// Where it is written; of what a program made, `otherwise`.
  const SourceLocation& where_or(const SourceLocation& otherwise) const { return where().line > 0 ? where() : otherwise; }
  /// Is it written with signs that a factor must keep in parentheses?
  bool is_sum_or_negation() const { return kind() == Kind::sum || kind() == Kind::negation; }

  /// A function that is written with its name: not sqrt and abs, which enclose their argument.
  bool is_named_function() const { return kind() == Kind::function && name() != "sqrt" && name() != "abs"; }
  bool is_whole_number() const { return kind() == Kind::number && name().find_first_of(".e") == std::string::npos; }
  /// Is it written without parentheses below an exponent?
  bool is_bare_base() const {
    return kind() == Kind::symbol || (kind() == Kind::number && name().find('e') == std::string::npos) ||
           (kind() == Kind::function && !is_named_function());
  }

  /// Does the name occur?
  bool mentions(const std::string& symbol_name) const;
  /// With values in place of names.
  Expression substituted(const std::map<std::string, Expression>& values) const;
  /// In the model language, with the fewest parentheses; parses back to the same tree.
  std::string text() const;
  /// In LaTeX: theta2 → \theta_{2}, J3x → J_{3x}, quotients as \frac.
  std::string latex() const;

  friend Expression operator+(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a);
  friend Expression operator*(const Expression& a, const Expression& b);
  friend Expression operator/(const Expression& a, const Expression& b);
  /// Structural equality of the trees is same_tree(); operator== builds an equation (see Relation).
  friend bool same_tree(const Expression& a, const Expression& b);

 private:
  struct Node;
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  static Expression make(Kind kind, std::string name, std::vector<Expression> operands, const SourceLocation& where);
  static Expression appended(Kind kind, const Expression& a, const Expression& b);
  std::shared_ptr<const Node> node_;
};

bool same_tree(const Expression& a, const Expression& b);
Expression pow(const Expression& base, const Expression& exponent);
Expression sqrt(const Expression& x);
Expression sin(const Expression& x);
Expression cos(const Expression& x);
Expression tan(const Expression& x);
/// The circle constant, as in the model language.
Expression pi();
/// A number of degrees as an exact angle: of "15" pi/12, of "22.5" pi/8, of "1" pi/180.
Expression degrees(const std::string& decimal, const SourceLocation& where = {});

/// LaTeX for a name: theta2 → \theta_{2}, J3x → J_{3x}, y_A → y_{A}.
std::string latex_name(const std::string& name);

/// lhs = rhs, lhs ≤ rhs or lhs ≥ rhs.
struct Relation {
  enum class Kind { equal, less_equal, greater_equal };
  Expression lhs;
  Kind kind = Kind::equal;
  Expression rhs;
  std::string text() const;
  Relation substituted(const std::map<std::string, Expression>& values) const {
    return {lhs.substituted(values), kind, rhs.substituted(values)};
  }
};
bool same_relation(const Relation& a, const Relation& b);
Relation operator==(const Expression& lhs, const Expression& rhs);
Relation operator<=(const Expression& lhs, const Expression& rhs);
Relation operator>=(const Expression& lhs, const Expression& rhs);

std::ostream& operator<<(std::ostream& out, const Expression& e);
std::ostream& operator<<(std::ostream& out, const Relation& r);

}  // namespace corank::symbolic
