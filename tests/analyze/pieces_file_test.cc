// A file of aspects and modes: what is written is read and verified, but for upper bounds; what is changed is found out.
#include "corank/result/pieces_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "corank/analyze/aspects.h"
#include "corank/study/model.h"

namespace corank::analyze {
namespace {

using result::PiecesFile;
using ::testing::HasSubstr;

PiecesFile make_file(const std::string& name) {
  const study::Question question{
      .model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism};
  solve::Control control;
  AspectsOptions options;
  options.certificate = true;
  return to_file(question, aspects(question, options, control));
}

const PiecesFile& slider() {
  static const PiecesFile file = make_file("three_slider");
  return file;
}

const PiecesFile& rocker() {
  static const PiecesFile file = make_file("planar/four_bar_double_rocker");
  return file;
}

TEST(PiecesFile, IsReadAsItWasWritten) {
  const std::string path = ::testing::TempDir() + "pieces_file_test.h5";
  result::write_pieces(path, slider());
  EXPECT_TRUE(result::is_pieces_file(path));
  const PiecesFile read = result::read_pieces(path);
  EXPECT_EQ(read.model_text, slider().model_text);
  EXPECT_EQ(read.space.regions, slider().space.regions);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read.lists[k].at_least, slider().lists[k].at_least);
    EXPECT_EQ(read.lists[k].at_most, slider().lists[k].at_most);
    ASSERT_EQ(read.lists[k].members.size(), slider().lists[k].members.size());
    EXPECT_EQ(read.lists[k].members.back().box, slider().lists[k].members.back().box);
    EXPECT_EQ(read.lists[k].members.back().signs, slider().lists[k].members.back().signs);
    EXPECT_EQ(read.lists[k].members.back().determinant_signs, slider().lists[k].members.back().determinant_signs);
  }
  EXPECT_TRUE(result::verify(read).covered());
}

TEST(PiecesFile, OfKnownAspectsIsVerifiedButForUpperBounds) {
  for (const PiecesFile* file : {&slider(), &rocker()}) {
    const check::PiecesReport report = result::verify(*file);
    EXPECT_TRUE(report.covered()) << result::to_table(report, *file);
    EXPECT_EQ(report.lists.at(0).at_least, 8);
    EXPECT_THAT(result::to_table(report, *file), HasSubstr("not checked: that there are no more pieces"));
  }
}

// Here 10 aspects have fewer choices of signs: only cells tell them apart.
TEST(PiecesFile, OfDextarIsVerified) {
  const PiecesFile file = make_file("dextar");
  const check::PiecesReport report = result::verify(file);
  EXPECT_TRUE(report.covered()) << result::to_table(report, file);
  EXPECT_EQ(report.lists.at(0).at_least, 10);
}

struct Change {
  const char* name;
  std::function<void(PiecesFile&)> apply;
  const char* words;
};

TEST(PiecesFile, ThatSomebodyChangedIsRefused) {
  const std::vector<Change> changes{
      {"a piece more",
       [](PiecesFile& f) {
         ++f.lists[0].at_least;
         f.lists[0].members.push_back(f.lists[0].members.front());
       },
       "9 pieces are claimed, 8 shown"},
      {"a piece without a member", [](PiecesFile& f) { ++f.lists[1].at_least; }, "not one member of each piece"},
      {"a piece too few at most", [](PiecesFile& f) { f.lists[2].at_most = 1; }, "there are more"},
      {"a factor's sign", [](PiecesFile& f) { f.lists[0].members[2].signs[0] *= -1; }, "the sign of function 1"},
      {"a sign that is none", [](PiecesFile& f) { f.lists[0].members[2].signs[0] = 0; }, "the sign of function 1"},
      {"a sign too few", [](PiecesFile& f) { f.lists[1].members[0].signs.pop_back(); }, "one sign for each function"},
      {"another factor", [](PiecesFile& f) { f.lists[1].factors[0] = "x_C + 1"; }, "not the factors"},
      {"a factor too few",
       [](PiecesFile& f) {
         f.lists[2].factors.pop_back();
         for (PieceMember& m : f.lists[2].members) m.signs.pop_back();
       },
       "not the factors"},
      {"a determinant's sign", [](PiecesFile& f) { f.lists[0].members[1].determinant_signs[1] *= -1; }, "a determinant"},
      {"a member beside the set",
       [](PiecesFile& f) {
         for (Interval& side : f.lists[0].members[0].box) side = Interval(side.lo() + 0.01, side.hi() + 0.01);
       },
       "not shown to lie in its box"},
      {"a member with nothing held", [](PiecesFile& f) { f.lists[0].members[0].free.clear(); }, "holds not as many"},
      {"a box is dropped", [](PiecesFile& f) { f.space.boxes.erase(f.space.boxes.begin() + 1); }, ""},
      {"a set of the outputs' limits", [](PiecesFile& f) { f.space.boxes[0].verdict = Verdict::undecided; },
       "neither regular"}};
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    PiecesFile file = slider();
    change.apply(file);
    const check::PiecesReport report = result::verify(file);
    EXPECT_FALSE(report.covered());
    EXPECT_THAT(result::to_table(report, file), HasSubstr(change.words));
  }
}

