#include "corank/symbolic/model/expression_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>

namespace corank::symbolic {
namespace {

constexpr std::array<std::string_view, 10> kFunctions = {"sin",  "cos",  "tan", "asin", "acos",
                                                         "atan", "sqrt", "exp", "log",  "abs"};
constexpr std::size_t kMaxDigits = 10'000;
constexpr int kMaxDecimalExponent = 400;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter_of_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::string_view take_digits(std::string_view& text) {
  const std::size_t n = std::find_if_not(text.begin(), text.end(), is_digit) - text.begin();
  const std::string_view digits = text.substr(0, n);
  text.remove_prefix(n);
  return digits;
}

}  // namespace

bool is_identifier(std::string_view name) {
  return !name.empty() && !is_digit(name[0]) &&
         std::ranges::all_of(name, [](char c) { return is_letter_of_name(c) || is_digit(c); });
}

bool is_function_name(std::string_view name) { return std::ranges::find(kFunctions, name) != kFunctions.end(); }

std::string function_names() { return joined({kFunctions.begin(), kFunctions.end()}); }

bool is_reserved(std::string_view name) { return name == "pi" || name == "deg" || is_function_name(name); }

std::string normal_decimal(std::string_view text, const SourceLocation& where) {
  std::string_view rest = text;
  const std::string_view whole = take_digits(rest);
  std::string_view fraction, exponent;
  if (!rest.empty() && rest[0] == '.') {
    rest.remove_prefix(1);
    fraction = take_digits(rest);
  }
  bool well_formed = !whole.empty() || !fraction.empty();
  bool negative_exponent = false;
  if (well_formed && !rest.empty() && (rest[0] == 'e' || rest[0] == 'E')) {
    rest.remove_prefix(1);
    if (!rest.empty() && (rest[0] == '+' || rest[0] == '-')) {
      negative_exponent = rest[0] == '-';
      rest.remove_prefix(1);
    }
    exponent = take_digits(rest);
    well_formed = !exponent.empty();
  }
  if (!well_formed || !rest.empty())
    throw ModelError(where, in_quotes(text) + " is not a number", "a number such as 2, 0.90 or 1e-6");
  if (whole.size() + fraction.size() > kMaxDigits)
    throw ModelError(where,
                     "the number " + in_quotes(text) + " has " + std::to_string(whole.size() + fraction.size()) + " digits",
                     "at most " + std::to_string(kMaxDigits));
  int power = 0;
  const auto parsed = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (!exponent.empty() && (parsed.ec != std::errc() || power > kMaxDecimalExponent))
    throw ModelError(where, "the number " + in_quotes(text) + " is out of range",
                     "an exponent of ten between -" + std::to_string(kMaxDecimalExponent) + " and " +
                         std::to_string(kMaxDecimalExponent));
  std::string result(whole.empty() ? "0" : whole);
  if (!fraction.empty()) result.append(".").append(fraction);
  if (!exponent.empty()) result.append(negative_exponent ? "e-" : "e").append(exponent);
  return result;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.size() <= kLongest) return std::string(text);
  std::size_t n = kLongest;
  while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0) == 0x80) --n;  // not inside a UTF-8 character
  return std::string(text.substr(0, n)) + "…";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string in_quotes(std::string_view text) { return "'" + shortened(text) + "'"; }

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (small(a[i - 1]) == small(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 60;
  if (name.size() > kLongest) return "";
  std::string best;
  std::size_t fewest = name.size() / 3 + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest) continue;
    const std::size_t changes = edit_distance(name, candidate);
    if (changes >= candidate.size() || changes > fewest || (changes == fewest && !best.empty())) continue;
    best = candidate;
    fewest = changes;
  }
  return best;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : "; did you mean " + in_quotes(nearest) + "?";
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
  return text;
}

std::string noun(std::size_t n, const std::string& word) {
  if (n == 1) return word;
  return word.ends_with('y') ? word.substr(0, word.size() - 1) + "ies" : word + (word.ends_with('x') ? "es" : "s");
}

std::string counted(std::size_t n, const std::string& word) { return std::to_string(n) + " " + noun(n, word); }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f\v";
  const std::size_t first = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

}  // namespace corank::symbolic
