// Runs the built program as a user would.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace corank::app {

struct Outcome {
  int status = -1;  ///< exit status; 1000 + signal where a signal ended it
  std::string out, err;
};

/// Runs `corank ARGS` to its end; standard error is no terminal.
Outcome run_corank(const std::vector<std::string>& args);

/// What the system lets a run have. A program that goes beyond its processor time is ended by a signal.
struct Allowed {
  std::optional<std::size_t> file_bytes{};  ///< of each file, as a full disk would
  std::optional<int> cpu_seconds{};
};
Outcome run_corank(const std::vector<std::string>& args, const Allowed& allowed);

/// The same without starting the program: a copy of this process runs the command line. For many short runs, whose time
/// would go into the loading of libraries.
Outcome run_corank_in_a_copy(const std::vector<std::string>& args, const Allowed& allowed);

/// run_corank by a program that was linked without Cairo.
Outcome run_corank_without_cairo(const std::vector<std::string>& args);

/// run_corank with standard output sent to a file of the system, such as /dev/full.
int run_corank_into(const std::string& file, const std::vector<std::string>& args);

/// `corank ARGS` with standard error on a terminal of its own.
class CorankOnTerminal {
 public:
  explicit CorankOnTerminal(const std::vector<std::string>& args);
  ~CorankOnTerminal();
  CorankOnTerminal(const CorankOnTerminal&) = delete;
  CorankOnTerminal& operator=(const CorankOnTerminal&) = delete;

  /// Blocks until the terminal has shown the text; false where the program ended without.
  bool wait_for(const std::string& text);
  void signal(int number) const;
  /// Waits for the program's end; `err` is all that the terminal has shown.
  Outcome finish();

 private:
  bool read_more();
  pid_t child_ = -1;
  int terminal_ = -1;
  std::string shown_;
  std::filesystem::path out_;
};

/// The words of one command line and then those of another.
std::vector<std::string> with(std::vector<std::string> args, const std::vector<std::string>& more);

/// A folder that lives as long as the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// A model of the repository.
std::string model(const std::string& name);
std::string read_text(const std::filesystem::path& path);

}  // namespace corank::app
