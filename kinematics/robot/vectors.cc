#include "corank/kinematics/robot/vectors.h"

#include <algorithm>

#include "corank/kinematics/robot/constant_scope.h"

namespace corank::kinematics {
namespace {

using Kind = Expression::Kind;

bool is_literal(const Expression& e, const char* digits) {
  if (e.kind() != Kind::number) return false;
  std::string text = e.name();
  if (text.find('.') != std::string::npos && text.find('e') == std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == digits;
}

bool has_names(const Expression& e) {
  if (e.kind() == Kind::symbol) return e.name() != "pi";
  return std::any_of(e.operands().begin(), e.operands().end(), has_names);
}

}  // namespace

bool is_literal_zero(const Expression& e) { return is_literal(e, "0"); }
bool is_literal_one(const Expression& e) { return is_literal(e, "1"); }

Expression folded_sum(const Expression& a, const Expression& b) {
  if (is_literal_zero(a)) return b;
  if (is_literal_zero(b)) return a;
  return a + b;
}

Expression folded_difference(const Expression& a, const Expression& b) {
  if (is_literal_zero(b)) return a;
  if (same_tree(a, b)) return 0;
  if (b.kind() == Kind::negation) return folded_sum(a, b.operands()[0]);
  return is_literal_zero(a) ? -b : a - b;
}

Expression folded_product(const Expression& a, const Expression& b) {
  if (is_literal_zero(a) || is_literal_zero(b)) return 0;
  if (is_literal_one(a)) return b;
  if (is_literal_one(b)) return a;
  if (a.kind() == Kind::negation) {
    const Expression product = folded_product(a.operands()[0], b);
    return product.kind() == Kind::negation ? product.operands()[0] : is_literal_zero(product) ? product : -product;
  }
  if (b.kind() == Kind::negation) return folded_product(b, a);
  return a * b;
}

Vector operator+(const Vector& a, const Vector& b) {
  return {folded_sum(a[0], b[0]), folded_sum(a[1], b[1]), folded_sum(a[2], b[2])};
}

Vector operator-(const Vector& a, const Vector& b) {
  return {folded_difference(a[0], b[0]), folded_difference(a[1], b[1]), folded_difference(a[2], b[2])};
}

Vector cross(const Vector& a, const Vector& b) {
  const auto component = [&](std::size_t i, std::size_t j) {
    return folded_difference(folded_product(a[i], b[j]), folded_product(a[j], b[i]));
  };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

Expression dot(const Vector& a, const Vector& b) {
  return folded_sum(folded_sum(folded_product(a[0], b[0]), folded_product(a[1], b[1])), folded_product(a[2], b[2]));
}

Pose operator*(const Pose& a, const Pose& b) {
  Pose result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result.rotation[i][j] = dot(a.rotation[i], {b.rotation[0][j], b.rotation[1][j], b.rotation[2][j]});
    result.translation[i] = folded_sum(dot(a.rotation[i], b.translation), a.translation[i]);
  }
  return result;
}

Pose inverse(const Pose& pose) {
  Pose result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result.rotation[i][j] = pose.rotation[j][i];
    result.translation[i] = folded_difference(0, dot(result.rotation[i], pose.translation));
  }
  return result;
}

Pose translation(const Vector& by) {
  Pose result;
  result.translation = by;
  return result;
}

Pose rotation(int axis, const Expression& angle) {
  Expression c = cos(angle), s = sin(angle);
  if (!has_names(angle)) {
    ConstantScope numbers;
    const auto cosine = numbers.value(c, "a rotation", angle.where()).integer();
    const auto sine = numbers.value(s, "a rotation", angle.where()).integer();
    if (cosine && sine) {
      c = Expression(*cosine);
      s = Expression(*sine);
    }
  }
  return rotation(axis, c, s);
}

Pose rotation(int axis, const Expression& cosine, const Expression& sine) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Pose result;
  result.rotation[i][i] = result.rotation[j][j] = cosine;
  result.rotation[j][i] = sine;
  result.rotation[i][j] = folded_difference(0, sine);
  return result;
}

}  // namespace corank::kinematics
