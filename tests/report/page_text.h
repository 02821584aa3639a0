// Takes a report's page apart.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace corank::report {

/// What the <script> element with this id holds.
inline std::string script_text(const std::string& page, const std::string& id) {
  const std::string head = "id=\"" + id + "\">";
  const std::size_t begin = page.find(head);
  if (begin == std::string::npos) throw std::runtime_error("the page has no script " + id);
  const std::size_t end = page.find("</script>", begin);
  return page.substr(begin + head.size(), end - begin - head.size());
}

/// RFC 4648, for text that is valid.
inline std::vector<std::uint8_t> decoded(const std::string& base64) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

inline std::vector<float> decoded_floats(const std::string& base64) {
  const std::vector<std::uint8_t> bytes = decoded(base64);
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace corank::report
