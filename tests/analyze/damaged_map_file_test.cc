// Files of maps that are damaged at random claim nothing false.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "corank/result/files/hdf5_file.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/tests/analyze/map_files.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

// Changes one thing, whatever it is. What is still confirmed has to be true.
std::string damage(unsigned seed, MapFile& f) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const auto move = [&](Interval& side) {
    const double by = std::array{-1e-1, -1e-3, -1e-9, 1e-9, 1e-3, 1e-1}[below(6)];
    const double a = side.lo() + (below(2) == 0 ? by : 0), b = side.hi() + (below(2) == 0 ? by : 0);
    side = Interval(std::min(a, b), std::max(a, b));
  };
  std::vector<MapCellClaim>& cells = f.claims.cells;
  std::size_t c = below(cells.size());
  while (cells[c].sheets.empty()) c = below(cells.size());
  MapCellClaim& cell = cells[c];
  MapSheet& sheet = cell.sheets[below(cell.sheets.size())];
  const std::size_t variable = below(sheet.box.size());
  switch (below(11)) {
    case 0: ++cell.count; return "count";
    case 1: cell.sheets.pop_back(), --cell.count; return "solution hidden";
    case 2: cell.sheets.push_back(sheet), ++cell.count; return "solution twice";
    case 3: {
      const MapCellClaim& other = cells[below(cells.size())];
      cell.count = other.count;
      cell.sheets = other.sheets;
      return "another cell's sheets";
    }
    case 4: {
      const std::size_t k = below(2), v = sheet.box.size() - 2 + k;
      move(cell.sides[k]);
      for (MapSheet& s : cell.sheets) s.box[v] = s.region[v] = cell.sides[k];
      return "cell moved";
    }
    case 5: {
      const std::size_t k = below(2), v = sheet.box.size() - 2 + k;
      cell.sides[k] = Interval(cell.sides[k].lo() - cell.sides[k].width(), cell.sides[k].hi() + cell.sides[k].width());
      for (MapSheet& s : cell.sheets) s.box[v] = s.region[v] = cell.sides[k];
      const MapCellClaim wide = cell;
      cells = {wide};
      return "cell wider";
    }
    case 6: move(sheet.box[variable]); return "box moved";
    case 7: move(sheet.region[variable]); return "region moved";
    case 8: sheet.region[variable] = Interval(-4, 4); return "region wider";
    case 9: {
      MapSheet& other = cell.sheets[below(cell.sheets.size())];
      std::swap(sheet.region, other.region);
      return "regions swapped";
    }
    default: {
      MapSheet& other = cell.sheets[below(cell.sheets.size())];
      const Box box = sheet.box;
      for (std::size_t j = 0; j < box.size(); ++j) {
        other.region[j] = Interval::hull(other.region[j], sheet.region[j]);
        other.box[j] = Interval::hull(other.box[j], box[j]);
      }
      return "sheets joined";
    }
  }
}

// Some cells of a map, of each number.
MapFile part_of(const MapFile& file, std::size_t most) {
  MapFile part = file;
  std::shuffle(part.claims.cells.begin(), part.claims.cells.end(), std::mt19937(1));
  part.claims.cells.resize(most);
  return part;
}

TEST(MapFile, ThatIsDamagedAtRandomClaimsNothingFalse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  std::map<std::string, int> refused_of, open_of;
  int count = 0, refused = 0, open = 0;
  for (const auto& [good, number] : {std::pair(part_of(cubic(), 20), &roots), {part_of(circles(), 20), &crossings}})
    for (unsigned seed = 0; seed < test::seeds(80); ++seed, ++count) {
      MapFile file = good;
      const std::string kind = damage(seed, file);
      SCOPED_TRACE(kind + ", " + std::to_string(seed));
      const check::MapReport report = result::verify(file);
      refused += !report.verified();
      refused_of[kind] += !report.verified();
      open += report.verified() && !report.complete();
      open_of[kind] += report.verified() && !report.complete();
      for (std::size_t c = 0; c < report.cells.size(); ++c) {
        if (!report.cells[c].at_least) continue;
        const MapCellClaim& cell = file.claims.cells[c];
        for (int k = 0; k < 5; ++k) {
          const int there = number(cell.sides[0].lo() + share(random) * cell.sides[0].width(),
                                   cell.sides[1].lo() + share(random) * cell.sides[1].width());
          EXPECT_LE(cell.count, there);
          if (report.cells[c].complete) {
            EXPECT_EQ(cell.count, there);
          }
        }
      }
    }
  for (const char* kind : {"count", "solution twice", "another cell's sheets", "cell moved", "box moved"})
    EXPECT_GT(refused_of[kind], 0) << kind;
  EXPECT_GT(open_of["solution hidden"], 0);
  std::printf("%d damages: %d refused, %d without completeness, %d true all the same\n", count, refused, open,
              count - refused - open);
}

// The bytes of the file: an error, or claims that are true.
TEST(MapFile, WithDamagedBytesIsRefusedOrTrue) {
  MapFile file = cubic();
  file.claims.cells.resize(12);
  const std::string path = ::testing::TempDir() + "map_file_test_bytes.h5";
  result::write_map(path, file);
  std::ifstream stream(path, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(stream), {}};
  std::mt19937 random(17);
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::string bad = good;
    bad[std::uniform_int_distribution<std::size_t>(0, bad.size() - 1)(random)] ^= static_cast<char>(1 << (trial % 8));
    if (trial % 6 == 0) bad.resize(bad.size() / 60 * static_cast<std::size_t>(trial));
    std::ofstream(path, std::ios::binary) << bad;
    try {
      const MapFile read = result::read_map(path);
      const check::MapReport report = result::verify(read);
      refused += !report.verified();
      if (read.model_text != file.model_text) continue;
      for (std::size_t c = 0; c < report.cells.size(); ++c) {
        const MapCellClaim& cell = read.claims.cells[c];
        if (report.cells[c].complete) {
          EXPECT_EQ(cell.count, roots(cell.sides[0].mid(), cell.sides[1].mid()));
        }
      }
    } catch (const result::ResultFileError&) {
      ++refused;
    } catch (const symbolic::ModelError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace corank::analyze
