#include "corank/solve/store/shard_bytes.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <utility>

#include "corank/solve/store/search_archive.h"

namespace corank {

void serialize(auto& archive, SelfMotionRecord& r) { archive(r.dimension, r.relations); }

namespace solve {

void serialize(auto& archive, SelfMotions::Stored& s) { archive(s.motions, s.observed, s.former); }

void serialize(auto& archive, Unit& u) { archive(u.id, u.cut, u.boxes, u.work, u.sigma, u.sheets); }

void save(ByteOutput& archive, const Shard& s) {
  archive(s.number, s.sheets, s.postponed, s.left, s.script, s.statistics);
  pack(archive, s.found, s.found.size());
}
// All but what was found.
void load_rest(ByteInput& archive, Shard& s) { archive(s.number, s.sheets, s.postponed, s.left, s.script, s.statistics); }
void load(ByteInput& archive, Shard& s) {
  load_rest(archive, s);
  s.found.clear();
  packed_in(archive).unpack(s.found);
}

void save(ByteOutput& archive, const Answer& a) {
  archive(a.id, cereal::make_size_tag(static_cast<cereal::size_type>(a.shards.size())));
  for (const Shard& shard : a.shards) archive(shard);
}
void load(ByteInput& archive, Received& a) {
  cereal::size_type shards = 0;
  archive(a.id, cereal::make_size_tag(shards));
  for (cereal::size_type i = 0; i < shards; ++i) {
    Received::PackedShard& part = a.parts.emplace_back();
    load_rest(archive, part.shard);
    part.found = packed_in(archive);
  }
}

namespace {

// As a Shard without what is left.
void write_part(ByteOutput& archive, const SearchView::ShardView& part) {
  const Shard& shard = *part.shard;
  const Shard::Mark end = part.end.value_or(shard.mark());
  std::vector<const Proven*> open;  // sheets to be cut
  for (std::size_t i = 0; i < end.sheets; ++i)
    if (!shard.sheets[i].cut) open.push_back(&shard.sheets[i]);
  archive(shard.number, cereal::make_size_tag(static_cast<cereal::size_type>(open.size())));
  for (const Proven* sheet : open) archive(*sheet);
  archive(shard.postponed, std::vector<Waiting>{});
  if (shard.script && part.end) {
    std::optional<Recorder> script = shard.script;
    script->go_back_to(end.script);
    archive(script);
  } else {
    archive(shard.script);
  }
  archive(shard.statistics);
  if (part.packed) {
    pack(archive, *part.packed);
  } else {
    pack(archive, shard.found, end.found);
  }
}

std::string first_line(std::string_view kind) {
  return "corank " + std::string(kind) + ", version " + engine_version() + "\n";
}

// `expected`: of the bytes, nearly. Memory that a growing string leaves behind costs more than what is written to it.
template <class Value>
std::string bytes_of_value(std::string_view kind, const Value& value, std::size_t expected = 0) {
  std::string bytes;
  bytes.reserve(expected);
  std::ostringstream stream(std::move(bytes), std::ios::binary);
  stream << first_line(kind);
  ByteOutput archive(stream);
  archive(value);
  return std::move(stream).str();
}

template <class Read>
void read_value(std::string_view kind, std::string_view bytes, Read read) {
  const std::string begin = "corank " + std::string(kind) + ", version ";
  const std::size_t end = bytes.substr(0, 200).find('\n');
  if (end == std::string_view::npos || !bytes.starts_with(begin))
    throw ShardError("these bytes are not a " + std::string(kind) + " of corank");
  const std::string_view version = bytes.substr(begin.size(), end - begin.size());
  if (version != engine_version()) {
    std::string named(version);
    std::ranges::replace_if(
        named, [](char c) { return c < ' ' || c > '~'; }, '?');
    throw ShardError("this " + std::string(kind) + " was made by corank " + named + ", and this is corank " +
                     engine_version());
  }
  try {
    ByteInput archive(bytes.substr(end + 1));
    read(archive);
    if (!archive.at_end()) throw ShardError("a part of a search cannot be read: more follows than belongs to it");
  } catch (const cereal::Exception& error) {
    throw ShardError(std::string("a part of a search cannot be read: ") + error.what());
  } catch (const std::logic_error& error) {  // numbers that are none, lengths that cannot be
    throw ShardError(std::string("a part of a search cannot be read: ") + error.what());
  } catch (const std::bad_alloc&) {
    throw ShardError("a part of a search cannot be read: it says that it holds more than there is memory for");
  }
}

template <class Value>
Value value_from(std::string_view kind, std::string_view bytes) {
  Value value;
  read_value(kind, bytes, [&](ByteInput& archive) { archive(value); });
  return value;
}

std::size_t expected_bytes(const Answer& answer) {
  std::size_t bytes = 4096;
  for (const Shard& shard : answer.shards) {
    const Box* former = nullptr;
    for (const Found& f : shard.found) {
      bytes += f.box.box.size() * sizeof(Interval);
      if (f.region.get() == former) continue;
      former = f.region.get();
      bytes += f.box.box.size() * sizeof(Interval) + sizeof(PackedFound::Run);
    }
  }
  return bytes;
}

constexpr std::string_view kPrepared = "question", kUnit = "unit", kAnswer = "answer", kState = "state";

void expect(bool fits) {
  if (!fits) throw ShardError("a part of a search cannot be read: it does not fit the system");
}

struct Sizes {
  explicit Sizes(const Prepared& prepared)
      : variables(prepared.reduction.kept.size()),
        sides(variables + prepared.reduction.definitions.size()),
        equations(prepared.reduction.system.equations.size()),
        recorded(prepared.options.proof) {}
  std::size_t variables, sides, equations;
  bool recorded;
};

void check_indices(const std::vector<int>& indices, std::size_t below) {
  for (const int i : indices) expect(i >= 0 && std::cmp_less(i, below));
}

void check_sheet(const certify::Sheet& sheet, const Sizes& sizes) {
  expect(sheet.region.size() == sizes.variables && sheet.image.size() == sizes.variables &&
         sheet.dependent.size() <= sizes.variables);
  check_indices(sheet.dependent, sizes.variables);
  check_indices(sheet.equations, sizes.equations);
}

void check_kind(const CoverBox& box, const Sizes& sizes) {
  expect(static_cast<int>(box.verdict) < kVerdicts && static_cast<int>(box.reason) < kReasons);
  check_indices(box.free, sizes.variables);
}

void check_found(const Found& found, const Sizes& sizes) {
  expect(found.box.box.size() == sizes.sides && (!found.region || found.region->size() == sizes.sides));
  check_kind(found.box, sizes);
  if (found.sheet) check_sheet(*found.sheet, sizes);
}

void check_proven(const Proven& proven, const Sizes& sizes) {
  expect(proven.x.size() == sizes.variables);
  check_sheet(proven.sheet, sizes);
}

void check_but_found(const Shard& shard, std::size_t found, const Sizes& sizes) {
  for (const Waiting& box : shard.left) expect(box.x.size() == sizes.variables);
  for (const Proven& proven : shard.sheets) check_proven(proven, sizes);
  for (const Postponed& postponed : shard.postponed) {
    expect(postponed.box.x.size() == sizes.variables);
    expect(postponed.near.x.size() == sizes.variables);
    if (postponed.proof.proven) check_sheet(postponed.proof, sizes);
  }
  expect(shard.script.has_value() == sizes.recorded || found + shard.sheets.size() == 0);
}

void check_work(const Work& work, const Sizes& sizes) {
  for (const Waiting& box : work.boxes) expect(box.x.size() == sizes.variables);
  expect(work.postpone >= 0 && std::isfinite(work.postpone));
}

}  // namespace

extern const char* const kEngineHash;  // made by cmake/EngineHash.cmake

const std::string& engine_version() {
  static const std::string version = std::string(CORANK_VERSION) + " (search " + kEngineHash + ")";
  return version;
}

std::string to_bytes(const Prepared& prepared) { return bytes_of_value(kPrepared, prepared); }
std::string to_bytes(const Unit& unit) { return bytes_of_value(kUnit, unit); }
std::string to_bytes(const Answer& answer) { return bytes_of_value(kAnswer, answer, expected_bytes(answer)); }

std::string to_bytes(const SearchView& state) {
  std::ostringstream stream(std::ios::binary);
  write(stream, state);
  return std::move(stream).str();
}

void write(std::ostream& out, const SearchView& state) {
  out << first_line(kState);
  ByteOutput archive(out);
  archive(state.first, state.pass, state.motions.stored(), state.cutting, state.sigma, state.seconds);
  const bool more = state.postponed != nullptr;
  archive(cereal::make_size_tag(static_cast<cereal::size_type>(state.parts.size() + more)));
  for (const SearchView::ShardView& part : state.parts) write_part(archive, part);
  if (!more) return;
  Shard beside(0, false);
  beside.postponed = *state.postponed;
  archive(beside);
}

Prepared prepared_from(std::string_view bytes) {
  Prepared prepared;
  read_value(kPrepared, bytes, [&](ByteInput& archive) {
    archive(prepared);
    prepared.system.validate();
    prepared.reduction.system.validate();
  });
  return prepared;
}

Unit unit_from(std::string_view bytes, const Prepared& prepared) {
  Unit unit = value_from<Unit>(kUnit, bytes);
  const Sizes sizes(prepared);
  check_work(unit.work, sizes);
  for (const Proven& proven : unit.sheets) check_proven(proven, sizes);
  return unit;
}

Received answer_from(std::string_view bytes, const Prepared& prepared) {
  Received answer = value_from<Received>(kAnswer, bytes);
  const Sizes sizes(prepared);
  for (const auto& [shard, found] : answer.parts) {
    check_but_found(shard, found.size(), sizes);
    expect(found.size() == 0 || found.sides() == sizes.sides);
    for (const CoverBox& kind : found.kinds()) check_kind(kind, sizes);
    for (const auto& [box, sheet] : found.sheets()) check_sheet(sheet, sizes);
  }
  return answer;
}

SearchState state_from(std::string_view bytes, const Prepared& prepared) {
  SearchState state;
  read_value(kState, bytes, [&](ByteInput& archive) {
    SelfMotions::Stored motions;
    archive(state.first, state.pass, motions, state.cutting, state.sigma, state.seconds);
    state.motions = SelfMotions::restored(prepared.reduction.system, std::move(motions));
    cereal::size_type shards = 0;
    archive(cereal::make_size_tag(shards));
    for (cereal::size_type i = 0; i < shards; ++i) archive(state.shards.emplace_back(0, false));
    const Sizes sizes(prepared);
    check_work(state.first, sizes);
    check_work(state.pass, sizes);
    for (const Shard& shard : state.shards) {
      check_but_found(shard, shard.found.size(), sizes);
      for (const Found& found : shard.found) check_found(found, sizes);
    }
  });
  return state;
}

}  // namespace solve
}  // namespace corank
