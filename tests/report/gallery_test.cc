// The gallery's entries as files, and how answers compare with published numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "corank/report/gallery/outcome.h"
#include "corank/report/html/gallery_page.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::report {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kEntry = R"(title = "A robot"
about = "It moves."
model = "robot.cuik"
source = "A. Author, A paper, 2001"
certainty = "read"

[[question]]
command = "aspects {model} --json"
expect = [{claim = "aspects", at = "/aspects", value = 10, published = "10"}]
)";

class Entries : public testing::Test {
 protected:
  Entries() : folder_(fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "robot.cuik") << "[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx = 1/2;\n";
  }
  ~Entries() override { fs::remove_all(folder_); }

  GalleryEntry read(const std::string& text) const {
    std::ofstream(folder_ / "entry.toml") << text;
    return read_entry(folder_ / "entry.toml");
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const symbolic::ModelError& error) {
      return error.what();
    }
    return "accepted";
  }
  static std::string without(const std::string& line) {
    std::string text = kEntry;
    const std::size_t at = text.find(line);
    return text.erase(at, text.find('\n', at) + 1 - at);
  }

  fs::path folder_;
};

TEST_F(Entries, AreRead) {
  const GalleryEntry entry = read(kEntry);
  EXPECT_EQ(entry.name, "entry");
  EXPECT_EQ(entry.questions.at(0).expect.at(0).published, "10");
  EXPECT_EQ(entry.shown_model, "gallery/robot.cuik");
  EXPECT_EQ(words_of(entry.questions[0].command, "m.cuik"), (std::vector<std::string>{"aspects", "m.cuik", "--json"}));
}

TEST_F(Entries, WithoutASourceAreRefused) {
  EXPECT_THAT(refusal(without("source")), HasSubstr("source is missing"));
  EXPECT_THAT(refusal(without("certainty")), HasSubstr("certainty is missing"));
  EXPECT_THAT(refusal(without("source") + "\n[[robot]]\nfile = \"x.h5\"\ncaption = \"x\"\nsource = \"not here\"\n"),
              HasSubstr("source is missing"));
}

TEST_F(Entries, WithAnUnknownKeyAreRefusedWithFileAndLine) {
  EXPECT_THAT(refusal("sorce = \"A paper\"\n" + kEntry), HasSubstr("entry.toml:1:1: unknown key 'sorce'; expected one of"));
  EXPECT_THAT(refusal(kEntry + "expected = 3\n"), HasSubstr("entry.toml:10:1: unknown key 'expected'"));
}

TEST_F(Entries, ThatMakeNoSenseAreRefused) {
  EXPECT_THAT(refusal("title = 3\n" + without("title")), HasSubstr("entry.toml:1:9: title is no text"));
  EXPECT_THAT(refusal("derived = \"\"\ncertainty = \"derived\"\n" + without("certainty")),
              HasSubstr("nothing says how the numbers were derived"));
  EXPECT_THAT(refusal("certainty = \"sure\"\n" + without("certainty")), HasSubstr("expected read, derived or memory"));
  EXPECT_THAT(refusal("model = \"other.cuik\"\n" + without("model")), HasSubstr("there is no file"));
  EXPECT_THAT(refusal(without("[[question]]")), HasSubstr("question is missing"));
  EXPECT_THAT(refusal("title = \"A robot\n"), HasSubstr("entry.toml:1:"));
  std::string text = kEntry;
  text.replace(text.find("/aspects\""), 8, "aspects");
  EXPECT_THAT(refusal(text), HasSubstr("at is no JSON pointer"));
}

TEST(Gallery, HasEntriesWithSourcesWhoseKeysAreInTheReferences) {
  const std::vector<GalleryEntry> entries = read_entries(CORANK_SOURCE_DIR "/gallery");
  EXPECT_GE(entries.size(), 25u);
  std::ifstream file(CORANK_SOURCE_DIR "/doc/references.bib");
  std::stringstream references;
  references << file.rdbuf();
  std::set<std::string> titles;
  for (const GalleryEntry& entry : entries) {
    SCOPED_TRACE(entry.name);
    EXPECT_TRUE(titles.insert(entry.title).second);
    EXPECT_GE(entry.source.size(), 20u);
    if (!entry.key.empty()) {
      EXPECT_THAT(references.str(), HasSubstr("{" + entry.key + ","));
    }
  }
}

