// corank gallery: published results, reproduced with proof, as a table and a page.

#include <algorithm>
#include <mutex>
#include <thread>

#include "corank/app/child_process.h"
#include "corank/app/gallery_run.h"
#include "corank/app/stored_run.h"
#include "corank/app/subcommands.h"
#include "corank/core/threads.h"
#include "corank/report/html/gallery_page.h"

namespace corank::app {
namespace {

namespace fs = std::filesystem;

struct GalleryCommand {
  std::vector<std::string> names;
  std::string entries, folder = "corank-gallery";
  bool quick = false, fresh = false;
  int threads = 0;
  double time_limit = 900;
  JsonOption json;
};

bool has_entries(const fs::path& folder) {
  std::error_code error;
  return std::ranges::any_of(fs::directory_iterator(folder, error),
                             [](const fs::directory_entry& item) { return item.path().extension() == ".toml"; });
}

/// Where the entries are that come with corank: of an installed program, or of the tree that it was built in.
fs::path own_entries() {
  for (fs::path folder = own_program().parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    for (const char* place : {"share/corank/gallery", "gallery"})
      if (has_entries(folder / place)) return folder / place;
  throw UsageError("no gallery is installed with this program; expected --entries FOLDER");
}

std::vector<report::GalleryEntry> chosen_entries(const GalleryCommand& command) {
  std::vector<report::GalleryEntry> all =
      report::read_entries(command.entries.empty() ? own_entries() : fs::path(command.entries));
  std::vector<std::string> known;
  for (const report::GalleryEntry& entry : all) known.push_back(entry.name);
  for (const std::string& name : command.names)
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("{}: no entry of the gallery; expected one of {}", name, fmt::join(known, ", ")));
  std::erase_if(all, [&](const report::GalleryEntry& entry) {
    const bool named = command.names.empty() || std::ranges::find(command.names, entry.name) != command.names.end();
    return !named || (command.quick && !entry.quick);
  });
  if (all.empty()) throw UsageError("no entry is left; expected names of quick entries beside --quick");
  return all;
}

/// All entries, several at a time; those that were not begun when `stop` was set are left out.
std::vector<report::GalleryResult> run_all(const std::vector<report::GalleryEntry>& entries, GalleryOptions options,
                                           int cores, const std::atomic<bool>& stop) {
  const std::size_t side_by_side = std::min<std::size_t>(entries.size(), static_cast<std::size_t>(cores));
  options.threads = cores / static_cast<int>(side_by_side);
  std::vector<std::optional<report::GalleryResult>> done(entries.size());
  std::atomic<std::size_t> next = 0, finished = 0;
  std::exception_ptr error;
  std::mutex mutex;
  ProgressLine line;
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size() && !stop; i = next++) {
      try {
        done[i] = run_entry(entries[i], options, stop);
      } catch (...) {
        const std::lock_guard lock(mutex);
        error = std::current_exception();
        next = entries.size();
      }
      const std::lock_guard lock(mutex);
      line.show(fmt::format("{} of {} entries", ++finished, entries.size()));
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < side_by_side; ++k) threads.emplace_back(work);
  }
  line.clear();
  if (error) std::rethrow_exception(error);
  std::vector<report::GalleryResult> results;
  for (auto& result : done)
    if (result && !(stop && report::is_failure(result->standing()))) results.push_back(std::move(*result));
  return results;
}

std::string shown_command(const GalleryCommand& command) {
  std::string text = "corank gallery";
  for (const std::string& name : command.names) text += " " + name;
  if (!command.entries.empty()) text += " --entries " + command.entries;
  if (command.quick) text += " --quick";
  return text + " -o " + command.folder;
}

ExitStatus gallery(GalleryCommand command) {
  command.json.check();
  const std::vector<report::GalleryEntry> entries = chosen_entries(command);
  const fs::path folder = fs::absolute(command.folder).lexically_normal();
  std::error_code failure;
  fs::create_directories(folder, failure);
  result::check_writable(folder / "index.html");
  const Interrupt interrupt;
  const fs::path program = own_program();
  const int cores = threads_for(command.threads);
  const std::vector<report::GalleryResult> results =
      run_all(entries,
              {program, result::version() + " " + hash_of(result::file_bytes(program)), folder, command.fresh, 1,
               command.time_limit},
              cores, Interrupt::stop());
  const bool complete = results.size() == entries.size();
  result::write_text(folder / "index.html", gallery_page(results, folder, shown_command(command)));
  if (command.json.say([&] { return gallery_json(results, complete) + "\n"; })) {
    fmt::print("{}", result::printable(gallery_table(results)));
    fmt::print("{}\n{}\n", to_words(report::sums_of(results)), result::printable_line((folder / "index.html").string()));
  }
  for (const report::GalleryResult& result : results)
    for (const std::string& problem : result.problems)
      fmt::print(stderr, "corank: {}: not drawn: {}\n", result.entry.name, result::printable_line(problem));
  if (!complete) {
    fmt::print(stderr, "corank: stopped by an interrupt; {} of {} entries are done\n", results.size(), entries.size());
    return kIncomplete;
  }
  return report::sums_of(results).failures > 0 ? kBadInput : kDone;
}

}  // namespace

void add_gallery(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("gallery", "Reproduce published results, and write a table and a web page about them");
  const auto command = std::make_shared<GalleryCommand>();
  sub->add_option("ENTRIES", command->names, "Names of entries; default: all");
  add_option(*sub, "--entries FOLDER", command->entries,
             "Folder of the entries NAME.toml; default: those that come with corank");
  add_option(*sub, "-o FOLDER", command->folder, "Folder for index.html and for what the commands write")
      ->capture_default_str();
  sub->add_flag("--quick", command->quick, "Only the entries that take seconds");
  sub->add_flag("--fresh", command->fresh, "Run every command again, also those whose answers are stored in the folder");
  add_option(*sub, "--time-limit SECONDS", command->time_limit,
             "End each command after SECONDS, so that its entry is not met; 0: no limit")
      ->capture_default_str();
  add_threads(*sub, command->threads);
  command->json.add(*sub);
  sub->footer(
      "An entry names a model, questions as command lines of corank, and the published numbers with their source\n"
      "(doc/gallery.md). Answers are stored in the folder, and taken from there while model, command and program are the\n"
      "same.\n\n"
      "Exit status: 0 every published number is met, 1 one is not, or bad input, 2 wrong usage, 3 stopped by an "
      "interrupt.\n\n"
      "Examples:\n  corank gallery\n  corank gallery dextar three_slider -o gallery\n  corank gallery --entries my-robots");
  sub->callback([command, &action] { action = [command] { return gallery(*command); }; });
}

}  // namespace corank::app
