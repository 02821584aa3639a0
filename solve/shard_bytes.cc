#include "corank/solve/shard_bytes.h"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/vector.hpp>
#include <new>
#include <sstream>

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

template <class Archive>
void serialize(Archive& archive, CoverBox& b) {
  archive(b.box, b.verdict, b.free, b.region, b.point, b.kernel_at_most, b.motion, b.reason);
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
void serialize(Archive& archive, Found& f) {
  archive(f.box, f.sheet, f.region, f.leaves);
}

template <class Archive>
void serialize(Archive& archive, Work& w) {
  archive(w.boxes, w.postpone);
}

template <class Archive>
void serialize(Archive& archive, Shard& s) {
  archive(s.number, s.sheets, s.postponed, s.found, s.left, s.script, s.statistics);
}

namespace {

// Says what follows, and changes with it.
constexpr std::uint32_t kWork = 0x636b5701, kShard = 0x636b5301;

template <class Value>
std::string bytes_of_value(std::uint32_t kind, const Value& value) {
  std::ostringstream stream(std::ios::binary);
  {
    cereal::PortableBinaryOutputArchive archive(stream);
    archive(kind, value);
  }
  return std::move(stream).str();
}

template <class Value>
void read_value(std::uint32_t kind, const std::string& bytes, Value& value) {
  std::istringstream stream(bytes, std::ios::binary);
  try {
    cereal::PortableBinaryInputArchive archive(stream);
    std::uint32_t found = 0;
    archive(found);
    if (found != kind) throw ShardError("these bytes are no part of a search by this version of corank");
    archive(value);
  } catch (const cereal::Exception& error) {
    throw ShardError(std::string("a part of a search cannot be read: ") + error.what());
  } catch (const std::length_error&) {
    throw ShardError("a part of a search cannot be read: it says that it holds more than there can be");
  } catch (const std::bad_alloc&) {
    throw ShardError("a part of a search cannot be read: it says that it holds more than there is memory for");
  }
}

}  // namespace

std::string to_bytes(const Work& work) { return bytes_of_value(kWork, work); }
std::string to_bytes(const Shard& shard) { return bytes_of_value(kShard, shard); }

Work work_from(const std::string& bytes) {
  Work work;
  read_value(kWork, bytes, work);
  return work;
}

Shard shard_from(const std::string& bytes) {
  Shard shard(0, false);
  read_value(kShard, bytes, shard);
  return shard;
}

}  // namespace solve
}  // namespace corank
