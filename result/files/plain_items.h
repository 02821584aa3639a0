// What a result file holds as plain values: named arrays, texts and attributes, and the bytes in which one process hands
// them to another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace corank::result {

enum class ItemType : std::uint8_t { float64, float32, int64, uint64, int32, uint8, word, text };
inline constexpr int kItemTypes = 8;
/// As which of them a number is stored.
template <class T>
consteval ItemType item_type() {
  if (std::is_same_v<T, double>) return ItemType::float64;
  if (std::is_same_v<T, float>) return ItemType::float32;
  if (std::is_same_v<T, std::int64_t>) return ItemType::int64;
  if (std::is_same_v<T, std::uint64_t>) return ItemType::uint64;
  if (std::is_same_v<T, std::int32_t>) return ItemType::int32;
  if (std::is_same_v<T, std::uint8_t>) return ItemType::uint8;
  throw std::invalid_argument("files hold no such numbers");  // ends the compilation
}

struct Item {
  /// "/group/name"; an attribute "/group@name"; a group "/group/".
  std::string name;
  ItemType type = ItemType::uint8;
  std::uint64_t width = 1;  ///< bytes of one element; of texts their longest length
  int rank = 0;             ///< 0: one value; at most 2
  std::array<std::uint64_t, 2> sizes{1, 1};
  std::vector<std::pair<std::uint8_t, std::string>> words;  ///< of type word: what its numbers mean
  std::span<const std::byte> data;                          ///< elements, row-major

  std::uint64_t elements() const { return sizes[0] * sizes[1]; }
  template <class T>
  std::vector<T> copied() const {
    std::vector<T> list(data.size() / sizeof(T));
    if (!list.empty()) std::memcpy(list.data(), data.data(), data.size());
    return list;
  }
};

/// Bytes that are no list of items.
class PlainItemsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writers call header(), then write its data and padding(); the list ends with the_end().
std::string item_header(const Item& item, std::uint64_t data_size);
std::string item_padding(std::uint64_t data_size);
std::string the_end();

/// The items by name. Trusts nothing: throws PlainItemsError where the bytes are no complete list of items with distinct
/// names, each with as much data as its shape asks for. The items refer to the bytes.
std::map<std::string, Item> parse_items(std::span<const std::byte> bytes);

}  // namespace corank::result
