#include <algorithm>
#include <array>
#include <utility>

#include "corank/result/files/hdf5_file.h"
#include "corank/result/files/hdf5_handle.h"
#include "corank/result/files/packed_chunks.h"

namespace corank::result {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw ResultFileError(path + ": " + what); }

// A handle whose failure is one of the file.
struct OwnHandle : Handle {
  OwnHandle(hid_t id, herr_t (*close)(hid_t), const std::string& path, const std::string& problem)
      : Handle(id, close, id < 0 ? path + ": " + problem : problem) {}
};

// Of numbers.
hid_t native(ItemType type) {
  switch (type) {
    case ItemType::float64: return H5T_NATIVE_DOUBLE;
    case ItemType::float32: return H5T_NATIVE_FLOAT;
    case ItemType::int64: return H5T_NATIVE_INT64;
    case ItemType::uint64: return H5T_NATIVE_UINT64;
    case ItemType::int32: return H5T_NATIVE_INT32;
    default: return H5T_NATIVE_UINT8;
  }
}

// A text of fixed length, padded with zeros: HDF5 has no strings of length 0, and variable-length ones end at a zero byte.
struct TextType : OwnHandle {
  TextType(std::size_t length, const std::string& path)
      : OwnHandle(H5Tcopy(H5T_C_S1), H5Tclose, path, "cannot describe a text") {
    H5Tset_size(*this, std::max<std::size_t>(length, 1));
    H5Tset_strpad(*this, H5T_STR_NULLPAD);
    H5Tset_cset(*this, H5T_CSET_UTF8);
  }
};

struct WordsType : OwnHandle {
  WordsType(const std::vector<std::string>& words, const std::string& path)
      : OwnHandle(H5Tenum_create(H5T_NATIVE_UINT8), H5Tclose, path, "cannot describe an enumeration") {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto value = static_cast<std::uint8_t>(i);
      if (H5Tenum_insert(*this, words[i].c_str(), &value) < 0) fail(path, "cannot describe the word " + words[i]);
    }
  }
};

// columns = 0: a vector.
struct ArraySpace : OwnHandle {
  ArraySpace(std::size_t rows, std::size_t columns, const std::string& path)
      : ArraySpace(std::array<hsize_t, 2>{rows, columns}, columns == 0 ? 1 : 2, path) {}

 private:
  ArraySpace(const std::array<hsize_t, 2>& sizes, int rank, const std::string& path)
      : OwnHandle(H5Screate_simple(rank, sizes.data(), nullptr), H5Sclose, path, "cannot describe an array") {}
};

struct ScalarSpace : OwnHandle {
  explicit ScalarSpace(const std::string& path)
      : OwnHandle(H5Screate(H5S_SCALAR), H5Sclose, path, "cannot describe a value") {}
};

hid_t create_dataset(hid_t file, const std::string& path, const std::string& name, hid_t type, hid_t space,
                     hid_t properties = H5P_DEFAULT) {
  const OwnHandle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path, "cannot write " + name);
  H5Pset_create_intermediate_group(links, 1);
  const OwnHandle timeless(properties == H5P_DEFAULT ? H5Pcreate(H5P_DATASET_CREATE) : H5Pcopy(properties), H5Pclose, path,
                           "cannot write " + name);
  H5Pset_obj_track_times(timeless, false);  // the same contents are the same bytes
  return H5Dcreate2(file, name.c_str(), type, space, links, timeless, H5P_DEFAULT);
}

void write_dataset(hid_t file, const std::string& path, const std::string& name, hid_t type, hid_t space, const void* data) {
  const QuietErrors quiet;
  const OwnHandle set(create_dataset(file, path, name, type, space), H5Dclose, path, "cannot write " + name);
  if (H5Sget_simple_extent_npoints(space) == 0) return;
  if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(path, "cannot write " + name + " (disk full?)");
}

// So much at a time that what it takes does not depend on the array's size.
template <class T>
void write_rows(hid_t file, const std::string& path, const std::string& name, hid_t type, std::size_t rows,
                std::size_t columns, const Hdf5Writer::FillRow<T>& fill) {
  constexpr std::size_t kBlock = std::size_t{4} << 20;
  const QuietErrors quiet;
  const ArraySpace all(rows, columns, path);
  const OwnHandle set(create_dataset(file, path, name, type, all), H5Dclose, path, "cannot write " + name);
  const std::size_t at_once = std::max<std::size_t>(1, kBlock / (std::max<std::size_t>(1, columns) * sizeof(T)));
  std::vector<T> block;
  for (std::size_t from = 0; from < rows && columns > 0; from += at_once) {
    const std::size_t count = std::min(at_once, rows - from);
    block.assign(count * columns, T{});
    for (std::size_t k = 0; k < count; ++k) fill(from + k, std::span(block).subspan(k * columns, columns));
    const std::array<hsize_t, 2> start{from, 0}, size{count, columns};
    if (H5Sselect_hyperslab(all, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) < 0 ||
        H5Dwrite(set, type, ArraySpace(count, columns, path), all, H5P_DEFAULT, block.data()) < 0)
      fail(path, "cannot write " + name + " (disk full?)");
  }
}

