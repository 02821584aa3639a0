#include "corank/tests/app/program.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "corank/app/run.h"

namespace corank::app {
namespace {

[[noreturn]] void execute(const char* program, const std::vector<std::string>& args) {
  std::vector<char*> argv{const_cast<char*>(program)};
  for (const std::string& a : args) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  execv(program, argv.data());
  _exit(127);
}

void redirect(int descriptor, const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
  close(file);
}

int wait_for_end(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("waitpid failed");
  }
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

void limit(int resource, rlim_t most) {
  rlimit limits{};
  getrlimit(resource, &limits);
  limits.rlim_cur = std::min(most, limits.rlim_max);
  if (setrlimit(resource, &limits) != 0) _exit(125);
}

// A child runs `work`, which ends it.
template <class Work>
int run_in_child(const Work& work, const std::filesystem::path& out, const std::filesystem::path& err,
                 const Allowed& allowed) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, err);
    if (allowed.file_bytes) limit(RLIMIT_FSIZE, *allowed.file_bytes);
    if (allowed.cpu_seconds) limit(RLIMIT_CPU, static_cast<rlim_t>(*allowed.cpu_seconds));
    work();
  }
  return wait_for_end(child);
}

template <class Work>
Outcome outcome_of(const Work& work, const Allowed& allowed) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  const int status = run_in_child(work, out, err, allowed);
  return {status, read_text(out), read_text(err)};
}

Outcome run_program(const char* program, const std::vector<std::string>& args, const Allowed& allowed = {}) {
  return outcome_of([&] { execute(program, args); }, allowed);
}

}  // namespace

Outcome run_corank(const std::vector<std::string>& args) { return run_program(CORANK_PROGRAM, args); }

Outcome run_corank(const std::vector<std::string>& args, const Allowed& allowed) {
  return run_program(CORANK_PROGRAM, args, allowed);
}

Outcome run_corank_in_a_copy(const std::vector<std::string>& args, const Allowed& allowed) {
  const auto work = [&] {
    const int status = run("corank", args);
    std::cout.flush();
    std::fflush(nullptr);
    _exit(status);
  };
  return outcome_of(work, allowed);
}

Outcome run_corank_without_cairo(const std::vector<std::string>& args) { return run_program(CORANK_WITHOUT_CAIRO, args); }

int run_corank_into(const std::string& file, const std::vector<std::string>& args) {
  return run_in_child([&] { execute(CORANK_PROGRAM, args); }, file, "/dev/null", {});
}

CorankOnTerminal::CorankOnTerminal(const std::vector<std::string>& args) {
  std::string pattern = (std::filesystem::temp_directory_path() / "corank-out-XXXXXX").string();
  close(mkstemp(pattern.data()));
  out_ = pattern;
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 200;
  child_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (child_ < 0) throw std::runtime_error("forkpty failed");
  if (child_ == 0) {
    redirect(STDOUT_FILENO, out_);
    execute(CORANK_PROGRAM, args);
  }
}

CorankOnTerminal::~CorankOnTerminal() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    wait_for_end(child_);
  }
  close(terminal_);
  std::filesystem::remove(out_);
}

// A terminal whose program has ended reads as an error.
bool CorankOnTerminal::read_more() {
  std::array<char, 4096> data;
  const ssize_t n = read(terminal_, data.data(), data.size());
  if (n <= 0) return false;
  shown_.append(data.data(), static_cast<std::size_t>(n));
  return true;
}

bool CorankOnTerminal::wait_for(const std::string& text) {
  while (shown_.find(text) == std::string::npos) {
    if (!read_more()) return false;
  }
  return true;
}

void CorankOnTerminal::signal(int number) const { kill(child_, number); }

Outcome CorankOnTerminal::finish() {
  while (read_more()) {
  }
  const int status = wait_for_end(child_);
  child_ = -1;
  return {status, read_text(out_), shown_};
}

std::vector<std::string> with(std::vector<std::string> args, const std::vector<std::string>& more) {
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "corank-app-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() { std::filesystem::remove_all(path_); }

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(file(name), std::ios::binary) << text;
  return file(name);
}

std::string model(const std::string& name) { return std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik"; }

std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace corank::app
