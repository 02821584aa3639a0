// A file of aspects and modes: what is written is read and verified; what is changed is found out.
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/claim_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "corank/analyze/aspects/aspects.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using result::PiecesFile;
using ::testing::HasSubstr;

PiecesFile make_pieces_file(symbolic::Mechanism model) {
  const study::Question question{.model = std::move(model)};
  solve::Control control;
  AspectsOptions options;
  options.certificate = true;
  return to_file(question, aspects(question, options, control));
}

PiecesFile make_pieces_file(const std::string& name, const std::vector<result::ConstantOverride>& constants = {}) {
  return make_pieces_file(
      study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik", constants).mechanism);
}

const PiecesFile& slider_pieces() {
  static const PiecesFile file = make_pieces_file("three_slider");
  return file;
}

const PiecesFile& rocker() {
  static const PiecesFile file = make_pieces_file("planar/four_bar_double_rocker");
  return file;
}

TEST(PiecesFile, IsReadAsItWasWritten) {
  const std::string path = ::testing::TempDir() + "pieces_file_test.h5";
  result::write_pieces(path, slider_pieces());
  EXPECT_EQ(result::format_of(path), result::kPiecesKind.format);
  const PiecesFile read = result::read_pieces(path);
  EXPECT_EQ(read.model_text, slider_pieces().model_text);
  EXPECT_EQ(read.space.regions, slider_pieces().space.regions);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read.lists[k].at_least, slider_pieces().lists[k].at_least);
    EXPECT_EQ(read.lists[k].at_most, slider_pieces().lists[k].at_most);
    ASSERT_EQ(read.lists[k].members.size(), slider_pieces().lists[k].members.size());
    EXPECT_EQ(read.lists[k].members.back().box, slider_pieces().lists[k].members.back().box);
    EXPECT_EQ(read.lists[k].members.back().signs, slider_pieces().lists[k].members.back().signs);
    EXPECT_EQ(read.lists[k].members.back().determinant_signs, slider_pieces().lists[k].members.back().determinant_signs);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const PieceProof &now = read.lists[k].proof.value(), &before = slider_pieces().lists[k].proof.value();
    ASSERT_EQ(now.cells.size(), before.cells.size());
    EXPECT_EQ(now.cells.back().sides, before.cells.back().sides);
    EXPECT_EQ(now.cells.back().sheet, before.cells.back().sheet);
    ASSERT_EQ(now.links.size(), before.links.size());
    EXPECT_EQ(now.links.back().point, before.links.back().point);
    EXPECT_EQ(now.links.back().held, before.links.back().held);
    EXPECT_EQ(now.bridges.size(), before.bridges.size());
  }
  EXPECT_TRUE(result::verify(read).complete());
}

void expect_complete(const PiecesFile& file) {
  const check::PiecesReport report = result::verify(file);
  EXPECT_TRUE(report.complete()) << result::to_table(report, file);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(report.lists.at(k).at_least, file.lists[k].at_least);
    EXPECT_EQ(report.lists[k].at_most, file.lists[k].at_most);
  }
}

TEST(PiecesFile, OfKnownAspectsIsVerified) {
  for (const PiecesFile* file : {&slider_pieces(), &rocker()}) {
    EXPECT_EQ(file->lists[0].at_most, 8);
    expect_complete(*file);
    EXPECT_THAT(result::to_table(result::verify(*file), *file), testing::EndsWith("\nverified\n"));
  }
}

// Here 4 assembly modes and 6 working modes have fewer choices of signs: only cells tell them apart.
TEST(PiecesFile, OfAFiveBarWithSlidersIsVerified) {
  const PiecesFile file = make_pieces_file("planar/five_bar_sliders", {{"w", "1/2"}});
  EXPECT_EQ(file.lists[1].at_most, 4);
  EXPECT_EQ(file.lists[2].at_most, 6);
  expect_complete(file);
}

// So have 10 aspects.
TEST(PiecesFile, OfDextarIsVerified) {
  const PiecesFile file = make_pieces_file("dextar");
  EXPECT_EQ(file.lists[0].at_most, 10);
  expect_complete(file);
}

