#include "corank/report/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <utility>

namespace corank::report {
namespace {

// HDF5 prints its error stack to stderr unless told not to.
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw ResultFileError(path + ": " + what); }

// An open HDF5 object; the operations on it throw on behalf of `path` and `item`.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& path, const std::string& problem) : id_(id), close_(close) {
    if (id_ < 0) fail(path, problem);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// A text of fixed length, padded with zeros: HDF5 has no strings of length 0, and variable-length ones end at a zero byte.
struct TextType : Handle {
  TextType(std::size_t length, const std::string& path)
      : Handle(H5Tcopy(H5T_C_S1), H5Tclose, path, "cannot describe a text") {
    H5Tset_size(*this, std::max<std::size_t>(length, 1));
    H5Tset_strpad(*this, H5T_STR_NULLPAD);
    H5Tset_cset(*this, H5T_CSET_UTF8);
  }
};

struct WordsType : Handle {
  WordsType(const std::vector<std::string>& words, const std::string& path)
      : Handle(H5Tenum_create(H5T_NATIVE_UINT8), H5Tclose, path, "cannot describe an enumeration") {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto value = static_cast<std::uint8_t>(i);
      if (H5Tenum_insert(*this, words[i].c_str(), &value) < 0) fail(path, "cannot describe the word " + words[i]);
    }
  }
};

// columns = 0: a vector.
struct Shape : Handle {
  Shape(std::size_t rows, std::size_t columns, const std::string& path)
      : Shape(std::array<hsize_t, 2>{rows, columns}, columns == 0 ? 1 : 2, path) {}

 private:
  Shape(const std::array<hsize_t, 2>& sizes, int rank, const std::string& path)
      : Handle(H5Screate_simple(rank, sizes.data(), nullptr), H5Sclose, path, "cannot describe an array") {}
};

struct Scalar : Handle {
  explicit Scalar(const std::string& path) : Handle(H5Screate(H5S_SCALAR), H5Sclose, path, "cannot describe a value") {}
};

void write_dataset(hid_t file, const std::string& path, const std::string& name, hid_t type, hid_t space, const void* data,
                   hid_t properties = H5P_DEFAULT) {
  const QuietErrors quiet;
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, path, "cannot write " + name);
  H5Pset_create_intermediate_group(links, 1);
  const Handle set(H5Dcreate2(file, name.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose, path,
                   "cannot write " + name);
  if (H5Sget_simple_extent_npoints(space) == 0) return;
  if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(path, "cannot write " + name + " (disk full?)");
}

void write_packed(hid_t file, const std::string& path, const std::string& name, hid_t type, std::size_t size,
                  const void* data) {
  constexpr hsize_t kChunk = 1 << 16;
  constexpr unsigned kLevel = 6;
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path, "cannot write " + name);
  const hsize_t chunk = std::clamp<hsize_t>(size, 1, kChunk);
  if (H5Pset_chunk(properties, 1, &chunk) < 0 || H5Pset_shuffle(properties) < 0 || H5Pset_deflate(properties, kLevel) < 0)
    fail(path, "cannot compress " + name);
  write_dataset(file, path, name, type, Shape(size, 0, path), data, properties);
}

void write_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name, hid_t type,
                     const void* data) {
  const QuietErrors quiet;
  const Handle at(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose, path, "cannot write to " + object);
  const Scalar space(path);
  const Handle attribute(H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
                         "cannot write the attribute " + name + " of " + object);
  if (H5Awrite(attribute, type, data) < 0) fail(path, "cannot write the attribute " + name + " of " + object);
}

// An opened dataset and its shape.
class Dataset {
 public:
  Dataset(hid_t file, const std::string& path, const std::string& name)
      : path_(path),
        name_(name),
        set_(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, path, "no corank result: " + name + " is missing"),
        space_(H5Dget_space(set_), H5Sclose, path, name + " has no shape") {
    rank_ = H5Sget_simple_extent_ndims(space_);
    if (rank_ < 0 || rank_ > 2) fail(path, name + " has " + std::to_string(rank_) + " dimensions; expected at most 2");
    H5Sget_simple_extent_dims(space_, sizes_.data(), nullptr);
  }
  Handle type() const { return {H5Dget_type(set_), H5Tclose, path_, name_ + " has no type"}; }
  std::size_t size() const { return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space_)); }
  int rank() const { return rank_; }

  void expect_shape(std::size_t rows, std::size_t columns) const {
    const int rank = columns == 0 ? 1 : 2;
    if (rank_ == rank && sizes_[0] == rows && (rank == 1 || sizes_[1] == columns)) return;
    fail(path_, name_ + " has another shape than the rest of the file; expected " + std::to_string(rows) +
                    (rank == 2 ? " x " + std::to_string(columns) : ""));
  }
  void read(hid_t type, void* data) const {
    if (size() == 0) return;
    if (H5Dread(set_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(path_, "cannot read " + name_);
  }

 private:
  std::string path_, name_;
  Handle set_, space_;
  int rank_ = 0;
  std::array<hsize_t, 2> sizes_{};
};

void read_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name, hid_t type,
                    void* data) {
  const QuietErrors quiet;
  const Handle attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
                         "no corank result: the attribute " + name + " of " + object + " is missing");
  const Handle space(H5Aget_space(attribute), H5Sclose, path, name + " has no shape");
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, type, data) < 0) {
    fail(path, "cannot read the attribute " + name + " of " + object);
  }
}

