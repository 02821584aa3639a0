#include "corank/symbolic/model/display_name.h"

#include <algorithm>
#include <map>

namespace corank::symbolic {
namespace {

const std::map<std::string, const char*, std::less<>>& greek_letters() {
  static const std::map<std::string, const char*, std::less<>> letters = {
      {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"},   {"delta", "δ"},  {"epsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},
      {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"},   {"lambda", "λ"}, {"mu", "μ"},      {"nu", "ν"},     {"xi", "ξ"},
      {"pi", "π"},    {"rho", "ρ"},   {"sigma", "σ"},   {"tau", "τ"},    {"upsilon", "υ"}, {"phi", "φ"},    {"chi", "χ"},
      {"psi", "ψ"},   {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},  {"Theta", "Θ"},   {"Lambda", "Λ"}, {"Xi", "Ξ"},
      {"Pi", "Π"},    {"Sigma", "Σ"}, {"Upsilon", "Υ"}, {"Phi", "Φ"},    {"Psi", "Ψ"},     {"Omega", "Ω"}};
  return letters;
}

}  // namespace

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_greek_letter(std::string_view word) { return greek_letters().contains(word); }

DisplayName display_name(const std::string& name) {
  const std::size_t n = std::find_if_not(name.begin(), name.end(), is_letter) - name.begin();
  if (n == 0) return {name, ""};  // a name that begins with _ is no word of mathematics
  DisplayName shown;
  const auto letter = greek_letters().find(std::string_view(name).substr(0, n));
  shown.base = letter == greek_letters().end() ? name.substr(0, n) : letter->second;
  for (std::size_t i = n; i < name.size(); ++i) {
    if (name[i] != '_') {
      shown.subscript += name[i];
    } else if (!shown.subscript.empty() && shown.subscript.back() != ',') {
      shown.subscript += ',';
    }
  }
  if (!shown.subscript.empty() && shown.subscript.back() == ',') shown.subscript.pop_back();
  return shown;
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string html_name(const std::string& name) {
  const DisplayName shown = display_name(name);
  std::string text = "<i>" + html_text(shown.base) + "</i>";
  if (!shown.subscript.empty()) text += "<sub>" + html_text(shown.subscript) + "</sub>";
  return text;
}

}  // namespace corank::symbolic
