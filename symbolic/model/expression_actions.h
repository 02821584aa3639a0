// What the tokens of an expression, of comments and of section headers mean, to any grammar that has expressions
// (model_file.cc, kinematics/language/part_file.cc).
#pragma once

#include <string>
#include <tao/pegtl.hpp>

#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_builder.h"
#include "corank/symbolic/model/model_grammar.h"

namespace corank::symbolic {

using TextInput = tao::pegtl::memory_input<tao::pegtl::tracking_mode::eager, tao::pegtl::eol::lf_crlf, const char*>;

template <typename AnyInput>
SourceLocation place(const AnyInput& in, const ModelBuilder& builder) {
  const tao::pegtl::position p = in.position();
  return {builder.file, static_cast<int>(p.line), static_cast<int>(p.column)};
}

/// The place that an expression keeps.
template <typename AnyInput>
SourceLocation expression_place(const AnyInput& in, const ModelBuilder& builder) {
  return builder.keep_places ? place(in, builder) : SourceLocation{};
}

template <typename ActionInput>
void end_operand(const ActionInput& in, ModelBuilder& b) {
  b.token_end = place(in, b);
  b.token_end.column += static_cast<int>(in.size());
  b.equation_is_empty = false;
}

/// What is declared here.
template <typename ActionInput>
void declare(const ActionInput& in, ModelBuilder& b) {
  b.declared = in.string();
  b.declared_where = place(in, b);
}

/// To be inherited by an Action that means more.
template <typename Rule>
struct ExpressionAction : tao::pegtl::nothing<Rule> {};

/// Specializes the template of actions of a grammar, whose actions fill a builder: with the input, and without.
#define CORANK_ACTION_OF(Actions, Builder, rule, ...)                \
  template <>                                                        \
  struct Actions<grammar::rule> {                                    \
    template <typename ActionInput>                                  \
    static void apply(const ActionInput& in, Builder& b) __VA_ARGS__ \
  };
#define CORANK_ACTION0_OF(Actions, Builder, rule, ...) \
  template <>                                          \
  struct Actions<grammar::rule> {                      \
    static void apply0(Builder& b) __VA_ARGS__         \
  };
#define CORANK_EXPRESSION_ACTION(rule, ...) CORANK_ACTION_OF(ExpressionAction, ModelBuilder, rule, __VA_ARGS__)
#define CORANK_EXPRESSION_ACTION0(rule, ...) CORANK_ACTION0_OF(ExpressionAction, ModelBuilder, rule, __VA_ARGS__)

CORANK_EXPRESSION_ACTION(section_title, {
  b.section_title = in.string();
  b.section_where = place(in, b);
  b.section_where.column -= 1;  // the bracket
})

CORANK_EXPRESSION_ACTION(percent_token, {
  const std::string_view number = in.string_view().substr(0, in.string_view().find_first_of(" \t\r\f\v%"));
  b.finish_tolerance(ModelBuilder::ToleranceForm::percent, normal_decimal(number, place(in, b)));
})
CORANK_EXPRESSION_ACTION0(tolerance_end, { b.finish_tolerance(ModelBuilder::ToleranceForm::absolute); })
CORANK_EXPRESSION_ACTION0(value_range_end, { b.finish_tolerance(ModelBuilder::ToleranceForm::range); })
CORANK_EXPRESSION_ACTION0(expression_begin, { b.expressions.begin(); })
CORANK_EXPRESSION_ACTION0(expression_end, { b.values.push_back(b.expressions.end()); })
CORANK_EXPRESSION_ACTION(number_token, {
  const std::string decimal =
      normal_decimal(in.string_view(), place(in, b));  // a fault has a place even where nodes have none
  b.expressions.operand(Expression::number(decimal, expression_place(in, b)));
  end_operand(in, b);
})
CORANK_EXPRESSION_ACTION(degrees_token, {
  const std::string_view number = in.string_view().substr(0, in.size() - std::string_view("deg").size());
  b.expressions.operand(degrees(normal_decimal(number, place(in, b)), expression_place(in, b)));
  end_operand(in, b);
})
CORANK_EXPRESSION_ACTION(name_token, {
  b.name = in.string();
  b.name_where = place(in, b);
  end_operand(in, b);
})
CORANK_EXPRESSION_ACTION0(symbol_end, {
  if (is_function_name(b.name))
    throw ModelError(b.name_where, "the function " + in_quotes(b.name) + " has no argument", b.name + "(…)");
  b.expressions.symbol(b.name, b.keep_places ? b.name_where : SourceLocation{});
})
CORANK_EXPRESSION_ACTION(group_open, {
  b.expressions.open(place(in, b));
  b.equation_is_empty = false;
})
CORANK_EXPRESSION_ACTION(call_open, {
  if (!is_function_name(b.name))
    throw ModelError(b.name_where, "unknown function " + in_quotes(b.name),
                     "an operator after the name, or one of " + function_names());
  b.expressions.open(place(in, b), b.name, b.keep_places ? b.name_where : SourceLocation{});
})
CORANK_EXPRESSION_ACTION(group_close, {
  b.expressions.close();
  end_operand(in, b);
})
CORANK_EXPRESSION_ACTION0(exponent_sign, { b.expressions.sign(ExpressionBuilder::SignOf::exponent); })
CORANK_EXPRESSION_ACTION0(factor_sign, { b.expressions.sign(ExpressionBuilder::SignOf::factor); })
CORANK_EXPRESSION_ACTION0(term_sign, {
  b.expressions.sign(ExpressionBuilder::SignOf::term);
  b.equation_is_empty = false;
})
CORANK_EXPRESSION_ACTION0(minus_sign, { b.expressions.sign(ExpressionBuilder::SignOf::term); })
CORANK_EXPRESSION_ACTION0(divide, { b.expressions.division(); })
CORANK_EXPRESSION_ACTION0(power_end, { b.expressions.end_power(); })
CORANK_EXPRESSION_ACTION0(term_end, { b.expressions.end_term(); })

#undef CORANK_EXPRESSION_ACTION
#undef CORANK_EXPRESSION_ACTION0

}  // namespace corank::symbolic
