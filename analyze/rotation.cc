// Rotations as text.
#include <regex>

#include "corank/analyze/ball.h"
#include "corank/symbolic/model_file.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;
using symbolic::ModelError;

constexpr const char* kExpected = "a product of turns about the axes, such as Rz(1/5)*Ry(pi/10)*Rx(3/10)";

Rotation turn(int axis, const Expression& angle) {
  Rotation r;
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  for (auto& row : r) row.fill(Expression(0));
  r[axis][axis] = Expression(1);
  r[j][j] = r[k][k] = cos(angle);
  r[k][j] = sin(angle);
  r[j][k] = -sin(angle);
  return r;
}

Rotation product(const Rotation& a, const Rotation& b) {
  const auto is = [](const Expression& e, int n) { return same_tree(e, Expression(n)); };
  Rotation result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      std::vector<Expression> sum;
      for (int k = 0; k < 3; ++k) {
        if (is(a[i][k], 0) || is(b[k][j], 0)) continue;
        sum.push_back(is(a[i][k], 1) ? b[k][j] : is(b[k][j], 1) ? a[i][k] : a[i][k] * b[k][j]);
      }
      result[i][j] = Expression::node(Expression::Kind::sum, sum);
    }
  return result;
}

// The end of the parentheses that open at `from`; npos where they stay open.
std::size_t closing(const std::string& text, std::size_t from) {
  int depth = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string::npos;
}

}  // namespace

Rotation parse_rotation(const std::string& text) {
  std::string rest = std::regex_replace(text, std::regex("\\s"), "");
  const auto refuse = [&] { return ModelError({"orientation", 0, 0}, "'" + text + "' is not a rotation", kExpected); };
  std::optional<Rotation> result;
  while (!rest.empty()) {
    if (result && rest[0] != '*') throw refuse();
    if (result) rest.erase(0, 1);
    const std::size_t axis = rest.size() > 3 && rest[0] == 'R' && rest[2] == '(' ? std::string("xyz").find(rest[1]) : 3;
    const std::size_t end = axis < 3 ? closing(rest, 2) : std::string::npos;
    if (end == std::string::npos) throw refuse();
    const Rotation r = turn(static_cast<int>(axis), symbolic::parse_expression(rest.substr(3, end - 3), "orientation"));
    result = result ? product(*result, r) : r;
    rest.erase(0, end + 1);
  }
  if (!result) throw refuse();
  return *result;
}

}  // namespace corank::analyze