// Loci cross on the border of sheets; a long single-loop's curve; a parallel robot's slice, whose C-space limits end.
TEST(PiecesFile, OfOtherMechanismsIsVerified) {
  expect_complete(make_pieces_file("three_slider", {{"L2", "4/5"}}));
  expect_complete(make_pieces_file("planar/four_bar_crank_rocker"));
  expect_complete(make_pieces_file("planar/3rpr", {{"bx", "3"}, {"lower1", "1/2"}, {"upper1", "1/2"}}));
  if (!test::long_run()) return;
  expect_complete(make_pieces_file("dextar_limits"));
  expect_complete(make_pieces_file("planar/3rpr", {{"lower1", "6/5"}, {"upper1", "6/5"}}));
}

// As in aspects_test.cc: two closed lines v + k w = ±π/2 and two v − m w = ±π/2 on a torus have 4 (k + m) faces;
// sin(n v + a) on a circle has 2n monotone arcs.
TEST(PiecesFile, OfPlantedPiecesConfirmsTheirNumber) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> harmonic(1, 4), shift(2, 9);
  const auto text = [](int c) { return std::to_string(c); };
  std::vector<std::pair<int, int>> lines{{1, 0}, {1, 1}};
  if (test::long_run()) lines.emplace_back(2, 1);
  for (const auto& [k, m] : lines) {
    const PiecesFile file = make_pieces_file(symbolic::parse_model(
        "[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx = sin(v + " + text(k) +
            "*w);\ny = sin(v - " + text(m) + "*w);\n[INPUTS] v, w\n[OUTPUTS] x, y\n",
        "lines.cuik"));
    EXPECT_EQ(file.lists[0].at_most, 4 * (k + m));
    expect_complete(file);
  }
  for (unsigned trial = 0; trial < test::seeds(4); ++trial) {
    const int n = harmonic(random);
    const PiecesFile file = make_pieces_file(
        symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nu : [-2, 2]\n[SYSTEM EQS]\nu = sin(" + text(n) + "*v + 1/" +
                                  text(shift(random)) + ");\n[INPUTS] v\n[OUTPUTS] u\n",
                              "wave.cuik"));
    EXPECT_EQ(file.lists[2].at_most, 2 * n);
    expect_complete(file);
  }
}

// What is verified as before, with upper bounds that are not confirmed.
void expect_open(const PiecesFile& file, const char* words) {
  const check::PiecesReport report = result::verify(file);
  EXPECT_TRUE(report.covered());
  EXPECT_FALSE(report.complete());
  EXPECT_THAT(result::to_table(report, file), HasSubstr("not confirmed: that there are at most as many"));
  EXPECT_THAT(result::to_table(report, file), HasSubstr(words));
}

TEST(PiecesFile, WithoutAProofOfUpperBoundsIsVerifiedButForThose) {
  PiecesFile file = slider_pieces();
  for (PieceClaims& claims : file.lists) claims.proof.reset();
  const std::string path = ::testing::TempDir() + "pieces_file_test_old.h5";
  result::write_pieces(path, file);
  expect_open(result::read_pieces(path), "at most as many aspects as claimed: the file has no proof of it");
}

