#include "corank/result/files/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <streambuf>

#include "corank/result/files/output_file.h"
#include "corank/result/files/source_group.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/text_file.h"

namespace corank::result {
namespace {

constexpr std::string_view kFirstWords = "corank checkpoint, version ";
constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t kLongestVersion = 200, kSumBytes = 4;
const char* const kArray = "/search/state";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw ResultFileError(printable_line(path.string() + ": " + why));
}

// Passes on what is written, and keeps its sum.
class SummingBuffer : public std::streambuf {
 public:
  explicit SummingBuffer(std::streambuf& to) : to_(to) { setp(block_.data(), block_.data() + block_.size()); }
  std::uint32_t sum() {
    pass_on();
    return sum_;
  }

 protected:
  int_type overflow(int_type c) override {
    pass_on();
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    *pptr() = traits_type::to_char_type(c);
    pbump(1);
    return c;
  }
  int sync() override {
    pass_on();
    return to_.pubsync();
  }

 private:
  void pass_on() {
    const auto size = pptr() - pbase();
    sum_ = static_cast<std::uint32_t>(crc32(sum_, reinterpret_cast<const Bytef*>(pbase()), static_cast<uInt>(size)));
    if (to_.sputn(pbase(), size) != size) throw ResultFileError("cannot write a checkpoint (disk full?)");
    setp(block_.data(), block_.data() + block_.size());
  }
  std::streambuf& to_;
  std::uint32_t sum_ = 0;
  std::array<char, 1 << 16> block_{};
};

void put(std::ostream& out, std::uint64_t number, std::size_t bytes) {
  for (std::size_t k = 0; k < bytes; ++k) out.put(static_cast<char>(number >> (8 * k) & 0xff));
}

void put(std::ostream& out, const std::string& text) {
  put(out, text.size(), 8);
  out << text;
}

void write(std::ostream& raw, const std::string& version, const Checkpoint& checkpoint, const StateWriter& state) {
  SummingBuffer buffer(*raw.rdbuf());
  std::ostream out(&buffer);
  out.exceptions(std::ios::badbit | std::ios::failbit);
  out << kFirstWords << version << '\n';
  put(out, checkpoint.arguments.size(), 8);
  for (const std::string& argument : checkpoint.arguments) put(out, argument);
  put(out, checkpoint.files.size(), 8);
  for (const Checkpoint::File& file : checkpoint.files) put(out, file.option), put(out, file.path), put(out, file.text);
  put(out, checkpoint.states.size(), 8);
  const std::string none;
  for (std::size_t i = 0; i < checkpoint.states.size(); ++i)
    put(out, i == checkpoint.under_way ? none : checkpoint.states[i]);
  put(out, checkpoint.under_way, 8);
  if (state) state(out);  // all the rest is it
  const std::uint32_t sum = buffer.sum();
  put(raw, sum, kSumBytes);
}

void sync_to_disk(const std::filesystem::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0 || fsync(file) != 0) {
    const std::string why = std::strerror(errno);
    if (file >= 0) close(file);
    refuse(path, "cannot be written to the disk: " + why);
  }
  close(file);
}

class Parser {
 public:
  Parser(const std::filesystem::path& path, std::string_view bytes) : path_(path), rest_(bytes) {}

  std::uint64_t number(std::size_t bytes) {
    need(bytes);
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < bytes; ++k)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(rest_[k])) << (8 * k);
    rest_.remove_prefix(bytes);
    return value;
  }
  std::string text() {
    const std::uint64_t size = number(8);
    need(size);
    std::string result(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return result;
  }
  template <class Read>
  void list(Read read) {
    const std::uint64_t count = number(8);
    need(count);
    for (std::uint64_t i = 0; i < count; ++i) read();
  }
  std::string rest() { return std::string(rest_); }

 private:
  void need(std::uint64_t bytes) const {
    if (bytes > rest_.size()) refuse(path_, "a damaged checkpoint: it is cut short");
  }
  const std::filesystem::path& path_;
  std::string_view rest_;
};

