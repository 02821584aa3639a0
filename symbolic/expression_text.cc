// Expressions in the model language.
//
// A printed tree parses back to the same tree: parentheses are set exactly where the grammar (model_grammar.h) would group
// otherwise, and around a minus sign that follows an operator, where the grammar could do without but a reader could not.
#include "corank/symbolic/expression.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

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

}  // namespace corank::symbolic
