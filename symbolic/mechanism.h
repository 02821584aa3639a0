// A mechanism: its constants, its coordinates q (lengths and angles) with their ranges, its assembly constraints Φ(q) = 0,
// and which coordinates are inputs v and outputs u. Built in C++ by the functions below or read from a model file
// (model_file.h).
//
// Without inputs and outputs it is a plain system, which can be solved but has no singularities to speak of.
// Invariants: names are distinct, are no reserved words (pi, sin …); every range's ends are expressions in constants. That
// expressions use known names only is checked by validate(), because constants may be overridden before.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "corank/symbolic/drawing.h"
#include "corank/symbolic/expression.h"

namespace corank::symbolic {

struct Constant {
  std::string name;
  Expression value;  ///< in numbers, pi and constants declared before
  SourceLocation where;
};

enum class CoordinateKind { length, angle };

struct Coordinate {
  std::string name;
  CoordinateKind kind = CoordinateKind::length;
  Expression lower, upper;  ///< in constants; lengths in the model's unit, angles in radians
  SourceLocation where;
  bool auxiliary =
      false;  ///< from [DUMMY VARS] or [CARTESIAN VARS]: defined by the others through equations, and of no interest
};

struct Constraint {
  Relation relation;  ///< = : part of Φ; ≤, ≥ : an inequality that every configuration must satisfy
  SourceLocation where;
};

class Mechanism {
 public:
  explicit Mechanism(std::string name = "mechanism") : name_(std::move(name)) {}

  /// Each returns the name as an expression, to be used in constraints. Throws ModelError where the name is taken, reserved
  /// or no identifier.
  Expression constant(const std::string& name, const Expression& value, const SourceLocation& where = {});
  Expression length(const std::string& name, const Expression& lower, const Expression& upper,
                    const SourceLocation& where = {});
  Expression angle(const std::string& name, const Expression& lower = -pi(), const Expression& upper = pi(),
                   const SourceLocation& where = {});
  /// Marks the coordinate declared last.
  void mark_auxiliary();
  /// Adds lhs = rhs (an assembly constraint) or an inequality.
  void constrain(const Relation& relation, const SourceLocation& where = {});
  /// Each argument is a coordinate's symbol. Throws ModelError for anything else, a repetition, or a coordinate that is
  /// already an output (input). Repeated calls add.
  void inputs(const std::vector<Expression>& symbols, const SourceLocation& where = {});
  void outputs(const std::vector<Expression>& symbols, const SourceLocation& where = {});
  void drawing(Drawing drawing) { drawing_ = std::move(drawing); }

  /// Replaces the value of a declared constant (`-D L2=1`). Throws ModelError where there is no such constant.
  void set_constant(const std::string& name, const Expression& value);

  const std::string& name() const { return name_; }
  /// The model's text as read, empty for a mechanism built in C++.
  const std::string& source_text() const { return source_text_; }
  void set_source_text(std::string text) { source_text_ = std::move(text); }

  const std::vector<Constant>& constants() const { return constants_; }
  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  const Drawing& drawing() const { return drawing_; }
  /// Where the inputs (outputs) were named first.
  const SourceLocation& inputs_where() const { return inputs_where_; }
  const SourceLocation& outputs_where() const { return outputs_where_; }
  /// No inputs and no outputs.
  bool is_plain_system() const { return inputs_.empty() && outputs_.empty(); }
  /// Index of a coordinate, −1 where there is none.
  int find_coordinate(const std::string& name) const;
  bool has_constant(const std::string& name) const;

  /// Throws ModelError, with the place, for: a name in a constant, range, constraint that is not declared (before, for
  /// constants); a coordinate in a constant or range; an absurd power (9^9^9^9); no coordinates; no constraints; a faulty
  /// drawing (Drawing::validate), or one with an angle outside sin, cos and tan.
  void validate() const;

 private:
  /// Registers the name of the next constant or coordinate, where it is free and no reserved word.
  void declare(const std::string& name, bool is_constant, const SourceLocation& where);
  void choose(const std::string& role, const std::vector<Expression>& symbols, const SourceLocation& where,
              std::vector<std::string>& chosen, const std::string& other_role, const std::vector<std::string>& others) const;

  std::string name_, source_text_;
  std::vector<Constant> constants_;
  std::vector<Coordinate> coordinates_;
  std::vector<Constraint> constraints_;
  std::vector<std::string> inputs_, outputs_;
  SourceLocation inputs_where_, outputs_where_;
  Drawing drawing_;
  /// A name in use: the constant or the coordinate of that index.
  struct Declaration {
    bool is_constant;
    std::size_t index;
  };
  std::unordered_map<std::string, Declaration> names_;
};

}  // namespace corank::symbolic
