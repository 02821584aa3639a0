#include "corank/result/files/plain_items.h"

#include <limits>

namespace corank::result {
namespace {

constexpr std::uint64_t kEnd = 0xc0;
constexpr std::uint64_t kMostWords = 256, kLongestItemName = 1024;
constexpr std::array<std::uint64_t, kItemTypes> kWidths{8, 4, 8, 8, 4, 1, 1, 0};  // text: any

std::uint64_t padded(std::uint64_t size) { return (size + 7) / 8 * 8; }

void put(std::string& bytes, std::uint64_t number) {
  std::array<char, 8> raw;
  std::memcpy(raw.data(), &number, raw.size());
  bytes.append(raw.data(), raw.size());
}

void put(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text + item_padding(text.size());
}

class ItemParser {
 public:
  explicit ItemParser(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::map<std::string, Item> parse() {
    std::map<std::string, Item> items;
    for (std::uint64_t kind = number(); kind != kEnd; kind = number()) {
      Item item = parse_item(kind);
      std::string name = item.name;
      if (!items.try_emplace(std::move(name), std::move(item)).second) throw PlainItemsError("a name occurs twice");
    }
    return items;
  }

 private:
  std::span<const std::byte> take(std::uint64_t size) {
    if (size > rest_.size() || padded(size) > rest_.size()) throw PlainItemsError("the list ends early");
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(padded(size));
    return taken;
  }

  std::uint64_t number() {
    std::uint64_t n = 0;
    std::memcpy(&n, take(8).data(), 8);
    return n;
  }

  std::string text() {
    const std::uint64_t size = number();
    if (size > kLongestItemName) throw PlainItemsError("a name is too long");
    const auto bytes = take(size);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  Item parse_item(std::uint64_t kind) {
    if (kind >= kItemTypes) throw PlainItemsError("an item has an unknown type");
    Item item;
    item.type = static_cast<ItemType>(kind);
    item.width = number();
    if (item.width == 0 || (item.type != ItemType::text && item.width != kWidths[kind]))
      throw PlainItemsError("an item has elements of another width than its type");
    const std::uint64_t rank = number();
    if (rank > 2) throw PlainItemsError("an item has more than two dimensions");
    item.rank = static_cast<int>(rank);
    for (std::uint64_t& size : item.sizes) size = number();
    for (std::uint64_t k = rank; k < 2; ++k)
      if (item.sizes[k] != 1) throw PlainItemsError("an item has sizes without dimensions");
    item.name = text();
    const std::uint64_t words = number();
    if (words > kMostWords || (words > 0 && item.type != ItemType::word))
      throw PlainItemsError("an item has too many words");
    for (std::uint64_t w = 0; w < words; ++w) {
      const std::uint64_t value = number();
      if (value > 255) throw PlainItemsError("a word has a number above 255");
      item.words.emplace_back(static_cast<std::uint8_t>(value), text());
    }
    item.data = take(number());
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    if ((item.sizes[1] > 0 && item.sizes[0] > kMost / item.sizes[1]) || item.elements() > kMost / item.width ||
        item.elements() * item.width != item.data.size())
      throw PlainItemsError("an item has more or less data than its shape asks for");
    return item;
  }

  std::span<const std::byte> rest_;
};

}  // namespace

std::string item_header(const Item& item, std::uint64_t data_size) {
  std::string bytes;
  put(bytes, static_cast<std::uint64_t>(item.type));
  put(bytes, item.width);
  put(bytes, static_cast<std::uint64_t>(item.rank));
  for (const std::uint64_t size : item.sizes) put(bytes, size);
  put(bytes, item.name);
  put(bytes, item.words.size());
  for (const auto& [value, word] : item.words) {
    put(bytes, value);
    put(bytes, word);
  }
  put(bytes, data_size);
  return bytes;
}

std::string item_padding(std::uint64_t data_size) { return std::string(padded(data_size) - data_size, '\0'); }

std::string the_end() {
  std::string bytes;
  put(bytes, kEnd);
  return bytes;
}

std::map<std::string, Item> parse_items(std::span<const std::byte> bytes) { return ItemParser(bytes).parse(); }

}  // namespace corank::result
