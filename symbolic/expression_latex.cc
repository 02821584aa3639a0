// Expressions in LaTeX, as a paper sets them: d + l_{2}\cos\theta_{2} - l_{5}\cos\theta_{5}.
#include <algorithm>
#include <string_view>

#include "corank/symbolic/display_name.h"
#include "corank/symbolic/expression.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Letters as one symbol: l → l, theta → \theta, ct → \mathit{ct}.
std::string latex_word(std::string_view word, const char* font) {
  if (is_greek_letter(word)) return "\\" + std::string(word);
  if (word.size() == 1) return std::string(word);
  return std::string(font) + "{" + std::string(word) + "}";
}

/// "1_u_x" → "1,u,x"; a piece of several letters and nothing else is set upright.
std::string latex_subscript(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t n = std::min(text.find('_'), text.size());
    const std::string_view piece = text.substr(0, n);
    text.remove_prefix(std::min(n + 1, text.size()));
    if (piece.empty()) continue;
    if (!result.empty()) result += ',';
    result += std::all_of(piece.begin(), piece.end(), is_letter) ? latex_word(piece, "\\mathrm") : std::string(piece);
  }
  return result;
}

std::string latex_number(const std::string& decimal) {
  const std::size_t e = decimal.find('e');
  if (e == std::string::npos) return decimal;
  return decimal.substr(0, e) + " \\cdot 10^{" + decimal.substr(e + 1) + "}";
}

std::string latex_function_name(const std::string& name) {
  if (name == "asin" || name == "acos" || name == "atan") return "\\arc" + name.substr(1);
  return "\\" + name;
}

std::string print(const Expression& e);

/// Tall contents get growing parentheses.
std::string in_parentheses(const std::string& inside) {
  const bool tall = inside.find("\\frac") != std::string::npos;
  return tall ? "\\left(" + inside + "\\right)" : "(" + inside + ")";
}

std::string in_parentheses_if(bool needed, const Expression& e) { return needed ? in_parentheses(print(e)) : print(e); }

/// Written with a name and its argument: not sqrt and abs, which enclose theirs.
bool is_named_function(const Expression& e) { return e.kind() == Kind::function && e.name() != "sqrt" && e.name() != "abs"; }

bool is_integer(const Expression& e) {
  return e.kind() == Kind::number && e.name().find_first_of(".e") == std::string::npos;
}

/// cos²θ is set as \cos^{2}\theta.
bool is_power_of_function(const Expression& e) {
  return e.kind() == Kind::power && is_named_function(e.operands()[0]) && is_integer(e.operands()[1]);
}

std::string print_function(const Expression& e, const std::string& exponent = "") {
  const Expression& argument = e.operands()[0];
  if (e.name() == "sqrt") return "\\sqrt{" + print(argument) + "}";
  if (e.name() == "abs") return "\\left|" + print(argument) + "\\right|";
  const std::string head = latex_function_name(e.name()) + exponent;
  if (argument.kind() != Kind::symbol) return head + in_parentheses(print(argument));
  const std::string name = latex_name(argument.name());
  return head + (name[0] == '\\' ? "" : " ") + name;
}

std::string print_power(const Expression& e) {
  const Expression& base = e.operands()[0];
  const std::string exponent = "^{" + print(e.operands()[1]) + "}";
  if (is_power_of_function(e)) return print_function(base, exponent);
  const bool bare = base.kind() == Kind::symbol ||
                    (base.kind() == Kind::number && base.name().find('e') == std::string::npos) ||
                    (base.kind() == Kind::function && !is_named_function(base));
  return in_parentheses_if(!bare, base) + exponent;
}

std::string print_sum(const Expression& e) {
  std::string result;
  for (const Expression& term : e.operands()) {
    const bool subtracted = !result.empty() && term.kind() == Kind::negation;
    if (!result.empty()) result += subtracted ? " - " : " + ";
    const Expression& printed = subtracted ? term.operands()[0] : term;
    result += in_parentheses_if(printed.kind() == Kind::sum || (subtracted && printed.kind() == Kind::negation), printed);
  }
  return result;
}

/// Between two factors: nothing before a function or a parenthesis, a space between letters, a dot before a number and
/// behind a function, whose argument would seem to go on.
std::string product_sign(const Expression& left, const Expression& right, const std::string& right_text) {
  const bool right_function = is_named_function(right) || is_power_of_function(right);
  if (is_named_function(left) || is_power_of_function(left)) return right_function ? " " : " \\cdot ";
  const char first = right_text[0];
  if ((first >= '0' && first <= '9') || right.kind() == Kind::number || right.kind() == Kind::quotient) return " \\cdot ";
  if (right.kind() == Kind::power && right.operands()[0].kind() == Kind::number) return " \\cdot ";
  return right_function || first == '(' ? "" : " ";
}

std::string print_product(const Expression& e) {
  std::string result;
  const Expression* left = nullptr;
  for (const Expression& factor : e.operands()) {
    const std::string text =
        in_parentheses_if(factor.is_sum_or_negation() || (left && factor.kind() == Kind::product), factor);
    if (left) result += product_sign(*left, factor, text);
    result += text;
    left = &factor;
  }
  return result;
}

std::string print(const Expression& e) {
  switch (e.kind()) {
    case Kind::number: return latex_number(e.name());
    case Kind::symbol: return latex_name(e.name());
    case Kind::function: return print_function(e);
    case Kind::sum: return print_sum(e);
    case Kind::product: return print_product(e);
    case Kind::quotient: return "\\frac{" + print(e.operands()[0]) + "}{" + print(e.operands()[1]) + "}";
    case Kind::power: return print_power(e);
    case Kind::negation: return "-" + in_parentheses_if(e.operands()[0].is_sum_or_negation(), e.operands()[0]);
  }
  return "";
}

}  // namespace

std::string Expression::latex() const { return print(*this); }

std::string latex_name(const std::string& name) {
  const std::size_t n = std::find_if_not(name.begin(), name.end(), is_letter) - name.begin();
  if (n == 0) {  // a name that begins with _ is no word of mathematics
    std::string escaped;
    for (char c : name) escaped += c == '_' ? "\\_" : std::string(1, c);
    return "\\mathtt{" + escaped + "}";
  }
  const std::string base = latex_word(std::string_view(name).substr(0, n), "\\mathit");
  const std::string subscript = latex_subscript(std::string_view(name).substr(n));
  return subscript.empty() ? base : base + "_{" + subscript + "}";
}

}  // namespace corank::symbolic
