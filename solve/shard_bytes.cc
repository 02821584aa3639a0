#include "corank/solve/shard_bytes.h"

#include <algorithm>
#include <ostream>
#include <streambuf>

#include "corank/solve/packed_found.h"
#include "corank/solve/search_archive.h"

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
    Received::Part& part = a.parts.emplace_back();
    load_rest(archive, part.shard);
    part.found = packed_in(archive);
  }
}

namespace {

// As a Shard without what is left.
void write_part(ByteOutput& archive, const SearchView::Part& part) {
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

// What is written to it is one string.
class StringBuffer : public std::streambuf {
 public:
  std::string bytes;

 private:
  int_type overflow(int_type c) override {
    if (c != traits_type::eof()) bytes.push_back(static_cast<char>(c));
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* some, std::streamsize count) override {
    bytes.append(some, count);
    return count;
  }
};

std::string first_line(std::string_view kind) {
  return "corank " + std::string(kind) + ", version " + engine_version() + "\n";
}

// `expected`: of the bytes, nearly. Memory that a growing string leaves behind costs more than what is written to it.
template <class Value>
std::string bytes_of_value(std::string_view kind, const Value& value, std::size_t expected = 0) {
  StringBuffer buffer;
  buffer.bytes.reserve(expected);
  std::ostream stream(&buffer);
  stream << first_line(kind);
  ByteOutput archive(stream);
  archive(value);
  return std::move(buffer.bytes);
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
    std::replace_if(
        named.begin(), named.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
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
Value value_from(std::string_view kind, std::string_view bytes, Value value = {}) {
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

constexpr std::string_view kPrepared = "question", kWork = "work", kShard = "shard", kUnit = "unit", kAnswer = "answer",
                           kState = "state";

}  // namespace

extern const char* const kEngineHash;  // made by cmake/EngineHash.cmake

const std::string& engine_version() {
  static const std::string version = std::string(CORANK_VERSION) + " (search " + kEngineHash + ")";
  return version;
}

std::string to_bytes(const Prepared& prepared) { return bytes_of_value(kPrepared, prepared); }
std::string to_bytes(const Work& work) { return bytes_of_value(kWork, work); }
std::string to_bytes(const Shard& shard) { return bytes_of_value(kShard, shard); }
std::string to_bytes(const Unit& unit) { return bytes_of_value(kUnit, unit); }
std::string to_bytes(const Answer& answer) { return bytes_of_value(kAnswer, answer, expected_bytes(answer)); }

std::string to_bytes(const SearchView& state) {
  StringBuffer buffer;
  std::ostream stream(&buffer);
  write(stream, state);
  return std::move(buffer.bytes);
}

void write(std::ostream& out, const SearchView& state) {
  out << first_line(kState);
  ByteOutput archive(out);
  archive(state.first, state.pass, state.motions.stored(), state.cutting, state.sigma, state.seconds);
  const bool more = state.postponed != nullptr;
  archive(cereal::make_size_tag(static_cast<cereal::size_type>(state.parts.size() + more)));
  for (const SearchView::Part& part : state.parts) write_part(archive, part);
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

Work work_from(std::string_view bytes) { return value_from<Work>(kWork, bytes); }
Shard shard_from(std::string_view bytes) { return value_from(kShard, bytes, Shard(0, false)); }
Unit unit_from(std::string_view bytes) { return value_from<Unit>(kUnit, bytes); }
Received answer_from(std::string_view bytes) { return value_from<Received>(kAnswer, bytes); }

SearchState state_from(std::string_view bytes, const Prepared& prepared) {
  SearchState state;
  read_value(kState, bytes, [&](ByteInput& archive) {
    SelfMotions::Stored motions;
    archive(state.first, state.pass, motions, state.cutting, state.sigma, state.seconds);
    state.motions = SelfMotions::restored(prepared.reduction.system, std::move(motions));
    cereal::size_type shards = 0;
    archive(cereal::make_size_tag(shards));
    for (cereal::size_type i = 0; i < shards; ++i) archive(state.shards.emplace_back(0, false));
    check(state, prepared);
  });
  return state;
}

}  // namespace solve
}  // namespace corank
