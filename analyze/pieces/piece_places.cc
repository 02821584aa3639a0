#include <algorithm>
#include <map>

#include "corank/analyze/pieces/pieces.h"
#include "corank/core/box_tree.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

class Places {
 public:
  Places(SignCells& cells, const Pieces& pieces)
      : cells_(cells), parts_(cells.cells().size()), tree_(box_tree(cells.cells(), &SignCell::sides)) {
    for (const Pieces::CellPart& part : pieces.parts) parts_[part.cell].emplace(part.signs, part.piece);
  }

  int of(const Box& box) {
    near_.clear();
    tree_.for_each_overlapping(box, 0.0, [&](std::size_t c) { near_.push_back(c); });
    const std::optional<int> only = only_piece();
    return only ? *only : in_the_middle(box);
  }

 private:
  // Of all parts of the cells nearby; −1: they have none. Nothing: there are several.
  std::optional<int> only_piece() const {
    int only = -1;
    for (const std::size_t c : near_)
      for (const auto& [signs, piece] : parts_[c]) {
        if (only >= 0 && only != piece) return {};
        only = piece;
      }
    return only;
  }

  bool is_over_middle(std::size_t c, const Box& box) const {
    const SignCell& cell = cells_.cells()[c];
    return std::ranges::all_of(cell.free, [&](int j) { return cell.sides[j].contains(box[j].mid()); });
  }

  // Of the solutions over the middle's free values the one that is nearest to it.
  int in_the_middle(const Box& box) {
    std::erase_if(near_, [&](std::size_t c) { return !is_over_middle(c, box); });
    if (const auto only = only_piece()) return *only;
    int best = -1;
    double least = 0;
    for (const std::size_t c : near_) {
      const Box solution = cells_.solution_over_middle(cells_.cells()[c], box);
      const auto part = parts_[c].find(cells_.signs(solution));
      if (part == parts_[c].end()) continue;
      double far = 0;
      for (std::size_t j = 0; j < box.size(); ++j) far = std::max(far, std::fabs(solution[j].mid() - box[j].mid()));
      if (best >= 0 && far >= least) continue;
      best = part->second;
      least = far;
    }
    return best;
  }

  SignCells& cells_;
  std::vector<std::map<std::vector<int>, int>> parts_;  // of each cell, by the signs
  BoxTree tree_;
  std::vector<std::size_t> near_;
};

}  // namespace

std::vector<int> piece_places(SignCells& cells, const Pieces& pieces, const std::vector<CoverBox>& boxes,
                              const solve::Control& control) {
  const UpwardRounding rounding;
  Places places(cells, pieces);
  std::vector<int> result(boxes.size(), -1);
  for (std::size_t i = 0; i < boxes.size() && !control.ended(); ++i)
    if (std::cmp_equal(boxes[i].box.size(), cells.system().size()) && boxes[i].verdict != Verdict::pending)
      result[i] = places.of(boxes[i].box);
  return result;
}

std::optional<int> only_piece(const SignCells& cells, const Pieces& pieces, const Box& box, const std::vector<int>& signs) {
  std::optional<int> only;
  for (const Pieces::CellPart& part : pieces.parts) {
    if (part.signs != signs) continue;
    const Box& sides = cells.cells()[part.cell].sides;
    if (!std::equal(box.begin(), box.end(), sides.begin(), [](const auto& x, const auto& y) { return x.overlaps(y); }))
      continue;
    if (only && *only != part.piece) return std::nullopt;
    only = part.piece;
  }
  return only;
}

}  // namespace corank::analyze
