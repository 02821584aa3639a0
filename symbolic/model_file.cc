#include "corank/symbolic/model_file.h"

#include <fstream>
#include <iterator>

#include "corank/symbolic/expression_words.h"
#include "corank/symbolic/model_builder.h"
#include "corank/symbolic/model_faults.h"
#include "corank/symbolic/model_grammar.h"

namespace corank::symbolic {
namespace {

namespace peg = tao::pegtl;

constexpr std::size_t kMaxFileBytes = std::size_t{8} << 20;

using Input = peg::memory_input<peg::tracking_mode::eager, peg::eol::lf_crlf, const char*>;

template <typename AnyInput>
SourceLocation place(const AnyInput& in, const ModelBuilder& builder) {
  const peg::position p = in.position();
  return {builder.file, static_cast<int>(p.line), static_cast<int>(p.column)};
}

/// The place that an expression keeps.
template <typename AnyInput>
SourceLocation expression_place(const AnyInput& in, const ModelBuilder& builder) {
  return builder.keep_places ? place(in, builder) : SourceLocation{};
}

/// What a token means.
template <typename Rule>
struct Action : peg::nothing<Rule> {};

#define CORANK_ACTION(rule, ...)                                          \
  template <>                                                             \
  struct Action<grammar::rule> {                                          \
    template <typename ActionInput>                                       \
    static void apply(const ActionInput& in, ModelBuilder& b) __VA_ARGS__ \
  };
#define CORANK_ACTION0(rule, ...)                   \
  template <>                                       \
  struct Action<grammar::rule> {                    \
    static void apply0(ModelBuilder& b) __VA_ARGS__ \
  };

template <typename ActionInput>
void declare(const ActionInput& in, ModelBuilder& b) {
  b.declared = in.string();
  b.declared_where = place(in, b);
}

template <typename ActionInput>
void end_operand(const ActionInput& in, ModelBuilder& b) {
  b.token_end = place(in, b);
  b.token_end.column += static_cast<int>(in.size());
  b.equation_is_empty = false;
}

CORANK_ACTION(block_comment_open, { b.comment_where = place(in, b); })

CORANK_ACTION0(expression_begin, { b.expressions.begin(); })
CORANK_ACTION0(expression_end, { b.values.push_back(b.expressions.end()); })
CORANK_ACTION(number_token, {
  const std::string decimal =
      normal_decimal(in.string_view(), place(in, b));  // a fault has a place even where nodes have none
  b.expressions.number(decimal, expression_place(in, b));
  end_operand(in, b);
})
CORANK_ACTION(name_token, {
  b.name = in.string();
  b.name_where = place(in, b);
  end_operand(in, b);
})
CORANK_ACTION0(symbol_end, {
  if (is_function_name(b.name)) {
    throw ModelError(b.name_where, "the function " + in_quotes(b.name) + " stands without an argument", b.name + "(…)");
  }
  b.expressions.symbol(b.name, b.keep_places ? b.name_where : SourceLocation{});
})
CORANK_ACTION(group_open, {
  b.expressions.open_group(place(in, b));
  b.equation_is_empty = false;
})
CORANK_ACTION(call_open, {
  if (!is_function_name(b.name)) {
    throw ModelError(b.name_where, "unknown function " + in_quotes(b.name),
                     "an operator behind the name, or one of " + function_names());
  }
  b.expressions.open_call(b.name, b.keep_places ? b.name_where : SourceLocation{}, place(in, b));
})
CORANK_ACTION(group_close, {
  b.expressions.close_group();
  end_operand(in, b);
})
CORANK_ACTION0(exponent_sign, { b.expressions.sign(ExpressionBuilder::SignOf::exponent); })
CORANK_ACTION0(factor_sign, { b.expressions.sign(ExpressionBuilder::SignOf::factor); })
CORANK_ACTION0(term_sign, {
  b.expressions.sign(ExpressionBuilder::SignOf::term);
  b.equation_is_empty = false;
})
CORANK_ACTION0(minus_sign, { b.expressions.sign(ExpressionBuilder::SignOf::term); })
CORANK_ACTION0(divide, { b.expressions.division(); })
CORANK_ACTION0(power_end, { b.expressions.end_power(); })
CORANK_ACTION0(term_end, { b.expressions.end_term(); })

CORANK_ACTION(section_title, {
  b.section_title = in.string();
  b.section_where = place(in, b);
  b.section_where.column -= 1;  // the bracket
})
CORANK_ACTION(constant_name, { declare(in, b); })
CORANK_ACTION0(constant_end, { b.finish_constant(); })
CORANK_ACTION(variables_header, {
  const std::string_view title = in.string_view();
  b.auxiliary = title.find("DUMMY") != title.npos || title.find("CARTESIAN") != title.npos;
})
CORANK_ACTION(variable_name, { declare(in, b); })
CORANK_ACTION0(length_mark, { b.kind = CoordinateKind::length; })
CORANK_ACTION0(angle_mark, { b.kind = CoordinateKind::angle; })
CORANK_ACTION0(variable_end, { b.finish_variable(); })
CORANK_ACTION0(no_range, { b.finish_variable(); })
CORANK_ACTION(composite_word,
              { b.finish_composite(in.string_view() == "unit" ? Composite::Kind::unit : Composite::Kind::rotation); })
CORANK_ACTION(equations_header, { b.implied = in.string_view().find("IMPLIED") != std::string_view::npos; })
CORANK_ACTION(equation_begin, {
  b.equation_where = place(in, b);
  b.equation_is_empty = true;
})
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
    throw ModelError(where, in_quotes(in.string_view()) + " is no variable", "the name of a variable");
  (b.names_are_inputs ? b.inputs : b.outputs).push_back(Expression::symbol(in.string(), where));
})
CORANK_ACTION(point_name, { declare(in, b); })
CORANK_ACTION0(point_end, { b.finish_point(); })
CORANK_ACTION(unit_name, { b.drawing.unit = in.string(); })
CORANK_ACTION(slider_word, { b.begin_part(DrawingPart::Kind::slider, place(in, b)); })
CORANK_ACTION(hinge_word, { b.begin_part(DrawingPart::Kind::hinge, place(in, b)); })
CORANK_ACTION(sphere_word, { b.begin_part(DrawingPart::Kind::sphere, place(in, b)); })
CORANK_ACTION(cylinder_word, { b.begin_part(DrawingPart::Kind::cylinder, place(in, b)); })
CORANK_ACTION(part_word, {
  for (const auto part : {DrawingPart::Kind::link, DrawingPart::Kind::platform, DrawingPart::Kind::joint,
                          DrawingPart::Kind::ground, DrawingPart::Kind::effector, DrawingPart::Kind::ball}) {
    if (in.string_view() == to_string(part)) b.begin_part(part, place(in, b));
  }
})
CORANK_ACTION(part_point, { b.drawing.parts.back().points.push_back(in.string()); })
CORANK_ACTION0(part_radius, { b.finish_radius(); })
CORANK_ACTION(colour_digits, { b.drawing.parts.back().colour = "#" + in.string(); })
#undef CORANK_ACTION
#undef CORANK_ACTION0