// Each makes a proof of too few pieces, or one with a gap.
TEST(PiecesFile, WithAGapInItsProofConfirmsNoUpperBound) {
  const auto with = [](const std::function<void(PieceProof&)>& change) {
    PiecesFile file = slider_pieces();
    change(*file.lists[0].proof);
    return file;
  };
  expect_open(with([](PieceProof& p) { p.cells.erase(p.cells.begin() + 3); }), "not shown to cover");
  expect_open(with([](PieceProof& p) { p.cells.clear(); }), "not shown to cover");
  expect_open(with([](PieceProof& p) {
                Interval& side = p.cells[5].sides[0];
                side = Interval(side.lo(), side.mid());
              }),
              "not shown to cover");
  expect_open(with([](PieceProof& p) {
                Interval& side = p.cells[5].sides[0];
                side = Interval(std::nextafter(side.lo(), side.hi()), side.hi());
              }),
              "not shown to cover");
  expect_open(with([](PieceProof& p) {
                Interval& side = p.cells[5].sides[0];
                side = Interval(side.lo() - 1, side.hi());
              }),
              "a cell is not within its sheet");
  expect_open(with([](PieceProof& p) { p.cells[5].sheet = 1'000'000; }), "a cell does not belong to a sheet");
  expect_open(with([](PieceProof& p) { p.cells[5].sheet = -1; }), "a cell does not belong to a sheet");
  expect_open(with([](PieceProof& p) { p.cells[5].sides.clear(); }), "not have one side for each free variable");
  expect_open(with([](PieceProof& p) {
                p.bridges.push_back({slider_pieces().space.boxes[0].free, {}});
              }),
              "sheet of its own");
  expect_open(with([](PieceProof& p) {
                p.bridges.push_back({slider_pieces().space.boxes[0].free, slider_pieces().space.regions[0]});
                for (Interval& side : p.bridges.back().region) side = Interval(side.lo() - 0.5, side.hi() + 0.5);
              }),
              "of its own: a part of it");
  for (std::size_t link = 0; link < slider_pieces().lists[0].proof->links.size(); ++link) {
    const check::PiecesReport report =
        result::verify(with([&](PieceProof& p) { p.links.erase(p.links.begin() + static_cast<std::ptrdiff_t>(link)); }));
    EXPECT_GE(report.lists.at(0).at_most, 8);
    EXPECT_TRUE(report.verified());
  }
  expect_open(with([](PieceProof& p) { p.links.clear(); }), "claimed: 8; confirmed: 8 to ");
}

// A piece fewer, everywhere in the claims: nothing speaks against it but the count of classes.
TEST(PiecesFile, ThatHidesAPieceConfirmsNoUpperBound) {
  for (const PiecesFile* good : {&slider_pieces(), &rocker()})
    for (std::size_t k = 0; k < 3; ++k) {
      PiecesFile file = *good;
      --file.lists[k].at_least;
      --*file.lists[k].at_most;
      file.lists[k].members.pop_back();
      expect_open(file, "to ");
      EXPECT_EQ(result::verify(file).lists[k].at_most, good->lists[k].at_most);
    }
}

struct PiecesChange {
  const char* name;
  std::function<void(PiecesFile&)> apply;
  const char* words;
};

TEST(PiecesFile, ThatSomebodyChangedIsRefused) {
  const std::vector<PiecesChange> changes{
      {"a piece more",
       [](PiecesFile& f) {
         ++f.lists[0].at_least;
         f.lists[0].members.push_back(f.lists[0].members.front());
       },
       "aspects: members 1 and 9 are one configuration: it cannot stand for two pieces"},
      {"a member for another", [](PiecesFile& f) { f.lists[0].members[5] = f.lists[0].members[2]; },
       "members 3 and 6 are one configuration"},
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
      {"a member with nothing held", [](PiecesFile& f) { f.lists[0].members[0].free.clear(); },
       "the number of variables that it holds"},
      {"a box is dropped", [](PiecesFile& f) { f.space.boxes.erase(f.space.boxes.begin() + 1); }, ""},
      {"a set of the outputs' limits", [](PiecesFile& f) { f.space.boxes[0].verdict = Verdict::undecided; },
       "neither regular"}};
  for (const PiecesChange& change : changes) {
    SCOPED_TRACE(change.name);
    PiecesFile file = slider_pieces();
    change.apply(file);
    const check::PiecesReport report = result::verify(file);
    EXPECT_FALSE(report.covered());
    EXPECT_THAT(result::to_table(report, file), HasSubstr(change.words));
  }
}

// Two aspects are in one working mode: both are members, and one piece. Its functions are the first and the last of all.
TEST(PiecesFile, WithMembersOfOnePieceForThoseOfTwoIsRefused) {
  PiecesFile file = slider_pieces();
  PieceClaims& modes = file.lists[2];
  modes.at_least = modes.at_most.emplace(8);
  modes.members = file.lists[0].members;
  for (PieceMember& m : modes.members) m.signs = {m.signs.front(), m.signs.back()};
  const check::PiecesReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.lists.at(2).members, 8U);
  EXPECT_THAT(report.lists[2].failures, testing::ElementsAre(HasSubstr("8 pieces are claimed, 4 shown")));
}

