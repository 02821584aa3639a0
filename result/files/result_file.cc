#include "corank/result/files/result_file.h"

#include <algorithm>
#include <fstream>
#include <numeric>

#include "corank/result/files/checkpoint.h"
#include "corank/result/files/cover_group.h"
#include "corank/result/files/output_file.h"
#include "corank/result/files/source_group.h"
#include "corank/result/values/tallies.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::result {
namespace {

constexpr const char* kFormat = "corank result";
constexpr const char* kAssembly = "/assembly";
constexpr int kOldest = 3;  // with one sigma, without reasons, larger kernels and their scales
constexpr int kMostCorank = 1000, kMostParts = 1000, kMostOfCounted = 1'000'000'000, kMostThreads = 1'000'000;

const EnumWords kReasonWords = words_of<Reason>(kReasons), kPassageWords = words_of<Passage>(kPassages);
const EnumWords kKindWords{"length", "cosine", "sine", "kernel", "auxiliary", "parameter"};

constexpr auto kVariableFields = [](auto& field, auto& variable) {
  field("names", variable.name);
  field.word("kinds", variable.kind, kKindWords);
  field.interval("domain", variable.domain);
};

constexpr auto kAngleFields = [](auto& field, auto& angle) {
  field("names", angle.name);
  field("cosine", angle.cosine);
  field("sine", angle.sine);
  field.interval("range", angle.range);
};

constexpr auto kReasonField = [](auto& field, auto& box) { field.word("reason", box.reason, kReasonWords); };

// Of a whole, from which part each box comes.
constexpr auto kPartField = [](auto& field, auto& box) { field("part", box.part, -1, kMostParts); };

// Bits of the types' names, in the order of the attribute `types`.
constexpr auto kTypeFields = [](auto& field, auto& box) {
  field.packed("types_proven", box.types.proven, kAllTypes);
  field.packed("types_excluded", box.types.excluded, kAllTypes);
};

// Of a workspace boundary; no side is stored as zeros.
auto passage_fields(std::size_t outputs) {
  return [outputs](auto& field, auto& box) {
    field.word("passage", box.passage, kPassageWords);
    CORANK_CHECK(box.side.empty() || box.side.size() == outputs);
    std::vector<double> side = box.side;
    side.resize(outputs);
    constexpr bool writes = std::is_const_v<std::remove_reference_t<decltype(box)>>;
    if constexpr (writes) {
      field.row("side", std::as_const(side), outputs);
    } else {
      field.row("side", side, outputs);
      if (std::ranges::any_of(side, [](double x) { return x != 0; })) box.side = std::move(side);
    }
  };
}

constexpr auto kStatistics = [](const auto& field, auto& statistics) {
  field("processed", statistics.processed);
  field("newton_steps", statistics.newton_steps);
  field("proofs_tried", statistics.proofs_tried);
  field("seconds_total", statistics.seconds_total);
  field("seconds_search", statistics.seconds_search);
  field("seconds_certify", statistics.seconds_certify);
};

// --- writing and reading; `oldest`: a file of that version ---

void store_texts_if_any(Hdf5Writer& file, const char* name, const std::vector<std::string>& texts) {
  if (!texts.empty()) StoredPart(file).texts(name, texts);
}
void store_texts_if_any(Hdf5Reader& file, const char* name, std::vector<std::string>& texts) {
  if (file.has(name)) StoredPart(file).texts(name, texts);
}

template <class File, class Data>
void store_sigma(const StoredPart<File>& file, Data& sigma, bool oldest) {
  file(oldest ? "sigma" : "sigma_length", sigma.length);
  file(oldest ? "sigma" : "sigma_angle", sigma.angle);
}

template <class File, class Data>
void store_options(File& to, Data& options, bool oldest) {
  const StoredPart file(to, "/options");
  file.list("/options/constants/", options.constants, kConstant);
  store_texts_if_any(to, "/options/outputs", options.outputs);
  store_sigma(file, options.sigma, oldest);
  if (!oldest) {
    file("corank", options.corank, 1, kMostCorank);
    file("passive_rates_eliminated", options.passive_rates_eliminated);
    file.texts("/options/kernel_scales", options.kernel_scales);
  }
  file("kernel", options.kernel);
  file.check(options.kernel.empty() || options.kernel == "right" || options.kernel == "left",
             "the attribute kernel of /options is neither right nor left: '" + options.kernel + "'");
  file("tolerance", options.tolerance);
  file("threads", options.threads, 0, kMostThreads);
  file("max_boxes", options.max_boxes);
  file("max_solutions", options.max_solutions);
  file("time_limit", options.time_limit);
}

// What a part has of its own, and a result without parts, but for its boxes.
template <class File, class Data>
void store_description(File& to, Data& result, bool oldest = false) {
  const StoredPart file(to);
  store_sigma(file, result.cover.sigma, oldest);
  file("dimension", result.cover.dimension, 0, kMostOfCounted);
  file("tolerance", result.cover.tolerance);
  file("configuration_size", result.configuration_size, 0, kMostOfCounted);
  file("equations", result.equations, 0, kMostOfCounted);
  file("inequalities", result.inequalities, 0, kMostOfCounted);
  file.text("/model/system", result.system_text);
  file.list("/variables/", result.variables, kVariableFields);
  file.list("/angles/", result.angles, kAngleFields);
  store_options(to, result.options, oldest);
  store_texts_if_any(to, "/outputs", result.outputs);
  store_texts_if_any(to, "/free_coordinates", result.free_coordinates);
  store_texts_if_any(to, "/inequality_sources", result.inequality_sources);
}

// Of boxes that have sides, verdicts and free variables.
template <class File, class Data>
void store_of_boxes(File& to, const std::string& group, Data& boxes, std::size_t outputs, bool of_parts,
                    bool oldest = false) {
  const StoredPart file(to);
  if (!oldest) file.further(group + "/", boxes, kReasonField);
  if (outputs > 0) file.further(group + "/", boxes, passage_fields(outputs));
  if (of_parts) file.further(group + "/", boxes, kPartField);
}

template <class File, class Data>
void store_types(File& to, Data& cover) {
  const StoredPart file(to, "/boxes");
  if constexpr (file.kWrites) {
    if (cover.types.asked == 0) return;
    to.attribute("/boxes", "types", fmt::format("{}", fmt::join(type_names(kAllTypes), " ")));
  } else if (!to.has_attribute("/boxes", "types_asked")) {
    return;  // none were asked for
  }
  file("types_asked", cover.types.asked, 0, kAllTypes);
  file("types_of_set", cover.types.of_set, 0, kAllTypes);
  file("types_left_out", cover.types.left_out);
  file.further("/boxes/", cover.boxes, kTypeFields);
  file.further("/points/", cover.points, kTypeFields);
}

// --- writing ---

// What a part has of its own, and a result without parts.
void write_own(Hdf5Writer& file, const Result& result) {
  const Cover& cover = result.cover;
  const auto write = [&](const std::string& group, const std::vector<CoverBox>& boxes) {
    write_boxes(file, group, boxes, result.variables.size());
    store_of_boxes(file, group, boxes, result.outputs.size(), !result.parts.empty());
  };
  file.attribute("/", "stopped", result.stopped);
  file.attribute("/", "complete", std::int64_t{cover.complete()});
  store_description(file, result);
  write("/boxes", cover.boxes);
  const auto counts = cover.counts();
  for (std::size_t v = 0; v < counts.size(); ++v)
    file.attribute("/boxes", to_string(static_cast<Verdict>(v)), std::uint64_t{counts[v]});
  file.attribute("/boxes", "wider_than_sigma", std::uint64_t{cover.wider_than_sigma});
  if (cover.observed_dimension > 0) file.attribute("/boxes", "observed_dimension", std::int64_t{cover.observed_dimension});
  write("/points", cover.points);
  store_types(file, cover);
  file.group("/statistics");
  kStatistics(StoredPart(file, "/statistics"), cover.statistics);
  write_certificates(file, cover, result.variables.size());
}

// --- reading ---

class ResultReader {
 public:
  explicit ResultReader(Hdf5Reader file, Reading reading = {}) : file_(std::move(file)), reading_(std::move(reading)) {
    if (!file_.has_attribute("/", "format") || file_.attribute<std::string>("/", "format") != kFormat)
      file_.fail("this is not a corank result" + other_kind_words(file_));
    format_ = file_.attribute<std::int64_t>("/", "format_version");
    if (format_ < kOldest || format_ > kFormatVersion)
      file_.fail("format version " + std::to_string(format_) + "; this corank reads versions " + std::to_string(kOldest) +
                 " to " + std::to_string(kFormatVersion));
  }

