// The examples of doc/parts.md are read as they stand there.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "corank/kinematics/language/part_file.h"

namespace corank::kinematics {
namespace {

TEST(PartsDocumentation, HasExamplesThatAreRead) {
  std::ifstream doc(CORANK_SOURCE_DIR "/doc/parts.md");
  ASSERT_TRUE(doc);
  const std::string joints = "[JOINTS] revolute turn: base A+(0,0,1) arm A+(0,0,1) revolute: arm H+(0,0,1) hand H+(0,0,1)\n";
  std::string links, block;  // the links from which fragments go on
  bool inside = false, is_text = false;
  int examples = 0;
  for (std::string line; std::getline(doc, line);) {
    if (!line.starts_with("```")) {
      if (inside) block += line + "\n";
      continue;
    }
    inside = !inside;
    if (inside) {
      block.clear();
      is_text = line == "```text";
      continue;
    }
    if (is_text) continue;
    ++examples;
    const bool has_links = block.find("[LINKS]") != std::string::npos;
    const bool is_whole = has_links && block.find("hand : point H (0, 0, 0)") == std::string::npos;
    if (has_links && !is_whole) links = block;
    const std::string holds_the_rest = "\nfix: base arm id fix: base hand id\n";
    std::string text = block;
    if (!is_whole) {
      text = block == links           ? links + joints
             : block.starts_with("[") ? links + joints + block
                                      : links + "[JOINTS]\n" + block + holds_the_rest;
    }
    EXPECT_NO_THROW(parse_parts(text, "doc.cuik")) << block;
  }
  EXPECT_GE(examples, 15);
}

}  // namespace
}  // namespace corank::kinematics
