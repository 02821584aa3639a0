#include "corank/report/pictures/box_payload.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace corank::report {
namespace {

static_assert(std::endian::native == std::endian::little, "the page's numbers are little-endian");

std::string base64_of(const std::vector<float>& numbers) {
  return base64({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(float)});
}

// The float below or equal, above or equal.
float float_below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float float_above(double x) { return -float_below(-x); }

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* to = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    const std::uint32_t group = bytes[i] << 16 | (n > 1 ? bytes[i + 1] << 8 : 0) | (n > 2 ? bytes[i + 2] : 0);
    for (std::size_t k = 0; k < 4; ++k, ++to)
      if (k <= n) *to = kAlphabet[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string box_payload(std::span<const CoverBox> boxes) {
  std::vector<int> all(boxes.empty() ? 0 : boxes.front().box.size());
  std::iota(all.begin(), all.end(), 0);
  return box_payload(boxes, all);
}

std::string box_payload(std::span<const CoverBox> boxes, std::span<const int> variables) {
  std::vector<float> numbers;
  numbers.reserve(boxes.size() * variables.size() * 2);
  for (const CoverBox& b : boxes) {
    for (const int v : variables) {
      const Interval& side = b.box[v];
      numbers.push_back(float_below(side.lo()));
      numbers.push_back(float_above(side.hi()));
    }
  }
  return base64_of(numbers);
}

std::string verdict_payload(std::span<const CoverBox> boxes) {
  return byte_payload(boxes, [](const CoverBox& b) { return b.verdict; });
}

std::string sides_payload(std::span<const CoverBox> boxes, std::size_t outputs) {
  std::vector<float> numbers;
  for (const CoverBox& b : boxes)
    for (std::size_t j = 0; j < outputs; ++j)
      numbers.push_back(b.passage == Passage::barrier && b.side.size() == outputs ? static_cast<float>(b.side[j]) : 0.0F);
  return base64_of(numbers);
}

}  // namespace corank::report