  Result read() {
    reading_.free = reading_.free || file_.has_attribute("/", "parts");
    Result result = read_one(nullptr);
    if (reading_.sides) return result;
    if (file_.has_attribute("/", "nearly_solved"))
      result.nearly_solved = file_.attribute<std::int64_t>("/", "nearly_solved") != 0;
    if (file_.has_attribute("/", "assembly")) {
      file_.enter(kAssembly);
      result.assembly.push_back(read_one(&result));
      result.assembly.back().set = symbolic::to_string(symbolic::SingularitySet::cspace);
      file_.enter("");
    }
    if (!file_.has_attribute("/", "parts")) return result;
    const int parts = file_.integer("/", "parts", 1, kMostParts);
    for (int i = 0; i < parts; ++i) {
      file_.enter("/parts/" + std::to_string(i));
      Result part = read_one(&result);
      part.part = word("part");
      if (file_.has_attribute("/", "condition")) part.condition = word("condition");
      if (part.outputs != result.outputs) file_.fail("a part has other outputs than the whole");
      result.parts.push_back(std::move(part));
    }
    file_.enter("");
    for (auto* boxes : {&result.cover.boxes, &result.cover.points})
      for (const CoverBox& box : *boxes)
        if (box.part < 0 || box.part >= parts) file_.fail("a box names a part that does not exist");
    return result;
  }

