#include "corank/result/piece_proof_group.h"

#include "corank/core/check.h"

namespace corank::result {
namespace {

// Lists of lists of one length each, end to end.
template <class T>
class Rows {
 public:
  explicit Rows(std::size_t columns) : columns_(columns) {}

  void add(const auto& row) {
    CORANK_CHECK(row.size() == columns_);
    data.insert(data.end(), row.begin(), row.end());
  }
  std::size_t size() const { return columns_ == 0 ? 0 : data.size() / columns_; }
  bool is_whole() const { return size() * columns_ == data.size(); }
  auto row(std::size_t k) const { return std::vector(at(k), at(k + 1)); }

  std::vector<T> data;

 private:
  auto at(std::size_t k) const { return data.begin() + static_cast<std::ptrdiff_t>(k * columns_); }

  std::size_t columns_;
};

struct Boxes {
  explicit Boxes(std::size_t columns) : lower(columns), upper(columns) {}

  void add(const std::vector<Interval>& box) {
    std::vector<double> from, to;
    for (const Interval& side : box) {
      from.push_back(side.lo());
      to.push_back(side.hi());
    }
    lower.add(from);
    upper.add(to);
  }

  Rows<double> lower, upper;
};

struct Groups {
  Groups(std::size_t n, std::size_t dimension)
      : bridges_free(dimension), held(dimension), bridges(n), cells(dimension), points(n) {}

  Rows<std::int32_t> bridges_free, held;
  std::vector<std::int32_t> sheets;
  Boxes bridges, cells;
  Rows<double> points;
};

// The same names for writing and reading.
void for_each_array(auto& groups, const auto& visit) {
  visit("/bridges_free", groups.bridges_free.data);
  visit("/bridges_lower", groups.bridges.lower.data);
  visit("/bridges_upper", groups.bridges.upper.data);
  visit("/cells_sheet", groups.sheets);
  visit("/cells_lower", groups.cells.lower.data);
  visit("/cells_upper", groups.cells.upper.data);
  visit("/links_held", groups.held.data);
  visit("/links_point", groups.points.data);
}

}  // namespace

void write_piece_proof(Hdf5Writer& file, const std::string& group, const PieceProof& proof, std::size_t n,
                       std::size_t dimension) {
  Groups groups(n, dimension);
  for (const SheetBridge& bridge : proof.bridges) {
    groups.bridges_free.add(bridge.free);
    groups.bridges.add(bridge.region);
  }
  for (const PieceCell& cell : proof.cells) {
    groups.sheets.push_back(cell.sheet);
    groups.cells.add(cell.sides);
  }
  for (const PieceLink& link : proof.links) {
    groups.held.add(link.held);
    groups.points.add(link.point);
  }
  file.enter(group);
  for_each_array(groups, [&](const char* name, const auto& data) { file.packed(name, data); });
  file.enter("");
}

PieceProof read_piece_proof(Hdf5Reader& file, const std::string& group, std::size_t n, std::size_t dimension) {
  Groups groups(n, dimension);
  file.enter(group);
  for_each_array(groups, [&](const char* name, auto& data) { file.read(name, data); });
  file.enter("");
  const auto refuse = [&](const char* what) { throw ResultFileError(file.path() + ": " + group + ": " + what); };
  const std::size_t bridges = groups.bridges_free.size(), cells = groups.sheets.size(), links = groups.held.size();
  const auto fits = [&](const auto& rows, std::size_t count) { return rows.is_whole() && rows.size() == count; };
  if (dimension == 0 || !fits(groups.bridges_free, bridges) || !fits(groups.bridges.lower, bridges) ||
      !fits(groups.bridges.upper, bridges) || !fits(groups.cells.lower, cells) || !fits(groups.cells.upper, cells) ||
      !fits(groups.held, links) || !fits(groups.points, links))
    refuse("its arrays differ in length");
  const auto box = [&](const Boxes& boxes, std::size_t k) {
    const std::vector<double> from = boxes.lower.row(k), to = boxes.upper.row(k);
    std::vector<Interval> result;
    for (std::size_t j = 0; j < from.size(); ++j) {
      if (!(from[j] <= to[j])) refuse("a box has a side that is not an interval");
      result.emplace_back(from[j], to[j]);
    }
    return result;
  };
  const auto variables = [&](const Rows<std::int32_t>& rows, std::size_t k) {
    const std::vector<std::int32_t> list = rows.row(k);
    for (const std::int32_t j : list)
      if (j < 0 || static_cast<std::size_t>(j) >= n) refuse("a variable does not exist");
    return std::vector<int>(list.begin(), list.end());
  };
  PieceProof proof;
  for (std::size_t k = 0; k < bridges; ++k)
    proof.bridges.push_back({variables(groups.bridges_free, k), box(groups.bridges, k)});
  for (std::size_t k = 0; k < cells; ++k) proof.cells.push_back({groups.sheets[k], box(groups.cells, k)});
  for (std::size_t k = 0; k < links; ++k) proof.links.push_back({groups.points.row(k), variables(groups.held, k)});
  return proof;
}

}  // namespace corank::result
