// Fields of what files hold, listed once for writing and reading: of a list of values as an array for each field, of a value
// as attributes.
//
//   constexpr auto kAngle = [](auto& field, auto& angle) { field("names", angle.name), field("cosine", angle.cosine); };
//   write_list(file, "/angles/", angles, kAngle);
//   angles = read_list<Angle>(file, "/angles/", kAngle);
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "corank/core/check.h"
#include "corank/core/exact_point.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/words.h"

namespace corank::result {

/// The width of a row that those of the other values have, whatever it is.
inline constexpr std::size_t kAlike = std::numeric_limits<std::size_t>::max();

/// Are integers and rows of numbers compressed?
enum class Storage : bool { plain, packed };

using EnumWords = std::vector<std::string>;
/// The names of an enumeration whose values are 0, 1 … count − 1.
template <class E>
EnumWords words_of(int count) {
  EnumWords words;
  for (int i = 0; i < count; ++i) words.emplace_back(to_string(static_cast<E>(i)));
  return words;
}

/// What such a function is called with. It writes values that are constant, and reads into others.
class StoredList {
 public:
  /// `file` is nothing where the list is written. `count`: of the values, where it is known before.
  StoredList(const Hdf5Reader* file, std::string prefix, Storage storage, std::optional<std::size_t> count)
      : file_(file), prefix_(std::move(prefix)), storage_(storage), count_(count) {}

  /// A text, an exact number or an integer, which has to be within bounds where it is read.
  template <class X>
  void operator()(const char* name, X& x, int least = -kMost, int most = kMost) {
    row(name, std::span(&x, 1), 1, least, most);
  }
  /// A row of `width` of them, or of doubles, for each value.
  template <class List>
  void row(std::string_view name, List&& list, std::size_t width, int least = -kMost, int most = kMost) {
    using X = std::remove_cvref_t<decltype(*std::begin(list))>;
    if constexpr (std::is_same_v<X, double>) {
      cells<double>(name, width, storage_, list);
    } else if constexpr (!std::is_same_v<X, int>) {
      cells<std::string>(name, width, storage_, list);
    } else if (storage_ == Storage::packed) {
      cells<std::int32_t>(name, width, storage_, list, least, most);
    } else {
      cells<std::int64_t>(name, width, storage_, list, least, most);
    }
  }
  /// A double, or bits up to `most`, compressed.
  template <class X>
  void packed(const char* name, X& x, int most = kMost) {
    cells<std::remove_const_t<X>>(name, 1, Storage::packed, std::span(&x, 1), 0, most);
  }
  template <class E>
  void word(const char* name, E& x, const EnumWords& words) {
    cells<std::uint8_t>(name, 1, Storage::plain, std::span(&x, 1), 0, kMost, &words);
  }
  /// Both ends as a row of two; of a box its lower and its upper ends as rows of two arrays, NAMElower and NAMEupper.
  template <class X>
  void interval(const char* name, X& x) {
    Ends<X> ends{x.lo(), x.hi()};
    cells<double>(name, 2, Storage::plain, ends);
    if constexpr (!std::is_const_v<X>) x = read_interval(name, ends.front(), ends.back());
  }
  template <class B>
  void box(std::string_view name, B& box, std::size_t width) {
    std::remove_const_t<Ends<B>> lower, upper;
    for (const Interval& side : box) lower.push_back(side.lo()), upper.push_back(side.hi());
    const bool named = naming_ || !std::is_const_v<B>;  // else the columns are there, and a name takes time
    const std::string of_lower = named ? std::string(name) + "lower" : "",
                      of_upper = named ? std::string(name) + "upper" : "";
    cells<double>(of_lower, width, storage_, static_cast<Ends<B>&>(lower));
    cells<double>(of_upper, width, storage_, static_cast<Ends<B>&>(upper));
    if constexpr (!std::is_const_v<B>)
      for (std::size_t i = 0; i < lower.size(); ++i) box.push_back(read_interval(of_lower, lower[i], upper[i]));
  }

