#include "corank/kinematics/language/part_file.h"

#include "corank/kinematics/language/part_builder.h"
#include "corank/kinematics/language/part_faults.h"
#include "corank/kinematics/language/part_grammar.h"
#include "corank/symbolic/model/expression_actions.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/parse_text.h"

namespace corank::kinematics {
namespace {

namespace peg = tao::pegtl;
using symbolic::declare;
using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::place;

/// What a token means.
template <typename Rule>
struct Action : symbolic::ExpressionAction<Rule> {};

#define CORANK_ACTION(rule, ...) CORANK_ACTION_OF(Action, PartBuilder, rule, __VA_ARGS__)
#define CORANK_ACTION0(rule, ...) CORANK_ACTION0_OF(Action, PartBuilder, rule, __VA_ARGS__)

template <typename ActionInput>
std::string_view text_before(const ActionInput& in, const PartBuilder& b) {
  return b.text.substr(0, in.begin() - b.text.data());
}

/// Does something other than the end of a comment stand before it in its line?
template <typename ActionInput>
bool follows_in_line(const ActionInput& in, const PartBuilder& b) {
  const std::string_view before = text_before(in, b);
  const std::size_t last = before.find_last_not_of(" \t\r\f\v");
  if (last == std::string_view::npos || before[last] == '\n' || before[last] == ']') return false;
  return before[last] != '/' || last == 0 || before[last - 1] != '*';
}

/// The first character behind the token, blanks left out.
template <typename ActionInput>
char next_character(const ActionInput& in, const PartBuilder& b) {
  const std::size_t next = b.text.find_first_not_of(" \t", in.end() - b.text.data());
  return next == std::string_view::npos ? '\n' : b.text[next];
}

// Expressions.
CORANK_ACTION(refused_function, {
  throw ModelError(place(in, b), "the function " + in_quotes(in.string_view()) + " is not supported",
                   "one of " + symbolic::function_names());
})
CORANK_ACTION(function_word, {
  b.name = small_letters(in.string_view());
  b.name_where = place(in, b);
})
CORANK_ACTION(constant_token, {
  b.push_constant(in.string_view(), place(in, b));
  symbolic::end_operand(in, b);
})
CORANK_ACTION(constant_name, { declare(in, b); })
CORANK_ACTION0(constant_end, { b.define_constant(); })
CORANK_ACTION(unit_name, {
  if (!b.robot.unit.empty() && b.robot.unit != in.string_view())
    throw ModelError(place(in, b), "the unit " + in_quotes(b.robot.unit) + " is already given", "the same unit everywhere");
  b.robot.unit = in.string();
})

// Points.
CORANK_ACTION(absolute_point, { b.points.push_back({b.pop_vector(), {}, place(in, b)}); })
CORANK_ACTION(vertex, { b.push_vertex(in.string_view(), place(in, b)); })
CORANK_ACTION(named_point, { b.push_named_point(in.string(), place(in, b)); })
CORANK_ACTION0(point_shift, { b.shift_point(); })
CORANK_ACTION(point_offset, { b.push_offset(place(in, b)); })

// Colours.
CORANK_ACTION0(colour_begin, { b.begin_colour(); })
CORANK_ACTION(colour_word, {
  const std::string word = small_letters(in.string_view());
  const bool bright = word == "white", grey = word == "grey";
  const auto has = [&](const char* a, const char* c, const char* d) {
    return bright || word == a || word == c || word == d ? 1.0 : grey ? 0.5 : 0.0;
  };
  b.add_colour({has("red", "yellow", "purple"), has("green", "yellow", "cyan"), has("blue", "purple", "cyan")});
})
CORANK_ACTION(rgb, {
  const SourceLocation where = place(in, b);
  std::array<double, 3> part;
  for (std::size_t i = 3; i-- > 0;) part[i] = b.scope.approximation(b.pop_value(), "a colour", where);
  b.add_colour(part);
})
CORANK_ACTION(colour_factor, {
  const SourceLocation where = place(in, b);
  const Expression factor = Expression::number(symbolic::normal_decimal(in.string_view(), where), where);
  b.colour_factor *= b.scope.approximation(factor, "a colour", where);
})
CORANK_ACTION0(colour_end, { b.finish_colour(); })
CORANK_ACTION0(link_colour, { b.link_colour = b.colour; })
CORANK_ACTION0(shape_colour, { b.shape_colour = b.colour; })

// Transformations.
CORANK_ACTION(transform_word, {
  b.transform_name = small_letters(in.string_view());
  b.transform_where = place(in, b);
  b.values_before_transform = b.values.size();
})
CORANK_ACTION0(transform_inverse, { b.transform_is_inverse = true; })
CORANK_ACTION0(transform_end, { b.finish_transform(); })

// Dynamics.
CORANK_ACTION0(dynamics_end, {
  b.values.clear();
  b.pass_over("dynamics (masses, inertia, velocities, forces …)");
})

// Shapes.
CORANK_ACTION(quoted_text, {
  b.quoted = in.string();
  b.quoted_where = place(in, b);
  b.quoted_where.column -= 1;  // the quotation mark
})
CORANK_ACTION(body_word, { b.shape_where = place(in, b); })
CORANK_ACTION(box_word, { b.shape_where = place(in, b); })
CORANK_ACTION(prism_word, { b.shape_where = place(in, b); })
CORANK_ACTION(sphere_word, { b.shape_where = place(in, b); })
CORANK_ACTION(cylinder_word, { b.shape_where = place(in, b); })
CORANK_ACTION(line_word, { b.shape_where = place(in, b); })
CORANK_ACTION(segments_word, { b.shape_where = place(in, b); })
CORANK_ACTION0(hidden_word, { b.hidden = true; })
void end_shape(PartBuilder& b) {
  b.points.clear();
  b.values.clear();
  b.shape_colour.clear();
  b.hidden = false;
}
CORANK_ACTION0(body_end, { b.finish_body(), end_shape(b); })
CORANK_ACTION0(box_end, { b.finish_box(), end_shape(b); })
CORANK_ACTION0(prism_end, { b.finish_prism(), end_shape(b); })
CORANK_ACTION0(sphere_end, { b.finish_solid(Shape::Kind::sphere), end_shape(b); })
CORANK_ACTION0(cylinder_end, { b.finish_solid(Shape::Kind::cylinder), end_shape(b); })
CORANK_ACTION0(line_end, { b.finish_solid(Shape::Kind::polygon), end_shape(b); })
CORANK_ACTION0(segments_end, { b.finish_segments(), end_shape(b); })
CORANK_ACTION(segment_point_end, { b.points.push_back({b.pop_vector(), {}, place(in, b)}); })

// Links.
CORANK_ACTION0(links_header, {
  b.in_obstacles = false;
  b.link_has_parts = false;
})
CORANK_ACTION0(link_separator, { b.link_has_parts = true; })
CORANK_ACTION(link_name, {
  const SourceLocation where = place(in, b);
  const char next = next_character(in, b);
  if (next != ':' && next != '-' && b.link_has_parts && follows_in_line(in, b))
    refuse_word_behind_link(in.string(), b.robot.links.back().name, where);
  b.begin_link(in.string(), where);
})
CORANK_ACTION(point_name, { declare(in, b); })
CORANK_ACTION0(point_end, { b.finish_named_point(); })

// Joints.
template <typename ActionInput>
void begin_joint(const ActionInput& in, PartBuilder& b) {
  b.begin_joint(in.string_view(), place(in, b));
}
CORANK_ACTION(axis_kind, { begin_joint(in, b); })
CORANK_ACTION(point_kind, { begin_joint(in, b); })
CORANK_ACTION(slot_kind, { begin_joint(in, b); })
CORANK_ACTION(fixed_kind, { begin_joint(in, b); })
CORANK_ACTION(gear_kind, { begin_joint(in, b); })
CORANK_ACTION(connector_kind, { begin_joint(in, b); })
CORANK_ACTION(refused_kind, {
  throw ModelError(place(in, b), "joints of the kind " + in_quotes(small_letters(in.string_view())) + " are not supported",
                   symbolic::listed(kind_names(), " or "));
})
CORANK_ACTION(joint_name, {
  b.draft.name = in.string();
  b.draft.name_where = place(in, b);
})
CORANK_ACTION(joint_link, { b.joint_link(in.string_view(), place(in, b)); })
CORANK_ACTION0(bracket_open, { b.bracket_has_two = false; })
CORANK_ACTION0(bracket_comma, { b.bracket_has_two = true; })
CORANK_ACTION(range_bracket, { b.push_bracket(place(in, b)); })
CORANK_ACTION(reference_tuple, { b.draft.references.push_back({b.pop_vector(), false, place(in, b)}); })
CORANK_ACTION(reference_offset, { b.draft.references.push_back({b.pop_vector(), true, place(in, b)}); })
CORANK_ACTION(reference_name, { b.push_named_reference(in.string(), place(in, b)); })
CORANK_ACTION(zero_direction, {
  b.draft.zeros.push_back(b.pop_vector());
  b.draft.zero_where = place(in, b);
})
CORANK_ACTION0(length_end, { b.draft.length = b.pop_value(); })
CORANK_ACTION0(dropped_end, { b.pop_value(); })
CORANK_ACTION0(avoid_word, { b.pass_over("limits to be avoided (avoid limits)"); })
CORANK_ACTION0(actuated_word, { b.draft.actuated = true; })
template <typename ActionInput>
ReadName read_name(const ActionInput& in, const PartBuilder& b) {
  return {b.resolve(in.string_view()), place(in, b)};
}
CORANK_ACTION(driver_name, { b.draft.driver = read_name(in, b); })
CORANK_ACTION(gear_driver, { b.draft.driver = read_name(in, b); })
CORANK_ACTION(gear_follower, { b.draft.follower = read_name(in, b); })
CORANK_ACTION0(ratio_end, { b.draft.ratio = b.pop_value(); })
CORANK_ACTION0(offset_end, { b.draft.offset = b.pop_value(); })
CORANK_ACTION0(gear_end, { b.finish_gear(); })
CORANK_ACTION(keep_parallelograms, { b.robot.keeps_parallelograms = place(in, b); })
CORANK_ACTION0(joint_end, { b.finish_joint(); })
CORANK_ACTION0(connector_end, { b.finish_connector(); })

// Rows of Denavit and Hartenberg.
CORANK_ACTION(dh_convention, { b.begin_dh(in.string_view(), place(in, b)); })
CORANK_ACTION(dh_base, { b.dh.base = b.require_link(read_name(in, b), "the name of a link that is declared before"); })
CORANK_ACTION(dh_column, { b.add_dh_column(in.string_view(), place(in, b)); })
CORANK_ACTION(dh_row_begin, { b.begin_dh_row(place(in, b)); })
CORANK_ACTION0(dh_cell_end, { b.dh.cells.push_back(b.pop_value()); })
CORANK_ACTION0(dh_cells_end, { b.finish_dh_cells(); })
CORANK_ACTION(dh_link_name, {
  b.dh.link = in.string();
  b.dh.link_where = place(in, b);
})
CORANK_ACTION0(dh_row_finished, { b.finish_dh_row(); })
CORANK_ACTION0(dh_end, { b.finish_dh(); })

// The other sections.
CORANK_ACTION0(obstacles_header, { b.in_obstacles = true; })
CORANK_ACTION0(joints_header, {
  b.in_obstacles = false;
  b.last_joint.clear();
})
CORANK_ACTION0(obstacle_shape, { b.pass_over("obstacles"); })
CORANK_ACTION0(collision_check, { b.pass_over("collision checks"); })
CORANK_ACTION(include_name, { declare(in, b); })
CORANK_ACTION0(include_file, {
  const std::string prefix = b.declared;
  b.include(prefix);
})
CORANK_ACTION0(equation_file, { b.read_equations(); })
CORANK_ACTION(model::requirement_line, { b.add_requirement(in.string(), place(in, b)); })
CORANK_ACTION(input_name, { b.add_input(in.string_view(), place(in, b)); })
CORANK_ACTION(output_name, {
  b.output = {};
  b.output.output.name = in.string();
  b.output.output.where = place(in, b);
})
CORANK_ACTION(output_kind, { b.output.kind = small_letters(in.string_view()); })
CORANK_ACTION0(joint_word, { b.output.kind = "joint"; })
CORANK_ACTION(output_link, { b.output.link = read_name(in, b); })
CORANK_ACTION(output_frame, { b.output.frame = read_name(in, b); })
CORANK_ACTION(output_point, { b.output.point = {in.string(), place(in, b)}; })
CORANK_ACTION(output_joint, { b.output.joint = read_name(in, b); })
CORANK_ACTION0(output_tuple, { b.output.vector = b.pop_vector(); })
CORANK_ACTION(output_axis, {
  const char first = small_letters(in.string_view())[0];
  b.output_axis = first == 'p' ? 3 : first - 'x';
})
CORANK_ACTION(output_bracket, { b.finish_output_range(place(in, b)); })
CORANK_ACTION(only_word, { b.begin_only(place(in, b)); })
CORANK_ACTION(only_axis, { b.output.output.asked[small_letters(in.string_view())[0] - 'x'] = true; })
CORANK_ACTION0(keeps_word, { b.draft.pose = {}; })
CORANK_ACTION0(kept_end, { b.output.output.kept = b.draft.pose; })
CORANK_ACTION0(output_end, { b.finish_output(); })
#undef CORANK_ACTION
#undef CORANK_ACTION0

/// In UTF-8, if the text is in Latin 1.
std::string from_latin_1(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return result;
}

bool is_utf8(std::string_view text) {
  peg::memory_input<> in(text.data(), text.data() + text.size(), "");
  return peg::parse<peg::seq<peg::star<peg::utf8::any>, peg::eof>>(in);
}

void parse_text(std::string_view text, PartBuilder& builder) {
  std::string converted;  // some of the suite's files are older than UTF-8
  if (std::filesystem::path(builder.file).extension() == ".world" && !is_utf8(text)) {
    converted = from_latin_1(text);
    text = converted;
  }
  builder.text = text;
  symbolic::parse_text<grammar::parts, Action>(text, builder);
}

/// What has_parts() looks for, and what may hold anything else. A quotation mark without its partner is no fault here.
struct parts_header : peg::sor<grammar::links_header, grammar::dh_header, grammar::include_header> {};
struct text_in_quotes : peg::seq<peg::one<'"'>, peg::star<peg::not_one<'"', '\n'>>, peg::one<'"'>> {};
struct other_text : peg::sor<symbolic::grammar::line_comment, grammar::hash_comment,
                             peg::seq<peg::string<'/', '*'>, peg::until<peg::sor<peg::string<'*', '/'>, peg::eof>>>,
                             text_in_quotes, peg::any> {};
struct parts_search : peg::seq<peg::star<peg::not_at<parts_header>, other_text>, parts_header> {};

}  // namespace

bool has_parts(std::string_view text) {
  peg::memory_input<> in(text.data(), text.data() + text.size(), "");
  return peg::parse<parts_search>(in);
}

Robot parse_parts(std::string_view text, const std::string& file, const std::optional<std::filesystem::path>& folder) {
  PartBuilder builder(file, folder);
  builder.parse_included = [&](const std::string& included) { parse_text(included, builder); };
  parse_text(text, builder);
  builder.finish();
  return std::move(builder.robot);
}

void parse_more(Robot& robot, std::string_view text, const std::string& file) {
  PartBuilder builder(file, std::nullopt);
  builder.go_on_with(robot);
  parse_text(text, builder);
  builder.finish();
  robot = std::move(builder.robot);
}

}  // namespace corank::kinematics
