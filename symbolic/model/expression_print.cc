// Expressions in the model language, and in LaTeX as a paper sets them.
#include <algorithm>
#include <string_view>

#include "corank/symbolic/model/display_name.h"
#include "corank/symbolic/model/expression.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

// A printed tree parses back to the same tree: parentheses are set exactly where the grammar (model_grammar.h) would group
// otherwise, and around a minus sign that follows an operator, where the grammar could do without but a reader could not.

void print(const Expression& e, std::string& out);

void print_in_parentheses_if(bool needed, const Expression& e, std::string& out) {
  if (needed) out += '(';
  print(e, out);
  if (needed) out += ')';
}

bool is_product_or_quotient(const Expression& e) { return e.kind() == Kind::product || e.kind() == Kind::quotient; }
bool is_atom(const Expression& e) {
  return e.kind() == Kind::number || e.kind() == Kind::symbol || e.kind() == Kind::function;
}

void print_sum(const Expression& e, std::string& out) {
  bool first = true;
  for (const Expression& term : e.operands()) {
    const bool subtracted = !first && term.kind() == Kind::negation;
    if (!first) out += subtracted ? " - " : " + ";
    const Expression& printed = subtracted ? term.operands()[0] : term;
    print_in_parentheses_if(printed.kind() == Kind::sum || (subtracted && printed.kind() == Kind::negation), printed, out);
    first = false;
  }
}

void print_product(const Expression& e, std::string& out) {
  bool first = true;
  for (const Expression& factor : e.operands()) {
    if (!first) out += '*';
    const bool grouped = first ? factor.kind() == Kind::product : is_product_or_quotient(factor);
    print_in_parentheses_if(grouped || factor.is_sum_or_negation(), factor, out);
    first = false;
  }
}

void print(const Expression& e, std::string& out) {
  const std::vector<Expression>& operands = e.operands();
  switch (e.kind()) {
    case Kind::number:
    case Kind::symbol: out += e.name(); break;
    case Kind::function:
      out += e.name();
      print_in_parentheses_if(true, operands[0], out);
      break;
    case Kind::sum: print_sum(e, out); break;
    case Kind::product: print_product(e, out); break;
    case Kind::quotient:
      print_in_parentheses_if(operands[0].is_sum_or_negation(), operands[0], out);
      out += '/';
      print_in_parentheses_if(operands[1].is_sum_or_negation() || is_product_or_quotient(operands[1]), operands[1], out);
      break;
    case Kind::power:
      print_in_parentheses_if(!is_atom(operands[0]), operands[0], out);
      out += '^';
      print_in_parentheses_if(!is_atom(operands[1]) && operands[1].kind() != Kind::power, operands[1], out);
      break;
    case Kind::negation:
      out += '-';
      print_in_parentheses_if(operands[0].is_sum_or_negation(), operands[0], out);
      break;
  }
}

// ---- LaTeX: d + l_{2}\cos\theta_{2} - l_{5}\cos\theta_{5}

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
    result += std::ranges::all_of(piece, is_letter) ? latex_word(piece, "\\mathrm") : std::string(piece);
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

std::string latex_of(const Expression& e);

/// Tall contents get growing parentheses.
std::string in_parentheses(const std::string& inside) {
  const bool tall = inside.find("\\frac") != std::string::npos;
  return tall ? "\\left(" + inside + "\\right)" : "(" + inside + ")";
}

std::string in_parentheses_if(bool needed, const Expression& e) {
  return needed ? in_parentheses(latex_of(e)) : latex_of(e);
}

/// cos²θ is set as \cos^{2}\theta.
bool is_power_of_function(const Expression& e) {
  return e.kind() == Kind::power && e.operands()[0].is_named_function() && e.operands()[1].is_whole_number();
}

std::string latex_function(const Expression& e, const std::string& exponent = "") {
  const Expression& argument = e.operands()[0];
  if (e.name() == "sqrt") return "\\sqrt{" + latex_of(argument) + "}";
  if (e.name() == "abs") return "\\left|" + latex_of(argument) + "\\right|";
  const std::string head = latex_function_name(e.name()) + exponent;
  if (argument.kind() != Kind::symbol) return head + in_parentheses(latex_of(argument));
  const std::string name = latex_name(argument.name());
  return head + (name[0] == '\\' ? "" : " ") + name;
}

std::string latex_power(const Expression& e) {
  const Expression& base = e.operands()[0];
  const std::string exponent = "^{" + latex_of(e.operands()[1]) + "}";
  if (is_power_of_function(e)) return latex_function(base, exponent);
  return in_parentheses_if(!base.is_bare_base(), base) + exponent;
}

std::string latex_sum(const Expression& e) {
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
  const bool right_function = right.is_named_function() || is_power_of_function(right);
  if (left.is_named_function() || is_power_of_function(left)) return right_function ? " " : " \\cdot ";
  const char first = right_text[0];
  if ((first >= '0' && first <= '9') || right.kind() == Kind::number || right.kind() == Kind::quotient) return " \\cdot ";
  if (right.kind() == Kind::power && right.operands()[0].kind() == Kind::number) return " \\cdot ";
  return right_function || first == '(' ? "" : " ";
}

std::string latex_product(const Expression& e) {
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

std::string latex_of(const Expression& e) {
  switch (e.kind()) {
    case Kind::number: return latex_number(e.name());
    case Kind::symbol: return latex_name(e.name());
    case Kind::function: return latex_function(e);
    case Kind::sum: return latex_sum(e);
    case Kind::product: return latex_product(e);
    case Kind::quotient: return "\\frac{" + latex_of(e.operands()[0]) + "}{" + latex_of(e.operands()[1]) + "}";
    case Kind::power: return latex_power(e);
    case Kind::negation: return "-" + in_parentheses_if(e.operands()[0].is_sum_or_negation(), e.operands()[0]);
  }
  return "";
}

}  // namespace

std::string Expression::text() const {
  std::string out;
  print(*this, out);
  return out;
}

std::string Relation::text() const {
  const char* const sign = kind == Kind::equal ? " = " : kind == Kind::less_equal ? " <= " : " >= ";
  return lhs.text() + sign + rhs.text();
}

std::string Expression::latex() const { return latex_of(*this); }

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
