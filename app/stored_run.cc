#include "corank/app/stored_run.h"

#include <fmt/format.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <sstream>

#include "corank/result/files/result_file.h"

namespace corank::app {
namespace {

/// What tells whether the files are those that were stored.
std::string hash_of_files(const std::string& output, const std::vector<std::filesystem::path>& files) {
  std::string all = hash_of(output);
  for (const std::filesystem::path& file : files)
    all += std::filesystem::exists(file) ? hash_of(result::file_bytes(file)) : std::string("missing");
  return hash_of(all);
}

}  // namespace

std::string hash_of(const std::string& text) {
  return to_string(boost::uuids::name_generator_sha1(boost::uuids::uuid{})(text));
}

StoredRun::StoredRun(std::filesystem::path folder, std::string name, std::string key)
    : output_(folder / (name + ".json")), record_(folder / (name + ".run")), key_(std::move(key)) {}

std::optional<report::GalleryRun> StoredRun::read(const std::vector<std::filesystem::path>& files) const {
  std::istringstream record(result::file_bytes(record_));
  std::string key, hash;
  report::GalleryRun run;
  if (!(record >> key >> hash >> run.status >> run.seconds >> run.processor_seconds)) return std::nullopt;
  run.output = result::file_bytes(output_);
  if (key != key_ || hash != hash_of_files(run.output, files)) return std::nullopt;
  run.stored = true;
  return run;
}

void StoredRun::write(const report::GalleryRun& run, const std::vector<std::filesystem::path>& files) const {
  result::write_text(output_, run.output);
  result::write_text(record_, fmt::format("{} {} {} {:.3f} {:.3f}\n", key_, hash_of_files(run.output, files), run.status,
                                          run.seconds, run.processor_seconds));
}

}  // namespace corank::app
