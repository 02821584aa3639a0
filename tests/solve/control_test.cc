// What ends a run, and what a control says of it.
#include "corank/solve/step/control.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "corank/solve/store/memory.h"
#include "corank/tests/solve/cover_questions.h"

namespace corank::solve {
namespace {

TEST(Control, WithoutLimitsEndsNothing) {
  Control control;
  EXPECT_FALSE(control.ended());
  EXPECT_FALSE(control.search_ended());
  EXPECT_TRUE(control.count_box());
  EXPECT_FALSE(control.ending());
}

TEST(Control, EndsAtItsTimeAndStaysEnded) {
  double now = 100;
  Control control({.time = 5, .clock = [&now] { return now; }});
  now = 104.9;
  EXPECT_FALSE(control.ended());
  const InStage stage(control, Stage::exact);
  now = 105;
  EXPECT_TRUE(control.ended());
  EXPECT_FALSE(control.overdue());
  now = 105.2 + Control::kGrace;
  EXPECT_TRUE(control.overdue());
  now = 100;
  EXPECT_TRUE(control.ended());
  EXPECT_EQ(control.ending(), (Ending{Limit::time, Stage::exact}));
  EXPECT_EQ(to_string(*control.ending()), "the time limit, in the stage exact points");
}

TEST(Control, SaysWhatHasStoppedItAlsoWhereNobodyHasAsked) {
  double now = 100;
  const Control control({.time = 5, .clock = [&now] { return now; }});
  EXPECT_EQ(stopped_by(control), "");
  now = 105;
  EXPECT_EQ(stopped_by(control), "the time limit, in the stage model");
}

TEST(Control, EndsWhereAnotherThreadSaysSo) {
  std::atomic<bool> stop{false};
  const Control control({.stop = &stop});
  EXPECT_FALSE(control.ended());
  stop = true;
  EXPECT_TRUE(control.ended());
  stop = false;
  EXPECT_TRUE(control.ended());
  EXPECT_EQ(control.ending(), (Ending{Limit::interrupt, Stage::model}));
}

TEST(Control, CountsTheBoxesOfAllSearchesAndEndsNothingElse) {
  Control control({.boxes = 3});
  control.count_boxes(1);
  EXPECT_TRUE(control.count_box());
  EXPECT_TRUE(control.count_box());
  EXPECT_FALSE(control.ending());
  EXPECT_FALSE(control.count_box());
  EXPECT_FALSE(control.ended());
  EXPECT_EQ(control.ending()->by, Limit::boxes);
}

TEST(Control, EndsSearchesThatKeepTooMuch) {
  Control control({.memory = 1000});
  control.keep(1000);
  EXPECT_FALSE(control.search_ended());
  control.keep(1);
  EXPECT_TRUE(control.search_ended());
  EXPECT_FALSE(control.ended());
  EXPECT_EQ(control.ending()->by, Limit::memory);
}

TEST(Control, KeepsTheNameOfTheOuterStage) {
  Control control;
  std::vector<Stage> begun;
  control.progress = [&](const Control::Progress& p) { begun.push_back(p.stage); };
  {
    const InStage outer(control, Stage::exact);
    const InStage inner(control, Stage::search);
    EXPECT_EQ(control.stage(), Stage::exact);
  }
  const InStage next(control, Stage::writing);
  EXPECT_EQ(control.stage(), Stage::writing);
  EXPECT_EQ(begun, (std::vector<Stage>{Stage::exact, Stage::writing}));
}

TEST(MemoryLimit, LeavesWhatDoesNotFitPending) {
  for (const int threads : {1, 2}) {
    Options options;
    options.sigma = 0.02;
    options.threads = threads;
    Control control({.memory = 700'000});
    const Cover cover = solve(prepare(torus().system(), options, control), control);
    EXPECT_FALSE(cover.complete());
    EXPECT_EQ(control.ending(), (Ending{Limit::memory, Stage::search}));
    EXPECT_EQ(control.kept(), 0) << "what the search kept is given back";
    EXPECT_GT(cover.boxes.size(), 100u);
    // The rest of the limit is for the copies that are made of each box, and for the file.
    EXPECT_LT(bytes_of(cover, kFileBytes), 700'000u);
    EXPECT_TRUE(covers(cover, {1.5, 0, 0}) && covers(cover, {0, -0.5, 0}) && covers(cover, {-1, 0, 0.5}));
  }
}

TEST(MemoryLimit, CountsWhatAProofTakes) {
  Options options;
  options.sigma = 0.1;
  const auto boxes_within = [&](bool proof) {
    options.proof = proof;
    Control control({.memory = 500'000});
    return solve(prepare(torus().system(), options, control), control).boxes.size();
  };
  EXPECT_LT(boxes_within(true), boxes_within(false));
}

TEST(MemoryLimit, IsOneOfTheOptions) {
  Options options;
  options.sigma = 0.02;
  options.memory_limit = 500'000;
  EXPECT_FALSE(solve(torus().system(), options).complete());
}

class MachineMemory : public testing::Test {
 protected:
  MachineMemory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "corank-memory-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    folder_ = pattern;
    write("proc/meminfo", "MemFree: 1 kB\nMemTotal:       8000 kB\n");
  }
  ~MachineMemory() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  std::uint64_t memory() const { return machine_memory(folder_ / "proc", folder_ / "groups"); }

  std::filesystem::path folder_;
};

TEST_F(MachineMemory, IsTheMainMemoryWhereNothingElseIsKnown) { EXPECT_EQ(memory(), 8000u * 1024); }

TEST_F(MachineMemory, IsTheLeastThatAControlGroupGrants) {
  write("proc/self/cgroup", "0::/user/shell\n");
  write("groups/user/memory.max", "max\n");
  write("groups/user/shell/memory.max", "max\n");
  EXPECT_EQ(memory(), 8000u * 1024);
  write("groups/user/memory.max", "4000000\n");
  EXPECT_EQ(memory(), 4000000u);
  write("groups/user/shell/memory.max", "3000000\n");
  EXPECT_EQ(memory(), 3000000u);
}

TEST_F(MachineMemory, KnowsTheFirstVersionOfControlGroups) {
  write("proc/self/cgroup", "5:cpu:/x\n4:cpu,memory:/shell\n");
  write("groups/memory/shell/memory.limit_in_bytes", "2000000\n");
  EXPECT_EQ(memory(), 2000000u);
}

TEST_F(MachineMemory, IsNothingWhereNothingIsKnown) { EXPECT_EQ(machine_memory(folder_ / "none", folder_ / "none"), 0u); }

}  // namespace
}  // namespace corank::solve
