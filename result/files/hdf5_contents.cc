#include "corank/result/files/hdf5_contents.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "corank/result/files/hdf5_handle.h"
#include "corank/result/files/plain_items.h"

namespace corank::result {
namespace {

constexpr int kDeepest = 6, kMostItems = 1000;  // of a group
constexpr int kMostItemsInAll = 200'000;        // a result may consist of many parts
constexpr std::size_t kLongestName = 200;
constexpr std::uint64_t kBytesAtATime = std::uint64_t{8} << 20;  // bytes read at a time
constexpr std::uint64_t kLongestChunk = std::uint64_t{1} << 24;
constexpr std::uint64_t kMostDeflated = 1040;  // deflate shrinks by no larger factor
constexpr std::uint64_t kLongestAttribute = std::uint64_t{1} << 16;

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error(what); }

// a·b, refused beyond 2^62.
std::uint64_t times(std::uint64_t a, std::uint64_t b, const std::string& name) {
  if (b != 0 && a > (std::uint64_t{1} << 62) / b) refuse(name + " declares an absurd size");
  return a * b;
}

struct Extents {
  int rank = 0;
  std::array<std::uint64_t, 2> sizes{1, 1};
};

Extents shape_of(hid_t space, const std::string& name) {
  Extents shape;
  const H5S_class_t kind = H5Sget_simple_extent_type(space);
  if (kind == H5S_SCALAR) return shape;
  shape.rank = H5Sget_simple_extent_ndims(space);
  if (kind != H5S_SIMPLE || shape.rank < 1 || shape.rank > 2)
    refuse(name + " does not have the shape of an item of a result");
  std::array<hsize_t, 2> sizes{1, 1}, most{1, 1};
  if (H5Sget_simple_extent_dims(space, sizes.data(), most.data()) < 0) refuse(name + " has no shape");
  for (int k = 0; k < shape.rank; ++k) {
    if (most[k] != sizes[k]) refuse(name + " can grow, which no item of a result can");
    shape.sizes[k] = sizes[k];
  }
  return shape;
}

void describe_words(hid_t type, Item& item) {
  const int count = H5Tget_nmembers(type);
  if (count < 0 || count > 256) refuse(item.name + " is an enumeration of too many words");
  for (unsigned i = 0; i < static_cast<unsigned>(count); ++i) {
    std::uint8_t value = 0;
    char* word = H5Tget_member_name(type, i);
    const std::string text = word ? std::string(word).substr(0, kLongestName) : "";
    H5free_memory(word);
    if (text.empty() || H5Tget_member_value(type, i, &value) < 0) refuse(item.name + " is a damaged enumeration");
    item.words.emplace_back(value, text);
  }
}

// The types that corank writes, and no others.
void describe_type(hid_t type, Item& item) {
  const std::array<std::pair<hid_t, ItemType>, 6> numbers{{{H5T_IEEE_F64LE, ItemType::float64},
                                                           {H5T_IEEE_F32LE, ItemType::float32},
                                                           {H5T_STD_I64LE, ItemType::int64},
                                                           {H5T_STD_U64LE, ItemType::uint64},
                                                           {H5T_STD_I32LE, ItemType::int32},
                                                           {H5T_STD_U8LE, ItemType::uint8}}};
  item.width = H5Tget_size(type);
  for (const auto& [known, kind] : numbers)
    if (H5Tequal(type, known) > 0) return void(item.type = kind);
  if (H5Tget_class(type) == H5T_ENUM && item.width == 1) {
    item.type = ItemType::word;
    return describe_words(type, item);
  }
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || item.width == 0)
    refuse(item.name + " has a type that no result has");
  item.type = ItemType::text;
}