 private:
  // Of a part, model and set are those of the whole.
  Result read_one(const Result* whole) {
    Result result;
    Cover& cover = result.cover;
    result.version = whole ? whole->version : word("version");
    result.model = whole ? whole->model : word("model");
    result.set = whole ? whole->set : word("set");
    result.model_text = whole ? whole->model_text : file_.text("/model/text");
    store_description(file_, result, format_ == kOldest);
    const std::size_t n = result.variables.size();
    for (const Angle& a : result.angles)
      if (std::min(a.cosine, a.sine) < 0 || std::max(a.cosine, a.sine) >= static_cast<int>(n))
        file_.fail("/angles name no variable");
    if (result.configuration_size > static_cast<int>(n))
      file_.fail("the attribute configuration_size is above the number of variables");
    if (file_.has("/outputs") && result.outputs.empty()) file_.fail("/outputs is empty");
    sides_.resize(n);
    std::iota(sides_.begin(), sides_.end(), 0);
    if (reading_.sides) sides_ = reading_.sides(result);
    if (file_.has_attribute("/", "stopped")) result.stopped = file_.attribute<std::string>("/", "stopped");
    for (const auto& [group, boxes] : {std::pair("/boxes", &cover.boxes), {"/points", &cover.points}}) {
      *boxes = read_boxes(file_, group, n, reading_.sides ? &sides_ : nullptr, reading_.free);
      store_of_boxes(file_, group, *boxes, result.outputs.size(), file_.has(std::string(group) + "/part"),
                     format_ == kOldest);
    }
    kStatistics(StoredPart(file_, "/statistics"), cover.statistics);
    if ((file_.attribute<std::int64_t>("/", "complete") != 0) != cover.complete())
      file_.fail("the attribute complete contradicts the boxes");
    check_counts(cover);
    cover.wider_than_sigma = file_.attribute<std::uint64_t>("/boxes", "wider_than_sigma");
    if (file_.has_attribute("/boxes", "observed_dimension"))
      cover.observed_dimension = file_.integer("/boxes", "observed_dimension", 1, static_cast<int>(n));
    store_types(file_, cover);
    if (!reading_.sides) read_certificates(file_, cover, n);
    if (reading_.sides) keep_sides(result);
    return result;
  }

