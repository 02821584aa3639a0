#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "corank/result/files/hdf5_contents.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/text_file.h"

namespace corank::result {
namespace {

// What the child needs beside the contents, which it passes on in blocks.
constexpr std::uint64_t kMemory = std::uint64_t{256} << 20;
constexpr std::uint64_t kSeconds = 4, kBytesPerSecond = std::uint64_t{10} << 20;

SharedBytes read_guarded(const std::string& path, Contents wanted) {
  if (const std::string fault = symbolic::reading_fault(path); !fault.empty())
    throw ResultFileError(printable_line(path) + ": cannot read this: " + fault);
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) throw ResultFileError(printable_line(path) + ": cannot read this: " + error.message());
  try {
    return run_guarded({kMemory + size, kSeconds + size / kBytesPerSecond},
                       [&](ByteSink& sink) { copy_contents(path, sink, wanted); });
  } catch (const GuardedWorkError& problem) {
    throw ResultFileError(printable_line(path + ": " + problem.what()));
  }
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::string& path, Contents wanted)
    : path_(printable_line(path)), bytes_(read_guarded(path, wanted)) {
  parse(bytes_->bytes());
}

Hdf5Reader::Hdf5Reader(std::string path, std::span<const std::byte> items) : path_(std::move(path)) { parse(items); }

void Hdf5Reader::parse(std::span<const std::byte> bytes) {
  try {
    items_ = parse_items(bytes);
  } catch (const PlainItemsError& error) {
    fail(std::string("damaged: ") + error.what());
  }
}

void Hdf5Reader::fail(const std::string& what) const { throw ResultFileError(printable_line(path_ + ": " + what)); }

const Item& Hdf5Reader::array(const std::string& name) const {
  const auto found = items_.find(at(name));
  if (found == items_.end()) fail("not a corank result: " + at(name) + " is missing");
  return found->second;
}

const Item& Hdf5Reader::array(const std::string& name, ItemType type, const std::string& expected) const {
  const Item& item = array(name);
  if (item.type != type) fail(name + " holds no " + expected);
  return item;
}

const Item& Hdf5Reader::shaped(const std::string& name, ItemType type, std::size_t rows, std::size_t columns,
                               const std::string& expected) const {
  const Item& item = array(name, type, expected);
  const int rank = columns == 0 ? 1 : 2;
  if (item.rank != rank || item.sizes[0] != rows || (rank == 2 && item.sizes[1] != columns))
    fail(name + " has another shape than the rest of the file; expected " + std::to_string(rows) +
         (rank == 2 ? " x " + std::to_string(columns) : ""));
  return item;
}

std::vector<double> Hdf5Reader::doubles(const std::string& name, std::size_t rows, std::size_t columns) const {
  return shaped(name, ItemType::float64, rows, columns, "floating-point numbers").copied<double>();
}

void Hdf5Reader::take_rows(const std::vector<std::string>& doubles, const std::string& bytes, std::size_t rows,
                           std::size_t columns, const UseRow& use) {
  constexpr std::size_t kBlock = std::size_t{4} << 20;
  std::vector<const Item*> items;
  for (const std::string& name : doubles)
    items.push_back(&shaped(name, ItemType::float64, rows, columns, "floating-point numbers"));
  const Item& masks = shaped(bytes, ItemType::uint8, rows, columns, "integers of one byte");
  if (columns == 0) return;
  const std::size_t at_once = std::max<std::size_t>(1, kBlock / (columns * sizeof(double)));
  std::vector<std::vector<double>> blocks(items.size());
  std::vector<std::span<const double>> row(items.size());
  std::vector<std::uint8_t> mask;
  const auto take = [this](std::span<const std::byte> data, auto& block) {
    std::memcpy(block.data(), data.data(), data.size());
    if (bytes_) bytes_->forget(data);
  };
  for (std::size_t from = 0; from < rows; from += at_once) {
    const std::size_t first = from * columns, count = std::min(at_once, rows - from) * columns;
    for (std::size_t k = 0; k < items.size(); ++k) {
      blocks[k].resize(count);
      take(items[k]->data.subspan(first * sizeof(double), count * sizeof(double)), blocks[k]);
    }
    mask.resize(count);
    take(masks.data.subspan(first, count), mask);
    for (std::size_t i = 0; i < count; i += columns) {
      for (std::size_t k = 0; k < items.size(); ++k) row[k] = std::span(blocks[k]).subspan(i, columns);
      use((first + i) / columns, row, std::span(mask).subspan(i, columns));
    }
  }
}

const Item& Hdf5Reader::vector_item(const std::string& name, ItemType type, const std::string& expected) const {
  const Item& item = array(name, type, expected);
  if (item.rank != 1) fail(name + (type == ItemType::text ? " is not a list of texts" : " is not a vector"));
  return item;
}

std::vector<std::uint8_t> Hdf5Reader::enumeration(const std::string& name, const std::vector<std::string>& words) const {
  const Item& item = vector_item(name, ItemType::word, "enumeration");
  std::array<int, 256> meaning, place;
  meaning.fill(-1);
  place.fill(-1);
  for (std::size_t k = 0; k < item.words.size(); ++k) {
    const auto& [value, word] = item.words[k];
    if (place[value] >= 0) fail(name + " is a damaged enumeration");
    place[value] = static_cast<int>(k);
    const auto found = std::ranges::find(words, word);
    if (found != words.end()) meaning[value] = static_cast<int>(found - words.begin());
  }
  std::vector<std::uint8_t> data = item.copied<std::uint8_t>();
  for (std::uint8_t& value : data) {
    if (place[value] < 0) fail(name + " holds a number without a word");
    if (meaning[value] < 0) fail(name + " holds the unknown word " + item.words[place[value]].second);
    value = static_cast<std::uint8_t>(meaning[value]);
  }
  return data;
}

std::string Hdf5Reader::text(const std::string& name) const {
  const Item& item = array(name, ItemType::text, "text");
  if (item.elements() != 1) fail(name + " is not a text");
  return text_of(item);
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  const Item& item = vector_item(name, ItemType::text, "texts");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < item.elements(); ++i) texts.push_back(text_of(item, i));
  return texts;
}