template <class T>
void read_vector(hid_t file, const std::string& path, const std::string& name, H5T_class_t expected, hid_t type,
                 std::vector<T>& data) {
  const QuietErrors quiet;
  const Dataset set(file, path, name);
  if (set.rank() != 1 || H5Tget_class(set.type()) != expected) fail(path, name + " is no vector of numbers of its kind");
  data.resize(set.size());
  set.read(type, data.data());
}

std::string unpadded(const char* begin, std::size_t length) {
  while (length > 0 && begin[length - 1] == '\0') --length;
  return {begin, length};
}

bool is_fixed_text(hid_t type) { return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0; }

}  // namespace

Hdf5Writer::Hdf5Writer(const std::string& path) : path_(path) {
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

void Hdf5Writer::group(const std::string& name) {
  const QuietErrors quiet;
  const Handle created(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path_,
                       "cannot make the group " + name);
}

void Hdf5Writer::doubles(const std::string& name, std::span<const double> data, std::size_t rows, std::size_t columns) {
  write_dataset(file_, path_, name, H5T_NATIVE_DOUBLE, Shape(rows, columns, path_), data.data());
}

void Hdf5Writer::bytes(const std::string& name, std::span<const std::uint8_t> data, std::size_t rows, std::size_t columns) {
  write_dataset(file_, path_, name, H5T_NATIVE_UINT8, Shape(rows, columns, path_), data.data());
}

void Hdf5Writer::integers(const std::string& name, std::span<const std::int64_t> data) {
  write_dataset(file_, path_, name, H5T_NATIVE_INT64, Shape(data.size(), 0, path_), data.data());
}

void Hdf5Writer::packed(const std::string& name, std::span<const std::uint8_t> data) {
  write_packed(file_, path_, name, H5T_NATIVE_UINT8, data.size(), data.data());
}
void Hdf5Writer::packed(const std::string& name, std::span<const std::int32_t> data) {
  write_packed(file_, path_, name, H5T_NATIVE_INT32, data.size(), data.data());
}
void Hdf5Writer::packed(const std::string& name, std::span<const float> data) {
  write_packed(file_, path_, name, H5T_NATIVE_FLOAT, data.size(), data.data());
}
void Hdf5Writer::packed(const std::string& name, std::span<const double> data) {
  write_packed(file_, path_, name, H5T_NATIVE_DOUBLE, data.size(), data.data());
}

void Hdf5Writer::enumeration(const std::string& name, std::span<const std::uint8_t> data,
                             const std::vector<std::string>& words) {
  write_dataset(file_, path_, name, WordsType(words, path_), Shape(data.size(), 0, path_), data.data());
}

void Hdf5Writer::text(const std::string& name, const std::string& text) {
  write_dataset(file_, path_, name, TextType(text.size(), path_), Scalar(path_), text.c_str());
}

void Hdf5Writer::texts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& t : texts) length = std::max(length, t.size());
  std::string data(length * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(data.data() + i * length, length);
  write_dataset(file_, path_, name, TextType(length, path_), Shape(texts.size(), 0, path_), data.data());
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(file_, path_, object, name, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  write_attribute(file_, path_, object, name, H5T_NATIVE_INT64, &value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::uint64_t value) {
  write_attribute(file_, path_, object, name, H5T_NATIVE_UINT64, &value);
}
void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::string& value) {
  write_attribute(file_, path_, object, name, TextType(value.size(), path_), value.c_str());
}

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path) {
  const QuietErrors quiet;
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) fail(path, "cannot read this as an HDF5 file: missing, foreign or cut short");
}

Hdf5Reader::~Hdf5Reader() {
  const QuietErrors quiet;
  H5Fclose(file_);
}

std::vector<double> Hdf5Reader::doubles(const std::string& name, std::size_t rows, std::size_t columns) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  set.expect_shape(rows, columns);
  if (H5Tget_class(set.type()) != H5T_FLOAT) fail(path_, name + " holds no floating-point numbers");
  std::vector<double> data(set.size());
  set.read(H5T_NATIVE_DOUBLE, data.data());
  return data;
}

