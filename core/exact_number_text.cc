// Exact numbers in the model language.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "corank/core/exact_number_node.h"

namespace corank {

const char* function_name(ConstantFunction f) {
  switch (f) {
    case ConstantFunction::sqrt: return "sqrt";
    case ConstantFunction::sin: return "sin";
    case ConstantFunction::cos: return "cos";
    case ConstantFunction::tan: return "tan";
    case ConstantFunction::asin: return "asin";
    case ConstantFunction::acos: return "acos";
    case ConstantFunction::atan: return "atan";
    case ConstantFunction::exp: return "exp";
    case ConstantFunction::log: return "log";
    case ConstantFunction::abs: return "abs";
  }
  return "?";
}

namespace {

using Node = ExactNumber::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

std::string text_of(const Node& x);

std::string parenthesized(const Node& x, bool wrap) { return wrap ? "(" + text_of(x) + ")" : text_of(x); }

bool is_atom(const Node& x) {
  return x.kind == Kind::pi || x.kind == Kind::function ||
         (x.kind == Kind::rational && x.value >= 0 && x.value.get_den() == 1);
}

// base^n for n ≥ 1
std::string power_text(const Node& base, long n) {
  const std::string b = parenthesized(base, !is_atom(base));
  return n == 1 ? b : b + "^" + std::to_string(n);
}

std::string product_text(const mpq_class& value, const std::vector<NodePtr>& factors) {
  std::string out;
  const mpq_class size = abs(value);
  bool empty = true;
  if (value < 0) out += "-";
  if (size != 1) out += size.get_str(), empty = false;
  for (const NodePtr& factor : factors) {
    if (factor->kind == Kind::power && factor->exponent < 0) {
      if (empty) out += "1";
      out += "/" + power_text(*factor->operands[0], -static_cast<long>(factor->exponent));
    } else {
      if (!empty) out += "*";
      out += parenthesized(*factor, factor->kind == Kind::sum);
    }
    empty = false;
  }
  return out;
}

std::string text_of(const Node& x) {
  switch (x.kind) {
    case Kind::rational: return x.value.get_str();
    case Kind::pi: return "pi";
    case Kind::function: return std::string(function_name(x.function)) + "(" + text_of(*x.operands[0]) + ")";
    case Kind::power:
      return x.exponent > 0 ? power_text(*x.operands[0], x.exponent)
                            : "1/" + power_text(*x.operands[0], -static_cast<long>(x.exponent));
    case Kind::product: return product_text(x.value, x.operands);
    case Kind::sum: {
      std::string out = x.value == 0 ? "" : x.value.get_str();
      for (const NodePtr& term : x.operands) {
        const std::string t = text_of(*term);
        if (out.empty()) {
          out = t;
        } else {
          out += t[0] == '-' ? " - " + t.substr(1) : " + " + t;
        }
      }
      return out;
    }
  }
  return {};
}

}  // namespace

std::string ExactNumber::text() const { return text_of(*node_); }

std::optional<std::string> ExactNumber::decimal() const {
  if (!is_rational()) return std::nullopt;
  mpz_class num = abs(node_->value.get_num()), den = node_->value.get_den();
  // value = num/den = digits · 10^exponent, digits with no trailing zero
  long exponent = 0;
  mpz_class two(2), five(5), rest = den;
  const auto twos = static_cast<long>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), two.get_mpz_t()));
  const auto fives = static_cast<long>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), five.get_mpz_t()));
  if (rest != 1) return std::nullopt;
  const long places = std::max(twos, fives);
  if (places > 400) return std::nullopt;
  mpz_class scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(places));
  mpz_class mantissa = num * scale / den;
  exponent = -places;
  mpz_class ten(10);
  if (mantissa != 0) exponent += static_cast<long>(mpz_remove(mantissa.get_mpz_t(), mantissa.get_mpz_t(), ten.get_mpz_t()));
  if (mantissa == 0) exponent = 0;
  std::string digits = mantissa.get_str();
  if (digits.size() > 17) return std::nullopt;
  const std::string sign = node_->value < 0 ? "-" : "";
  const auto size = static_cast<long>(digits.size());
  if (exponent >= 0 && exponent + size <= 20) return sign + digits + std::string(static_cast<std::size_t>(exponent), '0');
  if (exponent >= 0 || exponent < -20) return sign + digits + "e" + std::to_string(exponent);
  if (-exponent >= size) return sign + "0." + std::string(static_cast<std::size_t>(-exponent - size), '0') + digits;
  return sign + digits.substr(0, static_cast<std::size_t>(size + exponent)) + "." +
         digits.substr(static_cast<std::size_t>(size + exponent));
}

}  // namespace corank
