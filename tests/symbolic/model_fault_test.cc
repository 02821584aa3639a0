// Malformed models: each gets one line that says where, what is wrong and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct FaultCase {
  const char* name;
  std::string text;
  const char* place;        ///< line:column
  const char* problem;      ///< the beginning of the message behind the place
  const char* expectation;  ///< how the message goes on behind "expected"
};

std::ostream& operator<<(std::ostream& out, const FaultCase& fault) { return out << fault.name; }

std::string repeated(const std::string& part, int n) {
  std::string result;
  for (int i = 0; i < n; ++i) result += part;
  return result;
}

/// Constants in line 2.
std::string constants(const std::string& line) {
  return "[CONSTANTS]\n" + line + "\n[SYSTEM VARS]\nx:[0,1]\n[SYSTEM EQS]\nx=1;\n";
}
/// Variables in line 4, a constant c and a variable x.
std::string variables(const std::string& line) {
  return "[CONSTANTS]\nc := 1\n[SYSTEM VARS]\n" + line + "\nx:[0,1]\n[SYSTEM EQS]\nx=1;\n";
}
/// Equations in line 6, a constant c and variables x, y.
std::string equations(const std::string& line) {
  return "[CONSTANTS]\nc := 1\n[SYSTEM VARS]\nx:[0,1] y:[0,1]\n[SYSTEM EQS]\n" + line + "\n";
}
/// Lists from line 7 on, a constant c and variables x, y.
std::string lists(const std::string& line) { return equations("x=y;") + line; }

/// Rates in line 6, velocity equations in line 9, a drawing in line 11; constant c in line 1, lengths x, y and one equation.
std::string velocities(const std::string& rates, const std::string& rows, const std::string& drawing = "") {
  return "[CONSTANTS] c := 1\n[SYSTEM VARS]\nx:[0,1] y:[0,1]\n[SYSTEM EQS] x=y;\n[RATES]\n" + rates +
         "\nvx : input\n[VELOCITY EQS]\n" + rows + "\n[DRAWING]\n" + drawing + "\n";
}

