// Exact numbers as text: in the model language, and in prefix notation.
#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "corank/core/exact_number_node.h"

namespace corank {

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

constexpr int kDeepest = 2000;  // the reader of prefix notation is recursive

void write(const Node& x, std::string& out) {
  switch (x.kind) {
    case Kind::rational: out += x.value.get_str() + " "; return;
    case Kind::pi: out += "pi "; return;
    case Kind::sum: out += "+ " + x.value.get_str() + " " + std::to_string(x.operands.size()) + " "; break;
    case Kind::product: out += "* " + x.value.get_str() + " " + std::to_string(x.operands.size()) + " "; break;
    case Kind::power: out += "^ " + std::to_string(x.exponent) + " "; break;
    case Kind::function: out += std::string(function_name(x.function)) + " "; break;
  }
  for (const NodePtr& operand : x.operands) write(*operand, out);
}

[[noreturn]] void refuse() { throw std::invalid_argument("expected an exact number in prefix notation"); }

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  NodePtr node(int depth = 0) {
    if (depth > kDeepest) refuse();
    const std::string_view first = word();
    Node result;
    std::size_t operands = 1;
    if (first == "pi") {
      result.kind = Kind::pi;
      operands = 0;
    } else if (first == "+" || first == "*") {
      result.kind = first == "+" ? Kind::sum : Kind::product;
      result.value = rational(word());
      operands = integer(word());
      if (operands == 0 || operands > text_.size()) refuse();
    } else if (first == "^") {
      result.kind = Kind::power;
      result.exponent = integer(word());
    } else if (const auto function = function_of(first)) {
      result.kind = Kind::function;
      result.function = *function;
    } else {
      result.value = rational(first);
      operands = 0;
    }
    for (std::size_t i = 0; i < operands; ++i) result.operands.push_back(node(depth + 1));
    return std::make_shared<const Node>(std::move(result));
  }
  bool at_end() const { return text_.empty(); }

 private:
  std::string_view word() {
    const std::size_t end = text_.find(' ');
    if (end == std::string_view::npos || end == 0) refuse();
    const std::string_view result = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return result;
  }
  static int integer(std::string_view digits) {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || value < -1'000'000) refuse();
    return value;
  }
  static mpq_class rational(std::string_view digits) {
    mpq_class value;
    if (digits.find_first_not_of("-/0123456789") != std::string_view::npos || value.set_str(std::string(digits), 10) != 0 ||
        value.get_den() == 0)
      refuse();
    value.canonicalize();
    return value;
  }
  static std::optional<ConstantFunction> function_of(std::string_view name) {
    const auto at = std::ranges::find(kFunctionNames, name);
    if (at == kFunctionNames.end()) return std::nullopt;
    return static_cast<ConstantFunction>(at - kFunctionNames.begin());
  }

  std::string_view text_;
};

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
  if (exponent >= 0 && exponent + size <= 20) return sign + digits + std::string(exponent, '0');
  if (exponent >= 0 || exponent < -20) return sign + digits + "e" + std::to_string(exponent);
  if (-exponent >= size) return sign + "0." + std::string(-exponent - size, '0') + digits;
  return sign + digits.substr(0, size + exponent) + "." + digits.substr(size + exponent);
}

std::string ExactNumber::prefix() const {
  std::string out;
  write(*node_, out);
  return out;
}

ExactNumber ExactNumber::from_prefix(std::string_view text) {
  Reader reader(text);
  NodePtr node = reader.node();
  if (!reader.at_end()) refuse();
  return ExactNumber(std::move(node));
}

}  // namespace corank
