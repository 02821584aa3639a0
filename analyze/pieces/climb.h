// A way from a solution to the inner of its piece, as a chain of proven sheets on which every function keeps its sign.
//
// Where limits and loci meet at small angles, a cell may hold a sliver of a piece to which no cell next to it is proven to
// be joined: all of its neighbours have several mixed functions. From a point of the sliver one gets away from all zeros
// at once along the gradient of the sum of log |g_k| (the way to the analytic centre, key Nesterov1994).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "corank/analyze/pieces/sign_cells.h"
#include "corank/core/pieces.h"
#include "corank/core/shape.h"

namespace corank::analyze {

/// Sheets, each with a solution in common with the one before it. Theorem: each is connected, since it is the graph over
/// its free sides; every function has one sign on it. So all of them are in one piece.
struct Climb {
  std::vector<SheetBridge> sheets;
  std::vector<PieceLink> links;  ///< one more: the first is in the box of the start, the last where it arrived
};

class Climber {
 public:
  explicit Climber(const SignCells& cells) : cells_(cells), test_(cells.system()) {}

  /// The solution that joins a sheet to a part elsewhere, if any.
  using Arrived = std::function<std::optional<PieceLink>(const SheetBridge&)>;
  /// From near a solution in the box at which the functions have these signs. `arrived` is asked of each sheet; the climb
  /// ends where it has an answer. Nothing: it came to the centre, or no sheet was proven. Requires
  /// UpwardRounding::active().
  std::optional<Climb> climb(const Box& from, std::vector<double> near, const std::vector<int>& signs,
                             const Arrived& arrived);

 private:
  const SignCells& cells_;
  certify::MeetingTest test_;
};

}  // namespace corank::analyze
