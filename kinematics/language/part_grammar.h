// The grammar of the parts language, in PEGTL rules: sections of links, joints, inputs, outputs, and what is passed over.
// As in symbolic/model/model_grammar.h no rule that an action is attached to (part_file.cc) is ever taken back, and what has
// to follow stands in must<>, whose failure is a fault (part_faults.h).
//
// Blanks and line ends are all the same. Keywords may be written in capitals or not; names may not.
#pragma once

#include <tao/pegtl.hpp>

#include "corank/symbolic/model/model_grammar.h"

namespace corank::kinematics::grammar {

using namespace tao::pegtl;  // NOLINT: a namespace of grammar rules
namespace model = symbolic::grammar;
using model::any_case;

struct hash_comment : seq<one<'#'>, until<at<eolf>>> {};
struct gap : star<sor<space, model::line_comment, hash_comment, model::block_comment>> {};
struct line_gap : star<sor<model::blank_character, model::line_comment, hash_comment, model::block_comment>> {};
struct no_gap : success {};

using model::assign, model::constant_end, model::constant_name, model::file_end, model::point_end, model::point_name;
using model::header, model::word, model::section_or_end, model::known_section, model::unknown_section;
using model::percent_token, model::value_range_word, model::range_close, model::range_comma, model::tolerance_end;
using model::section_start, model::unit_name, model::value_range_end;
template <typename... Letters>
struct words : word<sor<Letters...>> {};
#define CORANK_WORD(name, text) \
  struct name : word<any_case<text>> {}

// Names. That of a thing in an included file may have its prefix before it: arm::elbow.
struct simple_name : model::identifier {};
struct long_name : seq<model::identifier, star<string<':', ':'>, model::identifier>> {};

// Operands of expressions: functions may be written in capitals, and only what is called like a function is a call.
struct function_word : words<any_case<"sin">, any_case<"cos">, any_case<"tan">, any_case<"asin">, any_case<"acos">,
                             any_case<"atan">, any_case<"sqrt">, any_case<"exp">, any_case<"log">, any_case<"abs">> {};
struct refused_function : words<any_case<"atan2">, any_case<"cot">, any_case<"parameter">> {};
struct constant_token : long_name {};
struct call;
struct parenthesis;
}  // namespace corank::kinematics::grammar

namespace corank::symbolic::grammar {
template <typename Gap>
struct part_operand
    : seq<star<one<'+'>, Gap>, sor<number_operand, kinematics::grammar::refused_function, kinematics::grammar::call,
                                   kinematics::grammar::constant_token, kinematics::grammar::parenthesis>> {};
template <>
struct operand<kinematics::grammar::gap> : part_operand<kinematics::grammar::gap> {};
template <>
struct operand<kinematics::grammar::line_gap> : part_operand<kinematics::grammar::line_gap> {};
template <>
struct operand<kinematics::grammar::no_gap> : part_operand<kinematics::grammar::no_gap> {};
}  // namespace corank::symbolic::grammar

