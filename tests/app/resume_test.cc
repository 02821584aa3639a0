// Runs that were ended, by a limit or by SIGKILL, go on from what they have kept, and come to the same result.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "corank/result/files/checkpoint.h"
#include "corank/result/files/result_file.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

void expect_same(const std::string& one, const std::string& other) {
  const result::Result a = result::read_result(one), b = result::read_result(other);
  ASSERT_EQ(a.cover.boxes.size(), b.cover.boxes.size());
  for (std::size_t i = 0; i < a.cover.boxes.size(); ++i) {
    ASSERT_EQ(a.cover.boxes[i].box, b.cover.boxes[i].box) << i;
    ASSERT_EQ(a.cover.boxes[i].verdict, b.cover.boxes[i].verdict) << i;
    ASSERT_EQ(a.cover.boxes[i].region, b.cover.boxes[i].region) << i;
  }
  EXPECT_EQ(a.cover.regions, b.cover.regions);
  EXPECT_EQ(a.cover.sigma, b.cover.sigma);
  EXPECT_EQ(a.model_text, b.model_text);
  EXPECT_EQ(a.system_text, b.system_text);
  EXPECT_EQ(a.cover.statistics.processed, b.cover.statistics.processed);
  ASSERT_EQ(a.cover.proof != nullptr, b.cover.proof != nullptr);
  EXPECT_TRUE(!a.cover.proof || *a.cover.proof == *b.cover.proof);
}

// The program as a child that ends after a number of renames in the folder, by SIGKILL, or by itself: its status.
std::optional<int> killed_after(int renames, const std::string& folder, const Words& args) {
  const int watch = inotify_init1(IN_CLOEXEC);
  EXPECT_GE(inotify_add_watch(watch, folder.c_str(), IN_MOVED_TO), 0);
  Words words = with({CORANK_PROGRAM}, args);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> alive{};
  EXPECT_EQ(pipe2(alive.data(), O_CLOEXEC), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, alive[1], 9);  // closes when the child ends
  pid_t child = -1;
  EXPECT_EQ(posix_spawn(&child, CORANK_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  close(alive[1]);
  while (renames > 0) {
    std::array<pollfd, 2> either{{{watch, POLLIN, 0}, {alive[0], POLLIN, 0}}};
    if (poll(either.data(), either.size(), -1) < 0 || (either[1].revents & POLLHUP) != 0) break;
    alignas(inotify_event) std::array<char, 1 << 14> events{};
    const ssize_t size = read(watch, events.data(), events.size());
    for (ssize_t at = 0; at < size; --renames)
      at += static_cast<ssize_t>(sizeof(inotify_event) + reinterpret_cast<inotify_event*>(&events[at])->len);
  }
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  close(alive[0]);
  close(watch);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  return std::nullopt;
}

Words surface(const std::string& result) {
  return {"solve", model("dextar"), "--set", "cspace", "--sigma", "0.2", "--threads", "2", "--proof", "-o", result};
}

TEST(Resume, GoesOnAfterLimitsFromACheckpointAndFromAResult) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), part = folder.file("part.h5"), next = folder.file("next.h5"),
                    kept = folder.file("kept");
  EXPECT_EQ(run_corank(surface(whole)).status, 0);
  const Outcome first = run_corank(with(surface(part), {"--checkpoint", kept, "--max-boxes", "500"}));
  EXPECT_EQ(first.status, 3);
  EXPECT_THAT(first.err, HasSubstr("to go on: corank solve --resume " + kept));
  EXPECT_EQ(run_corank({"solve", "--resume", part, "-o", next}).status, 0);
  expect_same(whole, next);
  const Outcome second = run_corank({"solve", "--resume", kept, "--max-boxes", "1000"});
  EXPECT_EQ(second.status, 3) << second.err;
  EXPECT_EQ(run_corank({"solve", "--resume", kept, "--threads", "3"}).status, 0);
  expect_same(whole, part);  // the -o of the first run
  EXPECT_FALSE(std::filesystem::exists(kept)) << "it is complete";
}