std::vector<FaultCase> faults() {
  const char* const operand = "a number, a name, a function or '('";
  return {
      // the file as a whole
      {"EmptyFile", "", "1:1", "the model is empty", "sections such as"},
      {"OnlyComments", "% nothing\n/* at all */", "2:13", "the model is empty", "sections such as"},
      {"TextBeforeTheFirstSection", "\nx : [0, 1]", "2:1", "found 'x' before the first section",
       "a section such as [CONSTANTS]"},
      {"OpenComment", "[CONSTANTS]\na := 1 /* one\n", "2:8", "the comment that begins here with /* has no end", "*/"},
      {"NotUtf8", "[CONSTANTS]\n% caf\xE9\n", "2:6", "found the byte 0xE9, which is not UTF-8", "plain text in UTF-8"},
      {"OverlongUtf8", "%\xC0\xAF", "1:2", "found the byte 0xC0", "plain text in UTF-8"},
      {"NulByte", std::string("[CONSTANTS]\na\0:= 1", 19), "2:2", "found a NUL byte", "plain text"},
      {"NoVariables", "[CONSTANTS]\na := 1\n[SYSTEM EQS]\na = 1;", "4:7", "the model has no variables",
       "at least one, in [SYSTEM VARS]"},
      {"NoEquations", "[SYSTEM VARS]\nx:[0,1]\n", "3:1", "the model has no equations", "at least one, in [SYSTEM EQS]"},
      // sections
      {"UnsupportedSection", equations("x=y;\n[VELOCITY VARS]\ns=1"), "7:1", "section [VELOCITY VARS] is not supported",
       "[CONSTANTS], [SYSTEM VARS]"},
      {"SearchByMinimization", equations("x=y;\n[SEARCH]\nMIN x"), "8:1", "the search order MIN is not supported",
       "DEPTH FIRST"},
      {"UnknownSearchOrder", equations("x=y;\n[SEARCH]\nDEPTH LAST"), "8:7", "found 'LAST' in [SEARCH]", "DEPTH FIRST"},
      {"TextBehindTheSearchOrder", equations("x=y;\n[SEARCH]\nDEPTH FIRST x"), "8:13", "found 'x'", "a section"},
      {"UnknownSection", " [VARIABLES]", "1:2", "section [VARIABLES] is unknown", "[CONSTANTS], [SYSTEM VARS]"},
      {"LowerCaseSection", "[constants]", "1:1", "section [constants] is unknown", "[CONSTANTS], [SYSTEM VARS]"},
      {"SectionWithoutBracket", "[CONSTANTS\na := 1", "1:11", "the section's name has no ']' after it", "']'"},
      // constants
      {"ConstantWithEquals", constants("a = 1"), "2:3", "found '='", "':=' after the constant's name"},
      {"ConstantWithoutValue", constants("a :="), "2:5", "found the end of the line", operand},
      {"ConstantGoesOnInTheNextLine", constants("a := 1 +\nb := 2"), "2:9", "found the end of the line", operand},
      {"NameBeginsWithADigit", constants("2a := 1"), "2:1", "found '2'", "a definition, name := expression, or a section"},
      {"NameIsNotAscii", constants("θ := 1"), "2:1", "found 'θ'", "a definition"},
      {"ConstantWithAUnit", constants("a := 100 cm"), "2:12", "found the end of the line",
       "':=' after the constant's name; a number has no unit behind it"},
      {"NameWithADot", constants("a.b := 1"), "2:2", "found '.'", "':=' after the constant's name"},
      {"ConstantTwice", constants("a := 1\na := 2"), "3:1", "the name 'a' is already declared in line 2",
       "another name for the constant"},
      {"ReservedName", constants("pi := 3"), "2:1", "the name 'pi' is reserved", "another name for the constant"},
      {"FunctionName", constants("sin := 3"), "2:1", "the name 'sin' is reserved", "another name for the constant"},
      {"UsedBeforeItsDeclaration", constants("a := 2*b\nb := 1"), "2:8",
       "the constant 'b' in the constant 'a' is used before its declaration in line 3", "constants declared before"},
      {"UsedInItself", constants("a := a + 1"), "2:6", "the constant 'a' in the constant 'a' is used before",
       "constants declared before"},
      {"UnknownNameInAConstant", constants("a := 2*b"), "2:8", "the name 'b' in the constant 'a' is not declared",
       "a declared constant"},
      {"VariableInAConstant", constants("a := 2*x"), "2:8", "the variable 'x' in the constant 'a' is not allowed here",
       "numbers and constants"},
      {"HugeNumber", constants("a := 1e999999999"), "2:6", "the number '1e999999999' is out of range",
       "an exponent of ten between -400 and 400"},
      {"HugeExponentOfAnInteger", constants("a := 1e99999999999999999999"), "2:6",
       "the number '1e99999999999999999999' is out of range", "an"},
      {"TooManyDigits", constants("a := " + repeated("1", 10'001)), "2:6",
       "the number '1111111111111111111111111111111111111111…' has 10001 digits", "at most 10000"},
      {"TwoDots", constants("a := 1.2.3"), "2:9", "found '.3' right after a number", "an operator"},
      {"TowerOfPowers", constants("a := 9^9^9^9"), "2:10", "the exponent '9^9' in the constant 'a' is too large",
       "at most 1000 in absolute value"},
      // drawings
      {"UnknownDrawingWord", lists("[DRAWING]\nbar P Q"), "8:1", "found 'bar'", "point, link, platform"},
      {"PointWithoutName", lists("[DRAWING]\npoint = (0, 0)"), "8:7", "found '='", "the name of a point"},
      {"PointWithoutEquals", lists("[DRAWING]\npoint P (0, 0)"), "8:9", "found '('", "'=' after the point's name"},
      {"PointOfOneCoordinate", lists("[DRAWING]\npoint P = (x)"), "8:13", "found ')'", "',' between the coordinates"},
      {"PointOfFourCoordinates", lists("[DRAWING]\npoint P = (x, y, 0, 1)"), "8:19", "found ','", "an operator, or ')'"},
      {"PointThatGoesOn", lists("[DRAWING]\npoint P = (x, y) link P P"), "8:18", "found 'link'", "the end of the line"},
      {"PointWithUnknownName", lists("[DRAWING]\npoint P = (x, 2*z)"), "8:17",
       "the name 'z' in the point 'P' is not declared", "a declared constant or variable"},
      {"PointTwice", lists("[DRAWING]\npoint P = (x, y)\npoint P = (0, 0)"), "9:7", "the point 'P' is already declared",
       "another name"},
      {"PointsOfTwoKinds", lists("[DRAWING]\npoint P = (x, y)\npoint Q = (0, 0, 1)"), "9:7",
       "the point 'Q' has 3 coordinates", "2, as the first point"},
      {"PointWithABareAngle", lists("[SYSTEM VARS] t ~ [0, 1]\n[DRAWING]\npoint P = (cos(t), 2*t)"), "9:22",
       "the angle 't' in the point 'P' is outside sin, cos and tan", "cos(t)"},
      {"LinkToNowhere", lists("[DRAWING]\npoint P = (x, y)\nlink P Q"), "9:1", "the link names 'Q', which is not a point",
       "the name of a point, declared as point Q"},
      {"LinkOfOnePoint", lists("[DRAWING]\npoint P = (x, y)\nlink P"), "9:1", "the link has 1 point", "2 points or more"},
      {"LinkBackToItself", lists("[DRAWING]\npoint P = (x, y)\nlink P P"), "9:1", "the link names the point 'P' twice",
       "each point once"},
      {"PlatformOfTwoPoints", lists("[DRAWING]\npoint P=(x,y)\npoint Q=(0,0)\nplatform P Q"), "10:1",
       "the platform has 2 points", "3 points or more"},
      {"SliderWithoutARail", lists("[DRAWING]\npoint P = (x, y)\nslider P"), "9:9", "found the end of the",
       "slider P along A B"},
      {"UnitWithoutName", lists("[DRAWING]\nunit 2"), "8:6", "found '2'", "the name of a unit"},
      {"HingeInThePlane", lists("[DRAWING]\npoint P=(x,y)\npoint Q=(0,0)\nhinge P Q"), "10:1",
       "the hinge is in a drawing whose points have 2 coordinates", "joint P"},
      {"HingeWithoutAnAxis", lists("[DRAWING]\npoint P = (x, y, 0)\nhinge P"), "9:8", "found the end of the",
       "the name of a point"},
      {"HingeOfThreePoints", lists("[DRAWING]\npoint P = (x, y, 0)\nhinge P P Q"), "9:11", "found 'Q'",
       "the end of the line"},
      {"HingeOnOnePoint", lists("[DRAWING]\npoint P = (x, y, 0)\nhinge P P"), "9:1", "the hinge names the point 'P' twice",
       "each point once"},
      {"SphereWithoutRadius", lists("[DRAWING]\npoint P = (x, y)\nsphere P"), "9:9", "found the end of the",
       "radius and an expression"},
      {"CylinderOfOnePoint", lists("[DRAWING]\npoint P = (x, y)\ncylinder P radius 1"), "9:19", "found '1'",
       "radius and an expression"},
      {"RadiusWithoutValue", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius"), "9:16", "found the end of the", operand},
      {"RadiusWithACoordinate", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius 2*x"), "9:19",
       "the variable 'x' in the radius of the sphere is not allowed here", "numbers and constants"},
      {"RadiusBelowZero", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius 1 - 2"), "9:17",
       "the radius of the sphere is '1 - 2'", "a length of 0 or more"},
      {"ColourOfFiveDigits", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius 1 #12345"), "9:20", "found '12345'",
       "six hexadecimal digits after '#', #rrggbb"},
      {"ColourOfEightDigits", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius 1 #12345678"), "9:20", "found '12345678'",
       "six hexadecimal digits"},
      {"ColourByName", lists("[DRAWING]\npoint P = (x, y)\nsphere P radius 1 red"), "9:19", "found 'red'",
       "the end of the line"},
      {"ColourOfAJoint", lists("[DRAWING]\npoint P = (x, y)\njoint P #123456"), "9:1", "a joint has no colour of its own",
       "a colour after a link, platform, sphere or cylinder only"},
      // variables
      {"RangeInTheNextLine", variables("y :\n[0, 1]"), "5:1", "section [0, 1] is unknown",
       "a section; write the range of a variable in the variable's line"},
      {"VariableWithHalfARange", variables("y : 0, 1]"), "4:5", "found '0' where the range of 'y' should be",
       "[lower, upper], or nothing if the equations bound the variable"},
      {"VariableWithValue", variables("y := 1"), "4:3", "found ':='",
       "':' (a length), '~' (an angle) or '@' (a vector or matrix)"},
      {"CompositeOfNoKind", variables("w @ unitary"), "4:5", "found 'unitary'",
       "unit (a unit vector) or rotation (a rotation matrix) after '@'"},
      {"CompositeWithoutKind", variables("w @"), "4:4", "found the end of the line", "unit (a unit vector) or rotation"},
      {"CompositeWithRange", variables("w @ unit [0, 1]"), "4:10", "section [0, 1] is unknown",
       "a section; write the range"},
      {"ComponentDeclaredTwice", variables("w @ unit\nw_y : [0, 1]"), "5:1", "the name 'w_y' is already declared in line 4",
       "another name for the variable"},
      {"CompositeWithATakenComponent", variables("R_xy : [0, 1]\nR @ rotation"), "5:1",
       "the name 'R_xy' is already declared in line 4", "another name for the variable"},
      {"CompositeDeclaredTwice", variables("c @ unit"), "4:1", "the name 'c' is already declared in line 2",
       "another name for the variable"},
      {"VectorInAnEquation", variables("w @ unit") + "2*w = x;", "8:3", "the unit vector 'w' in an equation is not a number",
       "one of its components w_x … w_z"},
      {"MatrixInAnEquation", variables("R @ rotation") + "x = R;", "8:5",
       "the rotation matrix 'R' in an equation is not a number", "one of its components R_xx … R_zz"},
      {"MatrixInARange", variables("R @ rotation\ny : [0, R_xx]"), "5:9",
       "the variable 'R_xx' in the range of 'y' is not allowed", "numbers and constants"},
      {"RangeWithoutComma", variables("y : [0 1]"), "4:8", "found '1'", "',' between the ends of the range"},
      {"RangeWithOneEnd", variables("y : [1]"), "4:7", "found ']'", "',' between the ends of the range"},
      {"RangeWithoutBracket", variables("y : [0, 1"), "5:1", "found 'x'", "']' after the range"},
      {"RangeInParentheses", variables("y : (0, 1)"), "4:5", "found '(' where the range of 'y' should be", "[lower, upper]"},
      {"EmptyRange", variables("y : []"), "4:6", "found ']'", operand},
      {"VariableInARange", variables("y : [0, x]"), "4:9", "the variable 'x' in the range of 'y' is not allowed here",
       "numbers and constants"},
      {"UnknownNameInARange", variables("y : [-d, d]"), "4:7", "the name 'd' in the range of 'y' is not declared",
       "a declared constant"},
      {"VariableTwice", variables("x : [0, 1]"), "5:1", "the name 'x' is already declared in line 4",
       "another name for the variable"},
      {"VariableNamedAsAConstant", variables("c ~ [0, 1]"), "4:1", "the name 'c' is already declared in line 2",
       "another name for the variable"},
      // equations
      {"MissingSemicolon", equations("x = 1\ny = 1;"), "6:6", "the equation has no ';' at its end", "an operator or ';'"},
      {"MissingSemicolonBeforeASection", equations("x = (y)\n\n[INPUTS] x"), "6:8", "the equation has no ';' at its end",
       "an operator or ';'"},
      {"MissingSemicolonAtTheEnd", equations("x = 1 % so"), "6:6", "the equation has no ';' at its end",
       "an operator or ';'"},
      {"EmptyEquation", equations("x = y; ;"), "6:8", "the equation is empty", "left side = right side;"},
      {"NoRelation", equations("x + y;"), "6:6", "the equation that begins in line 6 has no relation", "'=', '<=' or '>='"},
      {"StrictRelation", equations("x < y;"), "6:3", "found '<'", "an operator, '=', '<=' or '>='"},
      {"NoRightSide", equations("x = ;"), "6:5", "found ';'", operand},
      {"NoLeftSide", equations("= x;"), "6:1", "found '='", operand},
      {"TwoRelations", equations("x = y = 1;"), "6:7", "found a second relation, '=', in the equation that begins in line 6",
       "';' at the end of each"},
      {"DoubleEquals", equations("x == y;"), "6:4", "found '='", operand},
      {"ParenthesisNotClosed", equations("2*(x + y = 1;"), "6:10", "found '=' inside the parentheses opened in 6:3",
       "an operator or ')'"},
      {"ParenthesisNotOpened", equations("x + y) = 1;"), "6:6", "found ')' without a '('", "an operator, '='"},
      {"ParenthesisNotOpenedOnTheRight", equations("x = y);"), "6:6", "found ')' without a '('", "an operator, or ';'"},
      {"EmptyParentheses", equations("x = ();"), "6:6", "found ')'", operand},
      {"UnknownFunction", equations("sinh(x) = y;"), "6:1", "unknown function 'sinh'",
       "an operator after the name, or one of sin, cos"},
      {"FunctionOfTwoArguments", equations("atan(x, y) = 1;"), "6:7", "found ',' inside the parentheses",
       "an operator or ')'"},
      {"FunctionWithoutArgument", equations("cos x = y;"), "6:1", "the function 'cos' has no argument", "cos(…)"},
      {"ProductWithoutOperator", equations("x = 2y;"), "6:6", "found 'y' right after a number",
       "an operator (a product is written 2*x)"},
      {"NamesWithoutOperator", equations("x y = 1;"), "6:3", "found 'y'", "an operator, '=', '<=' or '>='"},
      {"DoubleOperator", equations("x + * y = 1;"), "6:5", "found '*'", operand},
      {"DoublePlus", equations("x ++ y = 1;"), "6:4", "found '+'", operand},
      {"PowerWithTwoStars", equations("x**2 = 1;"), "6:3", "found '*'", operand},
      {"StrayCharacter", equations("x $ y = 1;"), "6:3", "found '$'", "an operator, '='"},
      {"StrayControlCharacter", equations("x \x01 y = 1;"), "6:3", "found the control character 0x01", "an operator, '='"},
      {"StrayUnicode", equations("x · y = 1;"), "6:3", "found '·'", "an operator, '='"},
      {"UnknownNameInAnEquation", equations("x +\n  z = 1;"), "7:3", "the name 'z' in an equation is not declared",
       "a declared constant or variable"},
      {"HugeExponent", equations("x^(1000*c + 2) = 1;"), "6:4", "the exponent '1000*c + 2' in an equation is too large",
       "at most 1000"},
      {"NestedTooDeeply", equations(repeated("(", 201) + "x" + repeated(")", 201) + " = y;"), "6:201",
       "the parentheses are nested too deeply", "at most 200"},
      {"TooManySigns", equations(repeated("-", 2000) + "x = y;"), "6:2001", "the expression is nested too deeply",
       "at most 1000 operations"},
      // rates and velocity equations
      {"RateWithoutMark", velocities("w", "vx=w;"), "6:2", "found the end of the line",
       "'~' (an angular rate) or ':' (a linear rate) after the rate's name"},
      {"RateWithoutRole", velocities("w ~", "vx=w;"), "6:4", "found the end of the line", "input, output or passive"},
      {"RateOfAnotherRole", velocities("w ~ driven", "vx=w;"), "6:5", "found 'driven'", "input, output or passive"},
      {"RateWithARange", velocities("w ~ [0, 1]", "vx=w;"), "6:5", "found '['", "input, output or passive"},
      {"RateThatIsAnExpression", velocities("2*w ~ input", "vx=w;"), "6:1", "found '2'",
       "a declaration, name ~ role or name : role, or a section"},
      {"RateNamedAsAVariable", velocities("x ~ output", "vx=x;"), "6:1", "the name 'x' is already declared in line 3",
       "another name for the rate"},
      {"RateNamedAsAConstant", velocities("c ~ output", "vx=c;"), "6:1", "the name 'c' is already declared in line 1",
       "another name for the rate"},
      {"RateTwice", velocities("vx : input", "vx=0;"), "7:1", "the name 'vx' is already declared in line 6",
       "another name for the rate"},
      {"RateOfAReservedName", velocities("cos ~ output", "vx=0;"), "6:1", "the name 'cos' is reserved",
       "another name for the rate"},
      {"RateInAnEquation", velocities("w ~ output", "vx=w;") + "[SYSTEM EQS] x = w*y;", "12:18",
       "the rate 'w' in an equation is not allowed here", "numbers, constants and variables"},
      {"RateInARange", velocities("w ~ output", "vx=w;") + "[SYSTEM VARS] z : [0, w]", "12:23",
       "the rate 'w' in the range of 'z' is not allowed here", "numbers and constants"},
      {"RateInAPoint", velocities("w ~ output", "vx=w;", "point P = (x, 2*w)"), "11:17",
       "the rate 'w' in the point 'P' is not allowed here", "numbers, constants and variables"},
      {"RateAsAnInput", velocities("w ~ output", "vx=w;") + "[INPUTS] w", "12:10",
       "the input 'w' is a rate, whose role is given in [RATES]", "a variable of the model"},
      {"VelocityInequality", velocities("w ~ output", "vx <= w;"), "9:1", "an inequality cannot be a velocity equation",
       "lhs = rhs"},
      {"VelocityEquationWithoutARate", velocities("w ~ output", "x = y;"), "9:1",
       "the velocity equation `x = y` holds no rate", "an equation that is linear in the rates"},
      {"VelocityEquationWithAnUnknownName", velocities("w ~ output", "vx = z;"), "9:6",
       "the name 'z' in a velocity equation is not declared", "a declared constant, variable or rate"},
      {"VelocityTermWithoutARate", velocities("w ~ output", "vx = w + x^2;"), "9:10",
       "the term 'x^2' in a velocity equation holds no rate", "a rate times an expression in coordinates and constants"},
      {"VelocityTermWithTwoRates", velocities("w ~ output", "vx = x*w*vx;"), "9:6",
       "the term 'x*w*vx' in a velocity equation is not linear and homogeneous in the rates", "a rate times"},
      {"VelocityTermWithASquare", velocities("w ~ output", "vx - w^2 = 0;"), "9:6",
       "the term 'w^2' in a velocity equation is not linear", "a rate times"},
      {"VelocityTermWithASine", velocities("w ~ output", "vx = sin(w);"), "9:6",
       "the term 'sin(w)' in a velocity equation is not linear", "a rate times"},
      {"VelocityTermOverARate", velocities("w ~ output", "vx = x/w;"), "9:6",
       "the term 'x/w' in a velocity equation is not linear", "a rate times"},
      {"VelocityTermThatIsMixed", velocities("w ~ output", "vx = x*(w + 1);"), "9:6",
       "the term 'x*(w + 1)' in a velocity equation is not linear and homogeneous", "a rate times"},
      {"RatesWithoutVelocityEquations", velocities("w ~ output", ""), "6:1", "the model has rates but no velocity equations",
       "at least one, in [VELOCITY EQS]"},
      {"VelocityEquationsWithoutRates", lists("[VELOCITY EQS]\nx = 0;"), "8:1",
       "the model has velocity equations but no rates", "[RATES], which declares them"},
      {"MobilityByRatesIsAnother", velocities("w ~ output\nu ~ passive", "vx = w;"), "10:1",
       "3 rates and 1 velocity equation give mobility 2, but 2 coordinates and 1 equation give mobility 1",
       "the same mobility from both"},
      {"PointMovesNowhere", velocities("w ~ output", "vx=w;", "point P = (x, y) moves"), "11:23",
       "found the end of the line", "the velocity of the point, (u, v) or (u, v, w)"},
      {"PointMovesByOneComponent", velocities("w ~ output", "vx=w;", "point P = (x, y) moves (vx)"), "11:27", "found ')'",
       "',' between the components"},
      {"PointMovesByFour", velocities("w ~ output", "vx=w;", "point P = (x, y) moves (vx, 0, 0, 0)"), "11:33", "found ','",
       "an operator, or ')' after two or three components of the velocity"},
      {"PlanarPointMovesInSpace", velocities("w ~ output", "vx=w;", "point P = (x, y) moves (vx, 0, 0)"), "11:7",
       "the velocity of the point 'P' has 3 components", "2, as the point itself"},
      {"PointMovesByNoRate", velocities("w ~ output", "vx=w;", "point P = (x, y) moves (vx, x)"), "11:29",
       "the term 'x' in the velocity of the point 'P' holds no rate", "a rate times"},
      {"PointMovesWithoutRates", lists("[DRAWING]\npoint P = (x, y) moves (x, y)"), "8:7",
       "the velocity of the point 'P' is given, but the model has no rates", "[RATES]"},
      // inputs and outputs
      {"InputIsNotDeclared", lists("[INPUTS] z"), "7:10", "the input 'z' is not declared", "a variable of the model"},
      {"InputIsAConstant", lists("[INPUTS]\nx\nc"), "9:1", "the input 'c' is a constant", "a variable of the model"},
      {"InputIsAFunction", lists("[INPUTS] sin"), "7:10", "'sin' is not a variable", "the name of a variable"},
      {"InputNamedTwice", lists("[INPUTS] x, y\n x"), "8:2", "the input 'x' is named twice", "each input once"},
      {"OutputIsAnInput", lists("[INPUTS] x\n[OUTPUTS] x"), "8:11", "the output 'x' is already an input",
       "a variable that is not an input"},
      {"NoInputs", lists("[INPUTS]\n[OUTPUTS] x"), "8:1", "found '['", "the name of a variable"},
      {"TwoCommas", lists("[INPUTS] x,, y"), "7:12", "found ','", "the name of a variable"},
      {"CommaAtTheEnd", lists("[INPUTS] x,\n[OUTPUTS] y"), "8:1", "found '['", "the name of a variable"},
      {"InputIsAnExpression", lists("[INPUTS] x+y"), "7:11", "found '+'", "the name of a variable, or a section"},
  };
}

class ModelFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(ModelFault, GetsOneMessageWithItsPlace) {
  const FaultCase& fault = GetParam();
  try {
    parse_model(fault.text, "m.cuik");
    FAIL() << "accepted:\n" << fault.text;
  } catch (const ModelError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, StartsWith(std::string("m.cuik:") + fault.place + ": " + fault.problem));
    EXPECT_THAT(message, HasSubstr(std::string("; expected ") + fault.expectation));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ModelFault, ::testing::ValuesIn(faults()),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(ModelFaults, AreAtLeastThirtyDifferentOnes) { EXPECT_GE(faults().size(), 30u); }

}  // namespace
}  // namespace corank::symbolic
