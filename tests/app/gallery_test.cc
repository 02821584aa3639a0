// corank gallery: published numbers against what the program finds, its stored runs, and what its exit status says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::HasSubstr;
using testing::Not;

// A robot with two points, and an entry about it.
class GalleryCommands : public testing::Test {
 protected:
  GalleryCommands() {
    std::filesystem::create_directories(folder_.file("entries"));
    write_model("1/4");
    write_entry(2);
  }

  void write_model(const std::string& square) const {
    folder_.write("entries/robot.cuik", "[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx^2 = " + square + ";\n");
  }
  void write_entry(int published, const std::string& more = "") const {
    folder_.write("entries/robot.toml",
                  "title = \"Robot\"\nabout = \"Two points.\"\nmodel = \"robot.cuik\"\n"
                  "source = \"A. Author, A paper\"\ncertainty = \"memory\"\n" +
                      more +
                      "[[question]]\ncommand = \"solve {model} -o points.h5 --json\"\n"
                      "expect = [{claim = \"points\", at = \"/points\", value = " +
                      std::to_string(published) + ", published = \"" + std::to_string(published) + "\"}]\n");
  }
  Outcome gallery(const std::vector<std::string>& more = {}) const {
    return run_corank(with({"gallery", "--entries", folder_.file("entries"), "-o", folder_.file("page")}, more));
  }

  TemporaryFolder folder_;
};

TEST_F(GalleryCommands, MeetAPublishedNumber) {
  const Outcome run = gallery();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("robot  points  2          2       proven"));
  const std::string page = read_text(folder_.file("page/index.html"));
  EXPECT_THAT(page, HasSubstr("A. Author, A paper"));
  EXPECT_THAT(page, HasSubstr("robot/1.json"));
  EXPECT_TRUE(nlohmann::json::accept(read_text(folder_.file("page/robot/1.json"))));
}

TEST_F(GalleryCommands, FailWithTheNumberThatWasFound) {
  write_entry(3);
  const Outcome run = gallery({"--json"});
  EXPECT_EQ(run.status, 1) << run.err;
  const nlohmann::json answer = nlohmann::json::parse(run.out);
  EXPECT_EQ(answer["failures"], 1);
  EXPECT_EQ(answer["entries"][0]["numbers"][0]["found"], "2");
  EXPECT_EQ(answer["entries"][0]["numbers"][0]["standing"], "MISSED");
  EXPECT_THAT(read_text(folder_.file("page/index.html")), HasSubstr("MISSED"));
}

TEST_F(GalleryCommands, ShowAnOpenEntryWithItsReason) {
  write_entry(3, "open = \"it takes longer\"\n");
  const Outcome run = gallery();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("open"));
  EXPECT_THAT(read_text(folder_.file("page/index.html")), HasSubstr("it takes longer"));
  write_entry(2, "open = \"it takes longer\"\n");
  EXPECT_THAT(gallery().out, HasSubstr("proven, though the entry says open"));
}

TEST_F(GalleryCommands, TakeAStoredRunWhileNothingHasChanged) {
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
  EXPECT_THAT(gallery().out, HasSubstr("(stored)"));
  EXPECT_THAT(gallery({"--fresh"}).out, Not(HasSubstr("(stored)")));
  write_entry(3);  // what is expected is compared anew
  const Outcome other = gallery();
  EXPECT_THAT(other.out, HasSubstr("(stored)"));
  EXPECT_EQ(other.status, 1);
  write_entry(2);
  folder_.write("entries/more.cuik", "[SYSTEM EQS]\nx >= -1;\n");
  folder_.write("entries/robot.cuik", "% more.cuik\n[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx^2 = 1/4;\n");
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
  EXPECT_THAT(gallery().out, HasSubstr("(stored)"));
  folder_.write("entries/more.cuik", "[SYSTEM EQS]\nx >= 0;\n");  // a file that the model names
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
  write_model("-1");
  const Outcome changed = gallery();
  EXPECT_THAT(changed.out, Not(HasSubstr("(stored)")));
  EXPECT_EQ(changed.status, 1);
}

