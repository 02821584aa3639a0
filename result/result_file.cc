#include "corank/result/result_file.h"

#include <algorithm>
#include <fstream>
#include <numeric>

#include "corank/result/certificate_file.h"
#include "corank/result/checkpoint.h"
#include "corank/result/cover_group.h"
#include "corank/result/output_file.h"
#include "corank/result/source_group.h"
#include "corank/result/stored_list.h"
#include "corank/symbolic/set_definition.h"

namespace corank::result {
namespace {

constexpr const char* kFormat = "corank result";
constexpr const char* kAssembly = "/assembly";
constexpr int kOldest = 3;  // with one sigma, without reasons, larger kernels and their scales
constexpr int kMostCorank = 1000, kMostParts = 1000, kMostOfCounted = 1'000'000'000, kMostThreads = 1'000'000;

const EnumWords kReasonWords = words_of<Reason>(kReasons), kPassageWords = words_of<Passage>(kPassages);
const EnumWords kKindWords{"length", "cosine", "sine", "kernel", "auxiliary"};

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

constexpr auto kSigma = [](auto& field, auto& sigma) {
  field("sigma_length", sigma.length);
  field("sigma_angle", sigma.angle);
};

// Attributes of a result, of its options, of its statistics.
constexpr auto kSizes = [](auto& field, auto& result) {
  field("dimension", result.cover.dimension, 0, kMostOfCounted);
  field("tolerance", result.cover.tolerance);
  field("configuration_size", result.configuration_size, 0, kMostOfCounted);
  field("equations", result.equations, 0, kMostOfCounted);
  field("inequalities", result.inequalities, 0, kMostOfCounted);
};

constexpr auto kKernelOptions = [](auto& field, auto& options) {
  field("corank", options.corank, 1, kMostCorank);
  field("passive_rates_eliminated", options.passive_rates_eliminated);
};

constexpr auto kFurtherOptions = [](auto& field, auto& options) {
  field("kernel", options.kernel);
  field("tolerance", options.tolerance);
  field("threads", options.threads, 0, kMostThreads);
  field("max_boxes", options.max_boxes);
  field("max_solutions", options.max_solutions);
  field("time_limit", options.time_limit);
};

constexpr auto kStatistics = [](auto& field, auto& statistics) {
  field("processed", statistics.processed);
  field("newton_steps", statistics.newton_steps);
  field("proofs_tried", statistics.proofs_tried);
  field("seconds_total", statistics.seconds_total);
  field("seconds_search", statistics.seconds_search);
  field("seconds_certify", statistics.seconds_certify);
};

// --- writing ---

void write_options(Hdf5Writer& file, const RunOptions& options) {
  write_constants(file, "/options/constants/", options.constants);
  if (!options.outputs.empty()) file.texts("/options/outputs", options.outputs);
  StoredAttributes attributes{.to = &file, .object = "/options"};
  kSigma(attributes, options.sigma);
  kKernelOptions(attributes, options);
  file.texts("/options/kernel_scales", options.kernel_scales);
  kFurtherOptions(attributes, options);
}

// Of a workspace boundary.
void write_passages(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, std::size_t outputs) {
  std::vector<std::uint8_t> passages;
  for (const CoverBox& box : boxes) passages.push_back(static_cast<std::uint8_t>(box.passage));
  file.enumeration(group + "/passage", passages, kPassageWords);
  file.doubles(group + "/side", boxes.size(), outputs, [&](std::size_t i, std::span<double> to) {
    CORANK_CHECK(boxes[i].side.empty() || boxes[i].side.size() == outputs);
    std::copy(boxes[i].side.begin(), boxes[i].side.end(), to.begin());
  });
}

void write_list_of_boxes(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes,
                         const Result& result) {
  write_boxes(file, group, boxes, result.variables.size());
  write_list(file, group + "/", boxes, kReasonField);
  if (!result.outputs.empty()) write_passages(file, group, boxes, result.outputs.size());
  if (!result.parts.empty()) write_list(file, group + "/", boxes, kPartField);
}

void write_types(Hdf5Writer& file, const Cover& cover) {
  if (cover.types.asked == 0) return;
  std::string names;
  for (const SingularityType type : kSingularityTypes) names += (names.empty() ? "" : " ") + std::string(to_string(type));
  file.attribute("/boxes", "types", names);
  file.attribute("/boxes", "types_asked", std::int64_t{cover.types.asked});
  file.attribute("/boxes", "types_of_set", std::int64_t{cover.types.of_set});
  file.attribute("/boxes", "types_left_out", std::uint64_t{cover.types.left_out});
  write_list(file, "/boxes/", cover.boxes, kTypeFields);
  write_list(file, "/points/", cover.points, kTypeFields);
}

// What a part has of its own, and a result without parts.
void write_own(Hdf5Writer& file, const Result& result) {
  const Cover& cover = result.cover;
  file.attribute("/", "stopped", result.stopped);
  file.attribute("/", "complete", std::int64_t{cover.complete()});
  StoredAttributes attributes{.to = &file};
  kSigma(attributes, cover.sigma);
  kSizes(attributes, result);
  file.text("/model/system", result.system_text);
  write_list(file, "/variables/", result.variables, kVariableFields);
  write_list(file, "/angles/", result.angles, kAngleFields);
  write_options(file, result.options);
  if (!result.outputs.empty()) file.texts("/outputs", result.outputs);
  write_list_of_boxes(file, "/boxes", cover.boxes, result);
  const auto counts = cover.counts();
  for (std::size_t v = 0; v < counts.size(); ++v)
    file.attribute("/boxes", to_string(static_cast<Verdict>(v)), std::uint64_t{counts[v]});
  file.attribute("/boxes", "wider_than_sigma", std::uint64_t{cover.wider_than_sigma});
  if (cover.observed_dimension > 0) file.attribute("/boxes", "observed_dimension", std::int64_t{cover.observed_dimension});
  write_list_of_boxes(file, "/points", cover.points, result);
  write_types(file, cover);
  file.group("/statistics");
  attributes.object = "/statistics";
  kStatistics(attributes, cover.statistics);
  write_certificates(file, cover, result.variables.size());
}

// --- reading ---

class ResultReader {
 public:
  explicit ResultReader(Hdf5Reader file, Reading reading = {}) : file_(std::move(file)), reading_(std::move(reading)) {
    if (!file_.has_attribute("/", "format") || file_.attribute<std::string>("/", "format") != kFormat)
      file_.fail("this is not a corank result");
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
    result.system_text = file_.text("/model/system");
    result.variables = read_list<ResultVariable>(file_, "/variables/", kVariableFields);
    const std::size_t n = result.variables.size();
    result.angles = read_list<Angle>(file_, "/angles/", kAngleFields);
    for (const Angle& a : result.angles)
      if (std::min(a.cosine, a.sine) < 0 || std::max(a.cosine, a.sine) >= static_cast<int>(n))
        file_.fail("/angles name no variable");
    sides_.resize(n);
    std::iota(sides_.begin(), sides_.end(), 0);
    if (reading_.sides) sides_ = reading_.sides(result);
    StoredAttributes attributes{.from = &file_};
    cover.sigma = sigma("/");
    kSizes(attributes, result);
    if (result.configuration_size > static_cast<int>(n))
      file_.fail("the attribute configuration_size is above the number of variables");
    read_options(result.options);
    if (file_.has_attribute("/", "stopped")) result.stopped = file_.attribute<std::string>("/", "stopped");
    if (file_.has("/outputs")) result.outputs = words("/outputs");
    if (file_.has("/outputs") && result.outputs.empty()) file_.fail("/outputs is empty");
    cover.boxes = read_list_of_boxes("/boxes", n, result.outputs.size());
    cover.points = read_list_of_boxes("/points", n, result.outputs.size());
    attributes.object = "/statistics";
    kStatistics(attributes, cover.statistics);
    if ((file_.attribute<std::int64_t>("/", "complete") != 0) != cover.complete())
      file_.fail("the attribute complete contradicts the boxes");
    check_counts(cover);
    cover.wider_than_sigma = file_.attribute<std::uint64_t>("/boxes", "wider_than_sigma");
    if (file_.has_attribute("/boxes", "observed_dimension"))
      cover.observed_dimension = file_.integer("/boxes", "observed_dimension", 1, static_cast<int>(n));
    read_types(cover);
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
    for (const int v : sides_) variables.push_back(result.variables[static_cast<std::size_t>(v)]);
    for (Angle& a : result.angles) {
      a.cosine = place(a.cosine);
      a.sine = place(a.sine);
    }
    std::erase_if(result.angles, [](const Angle& a) { return a.cosine < 0 || a.sine < 0; });
    result.configuration_size =
        static_cast<int>(std::lower_bound(sides_.begin(), sides_.end(), result.configuration_size) - sides_.begin());
    result.variables = std::move(variables);
  }