void pack(hid_t file, const std::string& path, const std::string& name, hid_t type, std::span<const std::byte> data,
          int threads, const Ended& in_haste) {
  constexpr hsize_t kChunk = 1 << 16;
  constexpr unsigned kLevel = 1;
  constexpr std::uint32_t kAllFilters = 0, kNoFilter = 3;  // a bit for each that a chunk goes without
  const std::size_t width = H5Tget_size(type), size = data.size() / width;
  const OwnHandle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path, "cannot write " + name);
  const hsize_t chunk = std::clamp<hsize_t>(size, 1, kChunk);
  if (H5Pset_chunk(properties, 1, &chunk) < 0 || H5Pset_shuffle(properties) < 0 || H5Pset_deflate(properties, kLevel) < 0)
    fail(path, "cannot compress " + name);
  const QuietErrors quiet;
  const ArraySpace space(size, 0, path);
  const OwnHandle set(create_dataset(file, path, name, type, space, properties), H5Dclose, path, "cannot write " + name);
  const auto write = [&](std::size_t k, std::span<const std::byte> bytes, bool packed) {
    const hsize_t offset = k * chunk;
    if (H5Dwrite_chunk(set, H5P_DEFAULT, packed ? kAllFilters : kNoFilter, &offset, bytes.size(), bytes.data()) < 0)
      fail(path, "cannot write " + name + " (disk full?)");
  };
  for_each_packed_chunk({data, width, chunk, kLevel}, threads, in_haste, write);
}

void put_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name, hid_t type,
                   const void* data) {
  const QuietErrors quiet;
  const OwnHandle at(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose, path, "cannot write to " + object);
  const ScalarSpace space(path);
  const OwnHandle attribute(H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
                            "cannot write the attribute " + name + " of " + object);
  if (H5Awrite(attribute, type, data) < 0) fail(path, "cannot write the attribute " + name + " of " + object);
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::string& path, int threads, Ended in_haste)
    : path_(path), threads_(threads), in_haste_(std::move(in_haste)) {
  // At the end of the process HDF5 would write once more what a full disk has refused, and crash.
  static const bool no_second_attempt = H5dont_atexit() >= 0;
  static_cast<void>(no_second_attempt);
  const QuietErrors quiet;
  file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file_ < 0) fail(path, "cannot create this file");
}

Hdf5Writer::~Hdf5Writer() {
  const QuietErrors quiet;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::close() {
  const QuietErrors quiet;
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = H5Fclose(std::exchange(file_, -1)) >= 0;
  if (!flushed || !closed) fail(path_, "cannot finish this file (disk full?)");
}

void Hdf5Writer::enter(const std::string& prefix) {
  prefix_.clear();
  if (!prefix.empty()) group(prefix);
  prefix_ = prefix;
}

void Hdf5Writer::group(const std::string& name) {
  const QuietErrors quiet;
  const std::string problem = "cannot make the group " + name;
  const OwnHandle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path_, problem);
  H5Pset_create_intermediate_group(links, 1);
  const OwnHandle created(H5Gcreate2(file_, at(name).c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path_, problem);
}

void Hdf5Writer::doubles(const std::string& name, std::span<const double> data, std::size_t rows, std::size_t columns) {
  write_dataset(file_, path_, at(name), H5T_NATIVE_DOUBLE, ArraySpace(rows, columns, path_), data.data());
}

void Hdf5Writer::doubles(const std::string& name, std::size_t rows, std::size_t columns, const FillRow<double>& fill) {
  write_rows(file_, path_, at(name), H5T_NATIVE_DOUBLE, rows, columns, fill);
}

void Hdf5Writer::bytes(const std::string& name, std::size_t rows, std::size_t columns, const FillRow<std::uint8_t>& fill) {
  write_rows(file_, path_, at(name), H5T_NATIVE_UINT8, rows, columns, fill);
}

void Hdf5Writer::integers(const std::string& name, std::span<const std::int64_t> data) {
  write_dataset(file_, path_, at(name), H5T_NATIVE_INT64, ArraySpace(data.size(), 0, path_), data.data());
}

void Hdf5Writer::write_packed(const std::string& name, ItemType type, std::span<const std::byte> data) {
  pack(file_, path_, at(name), native(type), data, threads_, in_haste_);
}

void Hdf5Writer::enumeration(const std::string& name, std::span<const std::uint8_t> data,
                             const std::vector<std::string>& words) {
  write_dataset(file_, path_, at(name), WordsType(words, path_), ArraySpace(data.size(), 0, path_), data.data());
}

void Hdf5Writer::text(const std::string& name, const std::string& text) {
  write_dataset(file_, path_, at(name), TextType(text.size(), path_), ScalarSpace(path_), text.c_str());
}

void Hdf5Writer::texts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& t : texts) length = std::max(length, t.size());
  std::string data(length * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(data.data() + i * length, length);
  write_dataset(file_, path_, at(name), TextType(length, path_), ArraySpace(texts.size(), 0, path_), data.data());
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name, ItemType type, const void* value) {
  put_attribute(file_, path_, at(object), name, native(type), value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::string& value) {
  put_attribute(file_, path_, at(object), name, TextType(value.size(), path_), value.c_str());
}

}  // namespace corank::result