TEST_F(GalleryCommands, DoNotTakeAChangedFileForAStoredRun) {
  gallery();
  const std::string answer = folder_.file("page/robot/1.json");
  std::string text = read_text(answer);
  text.replace(text.find("\"isolated\": 2"), 13, "\"isolated\": 3");
  folder_.write("page/robot/1.json", text);
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
  EXPECT_THAT(gallery().out, HasSubstr("(stored)"));
  folder_.write("page/robot/points.h5", "");
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
  EXPECT_GT(std::filesystem::file_size(folder_.file("page/robot/points.h5")), 1000u);
  folder_.write("page/robot/1.run", "nonsense");
  EXPECT_THAT(gallery().out, Not(HasSubstr("(stored)")));
}

TEST_F(GalleryCommands, SayWhatAnEntryLacksWithFileAndLine) {
  folder_.write("entries/robot.toml", "title = \"Robot\"\nabout = \"x\"\nmodel = \"robot.cuik\"\n");
  const Outcome run = gallery();
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("robot.toml"));
  EXPECT_THAT(run.err, HasSubstr("source is missing"));
}

TEST_F(GalleryCommands, SayThatACommandFoundNothing) {
  folder_.write("entries/robot.cuik", "no model");
  const Outcome run = gallery();
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("no answer, exit status 1"));
}

TEST(Gallery, IsFoundBesideTheProgram) {
  const TemporaryFolder folder;
  const Outcome run = run_corank({"gallery", "three_slider", "-o", folder.file("page")});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 entry with 6 published numbers: 6 proven"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("page/three_slider/page/index.html")));
  EXPECT_THAT(read_text(folder.file("page/index.html")), HasSubstr("id=\"robot-three_slider-0\""));
}

// The lines of the first block behind a mark, without their indentation.
std::string block_of(const std::string& document, const std::string& mark) {
  std::istringstream in(read_text(CORANK_SOURCE_DIR "/" + document));
  std::string text;
  bool marked = false, inside = false;
  for (std::string line; std::getline(in, line);) {
    line.erase(0, line.find_first_not_of(' '));
    marked = marked || line.find(mark) != std::string::npos;
    if (inside && line.starts_with("```")) return text;
    if (inside) text += line + "\n";
    inside = inside || (marked && line.starts_with("```"));
  }
  return "no such block";
}

TEST_F(GalleryCommands, RunTheEntryOfTheDocument) {
  folder_.write("entries/robot.toml", block_of("doc/gallery.md", "gallery_entry"));
  std::filesystem::copy_file(model("dextar"), folder_.file("entries/my_robot.cuik"));
  const Outcome run = gallery();
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 entry with 2 published numbers: 2 proven"));
  EXPECT_THAT(read_text(folder_.file("page/index.html")), HasSubstr("As in Figure 2."));
}

// The value of a line `key: value` of CITATION.cff.
std::string cited(const std::string& key) {
  std::ifstream file(CORANK_SOURCE_DIR "/CITATION.cff");
  for (std::string line; std::getline(file, line);) {
    line.erase(0, line.find_first_not_of(" -"));
    if (!line.starts_with(key + ": ")) continue;
    std::string value = line.substr(key.size() + 2);
    std::erase(value, '"');
    return value;
  }
  return "nothing";
}

TEST(Citation, IsPrintedAsBibtexWithWhatTheCitationFileSays) {
  const Outcome run = run_corank({"--cite"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, testing::StartsWith("@software{corank,\n"));
  for (const char* key : {"title", "name", "version", "license"})
    EXPECT_THAT(run.out, HasSubstr("{" + cited(key) + "}")) << key;
}

}  // namespace
}  // namespace corank::app
