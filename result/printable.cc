#include "corank/result/printable.h"

#include <fmt/format.h>

#include <cstdint>

namespace corank::result {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: no UTF-8
};

// The first character of a text that is not empty (Unicode standard, table 3-7).
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool shortest = length == 2 || code >= (length == 3 ? 0x800u : 0x10000u);
  if (!shortest || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
  return {code, length};
}

bool is_harmless(std::uint32_t c, bool one_line) {
  if (c == '\n' || c == '\t') return !one_line;
  const bool control = c < 0x20 || (c >= 0x7f && c <= 0x9f);
  const bool direction =
      c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
  return !control && !direction;
}

std::string made_visible(std::string_view text, bool one_line) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t length = c.length == 0 ? 1 : c.length;
    if (c.length > 0 && is_harmless(c.code, one_line)) {
      result += text.substr(0, length);
    } else if (length == 1) {
      result += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[0]));
    } else {
      result += fmt::format("\\u{:04x}", c.code);
    }
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return made_visible(text, false); }

std::string printable_line(std::string_view text) { return made_visible(text, true); }

}  // namespace corank::result
