#include "corank/app/solve_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "corank/app/exit_status.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/symbolic/model/text_file.h"

namespace corank::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kFiles{"FILE", "--loops", "--param"};
// May be given anew, and are not kept.
constexpr std::array<std::string_view, 10> kOfOneRun{"--max-boxes",    "--max-found", "--max-solutions", "--time-limit",
                                                     "--memory-limit", "--json",      "--checkpoint",    "--every",
                                                     "--resume",       "--refine"};
constexpr std::array<std::string_view, 3> kMayChange{"--threads", "-o", "--digits"};
constexpr std::array<std::string_view, 9> kOfRefine{
    "--refine", "--sigma", "--sigma-length", "--sigma-angle", "--threads", "-o", "--time-limit", "--memory-limit", "--json"};

bool is_among(const auto& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

std::optional<std::string> text_of(const std::string& path) {
  try {
    return symbolic::read_bytes(path);
  } catch (const symbolic::ReadingError&) {
    return std::nullopt;
  }
}

bool given(const CLI::App& sub, const std::string& name) { return sub.get_option(name)->count() > 0; }

// `option`: whose file holds all but what may be given anew.
void check_given(const CLI::App& sub, const char* option, const auto& may_be_given) {
  for (const CLI::Option* o : sub.get_options())
    if (o->count() > 0 && !may_be_given(o->get_name()))
      throw UsageError(fmt::format("{}: its file holds the model and the question; expected no {}", option,
                                   o->get_positional() ? "FILE beside it" : o->get_name()));
}

}  // namespace

void check_refine(const CLI::App& sub) {
  check_given(sub, "--refine", [](const std::string& name) { return is_among(kOfRefine, name); });
  if (!given(sub, "-o")) throw UsageError("--refine: expected -o NEW.h5 beside it");
}

result::Checkpoint checkpoint_of(const CLI::App& sub, const SolveCommand& command) {
  result::Checkpoint checkpoint;
  for (const CLI::Option* o : sub.get_options()) {
    const std::string name = o->get_name();
    if (o->count() == 0 || is_among(kFiles, name) || o->get_positional() || is_among(kOfOneRun, name)) continue;
    if (o->get_expected_max() == 0) {
      checkpoint.arguments.push_back(name);
      continue;
    }
    for (const std::string& value : o->results()) {
      checkpoint.arguments.push_back(name);
      checkpoint.arguments.push_back(name == "-o" ? fs::absolute(value).string() : value);
    }
  }
  const auto add_file = [&](const char* option, const std::string& path) {
    if (path.empty()) return;
    if (auto text = text_of(path)) checkpoint.files.push_back({option, fs::absolute(path).string(), std::move(*text)});
  };
  add_file("FILE", command.question.file);
  add_file("--loops", command.question.loops);
  add_file("--param", command.param_path);
  return checkpoint;
}

Resumed::Resumed(const CLI::App& sub, const SolveCommand& now) : path_(now.resume_path) {
  check_given(sub, "--resume",
              [](const std::string& name) { return is_among(kOfOneRun, name) || is_among(kMayChange, name); });
  checkpoint = result::read_checkpoint(path_, solve::engine_version());
  restore();
  if (given(sub, "--threads")) command.limits.threads = now.limits.threads;
  command.limits.max_boxes = now.limits.max_boxes;
  command.limits.max_found = now.limits.max_found;
  command.limits.time_limit = now.limits.time_limit;
  command.limits.memory_limit = now.limits.memory_limit;
  command.max_solutions = now.max_solutions;
  if (given(sub, "-o")) command.result_path = now.result_path;
  if (given(sub, "--digits")) command.digits = now.digits;
  command.json = now.json;
  command.every = now.every;
  command.resume_path = now.resume_path;
  const bool from_result = fs::path(path_).extension() == ".h5";
  command.checkpoint_path = !now.checkpoint_path.empty() || from_result ? now.checkpoint_path : path_;
}

Resumed::~Resumed() {
  std::error_code ignored;
  if (copies_) fs::remove_all(*copies_, ignored);
}

void Resumed::restore() {
  CLI::App former;
  add_solve_options(former, command);
  try {
    former.parse(std::vector<std::string>(checkpoint.arguments.rbegin(), checkpoint.arguments.rend()));
  } catch (const CLI::ParseError& error) {
    throw result::ResultFileError(fmt::format("{}: its options cannot be read: {}", path_, error.what()));
  }
  // All beside one another, as a model and its companions are.
  for (const result::Checkpoint::File& file : checkpoint.files) {
    std::string& place = file.option == "FILE"      ? command.question.file
                         : file.option == "--loops" ? command.question.loops
                                                    : command.param_path;
    place = file_of(file);
  }
}

std::string Resumed::file_of(const result::Checkpoint::File& file) {
  if (text_of(file.path) == file.text) return file.path;
  const fs::path name = fs::path(file.path).filename();
  if (name.empty()) throw result::ResultFileError(path_ + ": a file in it has no name");
  if (!copies_) {
    std::string folder = (fs::temp_directory_path() / "corank-XXXXXX").string();
    if (!mkdtemp(folder.data())) throw result::ResultFileError("cannot make a folder for copies of the model: " + folder);
    copies_ = folder;
  }
  const fs::path copy = *copies_ / name;
  std::ofstream out(copy, std::ios::binary);
  out << file.text;
  out.close();
  if (!out) throw result::ResultFileError("cannot write a copy of the model: " + copy.string());
  return copy.string();
}

}  // namespace corank::app
