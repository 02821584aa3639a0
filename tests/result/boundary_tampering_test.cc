// A result of parts, the boundary of a workspace, comes back from its file; one that was tampered with is rejected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/result/rejection.h"

namespace corank::result {
namespace {

const Result& arm() {
  static const Result result = [] {
    const symbolic::Mechanism mechanism = symbolic::read_model(CORANK_SOURCE_DIR "/models/planar/arm_3r_limits.cuik");
    Result whole;
    whole.model = mechanism.name();
    whole.model_text = mechanism.source_text();
    whole.set = "boundary";
    const System common = symbolic::configurations(mechanism);
    describe_system(common, whole);
    whole.system_text = symbolic::to_cuik(common);
    for (const symbolic::BoundaryPart& part : symbolic::boundary_parts(mechanism)) {
      const System system = symbolic::SetEquations(mechanism, symbolic::SingularitySet::boundary, part).compiled({});
      Result one;
      one.model = whole.model;
      one.model_text = whole.model_text;
      one.set = whole.set;
      one.part = part.text();
      one.outputs = mechanism.outputs();
      one.options.kernel = "left";
      one.system_text = symbolic::to_cuik(system);
      describe_system(system, one);
      solve::Options options;
      options.sigma = 0.3;
      options.proof = true;
      one.cover = solve::solve(system, options);
      solve::prove_exactly(system, options, one.cover);
      one.options.sigma = one.cover.sigma;
      whole.parts.push_back(std::move(one));
    }
    merge_parts(whole);
    return whole;
  }();
  return result;
}

// With the whole made of the changed parts: all that the list of all boxes can tell is in order.
std::string rejection_of(const std::function<void(Result&)>& change, bool with_proof = true) {
  Result result = arm();
  if (!with_proof)
    for (Result& part : result.parts) part.cover.proof = nullptr;  // to replay it takes most of the time
  change(result);
  merge_parts(result);
  return rejection(result);
}

// What a box claims is checked without the proof that no box is missing.
std::string rejection_of_boxes(const std::function<void(Result&)>& change) { return rejection_of(change, false); }

CoverBox& first(Result& result, Passage passage) {
  for (Result& part : result.parts)
    for (CoverBox& box : part.cover.boxes)
      if (box.passage == passage) return box;
  throw std::runtime_error("no box is " + std::string(to_string(passage)));
}

void expect_it_comes_back_verified() {
  bool complete = false;
  EXPECT_EQ(rejection(arm(), &complete), "");
  EXPECT_TRUE(complete);
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("corank-boundary-file-" + std::to_string(getpid()) + ".h5");
  write_result(path, arm());
  const Result back = read_result(path);
  std::filesystem::remove(path);
  ASSERT_EQ(back.parts.size(), arm().parts.size());
  EXPECT_EQ(back.outputs, (std::vector<std::string>{"x", "y"}));
  for (std::size_t i = 0; i < back.parts.size(); ++i) {
    EXPECT_EQ(back.parts[i].part, arm().parts[i].part);
    EXPECT_EQ(back.parts[i].system_text, arm().parts[i].system_text);
    ASSERT_EQ(back.parts[i].cover.boxes.size(), arm().parts[i].cover.boxes.size());
    for (std::size_t k = 0; k < back.parts[i].cover.boxes.size(); ++k) {
      const CoverBox &a = back.parts[i].cover.boxes[k], &b = arm().parts[i].cover.boxes[k];
      EXPECT_TRUE(a.box == b.box && a.passage == b.passage && a.side == b.side && a.free == b.free);
    }
  }
  EXPECT_GT(back.cover.boxes.size(), 100u);
}

void expect_other_passages_rejected() {
  EXPECT_THAT(rejection_of_boxes([](Result& r) { first(r, Passage::traversable).passage = Passage::barrier; }),
              testing::HasSubstr("it is not shown that the output finds a barrier there, on that side"));
  EXPECT_THAT(rejection_of_boxes([](Result& r) { first(r, Passage::barrier).passage = Passage::traversable; }),
              testing::HasSubstr("it is not shown that the output finds a way through there"));
}

void expect_other_sides_rejected() {
  EXPECT_THAT(rejection_of_boxes([](Result& r) {
                for (double& x : first(r, Passage::barrier).side) x = -x;
              }),
              testing::HasSubstr("it is not shown that the output finds a barrier there, on that side"));
  EXPECT_THAT(rejection_of_boxes([](Result& r) {
                first(r, Passage::barrier).side = {0.6, 0.6};
              }),
              testing::HasSubstr("its side is not a unit vector"));
}

void expect_other_parts_rejected() {
  EXPECT_THAT(rejection_of([](Result& r) { r.parts.pop_back(); }),
              testing::HasSubstr("the parts are not those of the model's set"));
  EXPECT_THAT(rejection_of([](Result& r) { std::swap(r.parts[1].part, r.parts[2].part); }),
              testing::HasSubstr("the parts are not those of the model's set"));
  EXPECT_THAT(rejection_of([](Result& r) { std::swap(r.parts[1].cover, r.parts[2].cover); }), testing::Not(""));
}

void expect_missing_boxes_rejected() {
  EXPECT_THAT(rejection_of([](Result& r) {
                auto& boxes = r.parts[0].cover.boxes;
                boxes.erase(boxes.begin());
              }),
              testing::Not(""));
}

void expect_other_wholes_rejected() {
  for (const std::function<void(Cover&)>& change : std::vector<std::function<void(Cover&)>>{
           [](Cover& c) { c.boxes.pop_back(); }, [](Cover& c) { c.boxes[0].part = 3; },
           [](Cover& c) { c.boxes[0].passage = Passage::unproven; }, [](Cover& c) { c.boxes[0].box[0] = Interval(0, 1); },
           [](Cover& c) { c.boxes[0].verdict = Verdict::undecided; }, [](Cover& c) { c.dimension = 2; }}) {
    Result result = arm();
    change(result.cover);
    EXPECT_THAT(rejection(result), testing::HasSubstr("the whole is not made of its parts"));
  }
}

void expect_other_outputs_rejected() {
  EXPECT_THAT(rejection_of([](Result& r) {
                for (Result& part : r.parts) part.outputs = {"y", "x"};
              }),
              testing::HasSubstr("the outputs are not those of the model"));
}

void expect_other_sets_rejected() {
  EXPECT_THAT(rejection_of([](Result& r) { r.set = "cspace"; }), testing::Not(""));
}

// In one process, since the result is dear to make.
TEST(BoundaryResult, IsVerifiedFromItsFileAndRejectedWhereItWasTamperedWith) {
  expect_it_comes_back_verified();
  expect_other_passages_rejected();
  expect_other_sides_rejected();
  expect_other_parts_rejected();
  expect_missing_boxes_rejected();
  expect_other_wholes_rejected();
  expect_other_outputs_rejected();
  expect_other_sets_rejected();
}

}  // namespace
}  // namespace corank::result