namespace corank::kinematics::grammar {
struct call : seq<function_word, gap, must<model::call_open>, gap, model::terms<gap>, gap, must<model::group_close>> {};
struct parenthesis : seq<model::group_open, gap, model::terms<gap>, gap, must<model::group_close>> {};
struct expression : model::expression<gap> {};

// Points and directions.
struct tuple_comma : one<','> {};
struct tuple_close : one<')'> {};
struct tuple : seq<one<'('>, gap, expression, gap, must<tuple_comma>, gap, expression, gap, must<tuple_comma>, gap,
                   expression, gap, must<tuple_close>> {};
struct absolute_point : tuple {};
struct offset_vector : tuple {};
struct direction : tuple {};
struct vertex : seq<plus<digit>, not_at<sor<model::name_tail, one<'.'>>>,
                    opt<gap, one<':'>, gap, plus<digit>, not_at<sor<model::name_tail, one<'.'>>>>> {};
struct named_point : simple_name {};
struct point : sor<absolute_point, vertex, named_point> {};
struct point_offset : seq<one<'+'>, gap, must<offset_vector>> {};
struct second_point : sor<point_offset, point> {};

// Colours: 0.5*red + color (r, g, b)
struct colour_word : words<any_case<"red">, any_case<"green">, any_case<"blue">, any_case<"purple">, any_case<"cyan">,
                           any_case<"yellow">, any_case<"white">, any_case<"black">, any_case<"grey">> {};
CORANK_WORD(rgb_word, "color");
struct rgb : seq<rgb_word, gap, must<tuple>> {};
struct colour_factor : model::decimal {};
struct colour_times : one<'*'> {};
struct colour_atom : sor<colour_word, rgb> {};
struct colour_term : seq<star<colour_factor, gap, must<colour_times>, gap>, must<colour_atom>> {};
struct colour_begin : at<sor<digit, one<'.'>, colour_word, rgb_word>> {};
struct colour_end : success {};
struct colour : seq<colour_begin, colour_term, star<gap, one<'+'>, gap, colour_term>, colour_end> {};

// Rigid transformations: Txyz(1, 0, 0)*Rz(pi/2)
struct transform_word : words<any_case<"txyz">, any_case<"tx">, any_case<"ty">, any_case<"tz">, any_case<"rx">,
                              any_case<"ry">, any_case<"rz">, any_case<"tr">> {};
CORANK_WORD(identity_word, "id");
struct transform_open : one<'('> {};
struct transform_close : one<')'> {};
struct transform_inverse : seq<one<'^'>, gap, one<'-'>, gap, one<'1'>> {};
struct transform_end : success {};
struct transform_call
    : seq<transform_word, gap, must<transform_open>, gap, expression, star<gap, one<',', ';'>, gap, expression>, gap,
          must<transform_close>, opt<gap, transform_inverse>, transform_end> {};
struct transform : sor<identity_word, transform_call> {};
struct transforms : seq<must<transform>, star<gap, one<'*'>, gap, must<transform>>> {};

// What concerns dynamics: passed over.
struct dynamics_end : success {};
struct number_list : seq<expression, star<gap, one<','>, gap, expression>> {};
CORANK_WORD(inertia_word, "inertia");
CORANK_WORD(matrix_word, "matrix");
CORANK_WORD(inertial_word, "inertial");
CORANK_WORD(frame_word, "frame");
CORANK_WORD(solid_word, "solid");
struct inertia_shape
    : words<any_case<"rod_x">, any_case<"rod_y">, any_case<"rod_z">, any_case<"cylinder_x">, any_case<"cylinder_y">,
            any_case<"cylinder_z">, any_case<"sphere">, any_case<"box">, any_case<"ellipsoid">> {};
struct inertia : seq<inertia_word, gap, must<matrix_word>, gap, opt<solid_word, gap>, opt<inertia_shape, gap>, number_list,
                     dynamics_end> {};
struct inertial_frame : seq<inertial_word, gap, must<frame_word>, gap, transforms, dynamics_end> {};
struct dynamics_word : words<any_case<"mass">, any_case<"velocity">, any_case<"acceleration">, any_case<"effort">,
                             any_case<"torque">, any_case<"force">, any_case<"cost">, any_case<"friction">,
                             any_case<"damping">, any_case<"rest">, any_case<"stiffness">> {};
struct dynamics_number : seq<dynamics_word, gap, expression, dynamics_end> {};
struct dynamics : sor<inertia, inertial_frame, dynamics_number> {};

// Shapes.
struct quote : one<'"'> {};
struct quoted_text : plus<not_one<'"', '\n', '\r'>> {};
struct quoted : seq<one<'"'>, must<quoted_text>, must<quote>> {};
CORANK_WORD(granularity_word, "granularity");
CORANK_WORD(hidden_word, "hidden");
CORANK_WORD(decoration_word, "decoration");
struct integer : plus<digit> {};
struct granularity : seq<granularity_word, gap, must<integer>> {};
struct shape_colour : colour {};
struct shape_tail : star<gap, sor<shape_colour, granularity, hidden_word, decoration_word>> {};
CORANK_WORD(body_word, "body");
CORANK_WORD(box_word, "box");
CORANK_WORD(prism_word, "prism");
CORANK_WORD(sphere_word, "sphere");
CORANK_WORD(cylinder_word, "cylinder");
CORANK_WORD(line_word, "line");
CORANK_WORD(segments_word, "segments");
struct body_end : success {};
struct box_end : success {};
struct prism_end : success {};
struct sphere_end : success {};
struct cylinder_end : success {};
struct line_end : success {};
struct segments_end : success {};
struct body_file : quoted {};
struct segments_open : one<'('> {};
struct segments_comma : one<','> {};
struct segments_close : one<')'> {};
struct segment_point_end : success {};
struct segment_point : seq<expression, gap, must<segments_comma>, gap, expression, gap, must<segments_comma>, gap,
                           expression, segment_point_end> {};
struct body : seq<body_word, gap, must<body_file>, shape_tail, body_end> {};
struct box : seq<box_word, gap, must<point>, gap, must<second_point>, shape_tail, box_end> {};
struct prism
    : seq<prism_word, gap, must<point>, gap, must<point>, gap, must<point>, gap, expression, shape_tail, prism_end> {};
struct sphere : seq<sphere_word, gap, expression, gap, must<point>, shape_tail, sphere_end> {};
struct cylinder : seq<cylinder_word, gap, expression, gap, must<point>, gap, must<second_point>, shape_tail, cylinder_end> {
};
struct line : seq<line_word, gap, must<point>, gap, must<second_point>, shape_tail, line_end> {};
struct segments : seq<segments_word, gap, must<segments_open>, gap, segment_point, star<gap, one<';'>, gap, segment_point>,
                      gap, must<segments_close>, shape_tail, segments_end> {};
struct shape : sor<body, box, prism, sphere, cylinder, line, segments> {};

// Section headers, and what may begin one.
struct constants_header : header<any_case<"constants">> {};
struct links_header : header<any_case<"links">> {};
struct joints_header : sor<header<any_case<"joints">>, header<any_case<"loops">>> {};
struct obstacles_header : header<any_case<"obstacles">> {};
struct dh_header : header<any_case<"dh">> {};
struct collisions_header : header<any_case<"collisions">> {};
struct include_header : header<any_case<"include">> {};
struct equations_header : header<any_case<"equations">> {};
struct inputs_header : header<any_case<"inputs">> {};
struct outputs_header : header<any_case<"outputs">> {};
struct capital_header : header<upper, star<sor<upper, model::blank_character>>> {};

// [CONSTANTS]  name := expression, also with ± expression, ± number %, or in [lower, upper]; print name, unit mm
struct colon : one<':'> {};
CORANK_WORD(print_word, "print");
CORANK_WORD(unit_word, "unit");
struct print_statement : seq<seq<print_word, gap, at<simple_name>>, simple_name> {};
struct unit_statement : seq<seq<unit_word, gap, at<simple_name>>, unit_name> {};
struct tolerance : seq<string<'\xC2', '\xB1'>, gap, sor<percent_token, seq<expression, tolerance_end>>> {};
struct value_range : seq<value_range_word, gap, one<'['>, gap, expression, gap, must<range_comma>, gap, expression, gap,
                         must<range_close>, value_range_end> {};
struct definition : seq<must<constant_name>, gap, must<assign>, gap, sor<value_range, seq<expression, opt<gap, tolerance>>>,
                        constant_end, opt<gap, one<';'>>> {};
struct constants_section
    : seq<constants_header, star<gap, not_at<section_or_end>, sor<print_statement, unit_statement, definition>>> {};

// [LINKS]  name, name : colour shapes points masses, or with '-' for ':' (the suite's end effector)
struct link_name : simple_name {};
struct link_separator : one<':', '-'> {};
struct link_colour : colour {};
CORANK_WORD(point_word, "point");
struct point_statement : seq<seq<point_word, gap, at<simple_name, gap, one<'('>>>, point_name, gap, must<tuple>, point_end> {
};
struct link_part : sor<shape, point_statement, dynamics> {};
struct link : seq<must<link_name>, opt<gap, link_separator, opt<gap, link_colour>, star<gap, link_part>>> {};
struct links_section : seq<links_header, star<gap, not_at<section_or_end>, link>> {};

// [JOINTS]
struct axis_kind : words<any_case<"revolute">, any_case<"crevolute">, any_case<"prismatic">, any_case<"universal">,
                         any_case<"cylindrical">, any_case<"planar">, any_case<"parallelogram">, any_case<"uni_prs_uni">> {};
struct slot_kind : words<any_case<"slot">> {};
struct gear_kind : words<any_case<"gear">> {};
struct point_kind : words<any_case<"spherical">, any_case<"sph_prs_sph">, any_case<"sph_sph">> {};
struct fixed_kind : words<any_case<"fix">> {};
struct connector_kind : words<any_case<"c_spring">, any_case<"c_cable">, any_case<"c_leg">> {};
struct refused_kind : words<any_case<"in_patch">, any_case<"spring">, any_case<"xyspring">> {};
struct any_kind : sor<axis_kind, point_kind, slot_kind, fixed_kind, gear_kind, connector_kind, refused_kind> {};
struct joint_name : simple_name {};
struct joint_link : long_name {};
struct joint_colon : colon {};
struct joint_end : success {};

CORANK_WORD(limits_word, "limits");
CORANK_WORD(range_word, "range");
CORANK_WORD(reference_word, "reference");
CORANK_WORD(zero_word, "zero");
CORANK_WORD(length_word, "length");
CORANK_WORD(radius_word, "radius");
CORANK_WORD(avoid_word, "avoid");
CORANK_WORD(actuated_word, "actuated");
CORANK_WORD(mimic_word, "mimic");
CORANK_WORD(ratio_word, "ratio");
CORANK_WORD(offset_word, "offset");
struct option_word : sor<limits_word, range_word, reference_word, zero_word, length_word, radius_word, avoid_word,
                         actuated_word, mimic_word, dynamics_word, inertia_word, inertial_word, granularity_word,
                         hidden_word, decoration_word, colour_word, rgb_word> {};
struct bracket_open : one<'['> {};
struct bracket_close : one<']'> {};
struct bracket_comma : one<','> {};
struct bracket : seq<bracket_open, gap, expression, gap, opt<bracket_comma, gap, expression, gap>, must<bracket_close>> {};
struct range_bracket : bracket {};
struct reference_tuple : tuple {};
struct reference_offset : seq<one<'+'>, gap, must<offset_vector>> {};
struct reference_name : simple_name {};
struct reference_point : seq<not_at<sor<any_kind, option_word>>, reference_name> {};
struct reference : sor<reference_tuple, reference_offset, reference_point> {};
struct range_option : seq<sor<range_word, limits_word>, gap, must<range_bracket>,
                          star<gap, sor<seq<not_at<capital_header>, range_bracket>, reference_word, reference>>> {};
struct reference_option : seq<reference_word, gap, must<reference>, gap, must<reference>> {};
struct zero_direction : direction {};
struct second_zero : seq<at<one<'('>>, zero_direction> {};
struct zero_option : seq<zero_word, gap, must<zero_direction>, opt<gap, second_zero>> {};
struct length_end : success {};
struct length_option : seq<length_word, gap, expression, length_end> {};
struct dropped_end : success {};  // of a number that is passed over
struct radius_option : seq<radius_word, gap, expression, dropped_end> {};
struct weight : seq<not_at<sor<any_kind, option_word>>, at<sor<digit, one<'.'>, one<'('>, one<'-'>, model::name_head>>,
                    expression, dropped_end> {};
struct avoid_option : seq<avoid_word, gap, must<limits_word>, opt<gap, weight>> {};
struct driver_name : long_name {};
struct ratio_end : success {};
struct offset_end : success {};
struct coupling_ratio : seq<ratio_word, gap, expression, ratio_end> {};
struct coupling_offset : seq<offset_word, gap, expression, offset_end> {};
struct mimic_option : seq<mimic_word, gap, must<driver_name>, opt<gap, coupling_ratio>, opt<gap, coupling_offset>> {};
struct joint_option : sor<mimic_option, range_option, reference_option, zero_option, length_option, radius_option,
                          avoid_option, actuated_word, dynamics, shape_colour, granularity, hidden_word, decoration_word> {};
struct joint_options : star<gap, joint_option> {};
template <typename Kind>
struct joint_head : seq<Kind, gap, opt<joint_name, gap>, must<joint_colon>, gap> {};
struct axis_end : seq<must<joint_link>, gap, must<point>, gap, must<second_point>> {};
struct point_shift : seq<one<'+'>, gap, must<offset_vector>> {};
struct point_joint_end : seq<must<joint_link>, gap, must<point>, opt<gap, point_shift>> {};
struct axis_joint : seq<joint_head<axis_kind>, axis_end, gap, axis_end, joint_options, joint_end> {};
struct point_joint : seq<joint_head<point_kind>, point_joint_end, gap, point_joint_end, joint_options, joint_end> {};
struct slot_joint : seq<joint_head<slot_kind>, axis_end, gap, point_joint_end, joint_options, joint_end> {};
struct fixed_joint
    : seq<joint_head<fixed_kind>, must<joint_link>, gap, must<joint_link>, gap, transforms, joint_options, joint_end> {};
struct connector_end : success {};
struct connector : seq<joint_head<connector_kind>, point_joint_end, gap, point_joint_end, joint_options, connector_end> {};
struct gear_driver : long_name {};
struct gear_follower : long_name {};
struct gear_ratio : coupling_ratio {};
struct gear_end : success {};
struct gear : seq<joint_head<gear_kind>, must<gear_driver>, gap, must<gear_follower>, gap, must<gear_ratio>,
                  opt<gap, coupling_offset>, gear_end> {};
struct joint : sor<axis_joint, point_joint, slot_joint, fixed_joint, gear, connector, refused_kind> {};
CORANK_WORD(keep_word, "keep");
CORANK_WORD(parallelograms_word, "parallelograms");
struct keep_parallelograms : seq<keep_word, gap, parallelograms_word> {};
struct joints_section : seq<joints_header, star<gap, not_at<section_or_end>, sor<keep_parallelograms, must<joint>>>> {};

// [DH]  standard or modified, from which link; the columns' names; rows of four expressions, each in its line. Blanks
// separate the columns, or commas where one stands behind a row's first.
struct dh_convention : words<any_case<"standard">, any_case<"modified">> {};
CORANK_WORD(from_word, "from");
CORANK_WORD(link_word, "link");
struct dh_base : long_name {};
struct dh_column : words<any_case<"alpha">, any_case<"theta">, one<'a', 'A'>, one<'d', 'D'>> {};
struct dh_comma : one<','> {};
struct dh_columns : seq<must<dh_column>, rep<3, line_gap, opt<dh_comma, line_gap>, must<dh_column>>> {};
struct dh_row_begin : success {};
struct dh_cell_end : success {};
struct dh_cells_end : success {};
struct dh_has_commas : at<plus<not_at<sor<model::comment_start, one<'#'>>>, not_one<',', '[', '\n'>>, dh_comma> {};
template <typename Gap>
struct dh_cell : seq<model::expression<Gap>, dh_cell_end> {};
struct dh_cells_by_commas : seq<dh_cell<line_gap>, rep<3, line_gap, must<dh_comma>, line_gap, dh_cell<line_gap>>> {};
struct dh_cells_by_blanks : seq<dh_cell<no_gap>, rep<3, line_gap, dh_cell<no_gap>>> {};
struct dh_range : seq<sor<range_word, limits_word>, gap, must<range_bracket>> {};
struct dh_link_name : long_name {};
struct dh_link : seq<link_word, gap, must<dh_link_name>> {};
struct dh_option : sor<dh_range, actuated_word, dh_link> {};
struct dh_row_end : at<eolf> {};
struct dh_row_finished : success {};
struct dh_row : seq<dh_row_begin, sor<seq<dh_has_commas, dh_cells_by_commas>, dh_cells_by_blanks>, dh_cells_end,
                    star<line_gap, dh_option>, line_gap, must<dh_row_end>, dh_row_finished> {};
struct dh_end : success {};
struct dh_section : seq<dh_header, gap, must<dh_convention>, opt<gap, from_word, gap, must<dh_base>>, gap, dh_columns,
                        star<gap, not_at<section_or_end>, dh_row>, dh_end> {};

// [OBSTACLES] and [COLLISIONS]: passed over.
struct obstacle_name : simple_name {};
struct obstacle_shape : shape {};
struct obstacle : seq<must<obstacle_name>, gap, must<colon>, gap, must<obstacle_shape>> {};
struct obstacles_section : seq<obstacles_header, star<gap, not_at<section_or_end>, obstacle>> {};
struct checked_name : long_name {};
struct check_word
    : seq<opt<any_case<"do">, plus<space>, any_case<"not">, plus<space>>, any_case<"check">, not_at<model::name_tail>> {};
struct collision_check
    : seq<must<check_word>, gap, must<colon>, gap, must<checked_name>, opt<gap, one<','>, gap, must<checked_name>>> {};
struct collisions_section : seq<collisions_header, star<gap, not_at<section_or_end>, collision_check>> {};

// [INCLUDE]  prefix : "file"      [EQUATIONS]  eqfile : "file"
struct include_name : simple_name {};
struct include_file : quoted {};
struct include_section
    : seq<include_header, star<gap, not_at<section_or_end>, must<include_name>, gap, must<colon>, gap, must<include_file>>> {
};
CORANK_WORD(eqfile_word, "eqfile");
struct equation_file : quoted {};
struct equations_section
    : seq<equations_header,
          star<gap, not_at<section_or_end>, must<eqfile_word>, gap, must<colon>, gap, must<equation_file>>> {};

// [INPUTS]  joint, joint …
struct input_name : long_name {};
struct inputs_section
    : seq<inputs_header, gap, must<input_name>, star<gap, not_at<section_or_end>, opt<one<','>, gap>, must<input_name>>> {};

// [REQUIREMENTS]  as in a model of equations
struct requirements_header : header<any_case<"requirements">> {};
struct requirements_section
    : seq<requirements_header,
          star<gap, not_at<section_or_end>, must<model::requirement_line>, must<model::requirement_line_end>>> {};

// [OUTPUTS]  name : what of which
struct output_name : simple_name {};
struct output_link : long_name {};
struct output_frame : long_name {};
struct output_point : simple_name {};
struct output_joint : long_name {};
CORANK_WORD(of_word, "of");
CORANK_WORD(position_word, "position");
CORANK_WORD(pose_word, "pose");
CORANK_WORD(orientation_word, "orientation");
CORANK_WORD(direction_word, "direction");
CORANK_WORD(joint_word, "joint");
struct in_word : seq<word<any_case<"in">>, not_at<gap, one<':'>>> {};
struct output_tuple : tuple {};
struct output_of : seq<must<of_word>, gap, must<output_link>,
                       opt<sor<seq<gap, one<'.'>, gap, must<output_point>>, seq<gap, output_tuple>>>> {};
struct output_in : opt<gap, in_word, gap, must<output_frame>> {};
struct output_end : success {};
CORANK_WORD(keeps_word, "keeps");
struct output_axis : sor<any_case<"phi">, one<'x', 'y', 'z', 'X', 'Y', 'Z'>> {};
struct output_bracket : bracket {};
struct output_axis_range : seq<at<output_axis, gap, one<'['>>, output_axis, gap, output_bracket> {};
struct output_range : seq<sor<range_word, limits_word>, gap, must<output_axis_range>, star<gap, output_axis_range>> {};
struct only_word : seq<word<any_case<"only">>, not_at<gap, one<':'>>> {};
struct only_axis : seq<one<'x', 'y', 'z', 'X', 'Y', 'Z'>, not_at<model::name_tail>, not_at<gap, one<':'>>> {};
struct output_only : seq<only_word, gap, must<only_axis>, star<gap, only_axis>> {};
struct kept_end : success {};
struct output_keeps : seq<keeps_word, gap, transforms, kept_end> {};
struct output_options : star<gap, sor<output_range, output_only, output_keeps>> {};
struct output_kind : sor<position_word, pose_word, orientation_word, direction_word> {};
struct output_what
    : sor<seq<output_kind, gap, output_of, output_in, output_options>, seq<joint_word, gap, must<output_joint>>> {};
struct output : seq<must<output_name>, gap, must<colon>, gap, must<output_what>, output_end> {};
struct outputs_section : seq<outputs_header, star<gap, not_at<section_or_end>, output>> {};

struct section
    : seq<must<section_start>,
          sor<constants_section, links_section, joints_section, dh_section, obstacles_section, collisions_section,
              include_section, equations_section, inputs_section, outputs_section, requirements_section, unknown_section>> {
};
struct parts : seq<opt<utf8::bom>, gap, star<not_at<eof>, section, gap>, must<file_end>> {};

#undef CORANK_WORD

}  // namespace corank::kinematics::grammar
