// Words and numbers of a picture.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>

#include "corank/report/layout.h"
#include "corank/symbolic/display_name.h"

namespace corank::report {
namespace {

// With a real minus sign.
std::string number_text(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos) return fmt::format("{:.{}f}", 0.0, decimals);
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

// k·π/n: "−π/2", "3π/4".
std::string pi_text(long k, long n) {
  if (k == 0) return "0";
  const long common = std::gcd(k, n), top = std::labs(k / common), bottom = n / common;
  const std::string text = (k < 0 ? "−" : "") + (top == 1 ? std::string() : std::to_string(top)) + "π";
  return bottom == 1 ? text : text + "/" + std::to_string(bottom);
}

std::vector<Tick> multiples(double lo, double hi, double step, const std::function<std::string(long)>& text) {
  std::vector<Tick> result;
  const double slack = 1e-6 * step;
  for (long k = std::lround(std::ceil((lo - slack) / step)); static_cast<double>(k) * step <= hi + slack; ++k)
    result.push_back({std::clamp(static_cast<double>(k) * step, lo, hi), text(k)});
  return result;
}

}  // namespace

Label math_label(const std::string& name) {
  const symbolic::DisplayName shown = symbolic::display_name(name);
  const bool greek = !name.starts_with(shown.base);
  const bool letter = shown.base.size() == 1 && std::isalpha(static_cast<unsigned char>(shown.base[0])) != 0;
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0; };
  if (!(greek || letter) || shown.subscript.size() > 6 || !std::ranges::all_of(shown.subscript, is_plain)) return {{name}};
  Label label{{shown.base, true, false}};
  if (!shown.subscript.empty()) label.push_back({shown.subscript, false, true});
  return label;
}

Label axis_label(const PictureAxis& axis) {
  Label label = math_label(axis.name);
  if (!axis.function.empty()) label.insert(label.begin(), {axis.function + " "});
  if (axis.angle) label.push_back({" (rad)"});
  return label;
}

std::vector<Tick> ticks(double lo, double hi, bool angle, int count) {
  const double rough = (hi - lo) / std::max(1, count);
  if (angle && hi - lo > 2) {  // multiples of π/4, π/2, π, 2π …
    long numerator = 1, denominator = 4;
    while (std::numbers::pi * static_cast<double>(numerator) / static_cast<double>(denominator) < 0.8 * rough)
      denominator > 1 ? denominator /= 2 : numerator *= 2;
    return multiples(lo, hi, std::numbers::pi * static_cast<double>(numerator) / static_cast<double>(denominator),
                     [=](long k) { return pi_text(k * numerator, denominator); });
  }
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double digit = rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10;
  const double step = digit * power;
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  if (decimals <= 6 && std::max(std::fabs(lo), std::fabs(hi)) < 1e6)
    return multiples(lo, hi, step, [=](long k) { return number_text(static_cast<double>(k) * step, decimals); });
  return multiples(lo, hi, step, [=](long k) { return fmt::format("{:.6g}", static_cast<double>(k) * step); });
}

}  // namespace corank::report
