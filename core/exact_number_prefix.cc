#include "corank/core/exact_number_prefix.h"

#include <array>
#include <charconv>
#include <stdexcept>

#include "corank/core/exact_number_node.h"

namespace corank {
namespace {

using Node = ExactNumber::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

constexpr int kDeepest = 2000;  // a reader is recursive
constexpr std::array kFunctions{
    ConstantFunction::sqrt, ConstantFunction::sin,  ConstantFunction::cos, ConstantFunction::tan, ConstantFunction::asin,
    ConstantFunction::acos, ConstantFunction::atan, ConstantFunction::exp, ConstantFunction::log, ConstantFunction::abs};

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
      operands = static_cast<std::size_t>(integer(word()));
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
    for (const ConstantFunction f : kFunctions)
      if (name == function_name(f)) return f;
    return std::nullopt;
  }

  std::string_view text_;
};

}  // namespace

std::string to_prefix(const ExactNumber& x) {
  std::string out;
  write(x.node(), out);
  return out;
}

ExactNumber from_prefix(std::string_view text) {
  Reader reader(text);
  NodePtr node = reader.node();
  if (!reader.at_end()) refuse();
  return Node::of(std::move(node));
}

}  // namespace corank
