#include "corank/app/gallery_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "corank/app/child_process.h"
#include "corank/app/exit_status.h"
#include "corank/app/stored_run.h"
#include "corank/study/model.h"

namespace corank::app {
namespace {

namespace fs = std::filesystem;

/// The model's text, with those of the files beside it that it or the entry's commands name.
std::string text_of_model(const report::GalleryEntry& entry) {
  const std::string model = study::read_text(entry.model).text;
  std::string named = model;
  for (const report::GalleryQuestion& question : entry.questions) named += question.command + "\n";
  std::vector<fs::path> files;
  for (const auto& item : fs::directory_iterator(entry.model.parent_path()))
    if (item.is_regular_file() && named.find(item.path().filename().string()) != std::string::npos) files.push_back(item);
  std::ranges::sort(files);
  std::string all = model;
  for (const fs::path& file : files) all += "\n" + file.filename().string() + "\n" + study::read_text(file).text;
  return all;
}

/// The commands of one entry, in a folder of its own.
class EntryRun {
 public:
  EntryRun(const report::GalleryEntry& entry, const GalleryOptions& options, const std::atomic<bool>& stop)
      : entry_(entry), options_(options), stop_(stop), folder_(options.folder / entry.name) {
    fs::create_directories(folder_);
    model_text_ = text_of_model(entry);
  }

  report::GalleryResult run() {
    report::GalleryResult result{.entry = entry_, .runs = {}, .findings = {}, .problems = {}, .folder = folder_};
    // Earlier commands write files that later ones read or draw.
    for (std::size_t q = 0; q < entry_.questions.size(); ++q) {
      const report::GalleryQuestion& question = entry_.questions[q];
      const report::GalleryRun run = run_one(question.command, std::to_string(q + 1), files_of(question.command));
      result.seconds += run.seconds;
      result.findings.push_back(compare(question, run, !entry_.open.empty()));
      result.runs.push_back(run);
    }
    if (!entry_.report.empty()) draw(entry_.report, "report-run", {folder_ / "page" / "index.html"}, result);
    int number = 0;
    const auto draw_by = [&](const auto& picture) {
      if (picture.command.empty()) return;
      draw(picture.command, fmt::format("picture-{}", ++number), {folder_ / picture.file}, result);
    };
    std::ranges::for_each(entry_.robots, draw_by);
    std::ranges::for_each(entry_.pictures, draw_by);
    return result;
  }

 private:
  static report::GalleryRun nothing() {
    report::GalleryRun run;
    run.status = kIncomplete;
    return run;
  }

  /// What a command writes by -o, for those who draw it later.
  std::vector<fs::path> files_of(const std::string& command) const {
    std::vector<fs::path> files;
    const std::vector<std::string> words = report::words_of(command, entry_.model.string());
    for (std::size_t k = 0; k + 1 < words.size(); ++k)
      if (words[k] == "-o") files.push_back(folder_ / words[k + 1]);
    return files;
  }

  void draw(const std::string& command, const std::string& name, const std::vector<fs::path>& files,
            report::GalleryResult& result) {
    const report::GalleryRun run = run_one(command, name, files);
    result.seconds += run.seconds;
    // A report that ended early is valid, and says what is missing.
    const bool drawn = std::ranges::all_of(files, [](const fs::path& file) { return fs::exists(file); });
    if (!drawn && !stop_) result.problems.push_back(fmt::format("corank {}: {}", command, run.errors));
  }

  report::GalleryRun run_one(const std::string& command, const std::string& name, const std::vector<fs::path>& files) {
    std::vector<std::string> words = report::words_of(command, entry_.model.string());
    earlier_ += command + "\n";
    const StoredRun stored(folder_, name, hash_of(options_.build + "\n" + model_text_ + "\n" + earlier_));
    if (!options_.fresh)
      if (auto run = stored.read(files)) return *run;
    if (stop_) return nothing();
    static const std::vector<std::string> without_threads{"derive", "verify", "plot", "angles"};
    if (std::ranges::find(without_threads, words.at(0)) == without_threads.end())
      words.insert(words.end(), {"--threads", std::to_string(options_.threads)});
    for (const fs::path& file : files) fs::remove(file);
    const report::GalleryRun run = run_child(options_.program, words, folder_, options_.time_limit, stop_);
    if (!stop_ && !run.timed_out) stored.write(run, files);
    return run;
  }

  const report::GalleryEntry& entry_;
  const GalleryOptions& options_;
  const std::atomic<bool>& stop_;
  fs::path folder_;
  std::string model_text_, earlier_;  // the commands so far: each may read what an earlier one wrote
};

}  // namespace

report::GalleryResult run_entry(const report::GalleryEntry& entry, const GalleryOptions& options,
                                const std::atomic<bool>& stop) {
  return EntryRun(entry, options, stop).run();
}

}  // namespace corank::app
