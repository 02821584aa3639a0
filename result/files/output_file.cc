#include "corank/result/files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <system_error>

#include "corank/result/values/words.h"

namespace corank::result {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = ".part";
constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

// What a signal handler may read: names of part files that exist.
std::array<std::atomic<const char*>, 16> living_parts{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void on_end(int signal) {
  remove_part_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

auto handler_of(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

void remember(const char* part) {
  for (auto& place : living_parts)
    if (const char* none = nullptr; place.compare_exchange_strong(none, part)) break;
  // A handler of another's, such as one that asks for an early end, stays as it is, with its flags.
  for (const int signal : kSignals)
    if (handler_of(signal) == SIG_DFL) std::signal(signal, on_end);
}

void forget(const char* part) {
  bool any = false;
  for (auto& place : living_parts) {
    const char* mine = part;
    place.compare_exchange_strong(mine, nullptr);
    any = any || place.load() != nullptr;
  }
  for (const int signal : kSignals)
    if (!any && handler_of(signal) == on_end) std::signal(signal, SIG_DFL);
}

[[noreturn]] void refuse_writing(const fs::path& path, const std::string& why) {
  throw ResultFileError(printable_line(path.string() + ": cannot write here" + why));
}

// Where the links lead; the last of them may lead to nothing yet.
fs::path followed(const fs::path& path) {
  constexpr int kMostLinks = 40;
  fs::path target = path;
  std::error_code error;
  for (int k = 0; k < kMostLinks; ++k) {
    if (!fs::is_symlink(target, error)) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) refuse_writing(path, ": " + error.message());
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  refuse_writing(path, ": too many symbolic links");
}

void check_target(const fs::path& path, const fs::path& target) {
  struct stat info {};
  if (path.empty()) refuse_writing(path, "; expected the name of a file");
  if (stat(target.c_str(), &info) != 0) return;
  if (S_ISDIR(info.st_mode)) refuse_writing(path, ", it is a folder; expected the name of a file");
  if (!S_ISREG(info.st_mode)) refuse_writing(path, ", it is not a regular file; expected the name of a file");
  if ((info.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0 || access(target.c_str(), W_OK) != 0)
    refuse_writing(path, ": it is read-only");
}

std::string host() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "host";
  std::string text = name.data();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '/' || c == '.'; }, '-');
  return text;
}

// Is this the part file of a process of this machine that has ended?
bool is_left_over(std::string_view name, const std::string& prefix) {
  if (!name.starts_with(prefix) || !name.ends_with(kPart) || name.size() <= prefix.size() + kPart.size()) return false;
  const std::string_view digits = name.substr(prefix.size(), name.size() - prefix.size() - kPart.size());
  pid_t process = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), process);
  if (error != std::errc{} || end != digits.data() + digits.size() || process <= 0) return false;
  return kill(process, 0) != 0 && errno == ESRCH;
}

void remove_left_overs(const fs::path& folder, const std::string& prefix) {
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code ignored;
    if (is_left_over(at->path().filename().string(), prefix) && at->is_regular_file(ignored))
      fs::remove(at->path(), ignored);
  }
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : path_(path), target_(followed(path)) {
  check_target(path, target_);
  const std::string prefix = target_.filename().string() + "." + host() + ".";
  remove_left_overs(target_.parent_path(), prefix);
  part_ = target_.parent_path() / (prefix + std::to_string(getpid()) + std::string(kPart));
  // A link that somebody put in this place is not followed.
  std::error_code ignored;
  fs::remove(part_, ignored);
  const int file = open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) refuse_writing(path, std::string(": ") + std::strerror(errno));
  close(file);
  remember(part_.c_str());
}

OutputFile::~OutputFile() {
  forget(part_.c_str());
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void OutputFile::finish() const {
  check_target(path_, target_);  // it may have changed since
  struct stat info {};
  if (stat(target_.c_str(), &info) == 0) chmod(part_.c_str(), info.st_mode & 07777);
  std::error_code error;
  fs::rename(part_, target_, error);
  if (error) refuse_writing(path_, ": " + error.message());
}

void remove_part_files() noexcept {
  for (const auto& place : living_parts)
    if (const char* part = place.load(); part != nullptr) unlink(part);
}

}  // namespace corank::result
