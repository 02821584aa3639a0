// How the values of a search are written and read by cereal (solve/byte_archive.h). For shard_bytes.cc.
#pragma once

#include <cereal/types/map.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>

#include "corank/solve/byte_archive.h"
#include "corank/solve/shard.h"

// Each type beside the namespace that it lives in, where the archive looks for it.
namespace corank {

template <class Archive>
void save(Archive& archive, const Interval& x) {
  archive(x.lo(), x.hi());
}
template <class Archive>
void load(Archive& archive, Interval& x) {
  double lo = 0, hi = 0;
  archive(lo, hi);
  if (!(lo <= hi)) throw solve::ShardError("a part of a search holds an interval without a number");
  x = Interval(lo, hi);
}

// Without its sides (solve/packed_found.h).
template <class Archive>
void serialize(Archive& archive, CoverBox& b) {
  archive(b.verdict, b.free, b.region, b.point, b.kernel_at_most, b.motion, b.reason);
}

template <class Archive>
void serialize(Archive& archive, Statistics& s) {
  archive(s.processed, s.newton_steps, s.proofs_tried, s.seconds_total, s.seconds_search, s.seconds_certify);
}

template <class Archive>
void serialize(Archive& archive, Proof::Combination& c) {
  archive(c.equations, c.dependent, c.y);
}

template <class Archive>
void serialize(Archive& archive, Proof& p) {
  archive(p.roots, p.steps, p.integers, p.reals, p.combinations);
}

namespace certify {

template <class Archive>
void serialize(Archive& archive, Preconditioner& p) {
  archive(p.equations, p.dependent, p.y);
}

template <class Archive>
void serialize(Archive& archive, Sheet& s) {
  archive(s.proven, s.equations, s.motion, s.dependent, s.region, s.image);
}

}  // namespace certify

namespace solve {

template <class Archive>
void serialize(Archive& archive, Waiting& w) {
  archive(w.x, w.share, w.node);
}

template <class Archive>
void serialize(Archive& archive, Proven& p) {
  archive(p.x, p.sheet, p.node);
}

template <class Archive>
void serialize(Archive& archive, LocalSolution& s) {
  archive(s.x, s.rank);
}

template <class Archive>
void serialize(Archive& archive, Postponed& p) {
  archive(p.box, p.near, p.noisy, p.proof, p.step);
}

template <class Archive>
void serialize(Archive& archive, Work& w) {
  archive(w.boxes, w.postpone, w.until);
}

}  // namespace solve
}  // namespace corank
