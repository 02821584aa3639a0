// Parts of cells that are joined to pieces where a solution in two of them is proven.
#pragma once

#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <optional>
#include <vector>

#include "corank/analyze/pieces/climb.h"
#include "corank/analyze/pieces/sign_cells.h"
#include "corank/core/pieces.h"

namespace corank::analyze {

/// All of this requires that the cells and the control outlive it.
class CellParts {
 public:
  using Signs = std::vector<int>;
  enum class Kind { connected, passage, unknown };
  struct Part {
    std::size_t cell;
    Signs signs;
    Kind kind;
    bool holds_solution;  ///< proven
    std::optional<Box> solution{};
    std::vector<int> held{};  ///< the variables over whose values that is a solution
  };

  CellParts(SignCells& cells, solve::Control& control);

  SignCells& cells() const { return cells_; }
  const Part& operator[](std::size_t part) const { return parts_[part]; }
  std::size_t size() const { return parts_.size(); }
  const SignCell& cell_of(std::size_t part) const { return cells_.cells()[parts_[part].cell]; }
  bool crowded() const { return crowded_; }  ///< some cell's parts are not even listed

  /// The same for parts that are proven to be of one piece.
  std::size_t class_of(std::size_t part) { return proven_.find_set(part); }
  /// Joins connected parts: of one sheet, over the borders of cells, and by small sheets about points where two cells end.
  void join();
  /// From each of these classes that is not the largest of its signs, climbs (climb.h) to another one; false: none did.
  bool join_by_climbs(const std::map<std::size_t, std::vector<std::size_t>>& classes);
  /// Of what is joined.
  PieceProof proof();

  /// Parts of like signs in cells that touch.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (std::size_t c = 0; c < cells_.cells().size() && !control_.ended(); ++c)
      tree_.for_each_overlapping(cells_.cells()[c].sides, 0.0, [&](std::size_t d) {
        if (d <= c) return;
        for (const auto& [signs, part] : part_of_[c])
          if (const auto other = part_of_[d].find(signs); other != part_of_[d].end()) visit(part, other->second);
      });
  }

 private:
  struct End {
    std::size_t part, other;
    Box point;
  };

  // Two parts, why they are of one piece, and by which sheets of their own, if any.
  struct Joined {
    std::size_t part, other;
    std::vector<PieceLink> links;
    std::vector<SheetBridge> bridges;
  };

  void add_parts();
  bool is_in(const Box& point, std::size_t c) const;
  Box widened(Box box) const;
  bool is_joined_over(std::size_t c, const Box& box);
  void join_at(const Box& point, const std::vector<int>& held);
  void join_over_border(std::size_t c);
  void join_at_ends();
  void join_touching();
  void join_next_to(std::size_t c, std::size_t d, int count);
  std::optional<Box> solution_of(const Part& part);
  bool climb_from(std::size_t p, Climber& climber);
  std::optional<PieceLink> meeting(const Box& piece, const SignCell& cell);
  std::vector<int> free_of(const certify::Sheet& sheet) const;
  template <class Visit>
  void for_each_pair_of_one_sheet(const Visit& visit) const;

  SignCells& cells_;
  certify::MeetingTest test_;
  solve::Control& control_;
  BoxTree tree_;  // of the cells
  std::vector<Part> parts_;
  std::vector<std::map<Signs, std::size_t>> part_of_;  // of each cell
  std::vector<End> ends_;
  std::vector<Joined> joined_;
  bool crowded_ = false;
  boost::disjoint_sets_with_storage<> proven_;
};

}  // namespace corank::analyze
