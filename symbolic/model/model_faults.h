// What a fault in a text is called: for every rule that must<> asks for, what is expected there, and how the thing found
// instead is described.
#pragma once

#include <string>
#include <string_view>

#include "corank/symbolic/model/model_builder.h"
#include "corank/symbolic/model/model_grammar.h"

namespace corank::symbolic {

/// The name that a text begins with; empty where it begins with something else.
std::string name_at(std::string_view text);
/// The word, number, sign or character that a text begins with, for "found …".
std::string describe_start(std::string_view text);

/// A rule failed at `where`, in front of `rest`. Throws the ModelError that says so.
struct Fault {
  const ModelBuilder& builder;
  SourceLocation where;
  std::string_view rest;

  [[noreturn]] void found_instead_of(const std::string& expectation) const;
  [[noreturn]] void say(const std::string& problem, const std::string& expectation) const;
  /// The same at the end of what was read last, where that was in a line above.
  [[noreturn]] void say_behind_last_operand(const std::string& problem, const std::string& expectation) const;

  [[noreturn]] void no_operand() const;
  [[noreturn]] void no_assign() const;
  [[noreturn]] void no_relation() const;
  [[noreturn]] void no_equation_end() const;
  [[noreturn]] void no_group_close() const;
  [[noreturn]] void no_number_end() const;
  [[noreturn]] void no_range() const;
  [[noreturn]] void unknown_section() const;
  [[noreturn]] void no_search_order() const;
  [[noreturn]] void no_plain_text() const;
};

template <typename Rule>
struct FaultOf;  // no definition: every rule in a must<> needs one

#define CORANK_FAULT(rule, action)                                 \
  template <>                                                      \
  struct FaultOf<grammar::rule> {                                  \
    [[noreturn]] static void raise(const Fault& fault) { action; } \
  };
template <typename Gap>
struct FaultOf<grammar::operand<Gap>> {
  [[noreturn]] static void raise(const Fault& fault) { fault.no_operand(); }
};
template <typename Gap>
struct FaultOf<grammar::terms<Gap>> : FaultOf<grammar::operand<Gap>> {};  // cannot fail without its operand failing first
CORANK_FAULT(gap, fault.found_instead_of("a blank"))                      // cannot fail
CORANK_FAULT(number_end, fault.no_number_end())
CORANK_FAULT(group_close, fault.no_group_close())
CORANK_FAULT(lone_expression_end, fault.found_instead_of("an operator or the end of the expression"))
CORANK_FAULT(block_comment_rest, fault.say("the comment that begins here with /* has no end", "*/"))
CORANK_FAULT(section_title, fault.found_instead_of("the name of a section"))  // cannot fail
CORANK_FAULT(section_close, fault.say("the section's name has no ']' after it", "']'"))
CORANK_FAULT(known_section, fault.unknown_section())
CORANK_FAULT(constant_name, fault.found_instead_of("a definition, name := expression, or a section"))
CORANK_FAULT(assign, fault.no_assign())
CORANK_FAULT(variable_name,
             fault.found_instead_of("a declaration, name : [lower, upper] or name ~ [lower, upper], or a section"))
CORANK_FAULT(declarator,
             fault.found_instead_of("':' (a length), '~' (an angle) or '@' (a vector or matrix) after the variable's name"))
CORANK_FAULT(composite_word, fault.found_instead_of("unit (a unit vector) or rotation (a rotation matrix) after '@'"))
CORANK_FAULT(range_open, fault.no_range())
CORANK_FAULT(range_comma, fault.found_instead_of("',' between the ends of the range"))
CORANK_FAULT(range_close, fault.found_instead_of("']' after the range"))
CORANK_FAULT(limit_name, fault.found_instead_of("a limit, name : [lower, upper], or a section"))
CORANK_FAULT(limit_mark, fault.found_instead_of("':' after the variable's name, name : [lower, upper]"))
CORANK_FAULT(rate_name, fault.found_instead_of("a declaration, name ~ role or name : role, or a section"))
CORANK_FAULT(rate_mark, fault.found_instead_of("'~' (an angular rate) or ':' (a linear rate) after the rate's name"))
CORANK_FAULT(role_word, fault.found_instead_of("input, output or passive after the mark of the rate"))
CORANK_FAULT(inequality_name, fault.found_instead_of("the name of an inequality"))
CORANK_FAULT(inequality_name_end, fault.found_instead_of("'\"' after the name of the inequality"))
CORANK_FAULT(inequality_colon, fault.found_instead_of("':' after the name of the inequality"))
CORANK_FAULT(relation, fault.no_relation())
CORANK_FAULT(equation_end, fault.no_equation_end())
CORANK_FAULT(listed_name, fault.found_instead_of("the name of a variable"))
CORANK_FAULT(list_end, fault.found_instead_of("the name of a variable, or a section"))
CORANK_FAULT(requirement_line, fault.found_instead_of("a requirement, or a section"))
CORANK_FAULT(requirement_line_end, fault.found_instead_of("';' after the requirement"))
CORANK_FAULT(point_name, fault.found_instead_of("the name of a point"))
CORANK_FAULT(point_equals, fault.found_instead_of("'=' after the point's name"))
CORANK_FAULT(point_open, fault.found_instead_of("(x, y) or (x, y, z)"))
CORANK_FAULT(point_comma, fault.found_instead_of("',' between the coordinates of the point"))
CORANK_FAULT(point_close, fault.found_instead_of("an operator, or ')' after two or three coordinates of the point"))
CORANK_FAULT(moves_open, fault.found_instead_of("the velocity of the point, (u, v) or (u, v, w)"))
CORANK_FAULT(moves_comma, fault.found_instead_of("',' between the components of the velocity"))
CORANK_FAULT(moves_close, fault.found_instead_of("an operator, or ')' after two or three components of the velocity"))
CORANK_FAULT(unit_name, fault.found_instead_of("the name of a unit of length, such as mm"))
CORANK_FAULT(along_word, fault.found_instead_of("slider P along A B"))
CORANK_FAULT(part_point, fault.found_instead_of("the name of a point"))
CORANK_FAULT(radius_word, fault.found_instead_of("radius and an expression in constants after the solid's points"))
CORANK_FAULT(colour_digits, fault.found_instead_of("six hexadecimal digits after '#', #rrggbb"))
CORANK_FAULT(drawing_statement,
             fault.found_instead_of("point, link, platform, joint, hinge, ball, slider, ground, effector, "
                                    "sphere, cylinder or unit, or a section"))
CORANK_FAULT(drawing_line_end, fault.found_instead_of("the end of the line"))
CORANK_FAULT(search_order, fault.no_search_order())
CORANK_FAULT(search_end, fault.found_instead_of("a section after the search order"))
CORANK_FAULT(section_start, fault.say("found " + describe_start(fault.rest) + " before the first section",
                                      "a section such as [CONSTANTS] or [SYSTEM VARS]"))
CORANK_FAULT(file_end, fault.found_instead_of("a section"))  // cannot fail: sections go on to the end
CORANK_FAULT(text_end, fault.no_plain_text())
#undef CORANK_FAULT

}  // namespace corank::symbolic
