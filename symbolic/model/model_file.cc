#include "corank/symbolic/model/model_file.h"

#include "corank/symbolic/model/expression_actions.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_builder.h"
#include "corank/symbolic/model/model_faults.h"
#include "corank/symbolic/model/model_grammar.h"
#include "corank/symbolic/model/parse_text.h"
#include "corank/symbolic/model/text_file.h"

namespace corank::symbolic {
namespace {

/// What a token means.
template <typename Rule>
struct Action : ExpressionAction<Rule> {};

#define CORANK_ACTION(rule, ...) CORANK_ACTION_OF(Action, ModelBuilder, rule, __VA_ARGS__)
#define CORANK_ACTION0(rule, ...) CORANK_ACTION0_OF(Action, ModelBuilder, rule, __VA_ARGS__)

CORANK_ACTION(constant_name, { declare(in, b); })
CORANK_ACTION0(constant_end, { b.finish_constant(); })
CORANK_ACTION(stray_percent, {
  throw ModelError(place(in, b), "this % is neither a percent sign nor the beginning of a comment",
                   "a number before a percent sign, ± 5%, or a blank before a comment");
})
CORANK_ACTION(variables_header, {
  const std::string_view title = in.string_view();
  b.of_limits = false;
  b.auxiliary = title.find("DUMMY") != title.npos || title.find("CARTESIAN") != title.npos;
})
CORANK_ACTION0(limits_header, { b.of_limits = true; })
CORANK_ACTION(limit_name, { declare(in, b); })
CORANK_ACTION0(limit_end, {
  b.limits.push_back({b.declared, b.values.at(0), b.values.at(1), b.declared_where});
  b.values.clear();
})
CORANK_ACTION(variable_name, { declare(in, b); })
CORANK_ACTION0(length_mark, { b.kind = CoordinateKind::length; })
CORANK_ACTION0(angle_mark, { b.kind = CoordinateKind::angle; })
CORANK_ACTION0(variable_end, { b.finish_variable(); })
CORANK_ACTION0(no_range, { b.finish_variable(); })
CORANK_ACTION(composite_word,
              { b.finish_composite(in.string_view() == "unit" ? Composite::Kind::unit : Composite::Kind::rotation); })
CORANK_ACTION(equations_header, {
  b.implied = in.string_view().find("IMPLIED") != std::string_view::npos;
  b.of_rates = in.string_view().find("VELOCITY") != std::string_view::npos;
})
CORANK_ACTION(rate_name, { declare(in, b); })
CORANK_ACTION(role_word, {
  for (const Role role : {Role::input, Role::output, Role::passive})
    if (in.string_view() == to_string(role)) b.mechanism.rate(b.declared, b.kind, role, b.declared_where);
})
CORANK_ACTION(equation_begin, {
  b.equation_where = place(in, b);
  b.equation_is_empty = true;
  b.inequality_name.clear();
})
CORANK_ACTION(inequality_name, { b.inequality_name = in.string(); })
CORANK_ACTION(relation, {
  const char sign = *in.begin();
  b.relation = sign == '='   ? Relation::Kind::equal
               : sign == '<' ? Relation::Kind::less_equal
                             : Relation::Kind::greater_equal;
})
CORANK_ACTION0(equation_end, { b.finish_equation(); })
CORANK_ACTION0(inputs_header, { b.names_are_inputs = true; })
CORANK_ACTION0(outputs_header, { b.names_are_inputs = false; })
CORANK_ACTION(listed_name, {
  const SourceLocation where = place(in, b);
  if (is_reserved(in.string_view()))
    throw ModelError(where, in_quotes(in.string_view()) + " is not a variable", "the name of a variable");
  (b.names_are_inputs ? b.inputs : b.outputs).push_back(Expression::symbol(in.string(), where));
})
CORANK_ACTION(requirement_line, {
  std::string text = in.string();
  text.resize(text.find_last_not_of(" \t\r\n") + 1);
  b.mechanism.require(text, place(in, b));
})
CORANK_ACTION(point_name, { declare(in, b); })
CORANK_ACTION0(moves_word, { b.point_coordinates = b.values.size(); })
CORANK_ACTION0(point_end, { b.finish_point(); })
CORANK_ACTION(unit_name, { b.drawing.unit = in.string(); })
template <typename ActionInput>
void begin_part(const ActionInput& in, ModelBuilder& b) {
  b.drawing.parts.push_back({drawing_part_of(in.string_view()), {}, place(in, b)});
}
CORANK_ACTION(slider_word, { begin_part(in, b); })
CORANK_ACTION(hinge_word, { begin_part(in, b); })
CORANK_ACTION(sphere_word, { begin_part(in, b); })
CORANK_ACTION(cylinder_word, { begin_part(in, b); })
CORANK_ACTION(part_word, { begin_part(in, b); })
CORANK_ACTION(part_name, { b.drawing.parts.back().name = in.string(); })
CORANK_ACTION(part_point, { b.drawing.parts.back().points.push_back(in.string()); })
CORANK_ACTION0(part_radius, {
  b.drawing.parts.back().radius = b.values.at(0);
  b.values.clear();
})
CORANK_ACTION(colour_digits, { b.drawing.parts.back().colour = "#" + in.string(); })
#undef CORANK_ACTION
#undef CORANK_ACTION0

}  // namespace

Mechanism parse_model(std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  builder.mechanism = Mechanism(std::filesystem::path(file).stem().string());
  builder.mechanism.set_source_text(std::string(text));
  const SourceLocation end = parse_text<grammar::model, Action>(text, builder);
  builder.finish(end);
  return std::move(builder.mechanism);
}

Mechanism parse_fragment(std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  parse_text<grammar::model, Action>(text, builder);
  return std::move(builder.mechanism);
}

std::string read_text(const std::filesystem::path& path) {
  try {
    return read_bytes(path, kMaxFileBytes + 1);  // one byte more than may be: a parser refuses it
  } catch (const ReadingError& error) {
    throw ModelError({path.string(), 0, 0}, error.what(), "a model file");
  }
}

Mechanism read_model(const std::filesystem::path& path) { return parse_model(read_text(path), path.string()); }

Expression parse_expression(std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  parse_text<grammar::lone_expression, Action>(text, builder);
  return builder.values.at(0);
}

Constant parse_constant(const std::string& name, std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  parse_text<grammar::lone_constant_value, Action>(text, builder);
  return {name, builder.values.at(0), {}, builder.tolerance};
}

Expression parse_anonymous_expression(std::string_view text) {
  ModelBuilder builder(in_quotes(text), false);
  parse_text<grammar::lone_expression, Action>(text, builder);
  return builder.values.at(0);
}

}  // namespace corank::symbolic
