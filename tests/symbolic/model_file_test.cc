#include "corank/symbolic/model/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <tao/pegtl/contrib/analyze.hpp>

#include "corank/symbolic/model/model_builder.h"
#include "corank/symbolic/model/model_grammar.h"
#include "corank/tests/cuik/suite_files.h"

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> model_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".cuik") result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

constexpr const char* kEveryConstruct = R"(% a comment
[CONSTANTS]
a := 0.90          // another
b := (16.54^2 - 2.84^2 -
      1)/(-2*a);   /* a third,
                      longer one */
c := sqrt(2)*cos(pi/4)

[INPUTS] phi
[OUTPUTS]
x
[SYSTEM VARS]
x   : [-a, a]
phi ~ [-pi, pi];
[DUMMY VARS]
p:[0,
   1]
[SECONDARY VARS] q : [0, b] r : [0, 1]
[CARTESIAN VARS]
[SYSTEM EQS]
x = a*cos(phi) +
    b*sin(phi);   p*q = 1;
[COORD EQS]
r <= 1e-6;
[DUMMY EQS]
-p^2 >= -c;
[DRAWING]
point P = (x, 0)   % the tip
point O = (0,
           a*cos(phi)); unit mm
  link O /* fixed */ P
slider P along O Q
point Q = (1, 1)
[SYSTEM EQS]
x/2 = r;
)";

TEST(ModelFile, ReadsEveryConstruct) {
  const Mechanism m = parse_model(kEveryConstruct, "dir/every.cuik");
  EXPECT_EQ(m.name(), "every");
  EXPECT_EQ(m.source_text(), kEveryConstruct);
  ASSERT_EQ(m.constants().size(), 3u);
  EXPECT_EQ(m.constants()[0].value.text(), "0.90");
  EXPECT_EQ(m.constants()[1].value.text(), "(16.54^2 - 2.84^2 - 1)/(-2*a)");
  EXPECT_EQ(m.constants()[2].where.text(), "dir/every.cuik:7:1");
  ASSERT_EQ(m.coordinates().size(), 5u);
  EXPECT_EQ(m.coordinates()[0].kind, CoordinateKind::length);
  EXPECT_EQ(m.coordinates()[0].lower.text(), "-a");
  EXPECT_EQ(m.coordinates()[1].name, "phi");
  EXPECT_EQ(m.coordinates()[1].kind, CoordinateKind::angle);
  EXPECT_EQ(m.coordinates()[1].upper.text(), "pi");
  EXPECT_EQ(m.coordinates()[4].name, "r");
  ASSERT_EQ(m.constraints().size(), 5u);
  EXPECT_EQ(m.constraints()[0].relation.text(), "x = a*cos(phi) + b*sin(phi)");
  EXPECT_EQ(m.constraints()[0].where.text(), "dir/every.cuik:21:1");
  EXPECT_EQ(m.constraints()[1].relation.text(), "p*q = 1");
  EXPECT_EQ(m.constraints()[2].relation.text(), "r <= 1e-6");
  EXPECT_EQ(m.constraints()[3].relation.text(), "-p^2 >= -c");
  EXPECT_EQ(m.constraints()[4].where.line, 35);
  EXPECT_THAT(m.inputs(), ElementsAre("phi"));
  EXPECT_THAT(m.outputs(), ElementsAre("x"));
  const Drawing& drawing = m.drawing();
  EXPECT_EQ(drawing.unit, "mm");
  EXPECT_EQ(drawing.dimension(), 2);
  ASSERT_EQ(drawing.points.size(), 3u);
  EXPECT_EQ(drawing.points[1].name, "O");
  EXPECT_EQ(drawing.points[1].coordinates[1].text(), "a*cos(phi)");
  EXPECT_EQ(drawing.points[1].where.text(), "dir/every.cuik:29:7");
  ASSERT_EQ(drawing.parts.size(), 2u);
  EXPECT_EQ(drawing.parts[0].kind, DrawingPart::Kind::link);
  EXPECT_THAT(drawing.parts[0].points, ElementsAre("O", "P"));
  EXPECT_EQ(drawing.parts[0].where.text(), "dir/every.cuik:31:3");
  EXPECT_EQ(drawing.parts[1].kind, DrawingPart::Kind::slider);
  EXPECT_THAT(drawing.parts[1].points, ElementsAre("P", "O", "Q"));
}

