#include "corank/symbolic/writing/line_breaks.h"

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

namespace corank::symbolic {
namespace {

constexpr std::size_t kIndent = 4;

struct Break {
  std::size_t end, begin;  // of the line before, of the next one
  int depth;               // of parentheses and brackets
};

std::vector<Break> breaks(std::string_view text) {
  std::vector<Break> list;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' || text[i] == '[' ? 1 : text[i] == ')' || text[i] == ']' ? -1 : 0;
    const std::string_view rest = text.substr(i);
    if (rest.starts_with(", ")) list.push_back({i + 1, i + 2, depth});
    for (const std::string_view sign : {" + ", " - ", " & ", " = ", " >= ", " <= "})
      if (i > 0 && rest.starts_with(sign)) list.push_back({i, i + 1, depth});
  }
  return list;
}

std::string broken_at(const std::string& text, const std::vector<Break>& places, std::size_t first, std::size_t indent) {
  std::string out;
  std::size_t begin = 0, at = first;  // of the line: in the text, and its column
  const auto width_to = [&](std::size_t end) { return at + columns(std::string_view(text).substr(begin, end - begin)); };
  for (std::size_t k = 0; k < places.size() && width_to(text.size()) > kLineWidth;) {
    std::size_t last = k;  // the one that makes the longest line that fits, or the next one
    while (last + 1 < places.size() && width_to(places[last + 1].end) <= kLineWidth) ++last;
    out += text.substr(begin, places[last].end - begin) + "\n" + std::string(indent, ' ');
    begin = places[last].begin, at = indent;
    k = last + 1;
  }
  return out + text.substr(begin);
}

std::string for_each_line(const std::string& text, const std::function<std::string(const std::string&)>& of_line) {
  std::istringstream in(text);
  std::string out;
  for (std::string line; std::getline(in, line);) out += of_line(line) + "\n";
  if (!text.ends_with('\n') && !out.empty()) out.pop_back();
  return out;
}

}  // namespace

// What does not count as a column: the bytes of a character of UTF-8 behind its first.
std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) == 0x80U ? 0 : 1;
  return count;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string broken(const std::string& formula, std::size_t first, std::size_t indent) {
  return broken_at(formula, breaks(formula), first, indent);
}

std::string broken_model(const std::string& text) {
  std::string section;
  return for_each_line(text, [&section](const std::string& line) {
    if (line.starts_with('[')) section = line.substr(0, line.find(']') + 1);
    if (columns(line) <= kLineWidth) return line;
    const std::size_t end = line.find('%');
    std::string code = line.substr(0, end);
    const std::string note = end == std::string::npos ? "" : line.substr(end);
    const std::size_t value = code.find(":= ");
    if (section == "[CONSTANTS]" && value != std::string::npos)
      code = code.substr(0, value + 3) + "(" + code.substr(value + 3, code.find_last_not_of(' ') - value - 2) + ")";
    const bool ends_with_its_line = !section.ends_with("EQS]") && !section.ends_with("PUTS]");
    std::vector<Break> places = breaks(code);
    if (ends_with_its_line) std::erase_if(places, [](const Break& b) { return b.depth == 0; });
    return places.empty() || columns(code) <= kLineWidth ? line : broken_at(code, places, 0, kIndent) + note;
  });
}

std::string broken_latex(const std::string& text) {
  return for_each_line(text,
                       [](const std::string& line) { return line.starts_with('%') ? line : broken(line, 0, kIndent); });
}

}  // namespace corank::symbolic