// Two configurations of one piece: the proof that there are no more ends the search for cells that tell them apart.
TEST(PiecesFile, WithASecondMemberOfAPieceIsRefusedOnCoarseCells) {
  PiecesFile file = slider_pieces();
  const std::size_t cells = result::verify(file).lists.at(0).cells;
  PieceClaims& aspects = file.lists[0];
  PieceMember second = aspects.members[0];
  for (Interval& side : second.box) side = Interval(side.lo() - 1e-3, side.hi() + 1e-3);
  for (const int held : second.free) {
    Interval& side = second.box[static_cast<std::size_t>(held)];
    side = Interval(side.lo() + 1e-4, side.hi() + 1e-4);
  }
  aspects.members.push_back(second);
  ++aspects.at_least;
  const check::PiecesReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.lists.at(0).members, 9U);
  EXPECT_THAT(report.lists[0].failures, testing::ElementsAre("at least 9 pieces are claimed, 8 shown"));
  EXPECT_LE(report.lists[0].cells, cells);
}

// The same members of a model with a limit: one of them is beyond it.
TEST(PiecesFile, WithAMemberBeyondALimitIsRefused) {
  PiecesFile file = slider_pieces();
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
  PieceProof& proof = *list.proof;
  PieceCell& cell = proof.cells[below(proof.cells.size())];
  PieceLink& link = proof.links[below(proof.links.size())];
  switch (below(19)) {
    case 12: proof.cells.erase(proof.cells.begin() + (&cell - proof.cells.data())); return "cell dropped";
    case 13: move(cell.sides[below(cell.sides.size())]); return "cell moved";
    case 14: cell.sheet = static_cast<int>(below(f.space.boxes.size())); return "cell's sheet";
    case 15: proof.links.erase(proof.links.begin() + (&link - proof.links.data())); return "link dropped";
    case 16: link.point[below(link.point.size())] += std::array{-1e-1, 1e-6, 0.3}[below(3)]; return "link moved";
    case 17: link.held.front() = static_cast<int>(below(link.point.size())); return "link's held variable";
    case 18:
      --*list.at_most;
      --list.at_least;
      list.members.pop_back();
      return "piece hidden";
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
      auto script = std::make_shared<Proof>(*f.space.proof);
      script->steps[below(script->steps.size())] ^= 1;
      f.space.proof = script;
      return "proof's step";
    }
  }
}

TEST(PiecesFile, ThatIsDamagedAtRandomClaimsNothingFalse) {
  int refused = 0, count = 0, open = 0;
  std::map<std::string, int> refused_of, open_of;
  for (const PiecesFile* good : {&slider_pieces(), &rocker()})
    for (unsigned seed = 0; seed < test::seeds(40); ++seed, ++count) {
      PiecesFile file = *good;
      const std::string kind = damage(seed, file);
      SCOPED_TRACE(kind + ", " + std::to_string(seed));
      const check::PiecesReport report = result::verify(file);
      if (!report.covered()) {
        ++refused;
        ++refused_of[kind];
        continue;
      }
      open += !report.complete();
      open_of[kind] += !report.complete();
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(file.lists[k].at_least, good->lists[k].at_least);
        if (report.lists[k].at_most) {
          EXPECT_GE(*report.lists[k].at_most, *good->lists[k].at_most);
        }
        if (report.complete()) {
          EXPECT_GE(file.lists[k].at_most, good->lists[k].at_most);
        }
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
  for (const char* kind : {"cell dropped", "cell moved", "cell's sheet", "piece hidden"})
    EXPECT_GT(open_of[kind], 0) << kind;
  std::printf("%d damages: %d refused, %d true all the same, %d of these without an upper bound\n", count, refused,
              count - refused, open);
}

}  // namespace
}  // namespace corank::analyze
