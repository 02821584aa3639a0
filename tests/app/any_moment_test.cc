// Every command, ended at any question that it asks its clock: by the limit of time and by a signal. What it has found by
// then is said to be incomplete and holds, or is all that there is. What ended it is named, by tables and JSON, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>

#include "corank/app/limited_run.h"
#include "corank/app/run.h"
#include "corank/tests/app/program.h"
#include "corank/tests/seeds.h"

namespace corank::app {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using testing::HasSubstr;

enum class Way { limit, interrupt };
const char* name_of(Way way) { return way == Way::limit ? "the time limit" : "an interrupt"; }

// Stands still for k questions. Then it is late, later with each; or it sends a signal once.
class Clock {
 public:
  Clock(Way way, long k) : way_(way), k_(k) {}
  double operator()() {
    const long late = ++questions_ - k_;
    if (late <= 0) return 0;
    if (way_ == Way::limit) return 1e6 * static_cast<double>(late);
    if (late == 1) std::raise(SIGTERM);
    return 0;
  }
  long questions() const { return questions_; }

 private:
  const Way way_;
  const long k_;
  std::atomic<long> questions_{0};
};

struct Done {
  int status = -1;
  std::string out, err;
  long questions = 0;
};

// In this process: its clock is the test's.
Done run_by(Way way, long k, Words args) {
  Clock clock(way, k);
  const ClockOfCommands in_place([&clock] { return clock(); });
  args.insert(args.end(), {"--time-limit", "100000"});
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Done result;
  result.status = run("corank", args);
  result.out = testing::internal::GetCapturedStdout();
  result.err = testing::internal::GetCapturedStderr();
  result.questions = clock.questions();
  return result;
}

// Without the times that the machine's clock has measured.
std::string untimed(const std::string& text) {
  static const std::regex times("[0-9.e+-]+ s(?![a-z])");
  return std::regex_replace(text, times, "… s");
}

constexpr long kNever = 1'000'000'000;

struct Command {
  const char* name;
  Words args;                  // {} is a folder of its own
  Words before = {};           // run before it, undisturbed: writes what the command reads
  int status = 0;              // undisturbed
  const char* page = nullptr;  // is there in any case
};

Words in_folder(Words args, const TemporaryFolder& folder) {
  for (std::string& word : args)
    if (const std::size_t at = word.find("{}"); at != std::string::npos) word.replace(at, 2, folder.file(""));
  return args;
}

// 1, 8, 64, … and as many before the end, in turn by the limit and by a signal. A long run has 1, 4, 16, …, by both.
std::map<Way, std::set<long>> moments(long questions) {
  std::map<Way, std::set<long>> all;
  int turn = 0;
  for (long k = 1; k <= questions; k *= test::long_run() ? 4 : 8, ++turn)
    for (const Way way : {Way::limit, Way::interrupt}) {
      if (test::long_run() || (turn % 2 == 0) == (way == Way::limit)) all[way].insert(k);
      if (test::long_run() || (turn % 2 == 0) == (way == Way::interrupt)) all[way].insert(questions + 1 - k);
    }
  return all;
}

// No claim of any file fails, and none is half written.
void expect_files_hold(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    if (entry.path().extension() != ".h5") continue;
    const Done check = run_by(Way::limit, kNever, {"verify", entry.path().string(), "--sample", "20"});
    const Done whole = check.status == 2 ? run_by(Way::limit, kNever, {"verify", entry.path().string()}) : check;
    EXPECT_THAT(whole.status, testing::AnyOf(0, 3, 4)) << entry.path() << whole.out << whole.err;
  }
}

// The JSON object of a run that was ended, where one was asked for, names what ended it.
void expect_named_in_json(const fs::path& file, const Done& run, Way way) {
  if (!fs::exists(file)) return;
  const auto stopped = nlohmann::json::parse(read_text(file))["stopped"];
  if (run.status != 0 || !stopped.is_null()) {
    ASSERT_TRUE(stopped.is_string()) << run.out << run.err;
    EXPECT_THAT(stopped.get<std::string>(), HasSubstr(name_of(way)));
  }
}

