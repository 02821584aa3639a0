// Any bytes may come as a .param file: parse_param either returns values that have a use or throws CuikFileError with a
// line.
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  corank::result::CuikParameters parameters;
  try {
    parameters = corank::result::parse_param(text, "fuzzed.param");
  } catch (const corank::result::CuikFileError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzzed.param:") && error.line() >= 1, "an error without its place");
    require(message.find('\n') == std::string_view::npos, "a message of more than one line");
    return 0;
  }
  for (const auto& value : {parameters.sigma, parameters.small_sigma}) {
    require(!value || (std::isfinite(*value) && *value > 0), "a size of no use");
  }
  require(parameters.n_solutions >= 0, "a negative number of boxes");
  const std::set<std::string> distinct(parameters.ignored.begin(), parameters.ignored.end());
  require(distinct.size() == parameters.ignored.size(), "a parameter reported twice");
  return 0;
}
