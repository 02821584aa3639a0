#include "corank/symbolic/writing/mathml.h"

#include <cctype>

#include "corank/symbolic/model/display_name.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

std::string element(const char* tag, const std::string& inside) {
  return std::string("<") + tag + ">" + inside + "</" + tag + ">";
}
std::string row(const std::string& inside) { return element("mrow", inside); }
std::string sign(const char* text) { return element("mo", text); }
const char* const kInvisibleTimes = "&#x2062;";
constexpr const char* kThinSpace = "<mspace width=\"0.17em\"/>";
const char* const kApply = "&#x2061;";

std::string fenced(const std::string& inside) { return row(sign("(") + inside + sign(")")); }
std::string fenced_if(bool needed, const Expression& e) { return needed ? fenced(mathml(e)) : mathml(e); }

// One letter is slanted, digits and words stand upright.
std::string base_and_subscript(const DisplayName& shown) {
  const bool letter = shown.subscript.size() == 1 && !std::isdigit(static_cast<unsigned char>(shown.subscript[0]));
  return element("mi", html_text(shown.base)) + element(letter ? "mi" : "mn", html_text(shown.subscript));
}

std::string mathml_number(const std::string& decimal) {
  const std::size_t e = decimal.find('e');
  if (e == std::string::npos) return element("mn", decimal);
  std::string exponent = decimal.substr(e + 1);
  const bool negative = exponent[0] == '-';
  if (negative) exponent.erase(0, 1);
  exponent = (negative ? sign("−") : "") + element("mn", exponent);
  return row(element("mn", decimal.substr(0, e)) + sign("·") + element("msup", element("mn", "10") + row(exponent)));
}

/// `exponent` stands behind the function's name, as in cos²θ.
std::string mathml_function(const Expression& e, const std::string& exponent = "") {
  const Expression& argument = e.operands()[0];
  if (e.name() == "sqrt") return element("msqrt", mathml(argument));
  if (e.name() == "abs") return row(sign("|") + mathml(argument) + sign("|"));
  const bool arc = e.name() == "asin" || e.name() == "acos" || e.name() == "atan";
  const std::string name = element("mi", arc ? "arc" + e.name().substr(1) : e.name());
  const std::string head = exponent.empty() ? name : element("msup", name + exponent);
  const bool bare = argument.kind() == Kind::symbol;
  return row(head + sign(kApply) + (bare ? kThinSpace : "") + fenced_if(!bare, argument));
}

std::string mathml_power(const Expression& e) {
  const Expression &base = e.operands()[0], &exponent = e.operands()[1];
  if (base.is_named_function() && exponent.is_whole_number()) return mathml_function(base, mathml(exponent));
  if (base.kind() == Kind::symbol) {
    const DisplayName shown = display_name(base.name());
    if (!shown.subscript.empty()) return element("msubsup", base_and_subscript(shown) + row(mathml(exponent)));
  }
  return element("msup", fenced_if(!base.is_bare_base(), base) + row(mathml(exponent)));
}

std::string mathml_sum(const Expression& e) {
  std::string text;
  for (const Expression& term : e.operands()) {
    const bool subtracted = !text.empty() && term.kind() == Kind::negation;
    if (!text.empty()) text += sign(subtracted ? "−" : "+");
    const Expression& printed = subtracted ? term.operands()[0] : term;
    text += fenced_if(printed.kind() == Kind::sum || (subtracted && printed.kind() == Kind::negation), printed);
  }
  return row(text);
}

bool begins_with_a_number(const Expression& e) {
  if (e.kind() == Kind::number) return true;
  const bool goes_on = e.kind() == Kind::power || e.kind() == Kind::product;
  return goes_on && begins_with_a_number(e.operands()[0]);
}

bool begins_with_a_function(const Expression& e) {
  return e.is_named_function() || (e.kind() == Kind::power && e.operands()[0].is_named_function());
}

std::string mathml_product(const Expression& e) {
  std::string text;
  const Expression* left = nullptr;
  for (const Expression& factor : e.operands()) {
    // Behind a function the argument would seem to go on, behind a letter a number would seem to be its index.
    const bool dot = left && (left->is_named_function() ? !factor.is_named_function() : begins_with_a_number(factor));
    if (left) text += sign(dot ? "·" : kInvisibleTimes);
    if (left && !dot && begins_with_a_function(factor)) text += kThinSpace;  // "rb cos", not "rbcos"
    text += fenced_if(factor.is_sum_or_negation() || (left && factor.kind() == Kind::product), factor);
    left = &factor;
  }
  return row(text);
}

}  // namespace

std::string mathml_name(const std::string& name) {
  const DisplayName shown = display_name(name);
  return shown.subscript.empty() ? element("mi", html_text(shown.base)) : element("msub", base_and_subscript(shown));
}

std::string mathml(const Expression& e) {
  switch (e.kind()) {
    case Kind::number: return mathml_number(e.name());
    case Kind::symbol: return mathml_name(e.name());
    case Kind::function: return mathml_function(e);
    case Kind::sum: return mathml_sum(e);
    case Kind::product: return mathml_product(e);
    case Kind::quotient: return element("mfrac", row(mathml(e.operands()[0])) + row(mathml(e.operands()[1])));
    case Kind::power: return mathml_power(e);
    case Kind::negation: return row(sign("−") + fenced_if(e.operands()[0].is_sum_or_negation(), e.operands()[0]));
  }
  return "";
}

std::string mathml(const Relation& relation) {
  const char* const text = relation.kind == Relation::Kind::equal        ? "="
                           : relation.kind == Relation::Kind::less_equal ? "≤"
                                                                         : "≥";
  return row(mathml(relation.lhs) + sign(text) + mathml(relation.rhs));
}

std::string mathml(const ExpressionMatrix& matrix) {
  std::string rows;
  for (const auto& expressions : matrix.rows) {
    std::string cells;
    for (const Expression& e : expressions) cells += element("mtd", mathml(e));
    rows += element("mtr", cells);
  }
  return "<mtable class=\"matrix\">" + rows + "</mtable>";
}

std::string math(const std::string& inside, bool block) {
  return (block ? "<math display=\"block\">" : "<math>") + inside + "</math>";
}

}  // namespace corank::symbolic
