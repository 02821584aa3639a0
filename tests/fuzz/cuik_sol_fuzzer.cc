// Any bytes may come as a .sol file: parse_sol either returns boxes or throws CuikFileError with a line. What it returns is
// as cuik_files.h promises.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string_view>

#include "corank/result/cuik/cuik_files.h"

namespace {

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void check(const corank::result::SolFile& file) {
  const std::set<std::string> names(file.variables.begin(), file.variables.end());
  require(names.size() == file.variables.size(), "a name stands twice");
  for (const corank::result::SolBox& box : file.boxes) {
    require(static_cast<int>(box.box.size()) == file.size() && file.size() > 0, "boxes of different size");
    require(file.variables.empty() || file.variables.size() == box.box.size(), "more or fewer names than sides");
    for (const corank::Interval& x : box.box) {
      require(std::isfinite(x.lo()) && std::isfinite(x.hi()) && x.lo() <= x.hi(), "no interval");
    }
    for (const std::string& name : box.free) require(names.contains(name), "a free variable of no name");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  corank::result::SolFile file;
  try {
    file = corank::result::parse_sol(text, "fuzzed.sol");
  } catch (const corank::result::CuikFileError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzzed.sol:") && error.line() >= 1, "an error without its place");
    require(message.find('\n') == std::string_view::npos, "a message of more than one line");
    return 0;
  }
  check(file);
  return 0;
}