class AnyMoment : public testing::TestWithParam<Command> {};

TEST_P(AnyMoment, EndsTheCommandWithWhatHoldsByThen) {
  const Command& command = GetParam();
  std::optional<TemporaryFolder> kept;
  if (!command.before.empty()) {
    ASSERT_EQ(run_by(Way::limit, kNever, in_folder(command.before, kept.emplace())).status, 0);
  }
  const auto run_at = [&](Way way, long k, bool last) {
    const TemporaryFolder own;
    const TemporaryFolder& folder = kept ? *kept : own;
    Done result = run_by(way, k, in_folder(command.args, folder));
    for (std::size_t at; (at = result.out.find(folder.file(""))) != std::string::npos;)
      result.out.replace(at, folder.file("").size(), "");
    if (command.page) {
      EXPECT_TRUE(fs::exists(folder.file(command.page)));
    }
    if (last || result.status != command.status) expect_files_hold(folder.file(""));
    expect_named_in_json(folder.file("said.json"), result, way);
    return result;
  };
  const Done whole = run_at(Way::limit, kNever, true);
  ASSERT_EQ(whole.status, command.status) << whole.err;
  ASSERT_GT(whole.questions, 0) << "it never asks whether it is to end";
  int ended = 0;
  for (const auto& [way, at] : moments(whole.questions)) {
    for (const long k : at) {
      SCOPED_TRACE((way == Way::limit ? "the limit at question " : "a signal at question ") + std::to_string(k) + " of " +
                   std::to_string(whole.questions));
      const Done run = run_at(way, k - 1, false);
      const auto says_so = HasSubstr(name_of(way));
      const bool said = testing::Matches(says_so)(run.out + run.err);
      if (run.status == command.status) {  // too late to matter
        EXPECT_TRUE(said || untimed(run.out) == untimed(whole.out)) << run.out << whole.out;
        continue;
      }
      ++ended;
      EXPECT_THAT(run.out + run.err, says_so);
      if (!command.page && !run.out.empty() && command.args[0] != "verify") {  // whose table names the stage alone
        EXPECT_THAT(run.out, says_so);
      }
      EXPECT_EQ(run.status, 3) << run.err;
    }
  }
  EXPECT_GT(ended, 0);
}

const std::string kModels = CORANK_SOURCE_DIR "/models/";
const std::string kSlider = kModels + "three_slider.cuik", kDextar = kModels + "dextar.cuik",
                  kCrank = kModels + "planar/slider_crank.cuik", kArm = kModels + "planar/arm_2r_limits.cuik";

