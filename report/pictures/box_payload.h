// Numbers of boxes in base64, as the scripts of a page read them: box after box, floats little-endian.
//
// Bounds are doubles rounded outward to floats, so a box of the page holds the box of the result file and is at most one
// float wider on each side.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "corank/core/cover.h"

namespace corank::report {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// Lower and upper bound of each variable in turn.
std::string box_payload(std::span<const CoverBox> boxes);
/// The same of these variables only.
std::string box_payload(std::span<const CoverBox> boxes, std::span<const int> variables);
/// A byte for each box.
template <class Of>
std::string byte_payload(std::span<const CoverBox> boxes, const Of& of) {
  std::vector<std::uint8_t> bytes;
  for (const CoverBox& b : boxes) bytes.push_back(static_cast<std::uint8_t>(of(b)));
  return base64(bytes);
}
/// The index of its verdict in Verdict.
std::string verdict_payload(std::span<const CoverBox> boxes);
/// Two numbers for each output: where barriers keep it.
std::string sides_payload(std::span<const CoverBox> boxes, std::size_t outputs);

}  // namespace corank::report
