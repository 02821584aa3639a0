// HDF5 as far as corank needs it: named arrays, texts and attributes, written and read exactly. Paths are "/group/name";
// groups are made on the way. Every failure is a ResultFileError that names the file and the item.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "corank/core/guarded_process.h"
#include "corank/result/files/hdf5_contents.h"
#include "corank/result/files/plain_items.h"

namespace corank::result {

/// A result file that cannot be written or read, or that holds something else. what() is one line.
class ResultFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Hdf5Writer {
 public:
  /// Creates or truncates the file. `threads` compress what is to be packed, 0: one for each core. Once `in_haste`
  /// says so, it is written as it is: a larger file, sooner.
  explicit Hdf5Writer(const std::string& path, int threads = 1, Ended in_haste = {});
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// From now on every path is meant below this one, "/parts/0", which is made; "": below the file's root.
  void enter(const std::string& prefix);

  void group(const std::string& name);
  /// rows × columns doubles, row-major, bit for bit; columns = 0: a vector of `rows`.
  void doubles(const std::string& name, std::span<const double> data, std::size_t rows, std::size_t columns);
  /// The same row by row, so that no copy of all is made: `fill` sets the next row, which has `columns` > 0 zeros before.
  template <class T>
  using FillRow = std::function<void(std::size_t row, std::span<T> to)>;
  void doubles(const std::string& name, std::size_t rows, std::size_t columns, const FillRow<double>& fill);
  void bytes(const std::string& name, std::size_t rows, std::size_t columns, const FillRow<std::uint8_t>& fill);
  void integers(const std::string& name, std::span<const std::int64_t> data);
  /// Values that index `words`, stored as an enumeration of these words.
  void enumeration(const std::string& name, std::span<const std::uint8_t> data, const std::vector<std::string>& words);
  /// A vector or a span of any length, of std::uint8_t, std::int32_t, float or double, compressed (deflate).
  template <class List>
  void packed(const std::string& name, const List& data) {
    write_packed(name, item_type<typename List::value_type>(), std::as_bytes(std::span(data)));
  }
  void text(const std::string& name, const std::string& text);
  void texts(const std::string& name, const std::vector<std::string>& texts);

  /// Of type double, std::int64_t or std::uint64_t.
  template <class T>
  void attribute(const std::string& object, const std::string& name,
                 T value) requires(std::is_arithmetic_v<T> && sizeof(T) == 8) {
    write_attribute(object, name, item_type<T>(), &value);
  }
  void attribute(const std::string& object, const std::string& name, const std::string& value);

  /// Writes everything out; a writer that is destroyed without it leaves a file of no worth.
  void close();

 private:
  void write_packed(const std::string& name, ItemType type, std::span<const std::byte> data);
  void write_attribute(const std::string& object, const std::string& name, ItemType type, const void* value);
  std::string at(const std::string& name) const { return name == "/" && !prefix_.empty() ? prefix_ : prefix_ + name; }

  std::string path_, prefix_;
  int threads_;
  Ended in_haste_;
  std::int64_t file_ = -1;
};

/// Reads what a stranger may have written: the HDF5 library works in a child process with limits of memory and time, after
/// a check of the file's structure (result/files/hdf5_contents.h); what comes back is plain.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& path, Contents wanted = Contents::result);
  /// Items that are in memory already, as result/files/plain_items.h lays them out; `path` is for messages. The bytes have
  /// to outlive the reader.
  Hdf5Reader(std::string path, std::span<const std::byte> items);

  /// As Hdf5Writer::enter().
  void enter(const std::string& prefix) { prefix_ = prefix; }

  /// Each throws where the item is missing, or has another shape or type.
  std::vector<double> doubles(const std::string& name, std::size_t rows, std::size_t columns) const;
  /// The same row by row, of one or several arrays of this shape at once. What has been read is forgotten: a large array
  /// cannot be read twice, and is never there as a whole beside what is made of it.
  using UseRow = std::function<void(std::size_t row, std::span<const std::span<const double>> rows,
                                    std::span<const std::uint8_t> bytes)>;
  void take_rows(const std::vector<std::string>& doubles, const std::string& bytes, std::size_t rows, std::size_t columns,
                 const UseRow& use);
  /// A vector of any length, of std::uint8_t, std::int32_t, std::int64_t, float or double.
  template <class T>
  std::vector<T> vector(const std::string& name) const {
    return vector_item(name, item_type<T>(), "numbers of its kind").template copied<T>();
  }
  /// Indices into `words`, matched by word, not by number.
  std::vector<std::uint8_t> enumeration(const std::string& name, const std::vector<std::string>& words) const;
  std::string text(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;

  bool has(const std::string& name) const;  ///< a group or an array
  std::size_t rows(const std::string& name) const { return array(name).sizes[0]; }
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// Of type double, std::int64_t, std::uint64_t or std::string.
  template <class T>
  T attribute(const std::string& object, const std::string& name) const {
    if constexpr (std::is_same_v<T, std::string>) {
      return text_of(attribute_item(object, name, ItemType::text));
    } else {
      return attribute_item(object, name, item_type<T>()).template copied<T>().front();
    }
  }
  /// Throws where it is not from `least` to `most`.
  int integer(const std::string& object, const std::string& name, std::int64_t least, std::int64_t most) const;

  /// For messages, which are printable.
  const std::string& path() const { return path_; }
  /// Throws ResultFileError: "path: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void parse(std::span<const std::byte> bytes);
  const Item& array(const std::string& name) const;
  const Item& array(const std::string& name, ItemType type, const std::string& expected) const;
  const Item& vector_item(const std::string& name, ItemType type, const std::string& expected) const;
  const Item& attribute_item(const std::string& object, const std::string& name, ItemType type) const;
  static std::string text_of(const Item& item, std::size_t i = 0);
  const Item& shaped(const std::string& name, ItemType type, std::size_t rows, std::size_t columns,
                     const std::string& expected) const;

  std::string at(const std::string& name) const { return name == "/" && !prefix_.empty() ? prefix_ : prefix_ + name; }

  std::string path_, prefix_;
  std::optional<SharedBytes> bytes_;
  std::map<std::string, Item> items_;
};

/// Of what kind is the file, as its first words say: the text attribute `format` of its root; empty where it has none.
/// Throws ResultFileError where it is no readable HDF5 file.
std::string format_of(const std::string& path);

}  // namespace corank::result