TEST(ModelFile, DegreesAreExact) {
  const auto text = [](const char* e) { return parse_expression(e).text(); };
  EXPECT_EQ(text("15deg"), "pi/12");
  EXPECT_EQ(text("180deg"), "pi");
  EXPECT_EQ(text("0.0deg"), "0");
  EXPECT_EQ(text("-22.50deg"), "-pi/8");
  EXPECT_EQ(text("135deg + x"), "3*pi/4 + x");
  EXPECT_EQ(text("x*deg"), "x*(pi/180)");
  EXPECT_EQ(text("1e-3deg"), "1e-3*pi/180");
  EXPECT_EQ(text("33.333333333333deg"), "33.333333333333*pi/180");
  EXPECT_EQ(text("cos(60deg)"), "cos(pi/3)");
  EXPECT_EQ(text("deg_1"), "deg_1");
  EXPECT_THROW(text("15degrees"), ModelError);
  EXPECT_THROW(text("15 deg"), ModelError);
}

TEST(ModelFile, AConstantDegIsWhatDegIsAnyway) {
  const Mechanism m = parse_model(
      "[CONSTANTS]\ndeg := pi/180\na := 30*deg\n[SYSTEM VARS]\nx ~ [-a, 45deg]\n[SYSTEM EQS]\nsin(x) = 0;\n", "m.cuik");
  ASSERT_EQ(m.constants().size(), 1u);
  EXPECT_EQ(m.constants()[0].value.text(), "30*(pi/180)");
  EXPECT_EQ(m.coordinates()[0].upper.text(), "pi/4");
  EXPECT_THROW(parse_model("[CONSTANTS]\ndeg := 3.14/180\n", "m.cuik"), ModelError);
  EXPECT_THROW(parse_model("[SYSTEM VARS]\ndeg ~ [-pi, pi]\n", "m.cuik"), ModelError);
}

TEST(ModelFile, ExpressionsKnowTheirPlaces) {
  const Mechanism m = parse_model(kEveryConstruct, "every.cuik");
  const Expression& product = m.constraints()[0].relation.rhs.operands()[1];
  EXPECT_EQ(product.text(), "b*sin(phi)");
  EXPECT_EQ(product.operands()[1].where().text(), "every.cuik:22:7");
}

