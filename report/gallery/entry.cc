#include "corank/report/gallery/entry.h"

#include <algorithm>

#include "corank/symbolic/model/model_error.h"

namespace corank::report {

std::string to_string(Certainty certainty) {
  switch (certainty) {
    case Certainty::read: return "read";
    case Certainty::derived: return "derived";
    default: return "memory";
  }
}

std::vector<GalleryEntry> read_entries(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& item : std::filesystem::directory_iterator(folder, error))
    if (item.path().extension() == ".toml" && item.is_regular_file()) files.push_back(item.path());
  if (files.empty()) throw symbolic::ModelError({folder.string()}, "no entry is there", "files NAME.toml");
  std::ranges::sort(files);
  std::vector<GalleryEntry> entries;
  for (const std::filesystem::path& file : files) entries.push_back(read_entry(file));
  return entries;
}

std::vector<std::string> words_of(const std::string& command, const std::string& model) {
  std::vector<std::string> words;
  bool inside = false, quoted = false;
  for (const char c : command) {
    if (c == '"') quoted = !quoted;
    if (c == ' ' && !quoted) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c != '"') words.back() += c;
  }
  static const std::string place = "{model}";
  for (std::string& word : words)
    if (const std::size_t at = word.find(place); at != std::string::npos) word.replace(at, place.size(), model);
  return words;
}

}  // namespace corank::report