/// Turns a failed must<Rule> into the ModelError that FaultOf<Rule> words.
template <typename Rule>
struct Control : peg::normal<Rule> {
  template <typename AnyInput>
  [[noreturn]] static void raise(const AnyInput& in, ModelBuilder& builder) {
    const bool unfinished_comment = std::is_same_v<Rule, grammar::block_comment_rest>;
    FaultOf<Rule>::raise({builder, unfinished_comment ? builder.comment_where : place(in, builder),
                          std::string_view(in.current(), in.size())});
    throw std::logic_error("a fault that says nothing");
  }
};

/// Returns the place of the text's end.
template <typename Rule>
SourceLocation parse_text(std::string_view text, ModelBuilder& builder) {
  if (text.size() > kMaxFileBytes) {
    throw ModelError({builder.file, 0, 0}, "the text has " + std::to_string(text.size()) + " bytes",
                     "at most " + std::to_string(kMaxFileBytes));
  }
  Input plain(text.data(), text.data() + text.size(), "");
  peg::parse<grammar::plain_text, peg::nothing, Control>(plain, builder);
  Input in(text.data(), text.data() + text.size(), "");
  if (!peg::parse<Rule, Action, Control>(in, builder)) throw std::logic_error("a grammar that fails without a fault");
  return place(in, builder);
}

}  // namespace

Mechanism parse_model(std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  builder.mechanism = Mechanism(std::filesystem::path(file).stem().string());
  builder.mechanism.set_source_text(std::string(text));
  const SourceLocation end = parse_text<grammar::model>(text, builder);
  builder.finish(end);
  return std::move(builder.mechanism);
}

Mechanism read_model(const std::filesystem::path& path) {
  const std::string file = path.string();
  const SourceLocation where{file, 0, 0};
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw ModelError(where, "there is no such file", "a model file");
  if (std::filesystem::is_directory(status)) throw ModelError(where, "is a directory", "a model file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ModelError(where, "the file cannot be opened", "a readable model file");
  std::string text(kMaxFileBytes + 1, '\0');  // one byte more than may be: parse_text refuses it
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw ModelError(where, "the file cannot be read", "a readable model file");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_model(text, file);
}

Expression parse_expression(std::string_view text, const std::string& file) {
  ModelBuilder builder(file);
  parse_text<grammar::lone_expression>(text, builder);
  return builder.values.at(0);
}

Expression parse_anonymous_expression(std::string_view text) {
  ModelBuilder builder(in_quotes(text), false);
  parse_text<grammar::lone_expression>(text, builder);
  return builder.values.at(0);
}

}  // namespace corank::symbolic
