#include "corank/symbolic/model/text_file.h"

#include <algorithm>
#include <fstream>

namespace corank::symbolic {

std::string reading_fault(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  switch (status.type()) {
    case std::filesystem::file_type::regular: return "";
    case std::filesystem::file_type::not_found: return "there is no such file";
    case std::filesystem::file_type::directory: return "is a directory";
    case std::filesystem::file_type::none: return "cannot be read (" + error.message() + ")";
    default: return "is not a regular file";
  }
}

std::string read_bytes(const std::filesystem::path& path, std::size_t most) {
  if (const std::string fault = reading_fault(path); !fault.empty()) throw ReadingError(fault);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ReadingError("the file cannot be opened");
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::string text;
  while (in && text.size() < most) {
    const std::size_t before = text.size(), wanted = std::min(kBlock, most - before);
    text.resize(before + wanted);
    in.read(text.data() + before, static_cast<std::streamsize>(wanted));
    text.resize(before + in.gcount());
  }
  if (in.bad()) throw ReadingError("the file cannot be read");
  return text;
}

}  // namespace corank::symbolic
