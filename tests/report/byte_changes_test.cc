// Bytes of result files changed at random: each is refused or read, without a crash or a hang, and what is still verified is
// still true. CORANK_BYTE_CHANGES: how many changes of each file, by default a few.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <random>

#include "corank/report/html/page.h"
#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/summary.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/report/portrait_reader.h"

namespace corank::report {
namespace {

struct Kind {
  std::string model, set, constant;
  double sigma;
  bool proof;
};

result::Result solved(const Kind& kind, double sigma) {
  const symbolic::Mechanism mechanism =
      symbolic::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + kind.model + ".cuik");
  result::Result result;
  result.model = mechanism.name();
  result.model_text = mechanism.source_text();
  result.set = kind.set;
  result.options.kernel = kind.set == "cspace" ? "" : "right";
  if (!kind.constant.empty()) result.options.constants = {{"L2", kind.constant}};
  const System system = result::system_of(result);
  result.system_text = symbolic::to_cuik(system);
  result::describe_system(system, result);
  solve::Options options;
  options.sigma = sigma;
  options.proof = kind.proof;
  result.cover = solve::solve(system, options);
  solve::prove_exactly(system, options, result.cover);
  result.options.sigma = result.cover.sigma;
  return result;
}

bool meet(const Box& a, const Box& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (!a[j].overlaps(b[j])) return false;
  return true;
}

// What is known of the set whatever a file says: small boxes, each of which holds a solution of it.
std::vector<Box> known_solutions(const Kind& kind) {
  std::vector<Box> known;
  for (const CoverBox& b : solved(kind, kind.sigma / 8).cover.boxes)
    if (b.verdict == Verdict::regular || b.verdict == Verdict::isolated || b.verdict == Verdict::exact)
      known.push_back(b.box);
  return known;
}

// Claims of a verified file that cannot be true, since they contradict what is known of the set.
void expect_true(const result::Verification& verification, const result::Result& result, const Kind& kind,
                 const std::vector<Box>& known) {
  EXPECT_EQ(result.set, kind.set);
  for (const CoverBox& b : result.cover.boxes) {
    if (b.verdict != Verdict::isolated && b.verdict != Verdict::exact) continue;
    EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const Box& k) { return meet(k, b.box); }))
        << "a solution too many";
  }
  if (!verification.complete()) return;
  for (const Box& k : known) {
    const auto holds = [&k](const CoverBox& b) { return meet(k, b.box); };
    EXPECT_TRUE(std::any_of(result.cover.boxes.begin(), result.cover.boxes.end(), holds)) << "a solution is missing";
  }
}

// Tables, pictures and pages of whatever could be read. What cannot be shown is refused in words.
void show(const result::Result& result, const result::Verification& verification) {
  result::to_table(verification, result);
  result::to_json(verification);
  result::to_table(result);
  result::to_json(result);
  try {
    make_picture({picture_view(result, "r.h5")}, {{"1", "2"}, ColorScheme::verdict, 0});
  } catch (const std::invalid_argument&) {  // such as no variables
  }
  if (!verification.contradictions.empty()) return;  // corank report refuses it
  symbolic::Mechanism mechanism = symbolic::parse_model(result.model_text, result.model + ".cuik");
  for (const auto& [name, expression] : result.options.constants)
    mechanism.set_constant(name, symbolic::parse_expression(expression, "-D " + name));
  report_page(mechanism, {set_view(mechanism, result)}, {"", {}, {"r.h5"}});
}

int changes() {
  const char* const given = std::getenv("CORANK_BYTE_CHANGES");
  return given ? std::atoi(given) : 40;
}

class ByteChanges : public testing::TestWithParam<Kind> {};

TEST_P(ByteChanges, NeitherCrashNorHangNorPassWithAFalseClaim) {
  const Kind& kind = GetParam();
  const PictureFolder folder;
  const auto path = folder.file("r.h5");
  result::write_result(path, solved(kind, kind.sigma));
  const std::string bytes = bytes_of(path);
  const std::vector<Box> known = known_solutions(kind);
  ASSERT_FALSE(known.empty());
  std::mt19937_64 random(std::hash<std::string>{}(kind.model + kind.set));
  std::array<int, 4> outcomes{};  // refused, no model, not verified, verified
  for (int k = 0; k < changes(); ++k) {
    std::string changed = bytes;
    const int count = 1 << (k % 4);
    for (int c = 0; c < count; ++c) {
      char& byte = changed[random() % changed.size()];
      byte = static_cast<char>(k % 3 == 0 ? byte ^ (1 << random() % 8) : random());
    }
    std::ofstream(path, std::ios::binary).write(changed.data(), static_cast<std::streamsize>(changed.size()));
    try {
      const result::Result result = result::read_result(path);
      const result::Verification verification = result::verify(result);
      ++outcomes[verification.verified() ? 3 : 2];
      if (verification.verified()) expect_true(verification, result, kind, known);
      show(result, verification);
    } catch (const result::ResultFileError& error) {
      ++outcomes[0];
      EXPECT_EQ(std::string(error.what()).find_first_of("\n\x1b"), std::string::npos);
    } catch (const symbolic::ModelError&) {
      ++outcomes[1];
    }
    ASSERT_FALSE(HasFailure()) << "change " << k;
  }
  std::printf("of %d changes %d were refused, %d left no model, %d were not verified, %d changed no claim\n", changes(),
              outcomes[0], outcomes[1], outcomes[2], outcomes[3]);
  EXPECT_GT(outcomes[0], 0);
  EXPECT_GT(outcomes[3], 0) << "most bytes of a file are of no effect";
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ByteChanges,
    testing::Values(Kind{"three_slider", "forward", "1", 1e-6, true}, Kind{"three_slider", "forward", "3/4", 1e-6, false},
                    Kind{"three_slider", "cspace", "", 0.5, true}, Kind{"dextar", "inverse", "", 0.4, false}),
    [](const auto& test) { return test.param.model + "_" + test.param.set + std::to_string(test.index); });

}  // namespace
}  // namespace corank::report