std::string Hdf5Reader::text_of(const Item& item, std::size_t i) {
  const std::string_view padded(reinterpret_cast<const char*>(item.data.data()) + i * item.width, item.width);
  return std::string(padded.substr(0, padded.find_last_not_of('\0') + 1));
}

bool Hdf5Reader::has(const std::string& name) const { return items_.contains(at(name)) || items_.contains(at(name) + "/"); }

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return items_.contains(at(object) + "@" + name);
}

const Item& Hdf5Reader::attribute_item(const std::string& object, const std::string& name, ItemType type) const {
  const auto found = items_.find(at(object) + "@" + name);
  if (found == items_.end()) fail("not a corank result: the attribute " + name + " of " + at(object) + " is missing");
  const std::string which = "the attribute " + name + " of " + object;
  if (found->second.elements() != 1) fail(which + " is not one value");
  if (found->second.type != type)
    fail(which + (type == ItemType::text      ? " is not a text"
                  : type == ItemType::float64 ? " is not a floating-point number"
                                              : " is not an integer of the expected type"));
  return found->second;
}

int Hdf5Reader::integer(const std::string& object, const std::string& name, std::int64_t least, std::int64_t most) const {
  const auto value = attribute<std::int64_t>(object, name);
  if (value < least || value > most)
    fail("the attribute " + name + (object == "/" ? "" : " of " + object) + " is out of range");
  return static_cast<int>(value);
}

std::string format_of(const std::string& path) {
  const Hdf5Reader file(path);
  return file.has_attribute("/", "format") ? file.attribute<std::string>("/", "format") : std::string();
}

}  // namespace corank::result