TEST(Resume, GoesOnAfterSigkillAtAnyMoment) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), kept = folder.file("kept");
  EXPECT_EQ(run_corank(surface(whole)).status, 0);
  std::mt19937 random(3);
  int kills = 0;
  for (int round = 0; round < 3; ++round) {
    const TemporaryFolder mine;
    const std::string file = mine.file("r.h5"), checkpoint = mine.file("kept");
    std::optional<int> status;
    for (int run = 0; !status; ++run) {
      const bool resume = std::filesystem::exists(checkpoint);
      const Words args = resume ? Words{"solve", "--resume", checkpoint, "--every", "0"}
                                : with(surface(file), {"--checkpoint", checkpoint, "--every", "0"});
      status = killed_after(run < 6 ? 1 + static_cast<int>(random() % 3) : 1'000'000, mine.file(""), args);
      kills += !status;
    }
    EXPECT_EQ(*status, 0);
    expect_same(whole, file);
  }
  EXPECT_GT(kills, 3);
}

TEST(Resume, OfASetOfPartsGoesOnInTheRightPart) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), file = folder.file("r.h5"), kept = folder.file("kept");
  const Words solve{"solve", model("dextar_limits"), "--set", "boundary", "--sigma", "0.5"};
  const Outcome outcome = run_corank(with(solve, {"-o", whole}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::uint64_t all = result::read_result(whole).cover.statistics.processed;
  EXPECT_EQ(run_corank(with(solve, {"-o", file, "--checkpoint", kept, "--max-boxes", std::to_string(all / 2)})).status, 3);
  int runs = 1;
  for (; runs < 20; ++runs)
    if (run_corank({"solve", "--resume", kept, "--max-boxes", std::to_string(all / 5)}).status == 0) break;
  EXPECT_LT(runs, 20);
  EXPECT_GT(runs, 1);
  expect_same(whole, file);
}

TEST(Refine, CutsTheSheetsOfAnyResult) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), fine = folder.file("fine.h5");
  const Words curve{"solve", model("dextar"), "--set", "forward"}, plane{"solve", model("dextar"), "--set", "cspace"};
  const Words arm{"solve", model("serial/puma_560"), "--set", "inverse", "-D", "lo3=-1", "-D", "up3=0"};
  for (const Words& question : {curve, plane, arm}) {
    SCOPED_TRACE(question[1] + " " + question[3]);
    const Outcome first = run_corank(with(question, {"-o", whole, "--json"}));
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(nlohmann::json::parse(first.out)["options"]["sigma"].is_null(), question != curve);
    const Words refine{"solve", "--refine", whole, "--sigma", question == curve ? "0.005" : "0.2", "-o", fine};
    const Outcome second = run_corank(refine);
    ASSERT_EQ(second.status, 0) << second.err;
    const result::Result sheets = result::read_result(whole), boxes = result::read_result(fine);
    EXPECT_LT(sheets.cover.boxes.size() + 1000, boxes.cover.boxes.size());
    EXPECT_EQ(boxes.parts.size(), sheets.parts.size());
    EXPECT_EQ(boxes.cover.count(Verdict::undecided), sheets.cover.count(Verdict::undecided));
    EXPECT_EQ(boxes.cover.wider_than_sigma, 0u);
    EXPECT_EQ(boxes.cover.types.asked, sheets.cover.types.asked);
    EXPECT_EQ(run_corank({"verify", fine}).status, 4) << "every claim, but no proof of completeness";
  }
  EXPECT_EQ(run_corank({"solve", "--refine", whole, "--sigma", "0.2"}).status, 2) << "without -o";
  const std::string before = read_text(whole);
  EXPECT_THAT(run_corank({"solve", "--refine", whole, "-o", folder.file("./whole.h5")}).err,
              HasSubstr("-o: not overwritten"));
  EXPECT_EQ(read_text(whole), before);
  EXPECT_EQ(run_corank({"solve", "--refine", whole, "--sigma", "0.2", "--proof", "-o", fine}).status, 2);
}

TEST(Refine, IsRefusedWhereSigmaSteersTheSearch) {
  const TemporaryFolder folder;
  const std::string coarse = folder.file("coarse.h5");
  const std::string circle =
      folder.write("circle.cuik", "[SYSTEM VARS]\nx : [-2,2]\ny : [-2,2]\n[SYSTEM EQS]\nx^2 + 1.1*y^2 = 1;\n");
  const Outcome first = run_corank({"solve", circle, "--tolerance", "1e-6", "--sigma", "0.5", "-o", coarse});
  ASSERT_EQ(first.status, 0) << first.err;
  const Outcome refined = run_corank({"solve", "--refine", coarse, "--sigma", "0.1", "-o", folder.file("fine.h5")});
  EXPECT_EQ(refined.status, 1);
  EXPECT_THAT(refined.err, HasSubstr("tolerance"));
}