class ContentsCopy {
 public:
  ContentsCopy(const std::string& path, ByteSink& sink, Contents wanted)
      : sink_(sink),
        wanted_(wanted),
        file_size_(std::filesystem::file_size(path)),
        most_(static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / 2),
        file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
              "cannot read this as an HDF5 file: missing, foreign or cut short") {}

  void copy() {
    copy_group("/", 0);
    sink_.write(the_end());
  }

 private:
  // Calls `visit` with the names of a group's links or an object's attributes. An exception must not pass through the
  // library.
  template <class Iterate>
  static std::vector<std::string> names(const Iterate& iterate, const std::string& where) {
    std::vector<std::string> list;
    if (iterate(&list) < 0) refuse(where + " cannot be listed: it is damaged, or holds too much");
    for (const std::string& name : list)
      if (name.empty() || name.size() > kLongestName || name.find_first_of("/@") != std::string::npos)
        refuse(where + " holds an item with a name that no item of a result has");
    return list;
  }
  static herr_t remember(const char* name, void* list) {
    auto& names = *static_cast<std::vector<std::string>*>(list);
    if (names.size() >= kMostItems) return -1;
    names.emplace_back(name);
    return 0;
  }

  void count_item(const std::string& name) {
    if (++items_ > kMostItemsInAll) refuse(name + " is one item too many for a result");
  }

  void copy_group(const std::string& path, int depth) {
    if (depth > kDeepest) refuse(path + " lies too deep for a result");
    const Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose, path + " is not a group");
    copy_attributes(group, path);
    const auto list = [&group](void* found) {
      return H5Literate(
          group, H5_INDEX_NAME, H5_ITER_INC, nullptr,
          [](hid_t, const char* name, const H5L_info_t*, void* data) { return remember(name, data); }, found);
    };
    for (const std::string& name : names(list, path)) {
      const std::string item = (path == "/" ? path : path + "/") + name;
      count_item(item);
      if (path == "/" && (name == kSearchGroup) != (wanted_ == Contents::search)) continue;
      H5L_info_t link;
      if (H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) < 0) refuse(item + " is a damaged link");
      if (link.type != H5L_TYPE_HARD) refuse(item + " is a link to elsewhere; a result holds all of its data");
      H5O_info_t object;
      if (H5Oget_info_by_name2(group, name.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT) < 0) refuse(item + " is damaged");
      if (object.type == H5O_TYPE_GROUP) {
        Item entry;
        entry.name = item + "/";
        entry.sizes = {0, 1};
        entry.rank = 1;
        sink_.write(item_header(entry, 0));
        copy_group(item, depth + 1);
      } else if (object.type == H5O_TYPE_DATASET) {
        copy_dataset(item);
      } else {
        refuse(item + " is neither a group nor an array");
      }
    }
  }

  void copy_attributes(hid_t object, const std::string& path) {
    const auto list = [object](void* found) {
      return H5Aiterate2(
          object, H5_INDEX_NAME, H5_ITER_INC, nullptr,
          [](hid_t, const char* name, const H5A_info_t*, void* data) { return remember(name, data); }, found);
    };
    for (const std::string& name : names(list, path)) {
      Item item;
      item.name = path + "@" + name;
      count_item(item.name);
      const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, item.name + " is damaged");
      const Handle space(H5Aget_space(attribute), H5Sclose, item.name + " has no shape");
      const Handle type(H5Aget_type(attribute), H5Tclose, item.name + " has no type");
      if (H5Sget_simple_extent_npoints(space) != 1) refuse(item.name + " is not one value");
      describe_type(type, item);
      if (item.width > kLongestAttribute) refuse(item.name + " declares an absurd size");
      std::vector<std::byte> data(item.width);
      if (H5Aread(attribute, type, data.data()) < 0) refuse("cannot read " + item.name);
      write(item, data);
    }
  }

  void write(const Item& item, std::span<const std::byte> data) {
    sink_.write(item_header(item, data.size()));
    sink_.write(data);
    sink_.write(item_padding(data.size()));
  }

  // Does the file hold what the array declares? Chunks that are missing would read as zeros.
  void check_storage(hid_t set, hid_t space, const Item& item, std::uint64_t size) {
    const std::string& name = item.name;
    const Handle properties(H5Dget_create_plist(set), H5Pclose, name + " is damaged");
    const H5D_layout_t layout = H5Pget_layout(properties);
    if (H5Pget_external_count(properties) != 0) refuse(name + " is stored in another file; a result holds all of its data");
    if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) refuse(name + " is not stored like an array of a result");
    const int filters = H5Pget_nfilters(properties);
    for (int k = 0; k < filters; ++k) {
      unsigned flags = 0, settings = 0;
      std::size_t values = 0;
      const H5Z_filter_t filter =
          H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr, &settings);
      if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE) refuse(name + " passes a filter that no result has");
    }
    if (filters < 0 || filters > 2) refuse(name + " passes more filters than a result's arrays");
    if (size == 0) return;
    const std::uint64_t stored = H5Dget_storage_size(set);
    stored_ += std::min(stored, file_size_ + 1);
    const std::string beyond = name + " declares more than the file holds";
    if (stored_ > file_size_) refuse(beyond);
    if (layout == H5D_CONTIGUOUS) {
      const haddr_t at = H5Dget_offset(set);
      if (filters > 0 || stored != size || at == HADDR_UNDEF || at > file_size_ || size > file_size_ - at) refuse(beyond);
    } else {
      check_chunks(set, space, properties, item, stored);
    }
    declared_ += size;
    if (declared_ > most_) refuse("its contents would fill more than half of this machine's memory");
  }

  static void check_chunks(hid_t set, hid_t space, hid_t properties, const Item& item, std::uint64_t stored) {
    std::array<hsize_t, 2> chunk{1, 1};
    // Texts and words are never packed: what they become in memory is in proportion to the file.
    if (item.rank != 1 || item.type == ItemType::text || item.type == ItemType::word ||
        H5Pget_chunk(properties, 2, chunk.data()) != 1 || chunk[0] == 0 || chunk[0] > kLongestChunk)
      refuse(item.name + " is stored in chunks that no result has");
    const std::uint64_t chunks = (item.sizes[0] + chunk[0] - 1) / chunk[0];
    hsize_t present = 0;
    if (chunks > stored || item.sizes[0] * item.width / kMostDeflated > stored ||
        H5Dget_num_chunks(set, space, &present) < 0 || present != chunks)
      refuse(item.name + " declares more than the file holds");
  }

  void copy_dataset(const std::string& path) {
    Item item;
    item.name = path;
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path + " is damaged");
    copy_attributes(set, path);
    const Handle space(H5Dget_space(set), H5Sclose, path + " has no shape");
    const Handle type(H5Dget_type(set), H5Tclose, path + " has no type");
    describe_type(type, item);
    const Extents shape = shape_of(space, path);
    item.rank = shape.rank;
    item.sizes = shape.sizes;
    const std::uint64_t size = times(times(shape.sizes[0], shape.sizes[1], path), item.width, path);
    check_storage(set, space, item, size);
    sink_.write(item_header(item, size));
    if (size > 0) copy_blocks(set, space, type, item);
    sink_.write(item_padding(size));
  }

  // Along the first dimension, so much at a time that the memory needed does not depend on the array's size.
  void copy_blocks(hid_t set, hid_t space, hid_t type, const Item& item) {
    const std::uint64_t row = item.sizes[1] * item.width, rows = std::max<std::uint64_t>(1, kBytesAtATime / row);
    std::vector<std::byte> data;
    for (std::uint64_t from = 0; from < item.sizes[0]; from += rows) {
      const std::array<hsize_t, 2> start{from, 0}, count{std::min<std::uint64_t>(rows, item.sizes[0] - from), item.sizes[1]};
      data.resize(count[0] * row);
      const Handle part(item.rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(item.rank, count.data(), nullptr),
                        H5Sclose, "cannot read " + item.name);
      if (item.rank > 0 && H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0)
        refuse("cannot read " + item.name);
      if (H5Dread(set, type, part, item.rank == 0 ? H5S_ALL : space, H5P_DEFAULT, data.data()) < 0)
        refuse("cannot read " + item.name);
      sink_.write(data);
    }
  }

  ByteSink& sink_;
  const Contents wanted_;
  std::uint64_t file_size_, most_;
  Handle file_;
  int items_ = 0;
  std::uint64_t stored_ = 0, declared_ = 0;
};

}  // namespace

void copy_contents(const std::string& path, ByteSink& sink, Contents wanted) {
  const QuietErrors quiet;
  H5PLset_loading_state(0);  // a filter of the file must not bring code with it
  ContentsCopy(path, sink, wanted).copy();
}

}  // namespace corank::result