  // As the boxes are already.
  void keep_sides(Result& result) const {
    const auto place = [&](int v) {
      const auto at = std::lower_bound(sides_.begin(), sides_.end(), v);
      return at != sides_.end() && *at == v ? static_cast<int>(at - sides_.begin()) : -1;
    };
    std::vector<ResultVariable> variables;
    for (const int v : sides_) variables.push_back(result.variables[v]);
    for (Angle& a : result.angles) {
      a.cosine = place(a.cosine);
      a.sine = place(a.sine);
    }
    std::erase_if(result.angles, [](const Angle& a) { return a.cosine < 0 || a.sine < 0; });
    result.configuration_size =
        static_cast<int>(std::lower_bound(sides_.begin(), sides_.end(), result.configuration_size) - sides_.begin());
    result.variables = std::move(variables);
  }

  // Names go to terminals and pages: what could steer those is made visible.
  std::string word(const std::string& name) const { return printable_line(file_.attribute<std::string>("/", name)); }
  void check_counts(const Cover& cover) const {
    const auto counts = cover.counts();
    for (std::size_t v = 0; v < counts.size(); ++v) {
      const std::string name = to_string(static_cast<Verdict>(v));
      if (file_.attribute<std::uint64_t>("/boxes", name) != counts[v])
        file_.fail("the attribute " + name + " of /boxes contradicts the boxes");
    }
  }

  Hdf5Reader file_;
  Reading reading_;
  std::vector<int> sides_;
  std::int64_t format_ = kFormatVersion;
};

}  // namespace

void check_writable(const std::filesystem::path& path) { const OutputFile created_and_removed(path); }

void write_result(const std::filesystem::path& path, const Result& result, const Ended& in_haste) {
  const OutputFile target(path);
  Hdf5Writer file(target.part().string(), result.options.threads, in_haste);
  file.attribute("/", "format", std::string(kFormat));
  file.attribute("/", "format_version", std::int64_t{kFormatVersion});
  file.attribute("/", "version", result.version);
  file.attribute("/", "model", result.model);
  file.attribute("/", "set", result.set);
  file.text("/model/text", result.model_text);
  write_own(file, result);
  if (result.nearly_solved) file.attribute("/", "nearly_solved", std::int64_t{1});
  if (!result.assembly.empty()) file.attribute("/", "assembly", std::int64_t{1});
  if (!result.parts.empty()) file.attribute("/", "parts", std::int64_t{static_cast<std::int64_t>(result.parts.size())});
  for (std::size_t i = 0; i < result.parts.size(); ++i) {
    file.enter("/parts/" + std::to_string(i));
    file.attribute("/", "part", result.parts[i].part);
    if (!result.parts[i].condition.empty()) file.attribute("/", "condition", result.parts[i].condition);
    write_own(file, result.parts[i]);
  }
  if (!result.assembly.empty()) {
    file.enter(kAssembly);
    write_own(file, result.assembly.front());
  }
  if (!result.search.empty()) {
    file.enter("");
    write_search(file, result.search);
  }
  file.close();
  target.finish();
}

Result read_result(const std::filesystem::path& path) { return read_result(path, Reading{}); }

Result read_result(const std::filesystem::path& path, const Reading& reading) {
  return ResultReader(Hdf5Reader(path.string()), reading).read();
}

Result read_result(const std::string& name, std::span<const std::byte> items) {
  return ResultReader(Hdf5Reader(name, items)).read();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  const OutputFile target(path);
  std::ofstream file(target.part(), std::ios::binary);
  file << text << std::flush;
  file.close();
  if (!file) throw ResultFileError(path.string() + ": cannot write here (disk full?)");
  target.finish();
}

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace corank::result
