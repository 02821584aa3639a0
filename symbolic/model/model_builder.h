// What the grammar's actions build while a text is parsed: expressions on a stack of frames, one per open parenthesis, and
// from them the mechanism.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

class ExpressionBuilder {
 public:
  /// Parentheses inside one another: bounds the recursion of the grammar.
  static constexpr std::size_t kMaxNesting = 200;

  enum class SignOf { exponent, factor, term };

  void begin() { frames_.emplace_back(); }
  void operand(Expression e);
  void symbol(const std::string& name, const SourceLocation& where);  ///< pi/180 where it is deg
  /// A parenthesis; that of a function, or, without a name, of a group.
  void open(const SourceLocation& where, const std::string& function = "", const SourceLocation& function_where = {});
  void close();
  void sign(SignOf what);
  void division() { frames_.back().divides = true; }
  void end_power();
  void end_term();
  /// The expression begun last.
  Expression end();

  /// The innermost open parenthesis, if any.
  std::optional<SourceLocation> open_parenthesis() const;

 private:
  /// One operand of x ^ y ^ z, with the signs before it.
  struct ChainLink {
    Expression operand;
    int signs;
  };
  struct Frame {
    SourceLocation parenthesis;  ///< where it was opened; unused in the outermost frame
    std::string function;        ///< empty: mere parentheses
    SourceLocation function_where;
    std::vector<Expression> terms, factors;
    std::vector<ChainLink> chain;
    int exponent_signs = 0, factor_signs = 0, term_signs = 0;
    bool divides = false;
  };

  std::vector<Frame> frames_;
};

/// State of a parse. Faults ask it what was read last.
struct ModelBuilder {
  explicit ModelBuilder(std::string file_, bool keep_places_ = true) : file(std::move(file_)), keep_places(keep_places_) {}

  std::string file;
  const bool keep_places;  ///< else expressions carry no places

  ExpressionBuilder expressions;
  std::vector<Expression> values;  ///< finished expressions, until their definition, declaration or equation is
  Mechanism mechanism;

  std::string name;  ///< read last in an expression, and its place
  SourceLocation name_where;
  std::string declared;  ///< the constant or variable being declared, and its place
  SourceLocation declared_where;
  SourceLocation token_end;      ///< just behind the operand read last
  SourceLocation comment_where;  ///< the block comment opened last
  std::string section_title;     ///< of a section with an unknown name
  SourceLocation section_where;

  std::optional<Tolerance> tolerance;  ///< of the constant being defined
  CoordinateKind kind = CoordinateKind::length;
  bool auxiliary = false;  ///< the section's variables
  bool of_rates = false;   ///< the section's equations, as is `implied`
  bool implied = false;
  bool of_limits = false;             ///< the section is [LIMITS]
  std::size_t point_coordinates = 0;  ///< of `values` belong to the point's position, the others to its velocity; 0: all
  Relation::Kind relation = Relation::Kind::equal;
  SourceLocation equation_where;
  bool equation_is_empty = false;  ///< nothing of it has been read
  std::string inequality_name;

  bool names_are_inputs = true;
  std::vector<Expression> inputs, outputs;  ///< resolved at the end: their section may precede the variables
  std::vector<Limit> limits;                ///< likewise
  Drawing drawing;

  /// The tolerance of the constant whose value is read: ± the last value, ± that share of it, or from the one to the other.
  enum class ToleranceForm { absolute, percent, range };
  void finish_tolerance(ToleranceForm form, const std::string& percent = {});
  void finish_constant();
  void finish_variable();  ///< with its range where `values` has one
  void finish_composite(Composite::Kind composite);
  void finish_equation();
  void finish_point();
  /// After the whole text: inputs, outputs, and the checks of Mechanism::validate().
  void finish(const SourceLocation& end);
};

}  // namespace corank::symbolic