// `NAME` behind "entry" or "entries".
TEST(Paper, NamesEntriesThatAreThere) {
  std::ifstream file(CORANK_SOURCE_DIR "/paper/paper.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::set<std::string> names;
  const std::regex list("\\((?:entry|entries) ([^)]*)\\)"), name("`([a-z0-9_]+)`");
  for (std::sregex_iterator l(text.begin(), text.end(), list), end; l != end; ++l) {
    const std::string inside = (*l)[1];
    for (std::sregex_iterator n(inside.begin(), inside.end(), name); n != end; ++n) names.insert((*n)[1]);
  }
  EXPECT_GE(names.size(), 8u);
  for (const std::string& entry : names) EXPECT_TRUE(fs::exists(CORANK_SOURCE_DIR "/gallery/" + entry + ".toml")) << entry;
}

GalleryFinding found(const std::string& output, const std::string& at, GalleryValue value, double tolerance = 0,
                     bool open = false, const Expectation& more = {}) {
  Expectation e = more;
  e.at = at, e.value = std::move(value), e.tolerance = tolerance;
  GalleryRun run;
  run.output = output;
  return compare({"solve", {e}}, run, open).at(0);
}

TEST(Comparison, TakesAListForTheNumberOfItsItems) {
  EXPECT_EQ(found(R"({"points": [1, 2, 3]})", "/points", 3.0).standing, Standing::proven);
  EXPECT_EQ(found(R"({"points": [1, 2, 3]})", "/points", 4.0).standing, Standing::missed);
}

TEST(Comparison, TakesBoundsForAProofWhereTheyAreEqual) {
  EXPECT_EQ(found(R"({"n": {"at_least": 2, "at_most": 2}})", "/n", 2.0).standing, Standing::proven);
  const GalleryFinding wide = found(R"({"n": {"at_least": 2, "at_most": 4}})", "/n", 2.0);
  EXPECT_EQ(wide.standing, Standing::missed);
  EXPECT_EQ(wide.found, "2 to 4");
  EXPECT_EQ(found(R"({"n": {"at_least": 2, "at_most": null}})", "/n", 2.0).found, "2 or more");
}

TEST(Comparison, HoldsBothEndsOfAnEnclosureToTheTolerance) {
  const std::string answer = R"({"x": {"lo": 0.9, "hi": 1.1}})";
  EXPECT_EQ(found(answer, "/x", 1.0, 0.1001).standing, Standing::proven);
  EXPECT_EQ(found(answer, "/x", 1.0, 0.05).standing, Standing::missed);
  EXPECT_EQ(found(answer, "/x", 1.05, 0.1).standing, Standing::missed);
}

TEST(Comparison, TakesNoNumberOfPointsForProvenWhereABoxIsInDoubt) {
  EXPECT_EQ(found(R"({"points": [1], "boxes": {"undecided": 0, "pending": 0}})", "/points", 1.0).standing, Standing::proven);
  for (const char* verdict : {"undecided", "pending", "partial", "boundary"}) {
    const std::string answer = R"({"points": [1], "boxes": {")" + std::string(verdict) + R"(": 1}})";
    EXPECT_EQ(found(answer, "/points", 1.0).standing, Standing::unproven) << verdict;
  }
  EXPECT_EQ(found(R"({"points": [], "node_distance": 0.05, "boxes": {}})", "/points", 0.0).standing, Standing::unproven);
}

TEST(Comparison, TakesNothingForProvenOfAnAnswerThatIsNotComplete) {
  EXPECT_EQ(found(R"({"n": 1, "complete": false})", "/n", 1.0).standing, Standing::unproven);
  EXPECT_EQ(found(R"({"n": 1, "proven": false})", "/n", 1.0).standing, Standing::unproven);
  Expectation e;
  e.at = "/n", e.value = 1.0;
  GalleryRun stopped;
  stopped.output = R"({"n": 1})", stopped.status = 3;
  EXPECT_EQ(compare({"solve", {e}}, stopped, false).at(0).standing, Standing::unproven);
}

TEST(Comparison, KnowsYesAndNoAndTexts) {
  EXPECT_EQ(found(R"({"cuspidal": true})", "/cuspidal", true).standing, Standing::proven);
  EXPECT_EQ(found(R"({"cuspidal": false})", "/cuspidal", true).standing, Standing::missed);
  EXPECT_EQ(found(R"({"cuspidal": null})", "/cuspidal", false).found, "not known");
  EXPECT_EQ(found(R"({"cuspidal": null})", "/cuspidal", false).standing, Standing::missed);
  EXPECT_EQ(found(R"({"status": "path"})", "/status", std::string("path")).standing, Standing::proven);
}

TEST(Comparison, SaysWhatIsMissing) {
  EXPECT_EQ(found(R"({"n": 1})", "/m", 1.0).found, "nothing at /m");
  EXPECT_EQ(found("not JSON", "/m", 1.0).found, "no answer, exit status 0");
}

TEST(Comparison, OfAnOpenEntryIsNoFailureAndNoticesThatItIsMet) {
  EXPECT_EQ(found(R"({"n": 1})", "/n", 2.0, 0, true).standing, Standing::open);
  EXPECT_EQ(found("", "/n", 2.0, 0, true).standing, Standing::open);
  EXPECT_EQ(found(R"({"n": 2})", "/n", 2.0, 0, true).standing, Standing::surprise);
}

TEST(Comparison, OfOneOpenNumberIsNoFailureBesideOthersThatAreProven) {
  Expectation known, unknown;
  known.at = "/n", known.value = 2.0;
  unknown.at = "/m", unknown.value = 3.0, unknown.open = "It takes longer.";
  GalleryRun run;
  run.output = R"({"n": 2, "m": {"at_least": 1, "at_most": null}})";
  const auto findings = compare({"solve", {known, unknown}}, run, false);
  EXPECT_EQ(findings.at(0).standing, Standing::proven);
  EXPECT_EQ(findings.at(1).standing, Standing::open);
  run.output = R"({"n": 1, "m": 3})";
  EXPECT_EQ(compare({"solve", {known, unknown}}, run, false).at(0).standing, Standing::missed);
  EXPECT_EQ(compare({"solve", {known, unknown}}, run, false).at(1).standing, Standing::surprise);
}

TEST(Comparison, NamesAContradictionOnlyWhereItIsProven) {
  Expectation e;
  e.contradiction = "The paper counts a point twice.";
  EXPECT_EQ(found(R"({"n": 1})", "/n", 1.0, 0, false, e).standing, Standing::contradiction);
  EXPECT_EQ(found(R"({"n": 2})", "/n", 1.0, 0, false, e).standing, Standing::missed);
  EXPECT_EQ(found(R"({"n": 1, "complete": false})", "/n", 1.0, 0, false, e).standing, Standing::unproven);
}

TEST(Comparison, OfANumberWithoutProofSaysThatItAgrees) {
  Expectation e;
  e.proven = false;
  EXPECT_EQ(found(R"({"n": 1, "complete": false})", "/n", 1.0, 0, false, e).standing, Standing::agrees);
  EXPECT_EQ(found(R"({"n": 1, "complete": true})", "/n", 1.0, 0, false, e).standing, Standing::agrees);
  EXPECT_EQ(found(R"({"n": 2})", "/n", 1.0, 0, false, e).standing, Standing::missed);
}

TEST_F(Entries, StandOnThePageAndInTheTableWithWhatWasFound) {
  GalleryResult result{.entry = read(kEntry), .runs = {}, .findings = {}, .problems = {}, .folder = folder_};
  GalleryRun run;
  run.output = R"({"aspects": 9, "processed": 1234})";
  result.runs = {run};
  result.findings = {compare(result.entry.questions[0], run, false)};
  const std::string page = gallery_page({result}, folder_.parent_path(), "corank gallery");
  for (const char* text : {"A robot", "MISSED", "corank aspects gallery/robot.cuik --json", "A. Author, A paper, 2001",
                           "1\u202f234 boxes", "x = 1/2;"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(gallery_table({result}), HasSubstr("entry  aspects  10         9       MISSED"));
  EXPECT_THAT(gallery_json({result}, true), HasSubstr("\"failures\": 1"));
  EXPECT_EQ(to_words(sums_of({result})), "1 entry with 1 published number: 0 proven, 1 NOT MET");
}

}  // namespace
}  // namespace corank::report
