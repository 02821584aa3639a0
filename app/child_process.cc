#include "corank/app/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

#include "corank/result/files/result_file.h"

namespace corank::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSecondsToEnd = 10;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void check_call(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

/// A file without a name.
class HiddenFile {
 public:
  HiddenFile() {
    std::string name = (std::filesystem::temp_directory_path() / "corank-XXXXXX").string();
    descriptor_ = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
    unlink(name.c_str());
  }
  ~HiddenFile() { close(descriptor_); }
  HiddenFile(const HiddenFile&) = delete;
  HiddenFile& operator=(const HiddenFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const { return result::file_bytes("/proc/self/fd/" + std::to_string(descriptor_)); }

 private:
  int descriptor_;
};

pid_t spawn(const std::filesystem::path& program, std::vector<std::string> args, const std::filesystem::path& folder,
            int out, int err) {
  std::string name = program.string();
  std::vector<char*> words{name.data()};
  for (std::string& arg : args) words.push_back(arg.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
  pid_t child = -1;
  const int error = posix_spawn(&child, name.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  check_call(error, name.c_str());
  return child;
}

}  // namespace

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

report::GalleryRun run_child(const std::filesystem::path& program, const std::vector<std::string>& args,
                             const std::filesystem::path& folder, double seconds, const std::atomic<bool>& stop) {
  const HiddenFile out, err;
  report::GalleryRun run;
  const Clock::time_point start = Clock::now();
  const pid_t child = spawn(program, args, folder, out.descriptor(), err.descriptor());
  pollfd ended{.fd = static_cast<int>(syscall(SYS_pidfd_open, child, 0)), .events = POLLIN, .revents = 0};
  double asked = -1;
  while (poll(&ended, 1, 100) == 0 || !(ended.revents & POLLIN)) {
    const double now = seconds_since(start);
    const bool late = seconds > 0 && now > seconds;
    if (asked < 0 && (late || stop)) {
      run.timed_out = late;
      asked = now;
      kill(child, SIGINT);
    } else if (asked >= 0 && now > asked + kSecondsToEnd) {
      kill(child, SIGKILL);
    }
  }
  close(ended.fd);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  run.seconds = seconds_since(start);
  const auto time = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  run.processor_seconds = time(used.ru_utime) + time(used.ru_stime);
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  run.output = out.text();
  run.errors = err.text();
  return run;
}

}  // namespace corank::app
