#include "corank/solve/passages.h"

#include <tbb/parallel_for.h>

#include "corank/certify/passage.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"

namespace corank::solve {

void prove_passages(const Prepared& prepared, Cover& cover, Control& control) {
  constexpr int kHalvings = 6;  // of a box, one after the other
  if (!prepared.system.passage) return;
  const InStage stage(control, Stage::kernel);
  const certify::PassageTest test(prepared.system);
  if (!test.applies()) return;
  ThreadArena arena(prepared.options.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, cover.boxes.size(), [&](std::size_t i) {
      CoverBox& box = cover.boxes[i];
      if (box.verdict == Verdict::pending || control.ended()) return;
      const UpwardRounding rounding;
      certify::PassageTest::Finding found = test.of(box.box, kHalvings);
      box.passage = found.passage;
      box.side = std::move(found.side);
    });
  });
}

}  // namespace corank::solve
