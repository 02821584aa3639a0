// Exact geometry of a robot: numbers, vectors and rotations whose entries are expressions in its constants and in
// coordinates that are made along the way. GiNaC works behind it; whoever uses it holds a symbolic::GinacLock.
//
// Constants keep their names, so that equations can be read, but those worth 0 are put in. Whether an expression in
// constants is zero is decided by their values: rational ones exactly, others by enclosures of 512 bits; what these cannot
// tell from zero counts as zero.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/kinematics/robot/robot.h"
#include "corank/symbolic/algebra/ginac_bridge.h"

namespace corank::kinematics {

using GiNaC::ex;
using Vec = std::array<ex, 3>;
using Mat = std::array<Vec, 3>;  ///< row by row

Vec operator+(const Vec& a, const Vec& b);
Vec operator-(const Vec& a, const Vec& b);
Vec operator*(const ex& s, const Vec& a);
ex dot(const Vec& a, const Vec& b);
Vec cross(const Vec& a, const Vec& b);
Vec operator*(const Mat& m, const Vec& a);
Mat operator*(const Mat& a, const Mat& b);
Mat transpose(const Mat& m);
Mat identity();

class Algebra {
 public:
  explicit Algebra(const Robot& robot);

  /// An expression in constants.
  ex constant(const Expression& e, const SourceLocation& where) const;
  Vec vector(const Vector& v, const SourceLocation& where) const;
  /// An expression in constants and coordinates.
  ex expression(const Expression& e, const SourceLocation& where) const;
  /// A new coordinate's symbol.
  ex coordinate(const std::string& name);
  /// That of a coordinate that there is.
  ex symbol_of(const std::string& coordinate) const { return coordinates_.at(coordinate); }

  /// Of an expression in constants; 0 where it cannot be told from zero.
  int sign(const ex& constant) const;
  bool is_zero(const ex& constant) const { return sign(constant) == 0; }
  bool is_zero(const Vec& constants) const;
  bool are_parallel(const Vec& a, const Vec& b) const { return is_zero(cross(a, b)); }
  double value(const ex& constant) const;
  /// The number, where the constant is recognized as a rational one.
  std::optional<GiNaC::numeric> rational(const ex& constant) const;
  /// v/|v| of a constant vector that is not 0.
  Vec unit(const Vec& v) const;
  /// A unit vector perpendicular to a constant one, along a coordinate axis where that is possible.
  Vec perpendicular(const Vec& axis) const;
  /// The square root of a constant ≥ 0, a rational number where it is one.
  ex square_root(const ex& square) const;

  /// Expanded, like terms collected, terms that are worth 0 left out; cos² + sin² is 1 where that makes it shorter.
  ex clean(const ex& e) const;
  Vec clean(const Vec& v) const { return {clean(v[0]), clean(v[1]), clean(v[2])}; }
  /// A constant, under a name of its own where it is no short expression, so that what is made of it stays short.
  ex named(const ex& constant);
  Vec named(const Vec& v) { return {named(v[0]), named(v[1]), named(v[2])}; }
  /// The constants named so, which refer to the robot's and to those before them.
  std::vector<symbolic::Constant> named_constants() const;

  /// What was decided by the constants' values so far, so that equations are made for those: expressions in constants and
  /// their signs, those of constants that are put in among them. Terms that were kept need no condition: they are right
  /// where they are 0, too.
  std::vector<std::pair<ex, int>> decisions() const;

  /// No coordinate occurs.
  bool is_constant(const ex& e) const;
  bool is_constant(const Vec& v) const { return is_constant(v[0]) && is_constant(v[1]) && is_constant(v[2]); }

  const std::map<std::string, GiNaC::realsymbol>& constants() const { return constants_; }

  /// Into the model language.
  class Translation {
   public:
    explicit Translation(const Algebra& algebra);
    Expression operator()(const ex& e) const {
      return bridge_.to_expression(e.subs(theirs_, GiNaC::subs_options::no_pattern));
    }

   private:
    const symbolic::GinacBridge bridge_;
    GiNaC::exmap theirs_;  // the bridge's symbols, of the algebra's
  };

 private:
  ex collected(const ex& e) const;
  int sign_by_value(const ex& constant) const;
  void note(const ex& constant, int sign) const;
  void add_constant(const std::string& name, const ExactNumber& value);
  /// Enclosed tighter than doubles, constants put in.
  ExactNumber exact(const ex& constant) const;

  std::vector<std::string> constant_names_, coordinate_names_;
  std::map<std::string, GiNaC::realsymbol> constants_, coordinates_;
  GiNaC::exmap zeros_;                        // of constants that are put in
  std::map<std::string, ExactNumber> exact_;  // values of the constants, which share what they are made of
  std::map<std::string, double> plain_;       // the same in doubles
  mutable std::map<ex, int, GiNaC::ex_is_less> signs_;
  mutable std::map<ex, int, GiNaC::ex_is_less> decisions_;  // of which the equations are made
  std::map<ex, ex, GiNaC::ex_is_less> names_of_;            // of constants that were given a name
  std::vector<std::pair<std::string, ex>> named_;
  int numbered_ = 0;
};

}  // namespace corank::kinematics