// Two aspects are in one working mode: both are members, and one piece. Its functions are the first and the last of all.
TEST(PiecesFile, WithMembersOfOnePieceForThoseOfTwoIsRefused) {
  PiecesFile file = slider();
  PieceClaims& modes = file.lists[2];
  modes.at_least = modes.at_most.emplace(8);
  modes.members = file.lists[0].members;
  for (PieceMember& m : modes.members) m.signs = {m.signs.front(), m.signs.back()};
  const check::PiecesReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.lists.at(2).members, 8U);
  EXPECT_THAT(report.lists[2].failures, testing::ElementsAre(HasSubstr("8 pieces are claimed, 4 shown")));
}

// The same members of a model with a limit: one of them is beyond it.
TEST(PiecesFile, WithAMemberBeyondALimitIsRefused) {
  PiecesFile file = slider();
  const std::string from = "x_C : [-L1, L1]", to = "x_C : [0, L1]";
  ASSERT_NE(file.model_text.find(from), std::string::npos);
  file.model_text.replace(file.model_text.find(from), from.size(), to);
  const check::PiecesReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
}

// Changes one thing, whatever it is. What is still confirmed has to be true.
std::string damage(unsigned seed, PiecesFile& f) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const auto move = [&](Interval& side) {
    const double by = std::array{-1e-1, -1e-3, -1e-9, 1e-9, 1e-3, 1e-1}[below(6)];
    const double a = side.lo() + (below(2) == 0 ? by : 0), b = side.hi() + (below(2) == 0 ? by : 0);
    side = Interval(std::min(a, b), std::max(a, b));
  };
  PieceClaims& list = f.lists[below(3)];
  PieceMember& member = list.members[below(list.members.size())];
  CoverBox& box = f.space.boxes[below(f.space.boxes.size())];
  switch (below(12)) {
    case 0: list.at_least += 1; return "at_least";
    case 1: *list.at_most -= 1; return "at_most";
    case 2: member.signs[below(member.signs.size())] *= -1; return "sign";
    case 3: f.lists[0].members[below(8)].determinant_signs[below(2)] *= -1; return "determinant's sign";
    case 4: move(member.box[below(member.box.size())]); return "member moved";
    case 5: member = list.members[below(list.members.size())]; return "member twice";
    case 6:
      list.members.push_back(member);
      ++list.at_least;
      return "member added";
    case 7: member.free.front() = static_cast<int>(below(member.box.size())); return "member's held variable";
    case 8: f.space.boxes.erase(f.space.boxes.begin() + (&box - f.space.boxes.data())); return "box dropped";
    case 9: move(box.box[below(box.box.size())]); return "box moved";
    case 10: move(f.space.regions[below(f.space.regions.size())][below(box.box.size())]); return "region moved";
    default: {
      auto proof = std::make_shared<Proof>(*f.space.proof);
      proof->steps[below(proof->steps.size())] ^= 1;
      f.space.proof = proof;
      return "proof's step";
    }
  }
}

TEST(PiecesFile, ThatIsDamagedAtRandomClaimsNothingFalse) {
  int refused = 0, count = 0;
  std::map<std::string, int> refused_of;
  for (const PiecesFile* good : {&slider(), &rocker()})
    for (unsigned seed = 0; seed < 150; ++seed, ++count) {
      PiecesFile file = *good;
      const std::string kind = damage(seed, file);
      SCOPED_TRACE(kind + ", " + std::to_string(seed));
      const check::PiecesReport report = result::verify(file);
      if (!report.covered()) {
        ++refused;
        ++refused_of[kind];
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(file.lists[k].at_least, good->lists[k].at_least);
        for (std::size_t i = 0; i < file.lists[k].members.size(); ++i) {
          const PieceMember &now = file.lists[k].members[i], &before = good->lists[k].members[i];
          EXPECT_EQ(now.signs, before.signs);
          EXPECT_EQ(now.determinant_signs, before.determinant_signs);
        }
      }
    }
  EXPECT_GT(refused, count / 3);
  for (const char* kind : {"at_least", "sign", "determinant's sign", "member twice", "member added", "box dropped"})
    EXPECT_GT(refused_of[kind], 0) << kind;
  std::printf("%d damages: %d refused, %d true all the same, but for upper bounds\n", count, refused, count - refused);
}

}  // namespace
}  // namespace corank::analyze
