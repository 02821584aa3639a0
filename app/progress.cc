#include "corank/app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace corank::app {
namespace {

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressLine::ProgressLine(std::string task) : task_(std::move(task)), visible_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::follow(solve::Control& control) {
  if (!visible_) return;
  control.search_progress = [this](const solve::SearchProgress& progress) { show(progress); };
  control.progress = [this](const solve::Control::Progress& progress) { show(progress); };
}

void ProgressLine::show(const solve::Control::Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (!visible_ || (progress.stage == stage_ && now < next_)) return;
  stage_ = progress.stage;
  next_ = now + kRefreshInterval;
  std::string line = (task_.empty() ? "" : task_ + ": ") + to_string(progress.stage);
  if (progress.all > 0) line += fmt::format(": {} of {}", progress.done, progress.all);
  show(line);
}

void ProgressLine::show(const solve::SearchProgress& progress) {
  if (!visible_) return;
  std::string line = task_.empty() ? "" : task_ + ": ";
  line += fmt::format("search: {} done, {} left, {:.1f} % excluded", progress.processed, progress.waiting,
                      100 * progress.excluded);
  for (std::size_t v = 0; v < progress.verdicts.size(); ++v) {
    if (progress.verdicts[v] == 0) continue;
    line += fmt::format(", {} {}", progress.verdicts[v], to_string(static_cast<Verdict>(v)));
  }
  line += fmt::format(", {:.1f} s", progress.seconds);
  show(line);
}

void ProgressLine::show(const std::string& text) {
  if (!visible_) return;
  fmt::print(stderr, "\r{}\x1b[K", text.substr(0, terminal_width() - 1));
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressLine::clear() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace corank::app
