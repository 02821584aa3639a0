// Result files: what is written is read back bit for bit; what is no result is refused.
#include "corank/result/files/result_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>

#include "corank/result/files/cover_group.h"
#include "corank/tests/result/sample_result.h"
#include "corank/tests/seeds.h"

namespace corank::result {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ResultFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "corank-report-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path path(const std::string& name = "result.h5") const { return folder_ / name; }

  std::string refusal(const fs::path& file) const {
    try {
      read_result(file);
    } catch (const ResultFileError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

void expect_same_boxes(const std::vector<CoverBox>& a, const std::vector<CoverBox>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].box.size(), b[i].box.size());
    for (std::size_t v = 0; v < a[i].box.size(); ++v) ASSERT_TRUE(same_bits(a[i].box[v], b[i].box[v])) << i << " " << v;
    ASSERT_EQ(a[i].verdict, b[i].verdict);
    ASSERT_EQ(a[i].free, b[i].free);
    ASSERT_EQ(a[i].region, b[i].region);
    ASSERT_EQ(a[i].point, b[i].point);
    ASSERT_EQ(a[i].kernel_at_most, b[i].kernel_at_most);
  }
}

void expect_same_proofs(const Proof* a, const Proof* b) {
  ASSERT_EQ(a == nullptr, b == nullptr);
  if (a == nullptr) return;
  ASSERT_EQ(a->roots.size(), b->roots.size());
  for (std::size_t i = 0; i < a->roots.size(); ++i) {
    ASSERT_EQ(a->roots[i].size(), b->roots[i].size());
    for (std::size_t v = 0; v < a->roots[i].size(); ++v) EXPECT_TRUE(same_bits(a->roots[i][v], b->roots[i][v]));
  }
  EXPECT_EQ(a->combinations, b->combinations);
  EXPECT_EQ(a->steps, b->steps);
  EXPECT_EQ(a->integers, b->integers);
  EXPECT_EQ(a->reals, b->reals);
}

void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.model_text, b.model_text);
  EXPECT_EQ(a.set, b.set);
  EXPECT_EQ(a.stopped, b.stopped);
  EXPECT_EQ(a.system_text, b.system_text);
  EXPECT_EQ(a.options, b.options);
  ASSERT_EQ(a.variables.size(), b.variables.size());
  for (std::size_t i = 0; i < a.variables.size(); ++i) {
    EXPECT_EQ(a.variables[i].name, b.variables[i].name);
    EXPECT_EQ(a.variables[i].kind, b.variables[i].kind);
    EXPECT_TRUE(same_bits(a.variables[i].domain, b.variables[i].domain));
  }
  ASSERT_EQ(a.angles.size(), b.angles.size());
  for (std::size_t i = 0; i < a.angles.size(); ++i) {
    EXPECT_EQ(a.angles[i].name, b.angles[i].name);
    EXPECT_EQ(a.angles[i].cosine, b.angles[i].cosine);
    EXPECT_EQ(a.angles[i].sine, b.angles[i].sine);
    EXPECT_TRUE(same_bits(a.angles[i].range, b.angles[i].range));
  }
  EXPECT_EQ(a.configuration_size, b.configuration_size);
  EXPECT_EQ(a.equations, b.equations);
  EXPECT_EQ(a.inequalities, b.inequalities);
  EXPECT_EQ(a.cover.dimension, b.cover.dimension);
  EXPECT_TRUE(same_bits(a.cover.sigma.length, b.cover.sigma.length));
  EXPECT_TRUE(same_bits(a.cover.sigma.angle, b.cover.sigma.angle));
  EXPECT_EQ(a.cover.wider_than_sigma, b.cover.wider_than_sigma);
  EXPECT_EQ(a.cover.observed_dimension, b.cover.observed_dimension);
  EXPECT_TRUE(same_bits(a.cover.tolerance, b.cover.tolerance));
  expect_same_boxes(a.cover.boxes, b.cover.boxes);
  expect_same_boxes(a.cover.points, b.cover.points);
  ASSERT_EQ(a.cover.regions.size(), b.cover.regions.size());
  for (std::size_t i = 0; i < a.cover.regions.size(); ++i) {
    ASSERT_EQ(a.cover.regions[i].size(), b.cover.regions[i].size());
    for (std::size_t v = 0; v < a.cover.regions[i].size(); ++v)
      EXPECT_TRUE(same_bits(a.cover.regions[i][v], b.cover.regions[i][v]));
  }
  EXPECT_EQ(a.cover.exact_points, b.cover.exact_points);
  EXPECT_EQ(a.cover.reduction, b.cover.reduction);
  expect_same_proofs(a.cover.proof.get(), b.cover.proof.get());
  const Statistics &s = a.cover.statistics, &t = b.cover.statistics;
  EXPECT_EQ(s.processed, t.processed);
  EXPECT_EQ(s.newton_steps, t.newton_steps);
  EXPECT_EQ(s.proofs_tried, t.proofs_tried);
  EXPECT_TRUE(same_bits(s.seconds_total, t.seconds_total));
  EXPECT_TRUE(same_bits(s.seconds_search, t.seconds_search));
  EXPECT_TRUE(same_bits(s.seconds_certify, t.seconds_certify));
}

