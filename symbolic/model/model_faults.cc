#include "corank/symbolic/model/model_faults.h"

#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {
namespace {

const char* const kSections =
    "[CONSTANTS], [SYSTEM VARS], [SECONDARY VARS], [DUMMY VARS], [CARTESIAN VARS], [SYSTEM EQS], [COORD EQS], [DUMMY EQS], "
    "[IMPLIED EQS], [RATES], [VELOCITY EQS], [SEARCH], [INPUTS], [OUTPUTS], [LIMITS], [REQUIREMENTS] or [DRAWING]";
const char* const kOperand = "a number, a name, a function or '('";

/// Length of what Rule matches at the beginning of the text; 0 where it does not.
template <typename Rule>
std::size_t match_length(std::string_view text) {
  tao::pegtl::memory_input<> in(text.data(), text.data() + text.size(), "");
  return tao::pegtl::parse<Rule>(in) ? in.current() - text.data() : 0;
}

std::string hexadecimal(char c) {
  const char* const digits = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("0x") + digits[byte / 16] + digits[byte % 16];
}

struct relation_sign : tao::pegtl::sor<tao::pegtl::string<':', '='>, tao::pegtl::string<'<', '='>,
                                       tao::pegtl::string<'>', '='>, tao::pegtl::utf8::any> {};

}  // namespace

std::string name_at(std::string_view text) { return std::string(text.substr(0, match_length<grammar::identifier>(text))); }

std::string describe_start(std::string_view text) {
  if (text.empty()) return "the end of the text";
  if (text[0] == '\n' || text[0] == '\r' || text[0] == '%' || text.substr(0, 2) == "//") return "the end of the line";
  std::size_t n = match_length<grammar::identifier>(text);
  if (n == 0) n = match_length<grammar::decimal>(text);
  if (n > 0) return in_quotes(text.substr(0, n));
  if (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F) return "the control character " + hexadecimal(text[0]);
  return in_quotes(text.substr(0, std::max<std::size_t>(match_length<relation_sign>(text), 1)));
}

void Fault::say(const std::string& problem, const std::string& expectation) const {
  throw ModelError(where, problem, expectation);
}

void Fault::found_instead_of(const std::string& expectation) const {
  if (!rest.empty() && rest[0] == ')' && !builder.expressions.open_parenthesis())
    say("found ')' without a '('", expectation);
  say("found " + describe_start(rest), expectation);
}

void Fault::say_behind_last_operand(const std::string& problem, const std::string& expectation) const {
  const bool line_above = builder.token_end.line > 0 && builder.token_end.line < where.line;
  throw ModelError(line_above ? builder.token_end : where, problem, expectation);
}

void Fault::no_operand() const {
  if (builder.equation_is_empty && !rest.empty() && rest[0] == ';') say("the equation is empty", "left side = right side;");
  found_instead_of(kOperand);
}

// Of `l := 100 cm` the unit is read as the next constant's name.
void Fault::no_assign() const {
  const bool next_thing = rest.empty() || rest[0] == '[' || rest[0] == '\n' || rest[0] == '\r' || !name_at(rest).empty();
  found_instead_of(std::string("':=' after the constant's name") + (next_thing ? "; a number has no unit behind it" : ""));
}

void Fault::no_relation() const {
  if (rest.empty() || rest[0] == ';' || rest[0] == '[') {
    say_behind_last_operand(
        "the equation that begins in line " + std::to_string(builder.equation_where.line) + " has no relation",
        "'=', '<=' or '>='");
  }
  found_instead_of("an operator, '=', '<=' or '>='");
}

void Fault::no_equation_end() const {
  if (!rest.empty() && (rest[0] == '=' || rest[0] == '<' || rest[0] == '>')) {
    say("found a second relation, " + describe_start(rest) + ", in the equation that begins in line " +
            std::to_string(builder.equation_where.line),
        "';' at the end of each equation");
  }
  const bool next_thing = rest.empty() || rest[0] == '[' || !name_at(rest).empty();
  if (next_thing && builder.token_end.line < where.line)
    say_behind_last_operand("the equation has no ';' at its end", "an operator or ';'");
  if (rest.empty()) say("the equation has no ';' at its end", "an operator or ';'");
  found_instead_of("an operator, or ';' at the end of the equation");
}

void Fault::no_group_close() const {
  const std::optional<SourceLocation> opened = builder.expressions.open_parenthesis();
  say("found " + describe_start(rest) + " inside the parentheses opened in " + std::to_string(opened->line) + ":" +
          std::to_string(opened->column),
      "an operator or ')'");
}

void Fault::no_number_end() const {
  say("found " + describe_start(rest) + " right after a number",
      "an operator (a product is written 2*x), or a name that does not begin with a digit");
}

void Fault::no_range() const {
  if (builder.of_limits)
    say("found " + describe_start(rest) + " where the limits of " + in_quotes(builder.declared) + " should be",
        "[lower, upper]");
  say("found " + describe_start(rest) + " where the range of " + in_quotes(builder.declared) + " should be",
      "[lower, upper], or nothing if the equations bound the variable");
}

void Fault::unknown_section() const {
  const std::string title(trimmed(builder.section_title));
  if (title.find(',') != std::string::npos)
    throw ModelError(builder.section_where, "section [" + shortened(title) + "] is unknown",
                     "a section; write the range of a variable in the variable's line");
  const bool known_to_cuik = title == "VELOCITY VARS" || title == "NON DYNAMIC VARS" || title == "NON DYNAMIC EQS";
  const char* const why = known_to_cuik ? "] is not supported" : "] is unknown";
  throw ModelError(builder.section_where, "section [" + shortened(title) + why, kSections);
}

void Fault::no_search_order() const {
  const char* const kOrders = "DEPTH FIRST, BREADTH FIRST, or no [SEARCH]: every order finds the same solutions";
  const std::string found = describe_start(rest);
  if (found == "'MIN'") say("the search order MIN is not supported", kOrders);
  say("found " + found + " in [SEARCH]", kOrders);
}

void Fault::no_plain_text() const {
  if (rest[0] == '\0') say("found a NUL byte", "plain text");
  say("found the byte " + hexadecimal(rest[0]) + ", which is not UTF-8", "plain text in UTF-8");
}

}  // namespace corank::symbolic
