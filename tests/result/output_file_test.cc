// Files that are written beside their place: what they respect, and that nothing is left of them.
#include "corank/result/files/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "corank/result/files/result_file.h"
#include "corank/tests/report/portrait_reader.h"

namespace corank::result {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class WrittenFile : public testing::Test {
 protected:
  fs::path path(const std::string& name = "r.txt") const { return folder_.file(name); }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(folder_.file(""))) list.push_back(entry.path().filename().string());
    std::sort(list.begin(), list.end());
    return list;
  }
  static std::string refusal(const fs::path& path) {
    try {
      write_text(path, "text");
    } catch (const ResultFileError& error) {
      return error.what();
    }
    return "";
  }

 private:
  report::PictureFolder folder_;
};

// The child's exit status; 1000 + the signal that ended it.
int in_child(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

TEST_F(WrittenFile, WritesThroughASymbolicLink) {
  fs::create_directory(path("folder"));
  std::ofstream(path("folder/target")) << "old";
  fs::create_symlink("folder/target", path("link"));
  fs::create_symlink("link", path("second"));
  write_text(path("second"), "new");
  EXPECT_EQ(report::bytes_of(path("folder/target")), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")) && fs::is_symlink(path("second")));
  EXPECT_THAT(names(), ElementsAre("folder", "link", "second"));
  fs::create_symlink("not-there-yet", path("third"));
  write_text(path("third"), "text");
  EXPECT_EQ(report::bytes_of(path("not-there-yet")), "text");
  fs::create_symlink("circle", path("circle"));
  EXPECT_THAT(refusal(path("circle")), HasSubstr("too many symbolic links"));
}

TEST_F(WrittenFile, RefusesWhatIsNoRegularFile) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal(path("pipe")), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("not a regular file"));
  fs::create_symlink("/dev/null", path("device"));
  EXPECT_THAT(refusal(path("device")), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal(path("")), HasSubstr("it is a folder"));
  EXPECT_THAT(refusal(""), HasSubstr("expected the name of a file"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(names(), ElementsAre("device", "pipe"));
}

TEST_F(WrittenFile, RespectsAReadOnlyFile) {
  std::ofstream(path()) << "old";
  fs::permissions(path(), fs::perms(0444));
  EXPECT_THAT(refusal(path()), HasSubstr("read-only"));
  EXPECT_EQ(report::bytes_of(path()), "old");
}

TEST_F(WrittenFile, KeepsThePermissionsOfTheFileThatItReplaces) {
  std::ofstream(path()) << "old";
  fs::permissions(path(), fs::perms(0640));
  write_text(path(), "new");
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms(0640));
  EXPECT_EQ(report::bytes_of(path()), "new");
}

TEST_F(WrittenFile, LeavesNothingWhereItsProcessIsEndedBySigtermOrCtrlC) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const int status = in_child([&] {
      const OutputFile file(path());
      std::ofstream(file.part()) << "half";
      std::raise(signal);
    });
    EXPECT_EQ(status, 1000 + signal);
    EXPECT_THAT(names(), IsEmpty());
  }
}

TEST_F(WrittenFile, RemovesWhatAKilledProcessLeftAndNothingElse) {
  for (const char* name : {"r.txt", "other.txt"}) {
    const int status = in_child([&] {
      const OutputFile file(path(name));
      std::raise(SIGKILL);
    });
    EXPECT_EQ(status, 1000 + SIGKILL);
  }
  const OutputFile living(path("r.txt"));  // of a process that is at work
  std::ofstream(path("r.txt.backup.part")) << "mine";
  ASSERT_EQ(in_child([&] { write_text(path(), "new"); }), 0);
  const std::vector<std::string> left = names();
  ASSERT_EQ(left.size(), 4u) << testing::PrintToString(left);
  EXPECT_THAT(left[0], testing::StartsWith("other.txt.")) << "not for this file's writer to remove";
  EXPECT_THAT(left, testing::Contains("r.txt"));
  EXPECT_THAT(left, testing::Contains("r.txt.backup.part"));
  EXPECT_THAT(left, testing::Contains(living.part().filename().string()));
}

extern "C" void of_somebody_else(int) {}

TEST(OutputFile, LeavesTheHandlersOfOthersAsTheyAre) {
  struct sigaction mine {
  }, former{}, after{};
  mine.sa_handler = of_somebody_else;  // without SA_RESTART, which std::signal sets
  sigaction(SIGINT, &mine, &former);
  {
    const OutputFile file(fs::temp_directory_path() / "corank_handlers.txt");
    sigaction(SIGINT, nullptr, &after);
    EXPECT_EQ(after.sa_handler, &of_somebody_else);
  }
  sigaction(SIGINT, &former, &after);
  EXPECT_EQ(after.sa_handler, &of_somebody_else);
  EXPECT_EQ(after.sa_flags & SA_RESTART, 0);
}

}  // namespace
}  // namespace corank::result
