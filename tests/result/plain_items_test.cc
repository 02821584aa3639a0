// The bytes in which one process hands a file's contents to another: read back exactly, and refused where they are anything
// else.
#include "corank/result/files/plain_items.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace corank::result {
namespace {

std::string bytes_of(const Item& item, const std::string& data) {
  return item_header(item, data.size()) + data + item_padding(data.size());
}

Item text_item(const std::string& name, std::uint64_t width, std::uint64_t count) {
  Item item;
  item.name = name;
  item.type = ItemType::text;
  item.width = width;
  item.rank = 1;
  item.sizes = {count, 1};
  return item;
}

std::string sample() {
  Item words;
  words.name = "/boxes/verdict";
  words.type = ItemType::word;
  words.rank = 1;
  words.sizes = {3, 1};
  words.words = {{0, "regular"}, {7, "pending"}};
  Item number;
  number.name = "/@sigma";
  number.type = ItemType::float64;
  number.width = 8;
  const double sigma = 0.1;
  std::string raw(8, '\0');
  std::memcpy(raw.data(), &sigma, 8);
  return bytes_of(words, std::string("\0\7\7", 3)) + bytes_of(number, raw) + bytes_of(text_item("/names", 2, 2), "abcd") +
         the_end();
}

std::map<std::string, Item> parsed_items(const std::string& bytes) { return parse_items(std::as_bytes(std::span(bytes))); }

TEST(PlainItems, AreReadBack) {
  const std::string bytes = sample();
  const auto items = parsed_items(bytes);
  ASSERT_EQ(items.size(), 3u);
  const Item& words = items.at("/boxes/verdict");
  EXPECT_EQ(words.type, ItemType::word);
  EXPECT_EQ(words.words.at(1), (std::pair<std::uint8_t, std::string>{7, "pending"}));
  EXPECT_EQ(words.data.size(), 3u);
  EXPECT_EQ(words.data[2], std::byte{7});
  EXPECT_EQ(items.at("/names").elements(), 2u);
  EXPECT_EQ(items.at("/@sigma").rank, 0);
}

TEST(PlainItems, AreRefusedWhereTheyEndEarly) {
  const std::string bytes = sample();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(parsed_items(bytes.substr(0, length)), PlainItemsError) << length;
}

TEST(PlainItems, AreRefusedWhereANameStandsTwice) {
  const std::string item = bytes_of(text_item("/names", 2, 2), "abcd");
  EXPECT_THROW(parsed_items(item + item + the_end()), PlainItemsError);
}

TEST(PlainItems, AreRefusedWhereShapeAndDataContradictEachOther) {
  EXPECT_THROW(parsed_items(bytes_of(text_item("/names", 2, 3), "abcd") + the_end()), PlainItemsError);
  EXPECT_THROW(parsed_items(bytes_of(text_item("/names", std::uint64_t{1} << 63, 2), "") + the_end()), PlainItemsError)
      << "overflow";
  EXPECT_THROW(parsed_items(bytes_of(text_item("/names", 0, 2), "") + the_end()), PlainItemsError);
}

TEST(PlainItems, AreReadOrRefusedWhateverTheirBytes) {
  const std::string bytes = sample();
  std::mt19937 random(7);
  int refused = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string changed = bytes;
    for (int c = 0; c < 3; ++c) changed[random() % changed.size()] = static_cast<char>(random());
    try {
      for (const auto& [name, item] : parsed_items(changed)) ASSERT_EQ(item.data.size(), item.elements() * item.width);
    } catch (const PlainItemsError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 20000) << "some changes are of data only";
}

}  // namespace
}  // namespace corank::result