INSTANTIATE_TEST_SUITE_P(
    Of, AnyMoment,
    testing::Values(
        Command{"points", {"solve", kSlider, "--set", "forward", "-D", "L2=1", "--digits", "20", "--proof", "-o", "{}r.h5"}},
        Command{"curves", {"solve", kDextar, "--set", "inverse", "--sigma", "0.3", "-o", "{}r.h5"}},
        Command{"checkpoint", {"solve", kSlider, "--set", "cspace", "--checkpoint", "{}kept", "-o", "{}r.h5"}},
        Command{"boundary", {"solve", kArm, "--set", "boundary", "--sigma", "0.3", "-o", "{}r.h5"}},
        Command{"aspects", {"aspects", kCrank, "--cusps", "-o", "{}a.h5", "--json", "{}said.json"}},
        Command{"picture", {"aspects", kArm, "-o", "{}a.svg"}},
        Command{"topology", {"topology", kCrank, "-o", "{}t.h5", "--json", "{}said.json"}},
        Command{"path",
                {"path", kDextar, "--from", "J3x=0.5,J3y=1", "--from-mode", "1", "--to", "J3x=0.6,J3y=1", "--to-mode", "1",
                 "-o", "{}p.h5", "--json", "{}said.json"}},
        Command{
            "clearance",
            {"clearance", kDextar, "--at", "J3x=0.5,J3y=1", "--in", "J3x,J3y", "--proof", "{}c", "--json", "{}said.json"}},
        Command{
            "best_center",
            {"clearance", kDextar, "--best", "J3x=[0.4,0.6],J3y=[0.9,1]", "--precision", "0.5", "--json", "{}said.json"}},
        Command{"tolerance",
                {"tolerance", kDextar, "-D", "l=0.9±0.05", "--keep", "clearance>=0.15", "--at", "J3x=0.5,J3y=1", "--in",
                 "J3x,J3y", "--precision", "0.9", "--json", "{}said.json"}},
        Command{"tolerance_of_a_path",
                {"tolerance", kDextar, "-D", "l=0.9±0.001", "--keep", "path {}p.h5", "--precision", "0.9", "--json",
                 "{}said.json"},
                {"path", kDextar, "--from", "J3x=0.5,J3y=1", "--from-mode", "1", "--to", "J3x=0.6,J3y=1", "--to-mode", "1",
                 "-o", "{}p.h5"}},
        Command{"postures", {"postures", kDextar, "--at", "theta2=1,theta5=1", "--json", "{}said.json"}},
        Command{"cuspidal",
                {"cuspidal", kModels + "planar/3rpr.cuik", "--poses", "1", "--threads", "1", "--json", "{}said.json"}},
        Command{"clearance_map",
                {"clearance", kDextar, "--map", "J3x=[0.4,0.6],J3y=[0.9,1]", "--grid", "2", "-o", "{}m.svg", "--json",
                 "{}said.json"}},
        Command{"map",
                {"map", kDextar, "--over", "theta2=1:2", "--over", "theta5=1:2", "--resolution", "8", "--threads", "1", "-o",
                 "{}m.h5", "--json", "{}said.json"}},
        Command{"report", {"report", kSlider, "-o", "{}page"}, {}, 0, "page/index.html"},
        Command{"sweep", {"sweep", kSlider, "-D", "L1=1:1.1:2", "-o", "{}family"}, {}, 0, "family/index.html"},
        Command{"derive", {"derive", kDextar, "--set", "forward", "--format", "cuik", "-o", "{}d.cuik"}},
        Command{"derive_parts", {"derive", kArm, "--set", "boundary", "--json", "{}d.json"}},
        Command{"plot",
                {"plot", "{}r.h5", "--axes", "y_A,x_C", "-o", "{}p.svg"},
                {"solve", kSlider, "--set", "cspace", "-o", "{}r.h5"}},
        Command{"angles",
                {"angles", "{}r.h5", "s_theta2", "c_theta2", "{}a.sol"},
                {"solve", kDextar, "--set", "inverse", "--sigma", "0.3", "-o", "{}r.h5"}},
        Command{"refine",
                {"solve", "--refine", "{}r.h5", "--sigma", "0.5", "-o", "{}c.h5"},
                {"solve", kDextar, "--set", "cspace", "-o", "{}r.h5"}},
        Command{"refine_parts",
                {"solve", "--refine", "{}r.h5", "--sigma", "0.05", "-o", "{}c.h5"},
                {"solve", kArm, "--set", "boundary", "--sigma", "0.3", "-o", "{}r.h5"}},
        Command{"verify_result", {"verify", "{}r.h5"}, {"solve", kSlider, "--set", "forward", "--proof", "-o", "{}r.h5"}},
        Command{"verify_shape", {"verify", "{}t.h5"}, {"topology", kCrank, "-o", "{}t.h5"}},
        Command{"verify_pieces", {"verify", "{}a.h5"}, {"aspects", kCrank, "-o", "{}a.h5"}}),
    [](const auto& command) { return std::string(command.param.name); });

}  // namespace
}  // namespace corank::app
