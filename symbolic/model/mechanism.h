// A mechanism: its constants, its coordinates q (lengths and angles) with their ranges, its assembly constraints Φ(q) = 0,
// and which coordinates are inputs v and outputs u. Built in C++ by the functions below or read from a model file
// (model_file.h).
//
// A mechanism may also bring its own velocity equation L m = 0: rates m, each with its role, and equations that are linear
// in them, such as the twists of its loops. Else L is the derivative of Φ (velocity_equation.h).
//
// Without inputs and outputs, of coordinates or of rates, it is a plain system, which can be solved but has no singularities
// to speak of.
// Invariants: names are distinct, are no reserved words (pi, sin …); every range's ends are expressions in constants. That
// expressions use known names only is checked by validate(), because constants may be overridden before.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "corank/symbolic/model/drawing.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::symbolic {

class ModelValidator;

/// Of a constant that is known within a tolerance: lower ≤ value ≤ upper, each in numbers and constants declared before.
struct Tolerance {
  Expression lower, upper;

  std::string text() const { return "[" + lower.text() + ", " + upper.text() + "]"; }
};

struct Constant {
  std::string name;
  Expression value;  ///< in numbers, pi and constants declared before; the nominal one where there is a tolerance
  SourceLocation where;
  std::optional<Tolerance> tolerance{};  ///< one unknown value within it, the same wherever the name stands
};

enum class CoordinateKind { length, angle };

struct Coordinate {
  std::string name;
  CoordinateKind kind = CoordinateKind::length;
  Expression lower,
      upper;  ///< in constants; lengths in the model's unit, angles in radians; without meaning where has_range is false
  SourceLocation where;
  bool auxiliary =
      false;  ///< from [DUMMY VARS] or [CARTESIAN VARS]: defined by the others through equations, and of no interest
  bool has_range = true;    ///< false: a length whose range the equations are to give (limits.h)
  bool direction = false;   ///< a length without a unit: a component of a Composite
  bool within_one = false;  ///< of a system: shown to be in [-1, 1] at every solution (symbolic/sets/unit_vectors.h)

  /// "[0, 2*pi]"
  std::string range_text() const { return "[" + lower.text() + ", " + upper.text() + "]"; }
};

/// A coordinate with a range of one value.
bool is_fixed(const Coordinate& coordinate);
/// Holds the coordinate of that name at one value. Returns false if no coordinate has the name.
bool hold(std::vector<Coordinate>& coordinates, const std::string& name, const Expression& value);

/// Coordinates declared together, with the equations that tie them:
///   unit      w_x, w_y, w_z with w_x² + w_y² + w_z² = 1;
///   rotation  R_xx, R_xy … R_zz, row by row, the columns a = (R_xx, R_yx, R_zx), b, c being the axes of the moving frame in
///   the fixed one:
///             |a|² = 1, |b|² = 1, a·b = 0, c = a × b. These are as many independent equations as 9 − dim SO(3) = 6, at
///             every rotation; reflections do not satisfy them.
struct Composite {
  enum class Kind { unit, rotation };
  Kind kind;
  std::string name;
  std::vector<std::string> components;
  SourceLocation where;
};

struct Constraint {
  Relation relation;  ///< = : part of Φ; ≤, ≥ : an inequality that every configuration must satisfy
  SourceLocation where;
  std::string note = {};  ///< "w @ unit" where a declaration implies it; of an inequality its name
};

/// Ends no motion where the inequality is reached? Its name says so: "choice of …", whose sides are never equal, as the
/// model says; "slice of …", where the search ends and the mechanism goes on.
bool is_no_end(const Constraint& inequality);

/// How far a joint moves: lower ≤ coordinate ≤ upper at every configuration. Unlike a mere range, which says where to look,
/// the mechanism ends there: a set may ask which configurations are at a limit (boundary.h).
struct Limit {
  std::string coordinate;
  Expression lower, upper;  ///< in constants
  SourceLocation where;

  std::string text() const { return "[" + lower.text() + ", " + upper.text() + "]"; }
};

/// What is required of a configuration besides being one, as its author writes it (requirement_text.h).
struct RequirementLine {
  std::string text;
  SourceLocation where;
};

/// A component of m, where the mechanism brings its own velocity equation.
struct Rate {
  std::string name;
  CoordinateKind kind = CoordinateKind::angle;  ///< angle: in rad/s; length: in the model's unit of length per second
  Role role = Role::passive;
  SourceLocation where;
};

