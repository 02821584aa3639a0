// Plain values as bytes for cereal, little-endian, and a reader that is never made to allocate much more than it was given.
#pragma once

#include <bit>
#include <cereal/cereal.hpp>
#include <cstring>
#include <ostream>
#include <string_view>

#include "corank/solve/store/shard_bytes.h"

namespace corank::solve {

static_assert(std::endian::native == std::endian::little, "numbers are written as this machine keeps them");

class ByteOutput : public cereal::OutputArchive<ByteOutput, cereal::AllowEmptyClassElision> {
 public:
  explicit ByteOutput(std::ostream& out) : OutputArchive(this), buffer_(*out.rdbuf()) {}
  void block(const void* bytes, std::uint64_t count) {
    const auto size = static_cast<std::streamsize>(count);
    if (buffer_.sputn(static_cast<const char*>(bytes), size) != size)
      throw ShardError("a part of a search cannot be written");
  }

 private:
  std::streambuf& buffer_;
};

class ByteInput : public cereal::InputArchive<ByteInput, cereal::AllowEmptyClassElision> {
 public:
  explicit ByteInput(std::string_view bytes) : InputArchive(this), rest_(bytes) {}
  template <class T>
  void number(T& value) {
    need(sizeof(T));
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
  }
  void block(void* bytes, std::uint64_t count) {
    if (count > 0) std::memcpy(bytes, take(count, 1).data(), count);
  }
  /// The next bytes as they are: `rows` rows.
  std::string_view take(std::uint64_t rows, std::uint64_t row) {
    if (row > 0 && rows > rest_.size() / row) throw ShardError("a part of a search cannot be read: it is cut short");
    const std::string_view taken = rest_.substr(0, rows * row);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  /// There are to be so many more values, each of a byte at least.
  void need(std::uint64_t values) const {
    if (values > rest_.size()) throw ShardError("a part of a search cannot be read: it is cut short");
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

template <class T, cereal::traits::EnableIf<std::is_arithmetic_v<T>> = cereal::traits::sfinae>
void CEREAL_SAVE_FUNCTION_NAME(ByteOutput& archive, const T& value) {
  archive.block(&value, sizeof(T));
}
template <class T, cereal::traits::EnableIf<std::is_arithmetic_v<T>> = cereal::traits::sfinae>
void CEREAL_LOAD_FUNCTION_NAME(ByteInput& archive, T& value) {
  archive.number(value);
}
inline void CEREAL_LOAD_FUNCTION_NAME(ByteInput& archive, bool& value) {
  std::uint8_t byte = 0;
  archive.number(byte);
  if (byte > 1) throw ShardError("a part of a search cannot be read: it is damaged");
  value = byte == 1;
}
template <class T>
void CEREAL_SAVE_FUNCTION_NAME(ByteOutput& archive, const cereal::BinaryData<T>& data) {
  archive.block(data.data, data.size);
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(ByteInput& archive, cereal::BinaryData<T>& data) {
  archive.block(data.data, data.size);
}
template <class Archive, class T>
requires std::is_same_v<Archive, ByteOutput> || std::is_same_v<Archive, ByteInput>
void CEREAL_SERIALIZE_FUNCTION_NAME(Archive& archive, cereal::NameValuePair<T>& pair) { archive(pair.value); }
template <class T>
void CEREAL_SAVE_FUNCTION_NAME(ByteOutput& archive, const cereal::SizeTag<T>& tag) {
  archive(static_cast<std::uint64_t>(tag.size));
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(ByteInput& archive, cereal::SizeTag<T>& tag) {
  std::uint64_t size = 0;
  archive.number(size);
  archive.need(size);
  tag.size = size;
}

}  // namespace corank::solve

CEREAL_SETUP_ARCHIVE_TRAITS(corank::solve::ByteInput, corank::solve::ByteOutput)
