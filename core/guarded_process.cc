#include "corank/core/guarded_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

namespace corank {
namespace {

// Sanitizers map terabytes that they never touch, so that they cannot live with a limit of the address space.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif
#else
constexpr bool kLimitsMemory = true;
#endif

enum ChildStatus : int { kDone = 0, kFailed = 1 };

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void fail(const std::string& what) { throw GuardedWorkError(what + ": " + std::strerror(errno)); }

std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &now) != 0) return;
  now.rlim_max = std::min<rlim_t>(now.rlim_max, hard);
  now.rlim_cur = std::min<rlim_t>(now.rlim_max, soft);
  setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
}

// Alone, silent, mortal, and without what this process does on a signal.
void prepare_child(const ProcessLimits& limits, std::uint64_t memory, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kFailed);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM, SIGXCPU}) std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // on a terminal it comes to both: this process decides, whose end is the child's, too
  if (const int null = open("/dev/null", O_RDWR); null >= 0)
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds, limits.cpu_seconds + 1);
  if (kLimitsMemory) limit(RLIMIT_AS, memory, memory);
}

[[noreturn]] void be_child(int output, const std::function<void(ByteSink&)>& work) {
  try {
    ByteSink sink(output);
    work(sink);
    _exit(kDone);
  } catch (const std::exception& error) {
    if (ftruncate(output, 0) == 0 && lseek(output, 0, SEEK_SET) == 0) {
      const std::string_view message = error.what();
      [[maybe_unused]] const auto written = ::write(output, message.data(), message.size());
    }
    _exit(kFailed);
  } catch (...) {
    _exit(kFailed);
  }
}

// Looks at `ended` now and then; the child does not outlive it.
int wait_for(pid_t child, const Ended& ended) {
  constexpr std::chrono::milliseconds kFirst{1}, kLongest{20};
  int status = 0;
  for (std::chrono::milliseconds pause = kFirst;; pause = std::min(2 * pause, kLongest)) {
    const pid_t found = waitpid(child, &status, ended ? WNOHANG : 0);
    if (found == child) return status;
    if (found < 0 && errno != EINTR) fail("cannot wait for a process");
    if (found != 0) continue;
    if (ended()) kill(child, SIGKILL);
    std::this_thread::sleep_for(pause);
  }
}

std::string end_of(int status, const ProcessLimits& limits) {
  if (!WIFSIGNALED(status)) return "the process failed";
  const int signal = WTERMSIG(status);
  if (signal == SIGTERM) return "interrupted";
  if (signal == SIGXCPU) return "not done after " + std::to_string(limits.cpu_seconds) + " s of processor time";
  return std::string("the process ended by a signal (") + strsignal(signal) + ")";
}

}  // namespace

SharedBytes::SharedBytes(int descriptor) {
  struct stat info {};
  if (fstat(descriptor, &info) != 0) fail("cannot read from a process");
  if (info.st_size == 0) return;
  size_ = info.st_size;
  void* data = mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor, 0);
  if (data == MAP_FAILED) fail("cannot read from a process");
  data_ = static_cast<const std::byte*>(data);
  descriptor_ = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
}

SharedBytes::SharedBytes(SharedBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

SharedBytes::~SharedBytes() {
  if (data_) munmap(const_cast<std::byte*>(data_), size_);
  if (descriptor_ >= 0) close(descriptor_);
}

void SharedBytes::forget(std::span<const std::byte> part) {
  const std::size_t page = sysconf(_SC_PAGESIZE);
  const std::size_t begin = part.data() - data_, end = begin + part.size();
  const std::size_t first = (begin + page - 1) / page * page, last = end / page * page;
  if (descriptor_ < 0 || first >= last) return;
  // Where it is refused, the memory is given back at the end.
  [[maybe_unused]] const int refused = fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                                 static_cast<off_t>(first), static_cast<off_t>(last - first));
}

void ByteSink::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw std::runtime_error(std::string("no memory for its contents: ") + std::strerror(errno));
    bytes = bytes.subspan(n);
  }
}

SharedBytes run_guarded(const ProcessLimits& limits, const std::function<void(ByteSink&)>& work, const Ended& ended) {
  const Descriptor output(memfd_create("corank", MFD_CLOEXEC));
  if (output.get() < 0) fail("cannot make room for a process's results");
  const std::uint64_t memory = address_space() + limits.memory;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) fail("cannot start a process");
  if (child == 0) {
    prepare_child(limits, memory, parent);
    be_child(output.get(), work);
  }
  const int status = wait_for(child, ended);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) return SharedBytes(output.get());
  if (WIFEXITED(status) && WEXITSTATUS(status) == kFailed) {
    const SharedBytes message(output.get());
    if (!message.bytes().empty())
      throw GuardedWorkError({reinterpret_cast<const char*>(message.bytes().data()), message.bytes().size()});
  }
  throw GuardedWorkError(end_of(status, limits));
}

}  // namespace corank
