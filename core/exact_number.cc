#include "corank/core/exact_number.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "corank/core/exact_number_node.h"

namespace corank {

namespace {

using Node = ExactNumber::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

constexpr std::size_t kMaxBits = 100'000;  // of a rational's numerator or denominator

std::size_t bits(const mpq_class& q) {
  return std::max(mpz_sizeinbase(q.get_num_mpz_t(), 2), mpz_sizeinbase(q.get_den_mpz_t(), 2));
}

[[noreturn]] void too_long() { throw std::domain_error("a number of more than 100000 bits"); }

NodePtr finished(Node node) {
  if (bits(node.value) > kMaxBits) too_long();
  return std::make_shared<const Node>(std::move(node));
}

NodePtr make_rational(mpq_class q) {
  Node node;
  node.value = std::move(q);
  return finished(std::move(node));
}

bool is_rational(const NodePtr& x) { return x->kind == Kind::rational; }

bool same(const NodePtr& x, const NodePtr& y) {
  if (x == y) return true;
  if (x->kind != y->kind || x->operands.size() != y->operands.size()) return false;
  if (x->value != y->value || x->exponent != y->exponent || x->function != y->function) return false;
  for (std::size_t i = 0; i < x->operands.size(); ++i)
    if (!same(x->operands[i], y->operands[i])) return false;
  return true;
}

NodePtr make_product(const NodePtr& x, const NodePtr& y);

// c·e with a rational c and e's factors; c = 1 and e itself where it is no product.
const mpq_class kOne = 1;
const mpq_class& rational_factor(const NodePtr& x) { return x->kind == Kind::product ? x->value : kOne; }
bool same_but_for_it(const NodePtr& x, const NodePtr& y) {
  const auto count = [](const NodePtr& z) { return z->kind == Kind::product ? z->operands.size() : std::size_t{1}; };
  const auto part = [](const NodePtr& z, std::size_t i) { return z->kind == Kind::product ? z->operands[i] : z; };
  if (count(x) != count(y)) return false;
  for (std::size_t i = 0; i < count(x); ++i)
    if (!same(part(x, i), part(y, i))) return false;
  return true;
}

bool is_real(const NodePtr& x) {
  try {
    Node::of(x).enclose();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

// Adds c·e to the operands: (b + c)·e where there is b·e. What cancels is left out if e is shown to be a real number.
void add_operand(Node& sum, const NodePtr& x) {
  constexpr std::size_t kMost = 64;  // operands, that sums of many cost no time
  const auto like = sum.operands.size() > kMost
                        ? sum.operands.end()
                        : std::ranges::find_if(sum.operands, [&](const NodePtr& y) { return same_but_for_it(x, y); });
  if (like == sum.operands.end()) {
    sum.operands.push_back(x);
    return;
  }
  const mpq_class factor = rational_factor(x) + rational_factor(*like);
  if (factor != 0) {
    *like = make_product(make_rational(factor / rational_factor(x)), x);
  } else if (is_real(x)) {
    sum.operands.erase(like);
  } else {
    sum.operands.push_back(x);
  }
}

NodePtr make_sum(const NodePtr& x, const NodePtr& y) {
  Node sum;
  sum.kind = Kind::sum;
  for (const NodePtr& part : {x, y}) {
    if (part->kind == Kind::rational) {
      sum.value += part->value;
    } else if (part->kind == Kind::sum) {
      sum.value += part->value;
      for (const NodePtr& operand : part->operands) add_operand(sum, operand);
    } else {
      add_operand(sum, part);
    }
  }
  if (sum.operands.empty()) return make_rational(sum.value);
  if (sum.operands.size() == 1 && sum.value == 0) return sum.operands[0];
  return finished(std::move(sum));
}

// √q of a rational number q ≥ 0: its square is q.
bool is_root_of_rational(const NodePtr& x) {
  return x->kind == Kind::function && x->function == ConstantFunction::sqrt && is_rational(x->operands[0]) &&
         x->operands[0]->value >= 0;
}

// Multiplies by e: √q·√q is q.
void multiply_operand(Node& product, const NodePtr& x) {
  if (is_root_of_rational(x)) {
    const auto like = std::ranges::find_if(product.operands, [&](const NodePtr& y) { return same(x, y); });
    if (like != product.operands.end()) {
      product.value *= x->operands[0]->value;
      product.operands.erase(like);
      return;
    }
  }
  product.operands.push_back(x);
}

// c·(q + a + b …) as a sum, so that sums of multiples of sums stay as short as their different parts are many.
NodePtr distribute(const mpq_class& c, const NodePtr& sum) {
  Node result;
  result.kind = Kind::sum;
  result.value = c * sum->value;
  const NodePtr factor = make_rational(c);
  for (const NodePtr& operand : sum->operands) result.operands.push_back(make_product(factor, operand));
  return finished(std::move(result));
}

NodePtr make_product(const NodePtr& x, const NodePtr& y) {
  for (const auto& [c, e] : {std::pair{x, y}, {y, x}})
    if (is_rational(c) && e->kind == Kind::sum && c->value != 0) return c->value == 1 ? e : distribute(c->value, e);
  Node product;
  product.kind = Kind::product;
  product.value = 1;
  for (const NodePtr& part : {x, y}) {
    if (part->kind == Kind::rational) {
      product.value *= part->value;
    } else if (part->kind == Kind::product) {
      product.value *= part->value;
      for (const NodePtr& operand : part->operands) multiply_operand(product, operand);
    } else {
      multiply_operand(product, part);
    }
  }
  if (product.value == 0 || product.operands.empty()) return make_rational(product.value);
  if (product.operands.size() == 1 && product.value == 1) return product.operands[0];
  std::ranges::stable_partition(product.operands,
                                [](const NodePtr& f) { return f->kind != Kind::power || f->exponent > 0; });
  return finished(std::move(product));
}

NodePtr make_power(const NodePtr& x, int n) {
  if (is_rational(x)) {
    if (n < 0 && x->value == 0) throw std::domain_error("division by zero");
    if (x->value == 1 || x->value == 0 || x->value == -1) {
      if (n == 0 || x->value == 1) return make_rational(1);
      return make_rational(x->value == 0 ? mpq_class(0) : mpq_class(n % 2 == 0 ? 1 : -1));
    }
    const auto count = static_cast<unsigned long>(std::labs(static_cast<long>(n)));
    // bits − 1 ≤ log2 of the numerator or denominator, so the result has more than (bits − 1)·n bits.
    if (count > kMaxBits || (bits(x->value) - 1) * count > kMaxBits) too_long();
    mpz_class num, den;
    mpz_pow_ui(num.get_mpz_t(), x->value.get_num_mpz_t(), count);
    mpz_pow_ui(den.get_mpz_t(), x->value.get_den_mpz_t(), count);
    mpq_class q = n < 0 ? mpq_class(den, num) : mpq_class(num, den);
    q.canonicalize();
    return make_rational(std::move(q));
  }
  if (n == 0) return make_rational(1);
  if (n == 1) return x;
  if (n > 1 && is_root_of_rational(x)) {
    const NodePtr even = make_power(x->operands[0], n / 2);
    return n % 2 == 0 ? even : make_product(even, x);
  }
  if (x->kind == Kind::power && x->exponent > 0 && n > 0 && x->exponent <= std::numeric_limits<int>::max() / n)
    return make_power(x->operands[0], x->exponent * n);
  Node power;
  power.kind = Kind::power;
  power.exponent = n;
  power.operands = {x};
  return finished(std::move(power));
}

// Digits with an optional sign, a point and an exponent; nothing where the text is none of these.
std::optional<mpq_class> parse_decimal(const std::string& text) {
  std::size_t i = 0;
  const auto digit = [&] { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  bool negative = false;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) negative = text[i++] == '-';
  std::string digits;
  while (digit()) digits += text[i++];
  long exponent = 0;
  if (i < text.size() && text[i] == '.') {
    ++i;
    while (digit()) digits += text[i++], --exponent;
  }
  if (digits.empty()) return std::nullopt;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    bool down = false;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) down = text[i++] == '-';
    if (!digit()) return std::nullopt;
    long e = 0;
    while (digit()) e = std::min(e * 10 + (text[i++] - '0'), 1'000'000'000L);
    exponent += down ? -e : e;
  }
  if (i != text.size()) return std::nullopt;
  if (digits.size() > 40'000) too_long();
  const mpz_class mantissa(digits, 10);
  if (mantissa == 0) return mpq_class(0);
  if (std::labs(exponent) > 40'000) too_long();
  mpz_class scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(exponent)));
  mpq_class q = exponent < 0 ? mpq_class(mantissa, scale) : mpq_class(mantissa * scale);
  q.canonicalize();
  if (negative) q = -q;
  return q;
}

}  // namespace

ExactNumber::ExactNumber() : ExactNumber(0L) {}
ExactNumber ExactNumber::Node::number(mpq_class q) { return ExactNumber(make_rational(std::move(q))); }

ExactNumber ExactNumber::dyadic(double x) {
  if (!std::isfinite(x)) throw std::invalid_argument("no rational number is infinite");
  return Node::number(mpq_class(x));
}

ExactNumber::ExactNumber(long n) : node_(make_rational(mpq_class(n))) {}

ExactNumber ExactNumber::rational(const std::string& text) {
  const std::size_t slash = text.find('/');
  std::optional<mpq_class> q = parse_decimal(text.substr(0, slash));
  if (slash != std::string::npos && q) {
    const std::string below = text.substr(slash + 1);
    const bool integers = text.find_first_of(".eE") == std::string::npos && below.find_first_of("+-") == std::string::npos;
    const std::optional<mpq_class> d = integers ? parse_decimal(below) : std::nullopt;
    if (d && *d == 0) throw std::domain_error("division by zero in " + text);
    q = d ? std::optional<mpq_class>(*q / *d) : std::nullopt;
  }
  if (!q) throw std::invalid_argument("`" + text + "` is not a number such as 12, -3/4, 0.90 or 1e-6");
  return ExactNumber(make_rational(*q));
}

ExactNumber ExactNumber::pi() {
  Node node;
  node.kind = Kind::pi;
  return ExactNumber(finished(std::move(node)));
}

ExactNumber ExactNumber::apply(ConstantFunction f, const ExactNumber& x) {
  if (x.is_rational()) {
    const mpq_class& q = x.node_->value;
    if (f == ConstantFunction::abs) return ExactNumber(make_rational(abs(q)));
    if (f == ConstantFunction::sqrt && q >= 0 && mpz_perfect_square_p(q.get_num_mpz_t()) &&
        mpz_perfect_square_p(q.get_den_mpz_t()))
      return ExactNumber(make_rational(mpq_class(sqrt(q.get_num()), sqrt(q.get_den()))));
    if (q == 0 && (f == ConstantFunction::cos || f == ConstantFunction::exp)) return 1;
    if (q == 0 && (f == ConstantFunction::sin || f == ConstantFunction::tan || f == ConstantFunction::asin ||
                   f == ConstantFunction::atan))
      return 0;
    if (q == 1 && f == ConstantFunction::log) return 0;
  }
  Node node;
  node.kind = Kind::function;
  node.function = f;
  node.operands = {x.node_};
  return ExactNumber(finished(std::move(node)));
}

ExactNumber operator+(const ExactNumber& x, const ExactNumber& y) { return ExactNumber(make_sum(x.node_, y.node_)); }
ExactNumber operator-(const ExactNumber& x) { return ExactNumber(make_product(make_rational(-1), x.node_)); }
ExactNumber operator-(const ExactNumber& x, const ExactNumber& y) { return x + (-y); }
ExactNumber operator*(const ExactNumber& x, const ExactNumber& y) { return ExactNumber(make_product(x.node_, y.node_)); }
ExactNumber operator/(const ExactNumber& x, const ExactNumber& y) {
  return ExactNumber(make_product(x.node_, make_power(y.node_, -1)));
}
ExactNumber pow(const ExactNumber& x, int n) { return ExactNumber(make_power(x.node_, n)); }
bool operator==(const ExactNumber& x, const ExactNumber& y) { return same(x.node_, y.node_); }

bool ExactNumber::is_rational() const { return node_->kind == Kind::rational; }
bool ExactNumber::is_zero() const { return is_rational() && node_->value == 0; }

std::ostream& operator<<(std::ostream& out, const ExactNumber& x) { return out << x.text(); }

}  // namespace corank
