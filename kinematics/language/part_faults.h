// What a fault in a text of the parts language is called, for every rule that must<> asks for (see
// symbolic/model/model_faults.h).
#pragma once

#include <string>

#include "corank/kinematics/language/part_builder.h"
#include "corank/kinematics/language/part_grammar.h"
#include "corank/symbolic/model/model_faults.h"

namespace corank::kinematics {

struct PartFault : symbolic::Fault {
  const PartBuilder& parts;

  [[noreturn]] void no_joint() const;
  [[noreturn]] void no_joint_link() const;
  [[noreturn]] void no_joint_colon() const;
  [[noreturn]] void no_point() const;
  [[noreturn]] void no_second_point() const;
  [[noreturn]] void no_colour() const;
  [[noreturn]] void no_output_kind() const;
  [[noreturn]] void no_dh_cell() const;
  [[noreturn]] void unknown_part_section() const;
};

template <typename Rule>
struct PartFaultOf {
  [[noreturn]] static void raise(const PartFault& fault) { symbolic::FaultOf<Rule>::raise(fault); }
};

#define CORANK_FAULT(rule, action)                                     \
  template <>                                                          \
  struct PartFaultOf<rule> {                                           \
    [[noreturn]] static void raise(const PartFault& fault) { action; } \
  };
CORANK_FAULT(symbolic::grammar::call_open, fault.found_instead_of("'(' after the function " + fault.builder.name))
CORANK_FAULT(grammar::tuple_comma, fault.found_instead_of("an operator, or ',' between the three numbers of (x, y, z)"))
CORANK_FAULT(grammar::tuple_close, fault.found_instead_of("an operator, or ')' after the three numbers of (x, y, z)"))
CORANK_FAULT(grammar::offset_vector, fault.found_instead_of("a direction (x, y, z) after '+'"))
CORANK_FAULT(grammar::tuple, fault.found_instead_of("(x, y, z)"))
CORANK_FAULT(grammar::point, fault.no_point())
CORANK_FAULT(grammar::second_point, fault.no_second_point())
CORANK_FAULT(grammar::colour_times, fault.found_instead_of("'*' and a colour after the factor"))
CORANK_FAULT(grammar::colour_atom, fault.no_colour())
CORANK_FAULT(grammar::transform, fault.found_instead_of("a transformation: Tx Ty Tz Txyz Rx Ry Rz TR, each with (…), or id"))
CORANK_FAULT(grammar::transform_open, fault.found_instead_of("'(' after the transformation"))
CORANK_FAULT(grammar::transform_close, fault.found_instead_of("an operator, ',' or ')' in the transformation"))
CORANK_FAULT(grammar::matrix_word, fault.found_instead_of("matrix after inertia"))
CORANK_FAULT(grammar::frame_word, fault.found_instead_of("frame after inertial"))
CORANK_FAULT(grammar::quoted_text, fault.found_instead_of("the name of a file in quotes"))
CORANK_FAULT(grammar::quote, fault.found_instead_of("'\"' after the name of the file, in its line"))
CORANK_FAULT(grammar::integer, fault.found_instead_of("a whole number"))
CORANK_FAULT(grammar::body_file, fault.found_instead_of("the name of the body's file, in quotes"))
CORANK_FAULT(grammar::segments_open, fault.found_instead_of("(x, y, z; x, y, z; …)"))
CORANK_FAULT(grammar::segments_comma, fault.found_instead_of("an operator, or ',' between the numbers of a point"))
CORANK_FAULT(grammar::segments_close, fault.found_instead_of("an operator, ';' and the next point, or ')'"))
CORANK_FAULT(grammar::known_section, fault.unknown_part_section())
CORANK_FAULT(grammar::link_name, fault.found_instead_of("a link, name : shapes and points, or a section"))
CORANK_FAULT(grammar::joint_link, fault.no_joint_link())
CORANK_FAULT(grammar::joint_colon, fault.no_joint_colon())
CORANK_FAULT(grammar::limits_word, fault.found_instead_of("limits after avoid"))
CORANK_FAULT(grammar::bracket_close, fault.found_instead_of("an operator, ',' or ']' in the range"))
CORANK_FAULT(grammar::range_bracket,
             fault.say("the range of " + fault.parts.draft.described() + " has no numbers", "[lower, upper]"))
CORANK_FAULT(grammar::reference, fault.found_instead_of("a reference point (x, y, z), or + (direction)"))
CORANK_FAULT(grammar::zero_direction, fault.found_instead_of("zero (u) (v), a direction (x, y, z) in each link"))
CORANK_FAULT(grammar::driver_name, fault.found_instead_of("the name of the joint that it follows after mimic"))
CORANK_FAULT(grammar::gear_driver, fault.found_instead_of("the name of the joint that leads"))
CORANK_FAULT(grammar::gear_follower, fault.found_instead_of("the name of the joint that follows"))
CORANK_FAULT(grammar::gear_ratio, fault.found_instead_of("ratio and a number: the follower's angle divided by the leader's"))
CORANK_FAULT(grammar::joint, fault.no_joint())
CORANK_FAULT(grammar::dh_convention, fault.found_instead_of("standard or modified (Craig), the convention of the rows"))
CORANK_FAULT(grammar::dh_base, fault.found_instead_of("the name of the link from which the rows begin, after from"))
CORANK_FAULT(grammar::dh_column, fault.found_instead_of("the names of the four columns in their order: a alpha d theta"))
CORANK_FAULT(grammar::dh_comma, fault.found_instead_of("an operator, or ',' and the next column: the row has commas"))
CORANK_FAULT(grammar::dh_link_name, fault.found_instead_of("the name of the row's link after link"))
CORANK_FAULT(grammar::dh_row_end, fault.found_instead_of("limits [lower, upper], actuated, link and its name, or the end of "
                                                         "the row; blanks or commas separate columns"))
CORANK_FAULT(symbolic::grammar::operand<grammar::no_gap>, fault.no_dh_cell())
CORANK_FAULT(grammar::obstacle_name, fault.found_instead_of("the name of an obstacle"))
CORANK_FAULT(grammar::colon, fault.found_instead_of("':' after the name"))
CORANK_FAULT(grammar::obstacle_shape, fault.found_instead_of("body, box, prism, sphere, cylinder, line or segments"))
CORANK_FAULT(grammar::check_word, fault.found_instead_of("check: …, do not check: …, or a section"))
CORANK_FAULT(grammar::checked_name, fault.found_instead_of("all, selfcollisions, connected, or the name of a link"))
CORANK_FAULT(grammar::include_name, fault.found_instead_of("prefix : \"file\", or a section"))
CORANK_FAULT(grammar::include_file, fault.found_instead_of("the name of a file, in quotes"))
CORANK_FAULT(grammar::eqfile_word, fault.found_instead_of("EQFILE : \"file\", or a section"))
CORANK_FAULT(grammar::equation_file, fault.found_instead_of("the name of a file of equations, in quotes"))
CORANK_FAULT(grammar::input_name, fault.found_instead_of("the name of a joint"))
CORANK_FAULT(grammar::output_name, fault.found_instead_of("name : position of link.point, or the like, or a section"))
CORANK_FAULT(grammar::output_link, fault.found_instead_of("the name of a link"))
CORANK_FAULT(grammar::output_frame, fault.found_instead_of("the name of a link after in"))
CORANK_FAULT(grammar::output_point, fault.found_instead_of("the name of a point after '.'"))
CORANK_FAULT(grammar::output_joint, fault.found_instead_of("the name of a joint"))
CORANK_FAULT(
    grammar::output_axis_range,
    fault.found_instead_of("the range of a component: x [lower, upper], or of an angle in the plane: phi [lower, upper]"))
CORANK_FAULT(grammar::only_axis, fault.found_instead_of("one or two of x, y and z after only"))
CORANK_FAULT(grammar::of_word, fault.found_instead_of("of and the name of a link"))
CORANK_FAULT(grammar::output_what, fault.no_output_kind())
CORANK_FAULT(grammar::section_start, fault.say("found " + symbolic::describe_start(fault.rest) + " before the first section",
                                               "a section such as [LINKS] or [JOINTS]"))
#undef CORANK_FAULT

template <typename Rule>
[[noreturn]] void raise_fault(const symbolic::Fault& fault, const PartBuilder& builder) {
  PartFaultOf<Rule>::raise({fault, builder});
}

/// What after a shape in the line of a link is no link of its own.
[[noreturn]] void refuse_word_behind_link(const std::string& word, const std::string& link, const SourceLocation& where);

}  // namespace corank::kinematics