  std::vector<CoverBox> read_list_of_boxes(const std::string& group, std::size_t n, std::size_t outputs) {
    std::vector<CoverBox> boxes = read_boxes(file_, group, n, reading_.sides ? &sides_ : nullptr, reading_.free);
    if (format_ > kOldest) read_into(file_, group + "/", boxes, kReasonField);
    if (file_.has(group + "/part")) read_into(file_, group + "/", boxes, kPartField);
    if (outputs == 0) return boxes;
    const std::vector<std::uint8_t> passages = file_.enumeration(group + "/passage", kPassageWords);
    const std::vector<double> sides = file_.doubles(group + "/side", boxes.size(), outputs);
    if (passages.size() != boxes.size()) file_.fail(group + " differ in length");
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].passage = static_cast<Passage>(passages[i]);
      const auto side = std::span(sides).subspan(i * outputs, outputs);
      if (boxes[i].passage != Passage::unproven) boxes[i].side.assign(side.begin(), side.end());
    }
    return boxes;
  }

  // Names go to terminals and pages: what could steer those is made visible.
  std::string word(const std::string& name) const { return printable_line(file_.attribute<std::string>("/", name)); }
  std::vector<std::string> words(const std::string& name) const {
    std::vector<std::string> list = file_.texts(name);
    for (std::string& text : list) text = printable_line(text);
    return list;
  }