/// The names of constants, coordinates, links …, in their order.
std::vector<std::string> names_of(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

class Mechanism {
 public:
  explicit Mechanism(std::string name = "mechanism") : name_(std::move(name)) {}

  /// Each returns the name as an expression, to be used in constraints. Throws ModelError where the name is taken, reserved
  /// or no identifier.
  Expression constant(const std::string& name, const Expression& value, const SourceLocation& where = {},
                      const std::optional<Tolerance>& tolerance = std::nullopt);
  Expression coordinate(const Coordinate& c);
  Expression length(const std::string& name, const Expression& lower, const Expression& upper,
                    const SourceLocation& where = {}) {
    return coordinate({name, CoordinateKind::length, lower, upper, where});
  }
  Expression angle(const std::string& name, const Expression& lower = -pi(), const Expression& upper = pi(),
                   const SourceLocation& where = {}) {
    return coordinate({name, CoordinateKind::angle, lower, upper, where});
  }
  /// A length whose range is what the equations say; those of a set throw where they do not bound it.
  Expression length_without_range(const std::string& name, const SourceLocation& where = {}) {
    return coordinate({name, CoordinateKind::length, 0, 0, where, false, false});
  }
  /// Declare a Composite's coordinates, lengths in [−1, 1], and add its equations. They return the coordinates.
  std::vector<Expression> unit_vector(const std::string& name, const SourceLocation& where = {});
  std::vector<Expression> rotation(const std::string& name, const SourceLocation& where = {});
  /// Marks the coordinates declared last.
  void mark_auxiliary(std::size_t coordinates = 1);
  /// Adds lhs = rhs (an assembly constraint) or an inequality.
  void constrain(const Relation& relation, const SourceLocation& where = {}, const std::string& note = {});
  /// Adds lhs = rhs as a consequence of the constraints, which solve/ is to find a proof of. Throws ModelError for an
  /// inequality.
  void imply(const Relation& relation, const SourceLocation& where = {});
  /// Each argument is a coordinate's symbol, or a Composite's for all of its coordinates. Throws ModelError for anything
  /// else, a repetition, or a coordinate that is already an output (input). Repeated calls add.
  void inputs(const std::vector<Expression>& symbols, const SourceLocation& where = {});
  void outputs(const std::vector<Expression>& symbols, const SourceLocation& where = {});
  /// These outputs, and no others; an input among them is none any more. For questions about other outputs than the model's.
  void replace_outputs(const std::vector<Expression>& symbols, const SourceLocation& where = {});
  /// Limits a coordinate. Throws ModelError for a name that is none of a coordinate, or limited already.
  void limit(const std::string& coordinate, const Expression& lower, const Expression& upper,
             const SourceLocation& where = {});
  /// Declares a component of m, as length() and angle() do of q.
  Expression rate(const std::string& name, CoordinateKind kind, Role role, const SourceLocation& where = {});
  /// Adds lhs = rhs, linear and homogeneous in the rates, its coefficients in constants and coordinates: a row of L. Throws
  /// ModelError for an inequality.
  void velocity(const Relation& relation, const SourceLocation& where = {});
  void drawing(Drawing drawing) { drawing_ = std::move(drawing); }
  /// Adds a requirement. Throws ModelError where the text is none; what its names mean is asked where it is used.
  void require(const std::string& text, const SourceLocation& where = {"requirement", 1, 1});

  /// Replaces the value of a declared constant (`-D L2=1`) and its tolerance. Throws ModelError where there is no such
  /// constant.
  void set_constant(const std::string& name, const Expression& value,
                    const std::optional<Tolerance>& tolerance = std::nullopt);

  /// Gives a declared coordinate that is no component of a composite another range. Throws ModelError where there is none.
  void set_range(const std::string& coordinate, const Expression& lower, const Expression& upper);
  /// The same, and an angle becomes a length: the real number in that range of which the equations take the sine and cosine.
  void unroll(const std::string& angle, const Expression& lower, const Expression& upper);
  /// Makes an inequality the equation of its two sides, behind all others: the configurations that reach it. It has
  /// to be one of the constraints.
  void reach(const Relation& inequality);

  const std::string& name() const { return name_; }
  /// The model's text as read, empty for a mechanism built in C++.
  const std::string& source_text() const { return source_text_; }
  void set_source_text(std::string text) { source_text_ = std::move(text); }

  const std::vector<Constant>& constants() const { return constants_; }
  /// Names of those with a tolerance.
  std::vector<std::string> toleranced() const;
  /// The name of a constant with a tolerance on which the expression depends, also through others; empty: none.
  std::string toleranced_in(const Expression& e) const;
  /// The same mechanism with the nominal values, exactly.
  Mechanism nominal() const;
  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  const std::vector<Composite>& composites() const { return composites_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  /// Those with =: Φ.
  std::vector<Constraint> equations() const;
  const std::vector<Constraint>& implied() const { return implied_; }
  const std::vector<std::string>& inputs() const { return inputs_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  void clear_limits() { limits_.clear(); }
  void keep_requirements(std::vector<RequirementLine> lines) { requirements_ = std::move(lines); }
  /// As declared; which of them are limits of a configuration, limits.h says.
  const std::vector<Limit>& limits() const { return limits_; }
  /// Both empty where L is the derivative of the constraints.
  const std::vector<Rate>& rates() const { return rates_; }
  const std::vector<Constraint>& velocity_equations() const { return velocity_equations_; }
  bool has_own_velocity_equation() const { return !rates_.empty(); }
  const Drawing& drawing() const { return drawing_; }
  const std::vector<RequirementLine>& requirements() const { return requirements_; }
  std::vector<std::string> requirement_texts() const;
  /// Where the inputs (outputs) were named first.
  const SourceLocation& inputs_where() const { return inputs_where_; }
  const SourceLocation& outputs_where() const { return outputs_where_; }
  /// The same with the derivative of its constraints as velocity equation, and nothing to draw.
  Mechanism without_rates() const;
  /// without_rates(), and without these coordinates and every constraint, limit, unit vector and rotation that has one.
  Mechanism without(const std::vector<std::string>& coordinates) const;
  /// No inputs and no outputs, neither coordinates nor rates.
  bool is_plain_system() const;
  /// Index of a coordinate, −1 where there is none.
  int find_coordinate(const std::string& name) const { return find(name, Declared::coordinate); }
  bool has_constant(const std::string& name) const { return find(name, Declared::constant) >= 0; }
  /// Null where no unit vector or rotation matrix has that name.
  const Composite* find_composite(const std::string& name) const;
  /// Index of a rate, −1 where there is none.
  int find_rate(const std::string& name) const { return find(name, Declared::rate); }
  /// Is it the name of anything?
  bool has(const std::string& name) const { return names_.contains(name); }

  /// Throws ModelError, with the place, for: a name in a constant, range, constraint that is not declared (before, for
  /// constants); a coordinate in a constant, range or radius; an absurd power (9^9^9^9); no coordinates; no constraints; a
  /// faulty drawing (Drawing::validate), or one with an angle outside sin, cos and tan or a radius below 0; rates without
  /// velocity equations or the other way round, a velocity equation that is not linear and homogeneous in the rates, and
  /// another mobility by rates than by coordinates.
  void validate() const;

 private:
  enum class Declared { constant, coordinate, composite, rate };
  /// Registers the name of the next constant, coordinate, composite or rate, where it is free and no reserved word.
  void declare(const std::string& name, Declared kind, const SourceLocation& where);
  int find(const std::string& name, Declared kind) const;
  void validate_rates(const ModelValidator& validator) const;
  /// Declares a composite and its coordinates name_suffix.
  std::vector<Expression> compose(Composite::Kind kind, const std::string& name, const std::vector<std::string>& suffixes,
                                  const SourceLocation& where);
  /// Those chosen before, then these, none of which may be among the others.
  std::vector<std::string> chosen(Role role, const std::vector<Expression>& symbols, const SourceLocation& where,
                                  std::vector<std::string> before, const std::vector<std::string>& others) const;

  std::string name_, source_text_;
  std::vector<Constant> constants_;
  std::vector<Coordinate> coordinates_;
  std::vector<Composite> composites_;
  std::vector<Constraint> constraints_, implied_, velocity_equations_;
  std::vector<Limit> limits_;
  std::vector<RequirementLine> requirements_;
  std::vector<Rate> rates_;
  std::vector<std::string> inputs_, outputs_;
  SourceLocation inputs_where_, outputs_where_;
  Drawing drawing_;
  /// A name in use: the constant, the coordinate, the composite or the rate of that index.
  struct Declaration {
    Declared kind;
    std::size_t index;
    SourceLocation where;
  };
  std::unordered_map<std::string, Declaration> names_;
};

}  // namespace corank::symbolic