Checkpoint parse(const std::filesystem::path& path, std::string_view bytes, const std::string& version) {
  if (!bytes.starts_with(kFirstWords)) refuse(path, "neither a checkpoint nor a result of corank");
  const std::size_t end = bytes.substr(0, kFirstWords.size() + kLongestVersion).find('\n');
  if (end == std::string_view::npos || bytes.size() < end + 1 + kSumBytes)
    refuse(path, "a damaged checkpoint: it is cut short");
  const std::string made_by(bytes.substr(kFirstWords.size(), end - kFirstWords.size()));
  if (made_by != version)
    refuse(path, "a checkpoint by corank " + made_by + "; this is corank " + version + ", whose search may differ");
  const std::string_view summed = bytes.substr(0, bytes.size() - kSumBytes);
  const std::uint64_t sum = Parser(path, bytes.substr(summed.size())).number(kSumBytes);
  if (crc32_z(0, reinterpret_cast<const Bytef*>(summed.data()), summed.size()) != sum)
    refuse(path, "a damaged checkpoint: its check sum is wrong");
  Parser parser(path, summed.substr(end + 1));
  Checkpoint checkpoint;
  parser.list([&] { checkpoint.arguments.push_back(parser.text()); });
  parser.list([&] {
    std::string option = parser.text(), name = parser.text();
    checkpoint.files.push_back({std::move(option), std::move(name), parser.text()});
  });
  parser.list([&] { checkpoint.states.push_back(parser.text()); });
  checkpoint.under_way = parser.number(8);
  constexpr std::size_t kMostSearches = 1'000'000;
  if (checkpoint.under_way > kMostSearches) refuse(path, "a damaged checkpoint: it is of too many searches");
  checkpoint.states.resize(std::max(checkpoint.states.size(), checkpoint.under_way + 1));
  checkpoint.states[checkpoint.under_way] = parser.rest();
  return checkpoint;
}

std::string why_without_search(const Hdf5Reader& file) {
  if (const std::string other = other_kind_words(file); !other.empty()) return "this is not a corank result" + other;
  return file.attribute<std::int64_t>("/", "complete") != 0
             ? "this result is complete: there is no search to go on with; expected a checkpoint, or a result that a limit "
               "ended"
             : "this result does not hold the state of its search; expected a checkpoint, or a result that does";
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& version, const Checkpoint& checkpoint,
                      const StateWriter& state) {
  const OutputFile target(path);
  {
    std::ofstream out(target.part(), std::ios::binary | std::ios::trunc);
    if (!out) refuse(path, "cannot write a checkpoint here");
    write(out, version, checkpoint, state);
    out.close();
    if (!out) refuse(path, "cannot write a checkpoint here (disk full?)");
  }
  sync_to_disk(target.part(), O_RDONLY);
  target.finish();
  const std::filesystem::path folder = target.part().parent_path();
  sync_to_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

std::string checkpoint_bytes(const std::string& version, const Checkpoint& checkpoint, const StateWriter& state,
                             std::uint64_t expected) {
  std::string room;
  room.reserve(expected);
  std::ostringstream out(std::move(room), std::ios::binary);
  write(out, version, checkpoint, state);
  return std::move(out).str();
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& version) {
  if (const std::string fault = symbolic::reading_fault(path); !fault.empty()) refuse(path, "cannot read this: " + fault);
  std::string bytes;
  {
    std::ifstream in(path, std::ios::binary);
    std::array<char, kHdf5Signature.size()> first{};
    in.read(first.data(), first.size());
    if (in && std::string_view(first.data(), first.size()) == kHdf5Signature) {
      in.close();
      const Hdf5Reader file(path.string(), Contents::search);
      if (!file.has(kArray)) refuse(path, why_without_search(file));
      const auto data = file.vector<std::uint8_t>(kArray);
      bytes.assign(data.begin(), data.end());
    } else {
      in.clear();
      in.seekg(0);
      std::ostringstream all(std::ios::binary);
      all << in.rdbuf();
      bytes = std::move(all).str();
    }
  }
  return parse(path, bytes, version);
}

void write_search(Hdf5Writer& file, const std::string& bytes) {
  file.packed(kArray, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace corank::result