  void check_counts(const Cover& cover) const {
    const auto counts = cover.counts();
    for (std::size_t v = 0; v < counts.size(); ++v) {
      const std::string name = to_string(static_cast<Verdict>(v));
      if (file_.attribute<std::uint64_t>("/boxes", name) != counts[v])
        file_.fail("the attribute " + name + " of /boxes contradicts the boxes");
    }
  }

  void read_types(Cover& cover) const {
    if (!file_.has_attribute("/boxes", "types_asked")) return;  // none were asked for
    const auto types = [&](const char* name) { return static_cast<TypeSet>(file_.integer("/boxes", name, 0, kAllTypes)); };
    cover.types = {types("types_asked"), types("types_of_set"), file_.attribute<std::uint64_t>("/boxes", "types_left_out")};
    read_into(file_, "/boxes/", cover.boxes, kTypeFields);
    read_into(file_, "/points/", cover.points, kTypeFields);
  }

  void read_options(RunOptions& options) const {
    options.constants = read_constants(file_, "/options/constants/");
    if (file_.has("/options/outputs")) options.outputs = words("/options/outputs");
    StoredAttributes attributes{.from = &file_, .object = "/options"};
    options.sigma = sigma("/options");
    kFurtherOptions(attributes, options);
    if (!options.kernel.empty() && options.kernel != "right" && options.kernel != "left")
      file_.fail("the attribute kernel of /options is neither right nor left: '" + options.kernel + "'");
    if (format_ == kOldest) return;
    kKernelOptions(attributes, options);
    options.kernel_scales = words("/options/kernel_scales");
  }

  Sigma sigma(const char* object) const {
    Sigma sigma;
    if (format_ == kOldest) return {file_.attribute<double>(object, "sigma"), file_.attribute<double>(object, "sigma")};
    StoredAttributes attributes{.from = &file_, .object = object};
    kSigma(attributes, sigma);
    return sigma;
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

}  // namespace corank::result