TEST(ModelFile, AcceptsWindowsLineEndsAByteOrderMarkAndNoNewlineAtTheEnd) {
  std::string text = kEveryConstruct;
  text.pop_back();
  std::string windows = "\xEF\xBB\xBF";
  for (char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Mechanism expected = parse_model(kEveryConstruct, "m.cuik"), m = parse_model(windows, "m.cuik");
  ASSERT_EQ(m.constraints().size(), expected.constraints().size());
  for (std::size_t i = 0; i < m.constraints().size(); ++i) {
    EXPECT_EQ(m.constraints()[i].relation.text(), expected.constraints()[i].relation.text());
    EXPECT_EQ(m.constraints()[i].where.text(), expected.constraints()[i].where.text());
  }
  EXPECT_EQ(m.drawing().parts[0].points, expected.drawing().parts[0].points);
  EXPECT_EQ(m.drawing().parts[0].where.text(), expected.drawing().parts[0].where.text());
}

TEST(ModelFile, AcceptsNamesSeparatedByCommasBlanksOrLines) {
  const std::string model = "[SYSTEM VARS]\nx:[0,1]\ny:[0,1]\nz:[0,1]\n[SYSTEM EQS]\nx=y;\n[INPUTS]";
  for (const char* names : {" x, y z", " x,y,z;", "\nx\ny\nz\n", " x ,\n y % two\n z"}) {
    EXPECT_THAT(parse_model(model + names, "m.cuik").inputs(), ElementsAre("x", "y", "z")) << names;
  }
  EXPECT_THAT(parse_model(model + " x [OUTPUTS] z [INPUTS] y", "m.cuik").inputs(), ElementsAre("x", "y"));
}

TEST(ModelFile, AMinusThatBeginsALineContinuesAnEquationButNotADefinition) {
  EXPECT_EQ(parse_model("[SYSTEM VARS]\nx:[0,1]\n[SYSTEM EQS]\nx\n- 1 = 0;", "m.cuik").constraints()[0].relation.lhs.text(),
            "x - 1");
  EXPECT_THROW(parse_model("[CONSTANTS]\na := 1\n- 1\n[SYSTEM VARS]\nx:[0,1]\n[SYSTEM EQS]\nx=0;", "m.cuik"), ModelError);
}

TEST(ModelFile, ReadsTheModelsOfTheRepository) {
  const std::filesystem::path models = CORANK_SOURCE_DIR "/models";
  for (const auto& path : model_files_in(models)) EXPECT_NO_THROW(read_model(path)) << path;

  const Mechanism dextar = read_model(models / "dextar.cuik");
  EXPECT_EQ(dextar.name(), "dextar");
  EXPECT_EQ(dextar.coordinates().size(), 6u);
  EXPECT_EQ(dextar.constraints().size(), 4u);
  EXPECT_EQ(dextar.drawing().points.size(), 5u);
  EXPECT_EQ(dextar.drawing().parts.size(), 7u);
  EXPECT_THAT(dextar.inputs(), ElementsAre("theta2", "theta5"));
  EXPECT_THAT(dextar.outputs(), ElementsAre("J3x", "J3y"));
  EXPECT_EQ(dextar.source_text(), read_file(models / "dextar.cuik"));

  const Mechanism slider = read_model(models / "three_slider.cuik");
  EXPECT_EQ(slider.constraints()[0].relation.text(), "y_A^2 + x_C^2 = L1^2");
}

TEST(ModelFile, ReadsSolidsHingesAndColours) {
  const Mechanism m = parse_model(R"([CONSTANTS]
r := 0.1
[SYSTEM VARS]
x : [0, 1]
[SYSTEM EQS]
x = 1;
[DRAWING]
point A = (x, 0, 0)
point B = (x, 0, 1)
hinge A B
ball A B
link A B #0aF9c3
sphere A radius 2*r #102030; cylinder A B radius r /* no colour */
)",
                                  "solids.cuik");
  const std::vector<DrawingPart>& parts = m.drawing().parts;
  ASSERT_EQ(parts.size(), 5u);
  EXPECT_EQ(parts[0].kind, DrawingPart::Kind::hinge);
  EXPECT_THAT(parts[0].points, ElementsAre("A", "B"));
  EXPECT_EQ(parts[1].kind, DrawingPart::Kind::ball);
  EXPECT_EQ(parts[2].colour, "#0aF9c3");
  EXPECT_EQ(parts[3].kind, DrawingPart::Kind::sphere);
  EXPECT_EQ(parts[3].radius.text(), "2*r");
  EXPECT_EQ(parts[3].colour, "#102030");
  EXPECT_EQ(parts[4].kind, DrawingPart::Kind::cylinder);
  EXPECT_THAT(parts[4].points, ElementsAre("A", "B"));
  EXPECT_EQ(parts[4].radius.text(), "r");
  EXPECT_EQ(parts[4].colour, "");
}

TEST(Drawing, RefusesAColourThatIsNone) {
  Mechanism m = parse_model("[SYSTEM VARS] x : [0, 1]\n[SYSTEM EQS] x = 1;\n[DRAWING]\npoint A = (x, 0)\n", "m.cuik");
  Drawing drawing = m.drawing();
  drawing.parts.push_back({DrawingPart::Kind::sphere, {"A"}, {}, "1", "#12\"456"});
  EXPECT_THROW(drawing.validate(), ModelError);
  drawing.parts.back().colour = "#124456";
  EXPECT_NO_THROW(drawing.validate());
  drawing.parts.back().radius = "-1";
  m.drawing(drawing);
  EXPECT_THROW(m.validate(), ModelError);
}

TEST(ModelFile, ReadsTheExampleOfTheDocumentation) {
  const std::string page = read_file(CORANK_SOURCE_DIR "/doc/model_language.md");
  const std::string fence = "```\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const Mechanism m = parse_model(page.substr(begin, page.find(fence, begin) - begin), "crank.cuik");
  EXPECT_EQ(m.coordinates().size(), 3u);
  EXPECT_THAT(m.inputs(), ElementsAre("theta"));
  EXPECT_EQ(m.drawing().points.size(), 4u);
  EXPECT_EQ(m.drawing().parts.size(), 6u);
}

TEST(ModelFile, ReadsEveryFileOfTheCuikSuite) {
  SKIP_WITHOUT_SUITE_FILES();
  int count = 0;
  for (const char* part : {"problems", "solutions"}) {
    for (const auto& path : model_files_in(cuik::suite_folder() / part)) {
      EXPECT_NO_THROW({
        const Mechanism m = read_model(path);
        EXPECT_TRUE(m.is_plain_system()) << path;
      }) << path;
      ++count;
    }
  }
  EXPECT_GT(count, 10);
}

