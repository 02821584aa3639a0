// The grammar of the model language, in PEGTL rules. No rule that an action is attached to (model_file.cc) is ever taken
// back: one token decides what follows, and what then has to follow stands in must<>, whose failure is a fault
// (model_faults.h).
//
//   expression = term {(+|-) term}       term = {-} factors       factors = power {(*|/) {-} power}
//   power = operand {^ {-} operand}      operand = number | name | function ( expression ) | ( expression )
#pragma once

#include <algorithm>
#include <cstddef>
#include <tao/pegtl.hpp>
#include <utility>

namespace corank::symbolic::grammar {

using namespace tao::pegtl;  // NOLINT: a namespace of grammar rules

// Words, written as texts. PEGTL's own TAO_PEGTL_STRING looks at 512 characters of each word, which took more time than all
// else in compiling a grammar.
template <std::size_t size>
struct Letters {
  consteval Letters(const char (&text)[size]) { std::copy_n(text, size, letters); }  // NOLINT: implicit
  char letters[size]{};
};

template <template <char...> typename Rule, Letters text, std::size_t... at>
Rule<text.letters[at]...> rule_of(std::index_sequence<at...>);

/// exactly<"unit">: string<'u', 'n', 'i', 't'>
template <Letters text>
using exactly = decltype(rule_of<tao::pegtl::string, text>(std::make_index_sequence<sizeof(text.letters) - 1>{}));

/// The same, in capitals or not.
template <Letters text>
using any_case = decltype(rule_of<tao::pegtl::istring, text>(std::make_index_sequence<sizeof(text.letters) - 1>{}));

// Blanks and comments. A definition ends with its line, an equation with its semicolon: line_gap stays in the line, gap does
// not.
struct blank_character : one<' ', '\t', '\r', '\f', '\v'> {};
struct comment_start : sor<one<'%'>, string<'/', '/'>, string<'/', '*'>> {};
struct line_comment : seq<sor<one<'%'>, string<'/', '/'>>, until<at<eolf>>> {};
struct block_comment_open : string<'/', '*'> {};
struct block_comment_rest : until<string<'*', '/'>> {};
struct block_comment : if_must<block_comment_open, block_comment_rest> {};
struct line_gap : star<sor<blank_character, line_comment, block_comment>> {};
struct gap : star<sor<space, line_comment, block_comment>> {};

// Words.
struct name_head : sor<alpha, one<'_'>> {};
struct name_tail : sor<alnum, one<'_'>> {};
struct identifier : seq<name_head, star<name_tail>> {};
struct decimal_exponent : seq<one<'e', 'E'>, opt<one<'+', '-'>>, plus<digit>> {};
struct decimal : seq<sor<seq<plus<digit>, opt<one<'.'>, star<digit>>>, seq<one<'.'>, plus<digit>>>, opt<decimal_exponent>> {
};

// Expressions. Gap is line_gap or gap; inside parentheses lines may end.
template <typename Gap>
struct terms;
struct number_end : not_at<sor<name_tail, one<'.'>>> {};
struct number_token : decimal {};
struct degrees_token : seq<decimal, string<'d', 'e', 'g'>, not_at<name_tail>> {};
struct number_operand : sor<degrees_token, if_must<number_token, number_end>> {};
struct group_close : one<')'> {};
struct group_open : one<'('> {};
struct group : if_must<group_open, gap, terms<gap>, gap, group_close> {};
struct call_open : one<'('> {};
struct call : if_must<call_open, gap, terms<gap>, gap, group_close> {};
struct name_token : identifier {};
struct symbol_end : success {};
template <typename Gap>
struct name_operand : seq<name_token, sor<seq<Gap, call>, symbol_end>> {};
template <typename Gap>
struct operand : sor<number_operand, name_operand<Gap>, group> {};
struct exponent_sign : one<'-'> {};
struct power_end : success {};
template <typename Gap>
struct power : seq<must<operand<Gap>>, star<Gap, one<'^'>, Gap, star<exponent_sign, Gap>, must<operand<Gap>>>, power_end> {};
struct times : one<'*'> {};
struct divide : one<'/'> {};
struct factor_sign : one<'-'> {};
template <typename Gap>
struct factors : seq<power<Gap>, star<Gap, sor<times, divide>, Gap, star<factor_sign, Gap>, power<Gap>>> {};
struct term_sign : one<'-'> {};
struct term_end : success {};
template <typename Gap>
struct term : seq<star<term_sign, Gap>, factors<Gap>, term_end> {};
struct plus_sign : one<'+'> {};
struct minus_sign : one<'-'> {};
template <typename Gap>
struct sum_sign : sor<plus_sign, minus_sign> {};
/// In the line of a constant +- begins a tolerance.
template <>
struct sum_sign<line_gap> : sor<seq<not_at<string<'+', '-'>>, plus_sign>, minus_sign> {};
template <typename Gap>
struct terms : seq<term<Gap>, star<Gap, sum_sign<Gap>, Gap, term<Gap>>> {};
struct expression_begin : success {};
struct expression_end : success {};
template <typename Gap>
struct expression : seq<expression_begin, terms<Gap>, expression_end> {};
struct lone_expression_end : eof {};
struct lone_expression : seq<gap, expression<gap>, gap, must<lone_expression_end>> {};

// Section headers.
template <typename... Words>
struct header : seq<one<'['>, star<blank_character>, Words..., star<blank_character>, one<']'>> {};
struct constants_header : header<exactly<"CONSTANTS">> {};
struct variables_header : header<sor<exactly<"SYSTEM">, exactly<"SECONDARY">, exactly<"DUMMY">, exactly<"CARTESIAN">>,
                                 plus<blank_character>, exactly<"VARS">> {};
struct equations_header
    : header<sor<exactly<"SYSTEM">, exactly<"COORD">, exactly<"DUMMY">, exactly<"IMPLIED">, exactly<"VELOCITY">>,
             plus<blank_character>, exactly<"EQS">> {};
struct rates_header : header<exactly<"RATES">> {};
struct inputs_header : header<exactly<"INPUTS">> {};
struct outputs_header : header<exactly<"OUTPUTS">> {};
struct limits_header : header<exactly<"LIMITS">> {};
struct drawing_header : header<exactly<"DRAWING">> {};
struct section_title : star<not_one<']', '[', '\n', '\r'>> {};
struct section_close : one<']'> {};
struct known_section : failure {};
struct unknown_section : if_must<one<'['>, section_title, section_close, known_section> {};
struct section_or_end : sor<eof, one<'['>> {};

struct range_comma : one<','> {};
struct range_close : one<']'> {};

// [CONSTANTS]  name := expression, name := expression ± expression, name := expression ± number %, or
//              name := in [lower, upper]
struct constant_name : identifier {};
struct assign : string<':', '='> {};
struct constant_end : success {};
struct tolerance_mark : sor<string<'+', '-'>, string<'\xC2', '\xB1'>> {};
/// A % with a blank before it begins a comment, unless nothing stands behind it.
struct percent_end : seq<star<blank_character>, sor<eolf, one<';'>>> {};
struct percent_token : seq<decimal, sor<one<'%'>, seq<plus<blank_character>, one<'%'>, at<percent_end>>>> {};
struct tolerance_end : success {};
struct stray_percent : at<sor<one<'%'>, seq<plus<blank_character>, one<'%'>, percent_end>>> {};
struct tolerance : seq<tolerance_mark, star<blank_character>, sor<percent_token, seq<expression<line_gap>, tolerance_end>>,
                       opt<stray_percent>> {};
struct value_range_word : seq<string<'i', 'n'>, not_at<name_tail>, at<line_gap, one<'['>>> {};
struct value_range_end : success {};
struct value_range : seq<value_range_word, gap, one<'['>, gap, expression<gap>, gap, must<range_comma>, gap, expression<gap>,
                         gap, must<range_close>, value_range_end> {};
struct constant_value : sor<value_range, seq<expression<line_gap>, opt<line_gap, tolerance>>> {};
struct definition
    : seq<must<constant_name>, line_gap, must<assign>, line_gap, constant_value, constant_end, opt<line_gap, one<';'>>> {};
/// What `-D NAME=…` gives.
struct lone_constant_value : seq<line_gap, constant_value, line_gap, must<lone_expression_end>> {};
struct constants_section : seq<constants_header, star<gap, not_at<section_or_end>, definition>> {};

template <typename Letters>
struct word : seq<Letters, not_at<name_tail>> {};

// [SYSTEM VARS]  name : [lower, upper], name ~ [lower, upper], either without its range, or name @ unit, name @ rotation
struct variable_name : identifier {};
struct length_mark : seq<one<':'>, not_at<one<'='>>> {};
struct angle_mark : one<'~'> {};
struct composite_mark : one<'@'> {};
struct declarator : sor<length_mark, angle_mark> {};
struct no_range : at<sor<eolf, one<';'>>> {};
struct range_open : one<'['> {};
struct variable_end : success {};
struct range : seq<must<range_open>, gap, expression<gap>, gap, must<range_comma>, gap, expression<gap>, gap,
                   must<range_close>, variable_end> {};
struct composite_word : sor<word<exactly<"unit">>, word<exactly<"rotation">>> {};
struct declaration
    : seq<must<variable_name>, line_gap,
          sor<seq<composite_mark, line_gap, must<composite_word>>, seq<must<declarator>, line_gap, sor<no_range, range>>>,
          opt<line_gap, one<';'>>> {};
struct variables_section : seq<variables_header, star<gap, not_at<section_or_end>, declaration>> {};

// [LIMITS]  name : [lower, upper]
struct limit_name : identifier {};
struct limit_mark : one<':'> {};
struct limit_end : success {};
struct limit : seq<must<limit_name>, line_gap, must<limit_mark>, line_gap, must<range_open>, gap, expression<gap>, gap,
                   must<range_comma>, gap, expression<gap>, gap, must<range_close>, limit_end, opt<line_gap, one<';'>>> {};
struct limits_section : seq<limits_header, star<gap, not_at<section_or_end>, limit>> {};

// [RATES]  name ~ role or name : role
struct rate_name : identifier {};
struct rate_mark : sor<length_mark, angle_mark> {};
struct role_word : sor<word<exactly<"input">>, word<exactly<"output">>, word<exactly<"passive">>> {};
struct rate : seq<must<rate_name>, line_gap, must<rate_mark>, line_gap, must<role_word>, opt<line_gap, one<';'>>> {};
struct rates_section : seq<rates_header, star<gap, not_at<section_or_end>, rate>> {};

// [SYSTEM EQS]  expression = expression;   "name": expression <= expression;
struct equation_begin : success {};
struct inequality_name : plus<not_one<'"', '\n'>> {};
struct inequality_name_end : one<'"'> {};
struct inequality_colon : one<':'> {};
struct inequality_label : if_must<one<'"'>, inequality_name, inequality_name_end, gap, inequality_colon, gap> {};
struct relation : sor<one<'='>, string<'<', '='>, string<'>', '='>> {};
struct equation_end : one<';'> {};
struct equation : seq<equation_begin, opt<inequality_label>, expression<gap>, gap, must<relation>, gap, expression<gap>, gap,
                      must<equation_end>> {};
struct equations_section : seq<equations_header, star<gap, not_at<section_or_end>, equation>> {};

// [INPUTS] and [OUTPUTS]  name, name …
struct listed_name : identifier {};
struct list_end : at<section_or_end> {};
struct names : seq<gap, must<listed_name>, star<gap, sor<if_must<one<','>, gap, listed_name>, listed_name>>,
                   opt<gap, one<';'>>, gap, must<list_end>> {};
struct names_section : seq<sor<inputs_header, outputs_header>, names> {};

// [DRAWING]  point P = (x, y), also with moves (u, v) behind it, or another word and the names of points, a radius, a
// colour; each ends with its line. A body's name and = may stand before its points.
struct point_word : word<exactly<"point">> {};
struct unit_word : word<exactly<"unit">> {};
struct slider_word : word<exactly<"slider">> {};
struct along_word : word<exactly<"along">> {};
struct part_word : word<sor<exactly<"link">, exactly<"platform">, exactly<"joint">, exactly<"ground">, exactly<"effector">,
                            exactly<"ball">>> {};
struct hinge_word : word<exactly<"hinge">> {};
struct sphere_word : word<exactly<"sphere">> {};
struct cylinder_word : word<exactly<"cylinder">> {};
struct radius_word : word<exactly<"radius">> {};
struct point_name : identifier {};
struct point_equals : one<'='> {};
struct point_open : one<'('> {};
struct point_comma : one<','> {};
struct point_close : one<')'> {};
struct point_end : success {};
struct unit_name : identifier {};
struct part_point : identifier {};
struct part_radius : success {};
struct colour_digits : sor<seq<rep<6, xdigit>, not_at<name_tail>>, failure> {};
struct colour : seq<line_gap, if_must<one<'#'>, colour_digits>> {};
struct drawing_line_end : sor<at<eolf>, one<';'>> {};
struct third_coordinate : seq<one<','>, gap, expression<gap>, gap> {};
struct moves_word : word<exactly<"moves">> {};
struct moves_open : one<'('> {};
struct moves_comma : one<','> {};
struct moves_close : one<')'> {};
struct point_velocity : seq<moves_word, line_gap, must<moves_open>, gap, expression<gap>, gap, must<moves_comma>, gap,
                            expression<gap>, gap, opt<third_coordinate>, must<moves_close>> {};
struct drawing_point : seq<point_word, line_gap, must<point_name>, line_gap, must<point_equals>, line_gap, must<point_open>,
                           gap, expression<gap>, gap, must<point_comma>, gap, expression<gap>, gap, opt<third_coordinate>,
                           must<point_close>, opt<line_gap, point_velocity>, point_end> {};
struct drawing_unit : seq<unit_word, line_gap, must<unit_name>> {};
struct part_name : identifier {};
struct named : opt<at<identifier, line_gap, one<'='>>, part_name, line_gap, one<'='>, line_gap> {};
struct drawing_slider : seq<slider_word, line_gap, must<part_point>, line_gap, must<along_word>, line_gap, must<part_point>,
                            line_gap, must<part_point>> {};
struct drawing_hinge : seq<hinge_word, line_gap, must<part_point>, line_gap, must<part_point>> {};
struct drawing_radius : seq<line_gap, must<radius_word>, line_gap, expression<line_gap>, part_radius> {};
struct drawing_sphere : seq<sphere_word, line_gap, named, must<part_point>, drawing_radius> {};
struct drawing_cylinder : seq<cylinder_word, line_gap, named, must<part_point>, line_gap, must<part_point>, drawing_radius> {
};
struct drawing_part : seq<part_word, line_gap, named, must<part_point>, star<line_gap, part_point>> {};
struct drawing_statement
    : sor<drawing_point, drawing_unit,
          seq<sor<drawing_slider, drawing_hinge, drawing_sphere, drawing_cylinder, drawing_part>, opt<colour>>> {};
struct drawing_section
    : seq<drawing_header, star<gap, not_at<section_or_end>, must<drawing_statement>, line_gap, must<drawing_line_end>>> {};

// [REQUIREMENTS]  a text up to its semicolon (requirement_text.cc has its grammar)
struct requirements_header : header<exactly<"REQUIREMENTS">> {};
struct requirement_line_end : one<';'> {};
struct requirement_end_of_range : plus<not_one<';', ',', '[', ']'>> {};
struct requirement_range : seq<one<'['>, requirement_end_of_range, one<','>, requirement_end_of_range, one<']'>> {};
struct requirement_line : plus<sor<not_one<';', '[', ']'>, requirement_range>> {};
struct requirements_section
    : seq<requirements_header, star<gap, not_at<section_or_end>, seq<must<requirement_line>, must<requirement_line_end>>>> {
};

// [SEARCH]  DEPTH FIRST or BREADTH FIRST: the order in which the CUIK suite visits boxes.
struct search_header : header<exactly<"SEARCH">> {};
struct search_order
    : seq<sor<exactly<"DEPTH">, exactly<"BREADTH">>, not_at<name_tail>, gap, exactly<"FIRST">, not_at<name_tail>> {};
struct search_end : at<section_or_end> {};
struct search_section : seq<search_header, gap, must<search_order>, gap, must<search_end>> {};

struct section_start : at<one<'['>> {};
struct section
    : seq<must<section_start>, sor<constants_section, variables_section, rates_section, equations_section, names_section,
                                   limits_section, drawing_section, requirements_section, search_section, unknown_section>> {
};
struct file_end : eof {};
struct model : seq<opt<utf8::bom>, gap, star<not_at<eof>, section, gap>, must<file_end>> {};

// Every text must be UTF-8 without NUL, before anything else is asked of it.
struct text_end : eof {};
struct plain_text : seq<star<utf8::not_one<U'\0'>>, must<text_end>> {};

}  // namespace corank::symbolic::grammar