std::vector<std::uint8_t> Hdf5Reader::bytes(const std::string& name, std::size_t rows, std::size_t columns) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  set.expect_shape(rows, columns);
  if (H5Tget_class(set.type()) != H5T_INTEGER) fail(path_, name + " holds no integers");
  std::vector<std::uint8_t> data(set.size());
  set.read(H5T_NATIVE_UINT8, data.data());
  return data;
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  set.expect_shape(set.size(), 0);
  if (H5Tget_class(set.type()) != H5T_INTEGER) fail(path_, name + " holds no integers");
  std::vector<std::int64_t> data(set.size());
  set.read(H5T_NATIVE_INT64, data.data());
  return data;
}

void Hdf5Reader::read(const std::string& name, std::vector<std::uint8_t>& data) const {
  read_vector(file_, path_, name, H5T_INTEGER, H5T_NATIVE_UINT8, data);
}
void Hdf5Reader::read(const std::string& name, std::vector<std::int32_t>& data) const {
  read_vector(file_, path_, name, H5T_INTEGER, H5T_NATIVE_INT32, data);
}
void Hdf5Reader::read(const std::string& name, std::vector<float>& data) const {
  read_vector(file_, path_, name, H5T_FLOAT, H5T_NATIVE_FLOAT, data);
}
void Hdf5Reader::read(const std::string& name, std::vector<double>& data) const {
  read_vector(file_, path_, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, data);
}

std::vector<std::uint8_t> Hdf5Reader::enumeration(const std::string& name, const std::vector<std::string>& words) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  set.expect_shape(set.size(), 0);
  const Handle stored = set.type();
  if (H5Tget_class(stored) != H5T_ENUM || H5Tget_size(stored) != 1) fail(path_, name + " is no enumeration");
  std::vector<std::uint8_t> data(set.size());
  const Handle raw_type(H5Tcopy(stored), H5Tclose, path_, name + " has no type");
  set.read(raw_type, data.data());
  std::array<int, 256> meaning;
  meaning.fill(-1);
  for (std::uint8_t& value : data) {
    if (meaning[value] < 0) {
      std::array<char, 64> word{};
      if (H5Tenum_nameof(stored, &value, word.data(), word.size()) < 0) fail(path_, name + " holds a number without a word");
      const auto found = std::find(words.begin(), words.end(), std::string(word.data()));
      if (found == words.end()) fail(path_, name + " holds the unknown word " + word.data());
      meaning[value] = static_cast<int>(found - words.begin());
    }
    value = static_cast<std::uint8_t>(meaning[value]);
  }
  return data;
}

std::string Hdf5Reader::text(const std::string& name) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  const Handle type = set.type();
  if (set.size() != 1 || !is_fixed_text(type)) fail(path_, name + " is no text");
  std::string data(H5Tget_size(type), '\0');
  set.read(type, data.data());
  return unpadded(data.data(), data.size());
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  const QuietErrors quiet;
  const Dataset set(file_, path_, name);
  const Handle type = set.type();
  if (set.rank() != 1 || !is_fixed_text(type)) fail(path_, name + " is no list of texts");
  const std::size_t length = H5Tget_size(type);
  std::string data(length * set.size(), '\0');
  set.read(type, data.data());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < set.size(); ++i) texts.push_back(unpadded(data.data() + i * length, length));
  return texts;
}

bool Hdf5Reader::has(const std::string& name) const {
  const QuietErrors quiet;
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {  // H5Lexists wants every group on the way
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}
bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  const QuietErrors quiet;
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}
double Hdf5Reader::double_attribute(const std::string& object, const std::string& name) const {
  double value = 0;
  read_attribute(file_, path_, object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}
std::int64_t Hdf5Reader::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  read_attribute(file_, path_, object, name, H5T_NATIVE_INT64, &value);
  return value;
}
std::uint64_t Hdf5Reader::unsigned_attribute(const std::string& object, const std::string& name) const {
  std::uint64_t value = 0;
  read_attribute(file_, path_, object, name, H5T_NATIVE_UINT64, &value);
  return value;
}
std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const QuietErrors quiet;
  const Handle attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path_,
                         "no corank result: the attribute " + name + " of " + object + " is missing");
  const Handle type(H5Aget_type(attribute), H5Tclose, path_, name + " has no type");
  if (!is_fixed_text(type)) fail(path_, "the attribute " + name + " of " + object + " is no text");
  std::string data(H5Tget_size(type), '\0');
  read_attribute(file_, path_, object, name, type, data.data());
  return unpadded(data.data(), data.size());
}

}  // namespace corank::report
