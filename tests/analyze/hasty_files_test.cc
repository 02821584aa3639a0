// Certificates that are written in haste, after a limit or an interrupt: compressed as far as there is time, and the same.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/topology/topology.h"
#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"
#include "corank/tests/analyze/map_files.h"

namespace corank::analyze {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Haste from the first question on leaves nothing compressed, from a later one on a part. Either way the file is read as the
// one that was written calmly: written again, both are the same bytes.
template <class File>
void expect_the_same_in_haste(const std::string& name, const File& file,
                              void (*write)(const std::filesystem::path&, const File&, const Ended&),
                              File (*read)(const std::filesystem::path&)) {
  SCOPED_TRACE(name);
  const std::string calm = ::testing::TempDir() + "calm_" + name + ".h5",
                    hasty = ::testing::TempDir() + "hasty_" + name + ".h5",
                    again = ::testing::TempDir() + "again_" + name + ".h5";
  int questions = 0;
  write(calm, file, [&] { return ++questions < 0; });
  ASSERT_GT(questions, 1) << "it never asks whether there is haste";
  std::uintmax_t plain = 0;
  bool in_part = false;
  for (int from = 1; from <= questions; ++from) {
    int asked = 0;
    write(hasty, file, [&] { return ++asked >= from; });
    EXPECT_EQ(asked, questions);
    const std::uintmax_t size = std::filesystem::file_size(hasty);
    if (from == 1) plain = size;
    in_part = in_part || (size > std::filesystem::file_size(calm) && size < plain);
    if (from != 1 && from != questions / 2 && from != questions) continue;
    const File back = read(hasty);
    EXPECT_TRUE(result::verify(back, check::Options{}).complete());
    write(again, back, {});
    EXPECT_TRUE(bytes_of(again) == bytes_of(calm)) << from;
  }
  EXPECT_TRUE(in_part);
}

study::Question slider_in_haste() {
  return {.model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/three_slider.cuik").mechanism};
}

TEST(HastyFiles, HoldShapesAsCalmOnesDo) {
  solve::Control control;
  TopologyOptions options;
  options.certificate = true;
  const study::Question question = slider_in_haste();
  expect_the_same_in_haste("shape", to_file(question, topology(question, options, control)), &result::write_shape,
                           &result::read_shape);
}

TEST(HastyFiles, HoldAspectsAsCalmOnesDo) {
  solve::Control control;
  AspectsOptions options;
  options.certificate = true;
  const study::Question question = slider_in_haste();
  expect_the_same_in_haste("aspects", to_file(question, aspects(question, options, control)), &result::write_pieces,
                           &result::read_pieces);
}

TEST(HastyFiles, HoldMapsAsCalmOnesDo) { expect_the_same_in_haste("map", circles(), &result::write_map, &result::read_map); }

}  // namespace
}  // namespace corank::analyze