  /// The first value is none, which only says what fields there are.
  void next_value() { at_ = naming_ ? 0 : at_ + 1, next_ = 0, naming_ = false; }
  std::size_t count() const { return count_.value_or(0); }
  void write(Hdf5Writer& file) const;

 private:
  static constexpr int kMost = std::numeric_limits<int>::max();
  template <class X>
  using Ends = std::conditional_t<std::is_const_v<X>, const std::vector<double>, std::vector<double>>;

  /// All values of a field, end to end.
  struct Column {
    std::string name;
    std::size_t width = 1;
    Storage storage = Storage::plain;
    const EnumWords* words = nullptr;
    std::variant<std::vector<std::string>, std::vector<std::int64_t>, std::vector<std::int32_t>, std::vector<double>,
                 std::vector<std::uint8_t>>
        data;
  };

  template <class Stored, class List>
  void cells(std::string_view name, std::size_t width, Storage storage, List&& list, int least = -kMost, int most = kMost,
             const EnumWords* words = nullptr) {
    if (naming_) return add({std::string(name), width, storage, words, std::vector<Stored>()});
    Column& column = columns_.at(next_++);
    auto& data = std::get<std::vector<Stored>>(column.data);
    if constexpr (std::is_const_v<std::remove_reference_t<decltype(*std::begin(list))>>) {
      if (column.width == kAlike) column.width = list.size();
      CORANK_CHECK(list.size() == column.width);
      for (const auto& x : list) data.push_back(stored<Stored>(x));
    } else {
      if constexpr (requires { list.resize(column.width); }) list.resize(column.width);
      for (std::size_t i = 0; i < column.width; ++i) read(name, data[at_ * column.width + i], list[i], least, most);
    }
  }

  template <class Stored, class X>
  static Stored stored(const X& x) {
    if constexpr (std::is_same_v<Stored, std::string>) {
      return text_of(x);
    } else {
      return static_cast<Stored>(x);
    }
  }
  template <class Stored, class X>
  void read(std::string_view name, const Stored& stored, X& x, int least, int most) const {
    if constexpr (std::is_same_v<Stored, std::string>) {
      read_text(name, stored, x);
    } else {
      if (std::is_integral_v<Stored> && (stored < least || stored > most)) refuse(name, "is out of range");
      x = static_cast<X>(stored);
    }
  }
  static const std::string& text_of(const std::string& text) { return text; }
  static std::string text_of(const ExactNumber& x) { return x.text(); }
  static std::string text_of(const RationalPolynomial& f);                                // coefficients with commas between
  void read_text(std::string_view name, const std::string& text, std::string& to) const;  // printable
  void read_text(std::string_view name, const std::string& text, ExactNumber& to) const;
  void read_text(std::string_view name, const std::string& text, RationalPolynomial& to) const;
  Interval read_interval(std::string_view name, double lower, double upper) const;
  void add(Column column);
  [[noreturn]] void refuse(std::string_view name, const std::string& what) const;