TEST_F(ResultFile, GivesBackEveryBitOfAResult) {
  write_result(path(), sample_result());
  expect_same(read_result(path()), sample_result());
}

TEST_F(ResultFile, GivesBackMoreBoxesThanAreReadAtOnce) {
  Result result = sample_result();
  const CoverBox last = result.cover.boxes.back();
  for (int i = 0; i < 200'000; ++i) {
    result.cover.boxes.push_back(last);
    for (Interval& side : result.cover.boxes.back().box) side = side + Interval(0, i);
  }
  write_result(path(), result);
  expect_same_boxes(read_result(path()).cover.boxes, result.cover.boxes);
}

TEST_F(ResultFile, GivesBackTheSidesThatAreAskedForAlone) {
  const Result all = sample_result();
  ASSERT_FALSE(all.angles.empty());
  const Angle angle = all.angles.front();
  const std::vector<int> kept{std::min(angle.cosine, angle.sine), std::max(angle.cosine, angle.sine)};
  write_result(path(), all);
  const Result some = read_result(path(), {.free = false, .sides = [&](const Result&) { return kept; }});
  ASSERT_EQ(some.variables.size(), 2u);
  ASSERT_EQ(some.angles.size(), 1u);
  EXPECT_EQ(some.angles[0].name, angle.name);
  EXPECT_EQ(some.variables[static_cast<std::size_t>(some.angles[0].cosine)].name,
            all.variables[static_cast<std::size_t>(angle.cosine)].name);
  ASSERT_EQ(some.cover.boxes.size(), all.cover.boxes.size());
  for (std::size_t i = 0; i < all.cover.boxes.size(); ++i) {
    const CoverBox &a = all.cover.boxes[i], &b = some.cover.boxes[i];
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_TRUE(b.free.empty());
    ASSERT_EQ(b.box.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(same_bits(a.box[static_cast<std::size_t>(kept[k])], b.box[k]));
  }
}

TEST_F(ResultFile, SaysWhatStoppedTheRun) {
  Result result = sample_result();
  result.stopped = "the memory limit, in the stage search";
  write_result(path(), result);
  expect_same(read_result(path()), result);
}

TEST_F(ResultFile, GivesBackAnEmptyResult) {
  Result empty;
  write_result(path(), empty);
  expect_same(read_result(path()), empty);
}

TEST_F(ResultFile, GivesBackAHundredThousandBoxesOfArbitraryBits) {
  Result result = sample_result();
  result.cover.boxes.clear();
  std::mt19937_64 random(11);
  for (int i = 0; i < 100'000; ++i) {
    CoverBox box;
    while (box.box.size() < 4) {
      const double a = std::bit_cast<double>(random()), b = std::bit_cast<double>(random());
      if (!std::isnan(a) && !std::isnan(b)) box.box.push_back(a <= b ? Interval(a, b) : Interval(b, a));
    }
    box.verdict = static_cast<Verdict>(random() % kVerdicts);
    for (int v = 0; v < 4; ++v) {
      if (random() % 2) box.free.push_back(v);
    }
    result.cover.boxes.push_back(std::move(box));
  }
  write_result(path(), result);
  expect_same(read_result(path()), result);
}

TEST_F(ResultFile, KeepsAModelTextLongerThanAnAttributeMayBe) {
  Result result = sample_result();
  while (result.model_text.size() < 200'000) result.model_text += result.model_text;
  write_result(path(), result);
  EXPECT_EQ(read_result(path()).model_text, result.model_text);
}

TEST_F(ResultFile, ReplacesAFileAndLeavesNoOtherBehind) {
  std::ofstream(path()) << "old";
  write_result(path(), sample_result());
  expect_same(read_result(path()), sample_result());
  const auto files = std::distance(fs::directory_iterator(path().parent_path()), fs::directory_iterator());
  EXPECT_EQ(files, 1);
}

TEST_F(ResultFile, IsReadableByTheGroupThatTheUmaskAllows) {
  const mode_t former = umask(022);
  write_result(path(), sample_result());
  umask(former);
  struct stat status;
  ASSERT_EQ(stat(path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST_F(ResultFile, RefusesToWriteWhereNoFolderIs) {
  const fs::path nowhere = path("missing") / "result.h5";
  EXPECT_THROW(check_writable(nowhere), ResultFileError);
  EXPECT_THROW(write_result(nowhere, sample_result()), ResultFileError);
  EXPECT_THROW(write_text(nowhere, "text"), ResultFileError);
  EXPECT_THROW(check_writable(path().parent_path()), ResultFileError) << "a folder is no file";
  EXPECT_NO_THROW(check_writable(path()));
  EXPECT_FALSE(fs::exists(path())) << "asking leaves nothing behind";
}

TEST_F(ResultFile, RefusesAMissingFile) { EXPECT_THAT(refusal(path()), HasSubstr("result.h5: cannot read")); }

TEST_F(ResultFile, RefusesAForeignFile) {
  std::ofstream(path()) << "x = 0;\n";
  EXPECT_THAT(refusal(path()), HasSubstr("cannot read this as an HDF5 file"));
}

TEST_F(ResultFile, RefusesAnHdf5FileThatIsNoResult) {
  Hdf5Writer file(path().string());
  file.texts("/names", {"a", "b"});
  file.close();
  EXPECT_THAT(refusal(path()), HasSubstr("not a corank result"));
}

TEST_F(ResultFile, RefusesAnyOtherFormat) {
  for (const int version : {2, kFormatVersion + 1}) {
    Hdf5Writer file(path().string());
    file.attribute("/", "format", std::string("corank result"));
    file.attribute("/", "format_version", std::int64_t{version});
    file.close();
    EXPECT_THAT(refusal(path()),
                HasSubstr("format version " + std::to_string(version) + "; this corank reads versions 3 to 4"));
  }
}

TEST_F(ResultFile, RefusesAFileCutShortAnywhere) {
  write_result(path(), sample_result());
  std::ostringstream whole;
  whole << std::ifstream(path(), std::ios::binary).rdbuf();
  const std::string bytes = whole.str();
  const std::size_t step = test::long_run() ? 97 : 293;
  for (std::size_t length = 0; length < bytes.size(); length += step) {
    std::ofstream(path("cut.h5"), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(length));
    ASSERT_NE(refusal(path("cut.h5")), "") << "cut to " << length << " of " << bytes.size() << " bytes";
  }
}

// A well-formed HDF5 file of the right format whose content contradicts itself: one item differs from a good empty result.
class InconsistentFile : public ResultFile {
 protected:
  std::string refusal_of(const std::string& changed, const std::function<void(Hdf5Writer&)>& write) {
    Hdf5Writer file(path().string());
    const auto unless_changed = [&](const std::string& name, const auto& write_good) {
      name == changed ? write(file) : write_good();
    };
    file.attribute("/", "format", std::string("corank result"));
    file.attribute("/", "format_version", std::int64_t{kFormatVersion});
    for (const char* name : {"version", "model", "set"}) file.attribute("/", name, std::string("x"));
    for (const char* name : {"complete", "dimension", "configuration_size", "equations", "inequalities"}) {
      unless_changed(name, [&] { file.attribute("/", name, std::int64_t{1}); });
    }
    for (const char* name : {"sigma", "sigma_length", "sigma_angle"}) file.attribute("/", name, 0.1);
    file.attribute("/", "tolerance", 0.0);
    for (const char* name : {"/model/text", "/model/system"}) file.text(name, "x");
    file.texts("/variables/names", {"x"});
    unless_changed("/variables/kinds",
                   [&] { file.enumeration("/variables/kinds", std::vector<std::uint8_t>{0}, {"length"}); });
    file.doubles("/variables/domain", std::vector{0.0, 1.0}, 1, 2);
    file.texts("/angles/names", {"t"});
    unless_changed("/angles/cosine", [&] { file.integers("/angles/cosine", std::vector<std::int64_t>{0}); });
    file.integers("/angles/sine", std::vector<std::int64_t>{0});
    file.doubles("/angles/range", std::vector{0.0, 1.0}, 1, 2);
    for (const char* name : {"names", "expressions"}) file.texts(std::string("/options/constants/") + name, {});
    file.attribute("/options", "kernel", std::string());
    for (const char* name : {"sigma", "sigma_length", "sigma_angle", "tolerance", "time_limit"})
      file.attribute("/options", name, 0.1);
    file.texts("/options/kernel_scales", {});
    for (const char* name : {"threads", "corank", "passive_rates_eliminated"})
      file.attribute("/options", name, std::int64_t{1});
    for (const char* name : {"max_boxes", "max_solutions"}) file.attribute("/options", name, std::uint64_t{0});
    for (const std::string group : {"/boxes", "/points"}) {
      unless_changed(group + "/lower", [&] { file.doubles(group + "/lower", std::vector{0.25}, 1, 1); });
      file.doubles(group + "/upper", std::vector{0.5}, 1, 1);
      unless_changed(group + "/verdict",
                     [&] { file.enumeration(group + "/verdict", std::vector<std::uint8_t>{0}, {"regular"}); });
      file.bytes(group + "/free", 1, 1, [](std::size_t, std::span<std::uint8_t>) {});
      file.enumeration(group + "/reason", std::vector<std::uint8_t>{0}, {"none"});
    }
    file.group("/statistics");
    for (const char* name : {"processed", "newton_steps", "proofs_tried"})
      file.attribute("/statistics", name, std::uint64_t{1});
    for (const char* name : {"seconds_total", "seconds_search", "seconds_certify"}) file.attribute("/statistics", name, 0.1);
    for (int v = 0; v < kVerdicts; ++v) {
      const std::string verdict = to_string(static_cast<Verdict>(v));
      unless_changed(verdict, [&] { file.attribute("/boxes", verdict, std::uint64_t{v == kept_}); });
    }
    file.attribute("/boxes", "wider_than_sigma", std::uint64_t{1});
    write_certificates(file, certificates_, 1);
    file.close();
    return refusal(path());
  }

  // One box and one point, without a region.
  static Cover certificates() {
    Cover cover;
    cover.boxes.resize(1);
    cover.points.resize(1);
    return cover;
  }

  Cover certificates_ = certificates();
  int kept_ = static_cast<int>(Verdict::regular);  // the verdict of the box
};

TEST_F(InconsistentFile, IsRefusedForACountThatIsNotThatOfTheBoxes) {
  EXPECT_THAT(refusal_of("undecided", [](Hdf5Writer& f) { f.attribute("/boxes", "undecided", std::uint64_t{1}); }),
              HasSubstr("undecided of /boxes contradicts the boxes"));
}

TEST_F(InconsistentFile, IsRefusedForIndicesOutOfRange) {
  const auto refused = [&](const std::function<void(Cover&)>& change) {
    certificates_ = certificates();
    change(certificates_);
    return refusal_of("nothing", [](Hdf5Writer&) {});
  };
  EXPECT_THAT(refused([](Cover& c) { c.boxes[0].region = 0; }), HasSubstr("out of range"));
  EXPECT_THAT(refused([](Cover& c) { c.points[0].point = -2; }), HasSubstr("out of range"));
  EXPECT_THAT(refused([](Cover& c) { c.boxes.clear(); }), HasSubstr("another length"));
  EXPECT_THAT(refused([](Cover& c) { c.reduction = {Elimination{1, 0}}; }), HasSubstr("names no variable"));
  EXPECT_THAT(refused([](Cover& c) { c.regions = {{{1.0, 0.0}}}; }), HasSubstr("empty interval"));
}

TEST_F(InconsistentFile, IsFineWithNothingChanged) {
  EXPECT_EQ(refusal_of("nothing", [](Hdf5Writer&) {}), "");
}

TEST_F(InconsistentFile, IsRefusedForBoxesOfAnotherShape) {
  EXPECT_THAT(refusal_of("/boxes/lower",
                         [](Hdf5Writer& f) {
                           f.doubles("/boxes/lower", std::vector{0.1, 0.2}, 1, 2);
                         }),
              HasSubstr("/boxes/lower has another shape"));
}

TEST_F(InconsistentFile, IsRefusedForEmptyIntervalsAndNotANumber) {
  for (const double lower : {0.75, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(refusal_of("/points/lower", [=](Hdf5Writer& f) { f.doubles("/points/lower", std::vector{lower}, 1, 1); }),
                HasSubstr("/points holds an empty interval"));
  }
}

TEST_F(InconsistentFile, IsRefusedForAWordThatIsNoVerdict) {
  const auto write = [](Hdf5Writer& f) { f.enumeration("/boxes/verdict", std::vector<std::uint8_t>{0}, {"certain"}); };
  EXPECT_THAT(refusal_of("/boxes/verdict", write), HasSubstr("unknown word certain"));
}

TEST_F(InconsistentFile, IsRefusedForAnAngleOfNoVariable) {
  const auto write = [](Hdf5Writer& f) { f.integers("/angles/cosine", std::vector<std::int64_t>{1}); };
  EXPECT_THAT(refusal_of("/angles/cosine", write), HasSubstr("name no variable"));
}

TEST_F(InconsistentFile, IsRefusedWhereItDeniesThatItIsComplete) {
  const auto write = [](Hdf5Writer& f) { f.attribute("/", "complete", std::int64_t{0}); };
  EXPECT_THAT(refusal_of("complete", write), HasSubstr("complete contradicts the boxes"));
}

TEST_F(InconsistentFile, ReadsVerdictsByTheirWordsNotTheirNumbers) {
  const auto write = [](Hdf5Writer& f) {
    f.enumeration("/boxes/verdict", std::vector<std::uint8_t>{1}, {"undecided", "isolated"});
  };
  kept_ = static_cast<int>(Verdict::isolated);
  EXPECT_EQ(refusal_of("/boxes/verdict", write), "");
  EXPECT_EQ(read_result(path()).cover.boxes.at(0).verdict, Verdict::isolated);
}

}  // namespace
}  // namespace corank::result
