// Work in a child process: its results come back, its end by whatever means does not end this one.
#include "corank/core/guarded_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <vector>

namespace corank::result {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kMegabyte = 1 << 20;
constexpr ProcessLimits kLimits{64 * kMegabyte, 20};

std::string failure(const std::function<void(ByteSink&)>& work, const ProcessLimits& limits = kLimits) {
  try {
    run_guarded(limits, work);
  } catch (const GuardedWorkError& error) {
    return error.what();
  }
  return "";
}

TEST(GuardedProcess, HandsBackWhatWasWritten) {
  const SharedBytes result = run_guarded(kLimits, [](ByteSink& sink) {
    sink.write("first ");
    sink.write("second");
  });
  const auto bytes = result.bytes();
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), "first second");
  EXPECT_TRUE(run_guarded(kLimits, [](ByteSink&) {}).bytes().empty());
}

TEST(GuardedProcess, HandsBackMoreThanItsLimitOfMemory) {
  const std::vector<std::byte> block(kMegabyte, std::byte{7});
  const SharedBytes result = run_guarded(kLimits, [&block](ByteSink& sink) {
    for (int k = 0; k < 100; ++k) sink.write(block);
  });
  ASSERT_EQ(result.bytes().size(), 100 * kMegabyte);
  EXPECT_EQ(result.bytes().back(), std::byte{7});
}

TEST(GuardedProcess, HandsBackTheTextOfAnException) {
  EXPECT_EQ(failure([](ByteSink& sink) {
              sink.write("half a result");
              throw std::runtime_error("no such item");
            }),
            "no such item");
}

TEST(GuardedProcess, EndsWhenItIsToldTo) {
  int asked = 0;
  const auto work = [](ByteSink&) {
    for (;;) pause();
  };
  EXPECT_THROW(run_guarded(kLimits, work, [&asked] { return ++asked > 3; }), GuardedWorkError);
  EXPECT_GT(asked, 3);
  EXPECT_TRUE(run_guarded(
                  kLimits, [](ByteSink&) {}, [] { return false; })
                  .bytes()
                  .empty());
}

TEST(GuardedProcess, SurvivesACrash) {
  EXPECT_THAT(failure([](ByteSink&) { std::raise(SIGSEGV); }), HasSubstr("ended by a signal"));
  EXPECT_THAT(failure([](ByteSink&) { std::abort(); }), HasSubstr("ended by a signal"));
}

TEST(GuardedProcess, EndsWhatDoesNotEnd) {
  const auto for_ever = [](ByteSink&) {
    std::atomic<int> turns = 0;
    for (;;) ++turns;
  };
  EXPECT_EQ(failure(for_ever, {64 * kMegabyte, 1}), "not done after 1 s of processor time");
}

TEST(GuardedProcess, EndsWhatWantsTooMuchMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer maps more memory than any limit allows";
#endif
  const auto hungry = [](ByteSink& sink) {
    const std::vector<std::byte> all(512 * kMegabyte);
    sink.write(all);
  };
  EXPECT_THAT(failure(hungry), HasSubstr("bad_alloc"));
}

}  // namespace
}  // namespace corank::result
