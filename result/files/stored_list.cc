#include "corank/result/files/stored_list.h"

namespace corank::result {

std::string StoredList::text_of(const RationalPolynomial& f) {
  std::string text;
  for (const ExactNumber& c : f) text += (text.empty() ? "" : ", ") + c.text();
  return text;
}

void StoredList::read_text(std::string_view, const std::string& text, std::string& to) const { to = printable_line(text); }

void StoredList::read_text(std::string_view name, const std::string& text, ExactNumber& to) const {
  try {
    to = ExactNumber::rational(text);
  } catch (const std::exception& error) {
    refuse(name, std::string("holds no number: ") + error.what());
  }
}

void StoredList::read_text(std::string_view name, const std::string& text, RationalPolynomial& to) const {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(", ", begin), text.size());
    read_text(name, text.substr(begin, end - begin), to.emplace_back());
    begin = end + 2;
  }
}

Interval StoredList::read_interval(std::string_view name, double lower, double upper) const {
  if (!(lower <= upper)) refuse(name, "holds an empty interval");
  return {lower, upper};
}

void StoredList::refuse(std::string_view name, const std::string& what) const {
  throw ResultFileError(printable_line(file_->path() + ": " + prefix_ + std::string(name) + " " + what));
}

void StoredList::write(Hdf5Writer& file) const {
  for (const Column& column : columns_) {
    const std::string name = prefix_ + column.name;
    const auto write = [&](const auto& data) {
      using Stored = typename std::remove_cvref_t<decltype(data)>::value_type;
      if constexpr (std::is_same_v<Stored, std::string>) {
        file.texts(name, data);
      } else if constexpr (std::is_same_v<Stored, std::int64_t>) {
        file.integers(name, data);
      } else if (column.storage == Storage::packed) {
        file.packed(name, data);
      } else if constexpr (std::is_same_v<Stored, std::uint8_t>) {
        file.enumeration(name, data, *column.words);
      } else if constexpr (std::is_same_v<Stored, double>) {
        file.doubles(name, data, column.width == 0 ? 0 : data.size() / column.width, column.width);
      }
    };
    std::visit(write, column.data);
  }
}

// Of a list that is read, all of the array is read at once.
void StoredList::add(Column column) {
  const auto read = [&](auto& data) {
    using Stored = typename std::remove_cvref_t<decltype(data)>::value_type;
    const std::string name = prefix_ + column.name;
    if constexpr (std::is_same_v<Stored, std::string>) {
      data = file_->texts(name);
    } else if constexpr (std::is_same_v<Stored, std::int64_t>) {
      data = file_->vector<std::int64_t>(name);
    } else if (column.storage == Storage::packed) {
      data = file_->vector<Stored>(name);
    } else if constexpr (std::is_same_v<Stored, std::uint8_t>) {
      data = file_->enumeration(name, *column.words);
    } else if constexpr (std::is_same_v<Stored, double>) {
      data = file_->doubles(name, count_.value_or(column.width == 0 ? 0 : file_->rows(name)), column.width);
    }
    if (column.width == kAlike) column.width = count() == 0 ? 0 : data.size() / count();
    if (!count_) count_ = column.width == 0 ? 0 : data.size() / column.width;
    if (data.size() != count() * column.width) refuse(column.name, "has another length than the list, or no whole boxes");
  };
  if (file_) std::visit(read, column.data);
  columns_.push_back(std::move(column));
}

}  // namespace corank::result
