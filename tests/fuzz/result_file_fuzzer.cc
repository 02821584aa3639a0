// Any bytes may come as a result file. An input that begins as HDF5 does is read as a file, in a child process, of which the
// fuzzer sees only what comes back; any other one is taken for what came back (result/files/plain_items.h), the part of
// reading that is compiled for the fuzzer. Either a result is returned, which is as result_file.h promises, or
// ResultFileError is thrown with a printable line.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "corank/result/files/result_file.h"
#include "corank/result/values/words.h"

namespace {

using corank::result::Result;

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

Result read_as_file(std::span<const std::uint8_t> bytes) {
  const int file = memfd_create("fuzzed", 0);
  require(file >= 0 && write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "no file to read");
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  try {
    Result result = corank::result::read_result(path);
    close(file);
    return result;
  } catch (...) {
    close(file);
    throw;
  }
}

void check_box(const Result& result, const corank::CoverBox& box) {
  const auto below = [](int index, std::size_t size) { return index >= -1 && index < static_cast<std::int64_t>(size); };
  require(box.box.size() == result.variables.size(), "a box of another size");
  for (const auto& side : box.box) require(side.lo() <= side.hi(), "no interval");
  for (const int v : box.free) require(v >= 0 && below(v, result.variables.size()), "a free variable that is none");
  require(below(box.region, result.cover.regions.size()), "a region that does not exist");
  require(below(box.point, result.cover.exact_points.size()), "a point that does not exist");
}

void check(const Result& result) {
  const std::size_t n = result.variables.size();
  require(result.configuration_size >= 0 && static_cast<std::size_t>(result.configuration_size) <= n,
          "more coordinates than variables");
  require(corank::result::printable_line(result.model) == result.model, "a name that is not printable");
  for (const auto& angle : result.angles)
    require(angle.cosine >= 0 && angle.sine >= 0 && static_cast<std::size_t>(std::max(angle.cosine, angle.sine)) < n,
            "an angle of no variable");
  for (const auto* list : {&result.cover.boxes, &result.cover.points})
    for (const auto& box : *list) check_box(result, box);
  for (const auto& region : result.cover.regions) require(region.size() == n, "a region of another size");
  for (const auto& point : result.cover.exact_points) require(point.coordinates.size() == n, "a point of another size");
  if (result.cover.proof)
    for (const auto& c : result.cover.proof->combinations)
      require(c.equations.size() == c.dependent.size() && c.y.size() == c.dependent.size() * c.dependent.size(),
              "a combination that is no matrix");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  const bool is_hdf5 = size > 4 && data[0] == 0x89 && data[1] == 'H' && data[2] == 'D' && data[3] == 'F';
  try {
    check(is_hdf5 ? read_as_file(bytes) : corank::result::read_result("fuzzed.h5", std::as_bytes(bytes)));
  } catch (const corank::result::ResultFileError& error) {
    require(corank::result::printable_line(error.what()) == error.what(), "a message that is not printable");
  }
  return 0;
}