  const Hdf5Reader* file_;
  const std::string prefix_;
  const Storage storage_;
  std::optional<std::size_t> count_;
  std::vector<Column> columns_;
  std::size_t next_ = 0, at_ = 0;
  bool naming_ = true;
};

template <class T, class Fields>
void write_list(Hdf5Writer& file, const std::string& prefix, const std::vector<T>& list, const Fields& fields,
                Storage storage = Storage::plain) {
  StoredList stored(nullptr, prefix, storage, {});
  const T none{};
  fields(stored, none);
  for (const T& value : list) stored.next_value(), fields(stored, value);
  stored.write(file);
}

/// Into the values that a list has already. Throws ResultFileError where the arrays have other lengths, or a value is out of
/// its range.
template <class T, class Fields>
void read_into(const Hdf5Reader& file, const std::string& prefix, std::vector<T>& list, const Fields& fields,
               Storage storage = Storage::plain, bool counted = true) {
  StoredList stored(&file, prefix, storage, counted ? std::optional(list.size()) : std::nullopt);
  T none{};
  fields(stored, none);
  if (!counted) list.resize(stored.count());
  for (T& value : list) stored.next_value(), fields(stored, value);
}

template <class T, class Fields>
std::vector<T> read_list(const Hdf5Reader& file, const std::string& prefix, const Fields& fields,
                         Storage storage = Storage::plain) {
  std::vector<T> list;
  read_into(file, prefix, list, fields, storage, false);
  return list;
}

/// What a file holds of one value, listed once for writing and reading: attributes of an object, lists, texts. `File` is
/// Hdf5Writer or Hdf5Reader.
template <class File>
class StoredPart {
 public:
  static constexpr bool kWrites = std::is_same_v<File, Hdf5Writer>;

  explicit StoredPart(File& file, const char* object = "/") : file_(file), object_(object) {}

  /// An attribute: file("threads", options.threads, 0, 1000).
  template <class X>
  void operator()(const char* name, X& x, std::int64_t least = 0, std::int64_t most = 0) const {
    using Plain = std::remove_const_t<X>;
    constexpr bool is_small = std::is_integral_v<Plain> && sizeof(Plain) < sizeof(std::int64_t);
    using Stored = std::conditional_t<is_small, std::int64_t, Plain>;
    if constexpr (kWrites) {
      file_.attribute(object_, name, static_cast<Stored>(x));
    } else if constexpr (is_small && !std::is_same_v<Plain, bool>) {
      x = static_cast<X>(file_.integer(object_, name, least, most));
    } else if constexpr (std::is_same_v<Plain, std::string>) {
      x = printable_line(file_.template attribute<Stored>(object_, name));
    } else {
      x = static_cast<X>(file_.template attribute<Stored>(object_, name));
    }
  }
  /// An attribute that is `none` where nothing is known.
  void optional(const char* name, auto& x, std::int64_t least, std::int64_t most, std::int64_t none) const {
    if constexpr (kWrites) {
      file_.attribute(object_, name, x ? std::int64_t{*x} : none);
    } else if (file_.template attribute<std::int64_t>(object_, name) != none) {
      x = file_.integer(object_, name, least, most);
    }
  }
  template <class List, class Fields>
  void list(const std::string& prefix, List& list, const Fields& fields, Storage storage = Storage::plain) const {
    further(prefix, list, fields, storage, false);
  }
  /// Fields of values that are there already.
  template <class List, class Fields>
  void further(const std::string& prefix, List& list, const Fields& fields, Storage storage = Storage::plain,
               bool counted = true) const {
    if constexpr (kWrites) {
      write_list(file_, prefix, list, fields, storage);
    } else {
      read_into(file_, prefix, list, fields, storage, counted);
    }
  }
  void text(const std::string& name, auto& x) const {
    if constexpr (kWrites) {
      file_.text(name, x);
    } else {
      x = file_.text(name);
    }
  }
  /// Read, they are printable.
  void texts(const std::string& name, auto& list) const {
    if constexpr (kWrites) {
      file_.texts(name, list);
    } else {
      list = file_.texts(name);
      for (std::string& text : list) text = printable_line(text);
    }
  }
  /// Texts that the reader knows.
  void same(const std::string& name, const std::vector<std::string>& texts, const char* problem) const {
    if constexpr (kWrites) {
      file_.texts(name, texts);
    } else {
      check(file_.texts(name) == texts, problem);
    }
  }
  /// Where it is read.
  void check([[maybe_unused]] bool good, [[maybe_unused]] const std::string& problem) const {
    if constexpr (!kWrites)
      if (!good) file_.fail(problem);
  }

 private:
  File& file_;
  const char* const object_;
};

}  // namespace corank::result
