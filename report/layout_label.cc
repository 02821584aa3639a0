// Words and numbers of a picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

#include "corank/report/layout.h"

namespace corank::report {
namespace {

struct GreekLetter {
  std::string_view name, letter;
};
constexpr std::array<GreekLetter, 33> kGreek{
    {{"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"},   {"delta", "δ"},   {"epsilon", "ε"}, {"zeta", "ζ"}, {"eta", "η"},
     {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"},   {"lambda", "λ"},  {"mu", "μ"},      {"nu", "ν"},   {"xi", "ξ"},
     {"rho", "ρ"},   {"sigma", "σ"}, {"tau", "τ"},     {"upsilon", "υ"}, {"phi", "φ"},     {"chi", "χ"},  {"psi", "ψ"},
     {"omega", "ω"}, {"Gamma", "Γ"}, {"Delta", "Δ"},   {"Theta", "Θ"},   {"Lambda", "Λ"},  {"Xi", "Ξ"},   {"Pi", "Π"},
     {"Sigma", "Σ"}, {"Phi", "Φ"},   {"Upsilon", "Υ"}, {"Psi", "Ψ"},     {"Omega", "Ω"}}};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

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
  std::size_t letters = 0;
  while (letters < name.size() && is_letter(name[letters])) ++letters;
  const std::string base = name.substr(0, letters);
  std::string rest = name.substr(letters);
  if (rest.starts_with('_')) rest.erase(0, 1);
  const auto greek = std::find_if(kGreek.begin(), kGreek.end(), [&](const GreekLetter& g) { return g.name == base; });
  const bool symbol = greek != kGreek.end() || base.size() == 1;
  if (!symbol || rest.size() > 6 || !std::all_of(rest.begin(), rest.end(), is_letter_or_digit)) return {{name}};
  Label label{{greek != kGreek.end() ? std::string(greek->letter) : base, true, false}};
  if (!rest.empty()) label.push_back({rest, false, true});
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