TEST(ModelFile, SaysThatAFileIsMissingOrADirectory) {
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      read_model(path);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message("no/such.cuik"), "no/such.cuik: there is no such file; expected a model file");
  EXPECT_THAT(message(CORANK_SOURCE_DIR "/models"), HasSubstr("models: is a directory; expected a model file"));
  EXPECT_THAT(message("/dev/zero"), HasSubstr("/dev/zero: is not a regular file; expected a model file"));
}

TEST(ModelFile, RefusesTextsLargerThanAnyModel) {
  const std::string text(9 << 20, ' ');
  EXPECT_THROW(parse_model(text, "m.cuik"), ModelError);
}

TEST(ModelFile, SurvivesDeepNestingOfEveryKind) {
  const std::string head = "[SYSTEM VARS]\nx:[0,1]\n[SYSTEM EQS]\n";
  const auto repeated = [](const std::string& part, int n) {
    std::string result;
    for (int i = 0; i < n; ++i) result += part;
    return result;
  };
  const int depth = 100'000;
  for (const std::string& equation :
       {repeated("(", depth), repeated("sin(", depth), repeated("-", depth) + "x = 0;",
        "x" + repeated("^x", depth) + " = 0;", "x" + repeated("/x", depth) + " = 0;", "x" + repeated("^-x", depth) + " = 0;",
        "x" + repeated("*-(x", depth) + " = 0;", "x" + repeated("*x/x", depth) + " = 0;"}) {
    EXPECT_THROW(parse_model(head + equation, "m.cuik"), ModelError) << equation.substr(0, 20);
  }
  EXPECT_NO_THROW(parse_model(head + repeated("(", 200) + "x" + repeated(")", 200) + " = 0;", "m.cuik"));
  EXPECT_NO_THROW(parse_model(head + "x" + repeated(" + x*x", 10'000) + " = x" + repeated("*2", 10'000) + ";", "m.cuik"));
}

TEST(ModelFile, AcceptsTheSearchOrdersThatChangeNoCover) {
  const std::string head = "[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx = 1;\n[SEARCH]\n";
  EXPECT_NO_THROW(parse_model(head + "DEPTH FIRST", "m.cuik"));
  EXPECT_NO_THROW(parse_model(head + "  BREADTH   % a comment\nFIRST\n[SYSTEM EQS]\nx <= 1;", "m.cuik"));
}

TEST(ModelFile, KnowsTheAuxiliaryVariablesByTheirSection) {
  const Mechanism m = parse_model(
      "[SYSTEM VARS]\na : [0, 1]\n[DUMMY VARS]\nb : [0, 1]\n[ SECONDARY VARS ]\nc : [0, 1]\n[CARTESIAN VARS]\nd : [0, 1]\n"
      "[SYSTEM VARS]\ne ~ [-pi, pi]\n[SYSTEM EQS]\na = b;",
      "m.cuik");
  std::string auxiliary;
  for (const Coordinate& c : m.coordinates()) auxiliary += c.auxiliary ? c.name : "";
  EXPECT_EQ(auxiliary, "bd");
}

TEST(ModelFile, HasAGrammarThatAlwaysMovesForward) {
  EXPECT_EQ(tao::pegtl::analyze<grammar::model>(), 0u);
  EXPECT_EQ(tao::pegtl::analyze<grammar::lone_expression>(), 0u);
}

// Each fault file names its own: "% fault: line 4: <part of the message>".
TEST(ModelFile, RefusesEachFaultFileWithTheMessageItAsksFor) {
  const auto files = model_files_in(CORANK_SOURCE_DIR "/tests/data/faults");
  EXPECT_GE(files.size(), 20u);
  for (const auto& path : files) {
    const std::string text = read_file(path);
    const std::string head = "% fault: line ";
    ASSERT_THAT(text, StartsWith(head)) << path;
    const std::size_t colon = text.find(':', head.size());
    const int line = std::stoi(text.substr(head.size(), colon - head.size()));
    const std::string fragment = text.substr(colon + 2, text.find('\n') - colon - 2);
    try {
      read_model(path);
      ADD_FAILURE() << path << " is accepted";
    } catch (const ModelError& error) {
      EXPECT_EQ(error.where().line, line) << error.what();
      EXPECT_GT(error.where().column, 0) << error.what();
      EXPECT_THAT(error.what(), HasSubstr(fragment));
    }
  }
}

}  // namespace
}  // namespace corank::symbolic