TEST(Refine, PicturesCutSheetsThatAreWhole) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), cut = folder.file("cut.h5");
  ASSERT_EQ(run_corank({"solve", model("dextar"), "--set", "cspace", "-o", whole}).status, 0);
  ASSERT_EQ(run_corank({"solve", "--refine", whole, "-o", cut}).status, 0);
  for (const std::string& file : {whole, cut})
    ASSERT_EQ(run_corank({"plot", file, "--axes", "J3x,J3y", "-o", file + ".svg"}).status, 0);
  EXPECT_EQ(read_text(whole + ".svg"), read_text(cut + ".svg"));
}

TEST(Resume, SaysWhyAFileHoldsNoSearchToGoOnWith) {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.h5"), path = folder.file("path.h5");
  ASSERT_EQ(run_corank({"solve", model("three_slider"), "--set", "forward", "-o", whole}).status, 0);
  EXPECT_THAT(run_corank({"solve", "--resume", whole}).err,
              HasSubstr("this result is complete: there is no search to go on"));
  ASSERT_EQ(run_corank({"path", model("dextar"), "--from", "J3x=0.5,J3y=1", "--from-mode", "1", "--to", "J3x=0.6,J3y=1",
                        "--to-mode", "1", "-o", path})
                .status,
            0);
  for (const Words& more : {Words{"--resume", path}, Words{"--refine", path, "-o", folder.file("cut.h5")}}) {
    const Outcome outcome = run_corank(with({"solve"}, more));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("not a corank result, but a certificate of corank path, which corank verify reads"));
  }
}

class Kept : public testing::Test {
 protected:
  void SetUp() override {
    EXPECT_EQ(run_corank(
                  {"solve", model("dextar"), "--set", "forward", "--sigma", "1", "--checkpoint", path, "--max-boxes", "100"})
                  .status,
              3);
    bytes = read_text(path);
  }
  void change(const std::string& to) const { std::ofstream(path, std::ios::binary) << to; }
  const TemporaryFolder folder;
  const std::string path = folder.file("kept");
  std::string bytes;
};

TEST_F(Kept, WithAnyByteChangedIsRefused) {
  std::mt19937 random(11);
  for (int k = 0; k < 500; ++k) {
    std::string changed = bytes;
    char& byte = changed[random() % changed.size()];
    byte = static_cast<char>(byte ^ (1 + random() % 255));
    change(changed);
    EXPECT_THROW(result::read_checkpoint(path, solve::engine_version()), result::ResultFileError) << k;
    EXPECT_TRUE(k % 50 != 0 || run_corank({"solve", "--resume", path}).status == 1) << k;
  }
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 100) {
    change(bytes.substr(0, length));
    EXPECT_THROW(result::read_checkpoint(path, solve::engine_version()), result::ResultFileError) << length;
  }
}

TEST_F(Kept, ByAnotherVersionIsRefusedByName) {
  std::string other = bytes;
  const std::size_t at = other.find("version ") + std::strlen("version ");
  other[at] = '7';
  change(other);
  const Outcome outcome = run_corank({"solve", "--resume", path});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("a checkpoint by corank 7"));
  EXPECT_THAT(outcome.err, HasSubstr("this is corank " + solve::engine_version()));
}

TEST_F(Kept, TakesNoOtherQuestion) {
  const Outcome outcome = run_corank({"solve", "--resume", path, "--set", "inverse"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("expected no --set"));
}

TEST_F(Kept, GoesOnWithItsOwnModelWhereTheFileHasChanged) {
  const std::string mine = folder.write("dextar.cuik", read_text(model("dextar"))), own = folder.file("own");
  const Words solve{"solve", mine, "--set", "forward", "--sigma", "1"};
  EXPECT_EQ(run_corank(with(solve, {"--checkpoint", own, "--max-boxes", "100"})).status, 3);
  const std::string whole = run_corank(with(solve, {"--json"})).out;
  folder.write("dextar.cuik", "gone");
  const Outcome resumed = run_corank({"solve", "--resume", own, "-o", folder.file("r.h5")});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(result::read_result(folder.file("r.h5")).model_text, read_text(model("dextar")));
}

}  // namespace
}  // namespace corank::app
