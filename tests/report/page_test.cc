// A report's page holds what the results hold, and loads nothing.
#include "corank/report/html/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "corank/report/html/page_data.h"
#include "corank/report/pictures/box_payload.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/report/page_text.h"
#include "corank/tests/result/sample_result.h"

namespace corank::report {
namespace {
using nlohmann::json;
using symbolic::Mechanism;
using symbolic::SingularitySet;
using testing::HasSubstr;

// y_A² + x_C² = 1, y_B² + x_C² = 16/25: eight forward singularities (Bohigas2017).
Mechanism slider() { return symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik"); }

result::Result solved(const Mechanism& mechanism, SingularitySet set) {
  const symbolic::KernelSide side = symbolic::KernelSide::right;
  const System system = algebrize(singularity_system(mechanism, set, side));
  result::Result result;
  result.model = mechanism.name();
  result.model_text = mechanism.source_text();
  result.set = to_string(set);
  result.cover = solve::solve(system);
  result::describe_system(system, result);
  result.options.kernel = set == SingularitySet::cspace ? "" : to_string(side);
  return result;
}

json set_of(const Mechanism& mechanism, SingularitySet set) {
  return json::parse(page_model(mechanism, derive(mechanism), {set_view(mechanism, solved(mechanism, set))}))["sets"][0];
}

/// Without printing the page where it does not.
bool holds(const std::string& page, const std::string& text) { return page.find(text) != std::string::npos; }

// A result as `solve --set boundary` makes one, with passages of its own.
TEST(Page, SaysOfEachBoxOfAWorkspaceBoundaryWhetherTheOutputCanPassAndWhereItIsKept) {
  const Mechanism mechanism = slider();
  result::Result result = solved(mechanism, SingularitySet::forward);
  ASSERT_GE(result.cover.boxes.size(), 3u);
  result.outputs = {"x", "y"};
  result.cover.boxes[1].passage = Passage::barrier;
  result.cover.boxes[1].side = {0.6, -0.8};
  result.cover.boxes[2].passage = Passage::traversable;
  const json passage =
      json::parse(page_model(mechanism, derive(mechanism), {set_view(mechanism, result)}))["sets"][0]["passage"];
  EXPECT_EQ(passage["outputs"], json({"x", "y"}));
  const std::vector<std::uint8_t> of = decoded(passage["of"]);
  ASSERT_EQ(of.size(), result.cover.boxes.size());
  EXPECT_EQ(std::vector<int>(of.begin(), of.begin() + 3), (std::vector{0, 1, 2}));
  const std::vector<float> sides = decoded_floats(passage["sides"]);
  ASSERT_EQ(sides.size(), 2 * of.size());
  EXPECT_EQ(std::vector<float>(sides.begin(), sides.begin() + 6), (std::vector<float>{0, 0, 0.6F, -0.8F, 0, 0}));
  EXPECT_TRUE(set_of(mechanism, SingularitySet::forward)["passage"].is_null());
}

TEST(Base64, KnowsTheVectorsOfRfc4648) {
  const auto encoded = [](const std::string& text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xFF\xFE\xFD\x00"), "//79");  // the text ends before the zero
}

TEST(PageBoxes, EncloseTheResultsBoxesWithinOneFloatOnEachSide) {
  const result::Result result = result::sample_result();
  const std::vector<float> numbers = decoded_floats(box_payload(result.cover.boxes));
  ASSERT_EQ(numbers.size(), result.cover.boxes.size() * result.variables.size() * 2);
  std::size_t k = 0;
  for (const CoverBox& b : result.cover.boxes) {
    for (const Interval& side : b.box) {
      const float lower = numbers[k++], upper = numbers[k++];
      EXPECT_LE(static_cast<double>(lower), side.lo());
      EXPECT_GE(static_cast<double>(upper), side.hi());
      EXPECT_GT(static_cast<double>(std::nextafter(lower, INFINITY)), side.lo());
      EXPECT_LT(static_cast<double>(std::nextafter(upper, -INFINITY)), side.hi());
    }
  }
}

TEST(PageBoxes, CarryTheirVerdictsInOrder) {
  const result::Result result = result::sample_result();
  const std::vector<std::uint8_t> bytes = decoded(verdict_payload(result.cover.boxes));
  ASSERT_EQ(bytes.size(), result.cover.boxes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(static_cast<Verdict>(bytes[i]), result.cover.boxes[i].verdict);
}

TEST(PageModel, NamesCoordinatesVariablesAndVelocities) {
  const Mechanism dextar = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  const json model = json::parse(page_model(dextar, derive(dextar), {}));
  EXPECT_EQ(model["coordinates"][0]["role"], "output");
  EXPECT_EQ(model["coordinates"][2]["role"], "input");
  EXPECT_EQ(model["coordinates"][2]["label"], json({"θ", "2"}));
  EXPECT_EQ(model["coordinates"][2]["cosine"], 2);
  EXPECT_EQ(model["coordinates"][2]["sine"], 3);
  EXPECT_EQ(model["constraints"].size(), 8u);  // four loop equations, four circles
  EXPECT_EQ(model["drawing"]["unit"], "dm");
  EXPECT_EQ(model["drawing"]["points"][1]["at"], json({1.18, 0}));
  EXPECT_EQ(model["drawing"]["points"][2]["at"][0], json({"*", 0.9, {"cos", "theta5"}}));
  EXPECT_EQ(model["drawing"]["points"][4]["at"][0], "J3x");

  const json set = set_of(slider(), SingularitySet::forward);
  EXPECT_EQ(set["count"], 8);
  EXPECT_EQ(set["points"].size(), 8u);
  EXPECT_EQ(set["columns"], json({1, 2}));  // L_y has the columns of y_B and x_C
}

// x² + y² = 1 and x = 1 touch at (1, 0), where Φ_q = (2x 2y; 1 0) has the right kernel (0, 1).
TEST(PageModel, TakesAVelocityOfCSpaceForRatesOfAllCoordinates) {
  const Mechanism mechanism = symbolic::parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx = 1;\n[INPUTS] x\n[OUTPUTS] y\n", "m.cuik");
  const json set = set_of(mechanism, SingularitySet::cspace_singular);
  EXPECT_EQ(set["variables"], json({"x", "y", "xi1", "xi2"}));
  EXPECT_EQ(set["columns"], json({0, 1}));
  EXPECT_EQ(set["scales"].size(), 2u);
}

// The three sliders with rates of the rods: a drawing's velocities are expressions in them.
TEST(PageModel, GivesTheModelsOwnRatesAndHowPointsMoveByThem) {
  const std::string rates =
      "[RATES]\nv_A : input\nv_B : output\nw1 ~ passive\nw2 ~ passive\n[VELOCITY EQS]\nv_A + x_C*w1 = 0;\n"
      "y_A*w1 = y_B*w2;\nv_B + x_C*w2 = 0;\n[DRAWING]\npoint P = (x_C, 0)";
  const Mechanism moving = symbolic::parse_model(slider().source_text() + rates + " moves (L1*y_A*w1, 0)", "m.cuik");
  const json page =
      json::parse(page_model(moving, derive(moving), {set_view(moving, solved(moving, SingularitySet::forward))}));
  EXPECT_EQ(page["rates"], json({"v_A", "v_B", "w1", "w2"}));
  EXPECT_EQ(page["sets"][0]["columns"], json({1, 2, 3})) << "v_B, w1 and w2, of the rates";
  EXPECT_EQ(page["drawing"]["points"].back()["moves"], json({{"*", 1.0, "y_A", "w1"}, 0.0}));
  EXPECT_FALSE(page["drawing"]["points"][0].contains("moves"));

  const Mechanism still = symbolic::parse_model(slider().source_text() + rates, "m.cuik");
  const json without =
      json::parse(page_model(still, derive(still), {set_view(still, solved(still, SingularitySet::forward))}));
  EXPECT_EQ(without["sets"][0]["columns"], json::array()) << "rates of coordinates they are not";
  EXPECT_FALSE(json::parse(page_model(slider(), derive(slider()), {})).contains("rates"));
}

TEST(PageModel, HoldsRadiiAndColoursOfParts) {
  const Mechanism mechanism = symbolic::parse_model(
      "[CONSTANTS]\nr := 1/4\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n[INPUTS] x\n"
      "[OUTPUTS] y\n[DRAWING]\npoint A = (x, y, 0)\npoint B = (x, y, 1)\nsphere A radius 2*r #102030\nhinge A B\n",
      "m.cuik");
  const json drawing = json::parse(page_model(mechanism, derive(mechanism), {}))["drawing"];
  EXPECT_EQ(drawing["dimension"], 3);
  EXPECT_EQ(drawing["parts"][0], json({{"kind", "sphere"}, {"points", {0}}, {"radius", 0.5}, {"colour", "#102030"}}));
  EXPECT_EQ(drawing["parts"][1], json({{"kind", "hinge"}, {"points", {0, 1}}}));
}

TEST(PageModel, NamesTheBoxesOfASelfMotion) {
  const Mechanism rhombus = symbolic::read_model(CORANK_SOURCE_DIR "/tests/data/rhombus.cuik");
  const result::Result forward = solved(rhombus, SingularitySet::forward);
  const json set = json::parse(page_model(rhombus, derive(rhombus), {set_view(rhombus, forward)}))["sets"][0];
  ASSERT_EQ(set["motions"].size(), forward.cover.self_motions.size());
  ASSERT_FALSE(set["motions"].empty());
  EXPECT_EQ(set["motions"][0]["dimension"], 1);
  for (const json& box : set["motions"][0]["boxes"]) EXPECT_EQ(forward.cover.boxes[box.get<std::size_t>()].motion, 0);
  EXPECT_GT(set["motions"][0]["boxes"].size(), 10u);
}

TEST(PageModel, RefusesAResultOfAnotherMechanism) {
  EXPECT_THROW(set_view(slider(), result::sample_result()), result::ResultFileError);
  result::Result plain = solved(slider(), SingularitySet::cspace);
  plain.set = "system";
  EXPECT_THROW(set_view(slider(), plain), result::ResultFileError);
}

TEST(Page, HoldsTheResultsAndLoadsNothing) {
  const Mechanism mechanism = slider();
  const std::vector<SetView> views = {set_view(mechanism, solved(mechanism, SingularitySet::cspace)),
                                      set_view(mechanism, solved(mechanism, SingularitySet::forward))};
  const std::string page = report_page(mechanism, views, {"corank report x.cuik", {}, {"cspace.h5", "forward.h5"}});
  for (const SetView& view : views) {
    const std::vector<CoverBox>& boxes = view.result.cover.boxes;
    EXPECT_EQ(script_text(page, "boxes-" + view.result.set), box_payload(boxes));
    EXPECT_EQ(script_text(page, "verdicts-" + view.result.set), verdict_payload(boxes));
  }
  EXPECT_EQ(json::parse(script_text(page, "model")), json::parse(page_model(mechanism, derive(mechanism), views)));
  const std::string before_scripts = page.substr(0, page.find("<script"));
  EXPECT_FALSE(std::regex_search(before_scripts, std::regex("(src|href)=\"(https?:)?//"))) << "the page loads something";
  EXPECT_FALSE(holds(page, "<link rel=\"stylesheet\""));
  EXPECT_FALSE(holds(page, "\nimport "));
  EXPECT_TRUE(holds(page, "corank verify forward.h5"));
  EXPECT_TRUE(holds(page, "8 points"));
  EXPECT_TRUE(holds(page, "<td>[−0.6"));
}

TEST(Page, EscapesWhatAModelMaySay) {
  const std::string text = "% </script><b>&\n" + slider().source_text();
  const Mechanism mechanism = symbolic::parse_model(text, "a<b.cuik");
  const std::string page = report_page(mechanism, {set_view(mechanism, solved(mechanism, SingularitySet::forward))});
  EXPECT_TRUE(holds(page, "% &lt;/script&gt;&lt;b&gt;&amp;"));
  EXPECT_TRUE(holds(page, "<h1>a&lt;b</h1>"));
  EXPECT_FALSE(holds(page, "</script><b>"));
}

TEST(Page, HoldsNoMarkupOfAResultsNames) {
  const Mechanism mechanism = symbolic::parse_model(slider().source_text(), "z<!--<script>.cuik");
  result::Result result = solved(mechanism, SingularitySet::forward);
  result.options.kernel = "right";
  result.version = "<script>alert(1)</script>";
  result.options.constants = {{"<img src=x onerror=alert(2)>", "1"}};
  const std::string page =
      report_page(mechanism, {set_view(mechanism, result)}, {"", {}, {"\"><script>alert(3)</script>.h5"}});
  EXPECT_FALSE(holds(page, "<!--<script"));
  EXPECT_FALSE(holds(page, "<script>alert"));
  EXPECT_FALSE(holds(page, "<img src=x"));
  EXPECT_EQ(json::parse(script_text(page, "model"))["model"], "z<!--<script>");
  EXPECT_EQ(script_text(page, "model").find('<'), std::string::npos);
}

TEST(Page, SaysWhereASearchEndedEarly) {
  const Mechanism mechanism = slider();
  result::Result result = solved(mechanism, SingularitySet::forward);
  EXPECT_FALSE(holds(report_page(mechanism, {set_view(mechanism, result)}), "A search ended early"));
  result.cover.boxes.front().verdict = Verdict::pending;
  const std::string page = report_page(mechanism, {set_view(mechanism, result)});
  EXPECT_TRUE(holds(page, "A search ended early"));
  EXPECT_TRUE(holds(page, "left 1 box unsearched, which may hold solutions"));
}

TEST(Page, SaysOfBoxesThatItWasToShowCutWhetherItDoes) {
  const Mechanism mechanism = slider();
  const SetView view = set_view(mechanism, solved(mechanism, SingularitySet::cspace));
  SetView cut = view, uncut = view;
  EXPECT_TRUE(say_cut(7, cut));
  EXPECT_TRUE(holds(report_page(mechanism, {cut}, {"", {}, {"cspace.h5"}}), "; drawn here: its 7 boxes, cut to σ</p>"));
  EXPECT_TRUE(holds(report_page(mechanism, {cut}, {"", {}, {"cspace.h5"}}), "cspace.h5</a></td><td>7</td>"));
  uncut.result.cover.sigma = {HUGE_VAL, HUGE_VAL};
  EXPECT_FALSE(say_cut(7, uncut));
  EXPECT_TRUE(holds(report_page(mechanism, {uncut}), "; drawn here: its 7 boxes uncut, since cut ones are too many"));
}

TEST(Page, SaysOfRegularBoxesWhatHoldsForAllOfThem) {
  const Mechanism mechanism = slider();
  result::Result result = solved(mechanism, SingularitySet::cspace);
  const std::string of_parts = "or, where the box holds a part of a sheet, at most one</dd>";
  EXPECT_FALSE(holds(report_page(mechanism, {set_view(mechanism, result)}), of_parts));
  CoverBox& box = *std::ranges::find(result.cover.boxes, Verdict::regular, &CoverBox::verdict);
  result.cover.regions[box.region][box.free.front()] = box.box[box.free.front()].mid();
  const std::string page = report_page(mechanism, {set_view(mechanism, result)});
  EXPECT_TRUE(holds(page, of_parts));
  EXPECT_TRUE(holds(page, "is smooth, but may leave the box"));
}

TEST(Page, RefusesAPlainSystem) {
  const Mechanism plain = symbolic::parse_model("[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 2;\n", "plain.cuik");
  EXPECT_THROW(report_page(plain, {}), symbolic::ModelError);
}

TEST(PointsTable, ShowsExactValuesDecimalsAndBoundsAsFarAsTheyAreKnown) {
  result::Result result = result::sample_result();
  result.cover.dimension = 0;
  ExactPoint point;  // t² = 1/2, t > 0: x = 3/5, the angle's cosine and sine t
  point.polynomial = {ExactNumber::rational("-1/2"), 0, 1};
  point.lower = 0;
  point.upper = 1;
  point.coordinates = {{ExactNumber::rational("3/5")}, {0, 1}, {0, 1}, {}};
  point.corank = 2;
  result.cover.exact_points = {point};
  result.cover.decimals = {{"-0.60", "0.71", "0.71", "0.00"}, {}};
  result.cover.points[0].point = 0;
  result.cover.points[1].point = -1;
  const std::string html = points_html({set_view(slider(), result, System())});
  EXPECT_THAT(
      html,
      HasSubstr("<td><math><mfrac><mrow><mn>3</mn></mrow><mrow><mn>5</mn></mrow></mfrac></math> <small>−0.60</small></td>"));
  EXPECT_THAT(html, HasSubstr("<td>[0.333333333, 0.333333334]</td>")) << "the bounds of a point without decimals";
  EXPECT_THAT(html, HasSubstr("<msqrt><mn>2</mn></msqrt>"));
  EXPECT_THAT(html, HasSubstr("<td>2</td></tr>")) << "the dimension of the kernel";
  result.cover.exact_points[0].lower = 3;
  result.cover.exact_points[0].upper = 4;
  EXPECT_THAT(points_html({set_view(slider(), result, System())}), HasSubstr("a number of degree 2"))
      << "what a file says may define none";
}

}  // namespace
}  // namespace corank::report
