#include "corank/result/result_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "corank/core/check.h"
#include "corank/result/certificate_file.h"
#include "corank/result/checkpoint.h"
#include "corank/result/cover_group.h"
#include "corank/result/output_file.h"
#include "corank/result/printable.h"
#include "corank/symbolic/set_definition.h"

namespace corank::result {
namespace {

constexpr const char* kFormat = "corank result";
constexpr const char* kAssembly = "/assembly";
constexpr int kFirstWithCertificates = 2;
constexpr int kMostCorank = 1000;
constexpr std::int64_t kMostParts = 1000;
constexpr int kFirstWithScales = 4;  // and two sigmas, and reasons

std::vector<std::string> reason_words() {
  std::vector<std::string> words;
  for (int i = 0; i < kReasons; ++i) words.push_back(to_string(static_cast<Reason>(i)));
  return words;
}

std::vector<std::string> passage_words() {
  std::vector<std::string> words;
  for (int i = 0; i < kPassages; ++i) words.push_back(to_string(static_cast<Passage>(i)));
  return words;
}

const std::vector<std::string>& kind_words() {
  static const std::vector<std::string> words{"length", "cosine", "sine", "kernel", "auxiliary"};
  return words;
}

void write_reasons(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes) {
  std::vector<std::uint8_t> reasons(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) reasons[i] = static_cast<std::uint8_t>(boxes[i].reason);
  file.enumeration(group + "/reason", reasons, reason_words());
}

// Of a workspace boundary.
void write_passages(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, const Result& result) {
  if (result.outputs.empty()) return;
  const std::size_t n = result.outputs.size();
  std::vector<std::uint8_t> passages;
  std::vector<double> sides(boxes.size() * n, 0.0);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    passages.push_back(static_cast<std::uint8_t>(boxes[i].passage));
    CORANK_CHECK(boxes[i].side.empty() || boxes[i].side.size() == n);
    std::copy(boxes[i].side.begin(), boxes[i].side.end(), sides.begin() + static_cast<std::ptrdiff_t>(i * n));
  }
  file.enumeration(group + "/passage", passages, passage_words());
  file.doubles(group + "/side", sides, boxes.size(), n);
}

// Of a whole, from which part each box comes.
void write_parts(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, const Result& result) {
  if (result.parts.empty()) return;
  std::vector<std::int64_t> parts;
  for (const CoverBox& box : boxes) parts.push_back(box.part);
  file.integers(group + "/part", parts);
}

// Bits of the types' names, in the order of the attribute `types`.
void write_types(Hdf5Writer& file, const Cover& cover) {
  if (cover.types.asked == 0) return;
  std::string names;
  for (const SingularityType type : kSingularityTypes) names += (names.empty() ? "" : " ") + std::string(to_string(type));
  file.attribute("/boxes", "types", names);
  file.attribute("/boxes", "types_asked", std::int64_t{cover.types.asked});
  file.attribute("/boxes", "types_of_set", std::int64_t{cover.types.of_set});
  file.attribute("/boxes", "types_left_out", std::uint64_t{cover.types.left_out});
  for (const auto& [group, list] : {std::pair("/boxes", &cover.boxes), std::pair("/points", &cover.points)}) {
    std::vector<std::uint8_t> proven, excluded;
    proven.reserve(list->size());
    excluded.reserve(list->size());
    for (const CoverBox& box : *list) {
      proven.push_back(box.types.proven);
      excluded.push_back(box.types.excluded);
    }
    file.packed(std::string(group) + "/types_proven", proven);
    file.packed(std::string(group) + "/types_excluded", excluded);
  }
}

void write_counts(Hdf5Writer& file, const Cover& cover) {
  const auto counts = cover.counts();
  for (std::size_t v = 0; v < counts.size(); ++v)
    file.attribute("/boxes", to_string(static_cast<Verdict>(v)), std::uint64_t{counts[v]});
  file.attribute("/boxes", "wider_than_sigma", std::uint64_t{cover.wider_than_sigma});
  if (cover.observed_dimension > 0) file.attribute("/boxes", "observed_dimension", std::int64_t{cover.observed_dimension});
}

void write_variables(Hdf5Writer& file, const Result& result) {
  std::vector<std::string> names;
  std::vector<std::uint8_t> kinds;
  std::vector<double> domain;
  for (const ResultVariable& v : result.variables) {
    names.push_back(v.name);
    kinds.push_back(static_cast<std::uint8_t>(v.kind));
    domain.insert(domain.end(), {v.domain.lo(), v.domain.hi()});
  }
  file.texts("/variables/names", names);
  file.enumeration("/variables/kinds", kinds, kind_words());
  file.doubles("/variables/domain", domain, names.size(), 2);
}

void write_angles(Hdf5Writer& file, const Result& result) {
  std::vector<std::string> names;
  std::vector<std::int64_t> cosines, sines;
  std::vector<double> range;
  for (const Angle& a : result.angles) {
    names.push_back(a.name);
    cosines.push_back(a.cosine);
    sines.push_back(a.sine);
    range.insert(range.end(), {a.range.lo(), a.range.hi()});
  }
  file.texts("/angles/names", names);
  file.integers("/angles/cosine", cosines);
  file.integers("/angles/sine", sines);
  file.doubles("/angles/range", range, names.size(), 2);
}

void write_options(Hdf5Writer& file, const RunOptions& options) {
  std::vector<std::string> names, expressions;
  for (const ConstantOverride& c : options.constants) {
    names.push_back(c.name);
    expressions.push_back(c.expression);
  }
  file.texts("/options/constants/names", names);
  file.texts("/options/constants/expressions", expressions);
  if (!options.outputs.empty()) file.texts("/options/outputs", options.outputs);
  file.attribute("/options", "kernel", options.kernel);
  file.attribute("/options", "sigma_length", options.sigma.length);
  file.attribute("/options", "sigma_angle", options.sigma.angle);
  file.texts("/options/kernel_scales", options.kernel_scales);
  file.attribute("/options", "corank", std::int64_t{options.corank});
  file.attribute("/options", "passive_rates_eliminated", std::int64_t{options.passive_rates_eliminated});
  file.attribute("/options", "tolerance", options.tolerance);
  file.attribute("/options", "threads", std::int64_t{options.threads});
  file.attribute("/options", "max_boxes", options.max_boxes);
  file.attribute("/options", "max_solutions", options.max_solutions);
  file.attribute("/options", "time_limit", options.time_limit);
}

void write_statistics(Hdf5Writer& file, const Statistics& statistics) {
  file.group("/statistics");
  file.attribute("/statistics", "processed", statistics.processed);
  file.attribute("/statistics", "newton_steps", statistics.newton_steps);
  file.attribute("/statistics", "proofs_tried", statistics.proofs_tried);
  file.attribute("/statistics", "seconds_total", statistics.seconds_total);
  file.attribute("/statistics", "seconds_search", statistics.seconds_search);
  file.attribute("/statistics", "seconds_certify", statistics.seconds_certify);
}

// --- reading ---

class ResultReader {
 public:
  explicit ResultReader(Hdf5Reader file, Reading reading = {}) : file_(std::move(file)), reading_(std::move(reading)) {
    if (!file_.has_attribute("/", "format") || file_.text_attribute("/", "format") != kFormat) {
      refuse("this is not a corank result");
    }
    format_ = file_.integer_attribute("/", "format_version");
    if (format_ < 1 || format_ > kFormatVersion) {
      refuse("format version " + std::to_string(format_) + "; this corank reads up to " + std::to_string(kFormatVersion));
    }
  }

  Result read() {
    reading_.free = reading_.free || file_.has_attribute("/", "parts");
    Result result = read_one(nullptr);
    if (reading_.sides) return result;
    if (file_.has_attribute("/", "nearly_solved")) result.nearly_solved = file_.integer_attribute("/", "nearly_solved") != 0;
    if (file_.has_attribute("/", "assembly")) {
      file_.enter(kAssembly);
      result.assembly.push_back(read_one(&result));
      result.assembly.back().set = symbolic::to_string(symbolic::SingularitySet::cspace);
      file_.enter("");
    }
    if (!file_.has_attribute("/", "parts")) return result;
    const std::int64_t parts = file_.integer_attribute("/", "parts");
    if (parts < 1 || parts > kMostParts) refuse("the attribute parts is out of range");
    for (std::int64_t i = 0; i < parts; ++i) {
      file_.enter("/parts/" + std::to_string(i));
      Result part = read_one(&result);
      part.part = word("/", "part");
      if (file_.has_attribute("/", "condition")) part.condition = word("/", "condition");
      if (part.outputs != result.outputs) refuse("a part has other outputs than the whole");
      result.parts.push_back(std::move(part));
    }
    file_.enter("");
    for (auto* boxes : {&result.cover.boxes, &result.cover.points})
      for (const CoverBox& box : *boxes)
        if (box.part < 0 || box.part >= parts) refuse("a box names a part that does not exist");
    return result;
  }

 private:
  // Of a part, model and set are those of the whole.
  Result read_one(const Result* whole) {
    Result result;
    if (whole) {
      result.version = whole->version;
      result.model = whole->model;
      result.set = whole->set;
      result.model_text = whole->model_text;
    } else {
      result.version = word("/", "version");
      result.model = word("/", "model");
      result.set = word("/", "set");
      result.model_text = file_.text("/model/text");
    }
    result.system_text = file_.text("/model/system");
    read_variables(result);
    read_angles(result);
    sides_.resize(result.variables.size());
    std::iota(sides_.begin(), sides_.end(), 0);
    if (reading_.sides) sides_ = reading_.sides(result);
    result.configuration_size = count("configuration_size");
    result.equations = count("equations");
    result.inequalities = count("inequalities");
    if (result.configuration_size > static_cast<int>(result.variables.size()))
      refuse("the attribute configuration_size is above the number of variables");
    read_options(result.options);
    if (file_.has_attribute("/", "stopped")) result.stopped = file_.text_attribute("/", "stopped");
    result.cover.dimension = count("dimension");
    result.cover.sigma = sigma("/");
    result.cover.tolerance = file_.double_attribute("/", "tolerance");
    result.cover.boxes = boxes("/boxes", result.variables.size());
    result.cover.points = boxes("/points", result.variables.size());
    read_statistics(result.cover.statistics);
    if ((file_.integer_attribute("/", "complete") != 0) != result.cover.complete()) {
      refuse("the attribute complete contradicts the boxes");
    }
    if (format_ >= kFirstWithCertificates) {
      check_counts(result.cover);
      result.cover.wider_than_sigma = file_.unsigned_attribute("/boxes", "wider_than_sigma");
      if (file_.has_attribute("/boxes", "observed_dimension")) {
        const std::int64_t observed = file_.integer_attribute("/boxes", "observed_dimension");
        if (observed < 1 || observed > static_cast<std::int64_t>(result.variables.size()))
          refuse("the attribute observed_dimension of /boxes is out of range");
        result.cover.observed_dimension = static_cast<int>(observed);
      }
      read_types(result.cover);
      if (!reading_.sides) read_certificates(file_, result.cover, result.variables.size());
    }
    if (file_.has("/outputs")) {
      result.outputs = words("/outputs");
      if (result.outputs.empty()) refuse("/outputs is empty");
      read_passages("/boxes", result.outputs.size(), result.cover.boxes);
      read_passages("/points", result.outputs.size(), result.cover.points);
    }
    read_parts("/boxes", result.cover.boxes);
    read_parts("/points", result.cover.points);
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

  void read_passages(const std::string& group, std::size_t n, std::vector<CoverBox>& boxes) const {
    const std::vector<std::uint8_t> passages = file_.enumeration(group + "/passage", passage_words());
    const std::vector<double> sides = file_.doubles(group + "/side", boxes.size(), n);
    if (passages.size() != boxes.size()) refuse(group + " differ in length");
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].passage = static_cast<Passage>(passages[i]);
      if (boxes[i].passage != Passage::unproven)
        boxes[i].side.assign(sides.begin() + static_cast<std::ptrdiff_t>(i * n),
                             sides.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
    }
  }

  void read_parts(const std::string& group, std::vector<CoverBox>& boxes) const {
    if (!file_.has(group + "/part")) return;
    const std::vector<std::int64_t> parts = file_.integers(group + "/part");
    if (parts.size() != boxes.size()) refuse(group + " differ in length");
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (parts[i] < -1 || parts[i] > kMostParts) refuse(group + "/part names a part that does not exist");
      boxes[i].part = static_cast<int>(parts[i]);
    }
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw ResultFileError(printable_line(file_.path() + ": " + problem));
  }

  // Names go to terminals and pages: what could steer those is made visible.
  std::string word(const std::string& object, const std::string& name) const {
    return printable_line(file_.text_attribute(object, name));
  }
  std::vector<std::string> words(const std::string& name) const {
    std::vector<std::string> list = file_.texts(name);
    for (std::string& text : list) text = printable_line(text);
    return list;
  }

  int count(const std::string& name) const {
    const std::int64_t value = file_.integer_attribute("/", name);
    if (value < 0 || value > 1'000'000'000) refuse("the attribute " + name + " is out of range");
    return static_cast<int>(value);
  }

  Interval interval(double lower, double upper, const std::string& where) const {
    if (!(lower <= upper)) refuse(where + " holds an empty interval");
    return {lower, upper};
  }

  void check_counts(const Cover& cover) const {
    const auto check = [&](const std::string& name, std::size_t boxes) {
      if (file_.unsigned_attribute("/boxes", name) != boxes)
        refuse("the attribute " + name + " of /boxes contradicts the boxes");
    };
    const auto counts = cover.counts();
    for (std::size_t v = 0; v < counts.size(); ++v) check(to_string(static_cast<Verdict>(v)), counts[v]);
  }

  void read_types(Cover& cover) const {
    if (!file_.has_attribute("/boxes", "types_asked")) return;  // older files
    const auto types = [&](const std::string& name) {
      const std::int64_t value = file_.integer_attribute("/boxes", name);
      if (value < 0 || value > kAllTypes) refuse("the attribute " + name + " of /boxes is out of range");
      return static_cast<TypeSet>(value);
    };
    cover.types = {types("types_asked"), types("types_of_set"), file_.unsigned_attribute("/boxes", "types_left_out")};
    for (const auto& [group, list] : {std::pair("/boxes", &cover.boxes), std::pair("/points", &cover.points)}) {
      std::vector<std::uint8_t> proven, excluded;
      file_.read(std::string(group) + "/types_proven", proven);
      file_.read(std::string(group) + "/types_excluded", excluded);
      if (proven.size() != list->size() || excluded.size() != list->size())
        refuse(std::string(group) + "/types_proven or _excluded has another length than the list of boxes");
      for (std::size_t i = 0; i < list->size(); ++i) {
        if (proven[i] > kAllTypes || excluded[i] > kAllTypes)
          refuse(std::string(group) + "/types_proven or _excluded is out of range");
        (*list)[i].types = {proven[i], excluded[i]};
      }
    }
  }

  void read_variables(Result& result) const {
    const std::vector<std::string> names = words("/variables/names");
    const std::vector<std::uint8_t> kinds = file_.enumeration("/variables/kinds", kind_words());
    const std::vector<double> domain = file_.doubles("/variables/domain", names.size(), 2);
    if (kinds.size() != names.size()) refuse("/variables/kinds and names differ in length");
    for (std::size_t i = 0; i < names.size(); ++i) {
      result.variables.push_back(
          {names[i], static_cast<VariableKind>(kinds[i]), interval(domain[2 * i], domain[2 * i + 1], "/variables/domain")});
    }
  }

  void read_angles(Result& result) const {
    const std::vector<std::string> names = words("/angles/names");
    const std::vector<std::int64_t> cosines = file_.integers("/angles/cosine"), sines = file_.integers("/angles/sine");
    const std::vector<double> range = file_.doubles("/angles/range", names.size(), 2);
    if (cosines.size() != names.size() || sines.size() != names.size()) refuse("/angles differ in length");
    const auto n = static_cast<std::int64_t>(result.variables.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::min(cosines[i], sines[i]) < 0 || std::max(cosines[i], sines[i]) >= n) refuse("/angles name no variable");
      result.angles.push_back({names[i], static_cast<int>(cosines[i]), static_cast<int>(sines[i]),
                               interval(range[2 * i], range[2 * i + 1], "/angles/range")});
    }
  }

  Sigma sigma(const std::string& group) const {
    if (format_ < kFirstWithScales) {
      const double both = file_.double_attribute(group, "sigma");
      return {both, both};
    }
    return {file_.double_attribute(group, "sigma_length"), file_.double_attribute(group, "sigma_angle")};
  }

  void read_options(RunOptions& options) const {
    const std::vector<std::string> names = words("/options/constants/names");
    const std::vector<std::string> expressions = words("/options/constants/expressions");
    if (names.size() != expressions.size()) refuse("/options/constants differ in length");
    for (std::size_t i = 0; i < names.size(); ++i) options.constants.push_back({names[i], expressions[i]});
    if (file_.has("/options/outputs")) options.outputs = words("/options/outputs");
    options.kernel = word("/options", "kernel");
    if (!options.kernel.empty() && options.kernel != "right" && options.kernel != "left")
      refuse("the attribute kernel of /options is neither right nor left: '" + options.kernel + "'");
    if (file_.has_attribute("/options", "corank")) {  // older files know 1 only
      const std::int64_t corank = file_.integer_attribute("/options", "corank");
      if (corank < 1 || corank > static_cast<std::int64_t>(kMostCorank))
        refuse("the attribute corank of /options is out of range");
      options.corank = static_cast<int>(corank);
    }
    if (file_.has_attribute("/options", "passive_rates_eliminated"))
      options.passive_rates_eliminated = file_.integer_attribute("/options", "passive_rates_eliminated") != 0;
    options.sigma = sigma("/options");
    if (format_ >= kFirstWithScales) options.kernel_scales = words("/options/kernel_scales");
    const std::int64_t threads = file_.integer_attribute("/options", "threads");
    if (threads < 0 || threads > 1'000'000) refuse("the attribute threads of /options is out of range");
    options.threads = static_cast<int>(threads);
    options.tolerance = file_.double_attribute("/options", "tolerance");
    options.max_boxes = file_.unsigned_attribute("/options", "max_boxes");
    options.max_solutions = file_.unsigned_attribute("/options", "max_solutions");
    options.time_limit = file_.double_attribute("/options", "time_limit");
  }

  void read_statistics(Statistics& statistics) const {
    statistics.processed = file_.unsigned_attribute("/statistics", "processed");
    statistics.newton_steps = file_.unsigned_attribute("/statistics", "newton_steps");
    statistics.proofs_tried = file_.unsigned_attribute("/statistics", "proofs_tried");
    statistics.seconds_total = file_.double_attribute("/statistics", "seconds_total");
    statistics.seconds_search = file_.double_attribute("/statistics", "seconds_search");
    statistics.seconds_certify = file_.double_attribute("/statistics", "seconds_certify");
  }

  std::vector<CoverBox> boxes(const std::string& group, std::size_t n) {
    const std::vector<std::uint8_t> verdict = file_.enumeration(group + "/verdict", verdict_words());
    std::vector<std::uint8_t> reason(verdict.size(), 0);
    if (format_ >= kFirstWithScales) reason = file_.enumeration(group + "/reason", reason_words());
    if (reason.size() != verdict.size()) refuse(group + "/reason has another length than the verdicts");
    std::vector<CoverBox> boxes(verdict.size());
    file_.take_rows({group + "/lower", group + "/upper"}, group + "/free", boxes.size(), n,
                    [&](std::size_t i, std::span<const std::span<const double>> ends, std::span<const std::uint8_t> free) {
                      CoverBox& b = boxes[i];
                      b.box.reserve(sides_.size());  // no more: there may be many
                      for (const int side : sides_) {
                        const auto v = static_cast<std::size_t>(side);
                        b.box.push_back(interval(ends[0][v], ends[1][v], group));
                      }
                      if (!reading_.free) return;
                      b.free.reserve(n - static_cast<std::size_t>(std::count(free.begin(), free.end(), 0)));
                      for (std::size_t v = 0; v < n; ++v)
                        if (free[v] != 0) b.free.push_back(static_cast<int>(v));
                    });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].verdict = static_cast<Verdict>(verdict[i]);
      boxes[i].reason = static_cast<Reason>(reason[i]);
    }
    return boxes;
  }

  Hdf5Reader file_;
  Reading reading_;
  std::vector<int> sides_;
  std::int64_t format_ = 0;
};

}  // namespace

void check_writable(const std::filesystem::path& path) { const OutputFile created_and_removed(path); }

namespace {

// What a part has of its own, and a result without parts.
void write_own(Hdf5Writer& file, const Result& result) {
  file.attribute("/", "stopped", result.stopped);
  file.attribute("/", "complete", std::int64_t{result.cover.complete()});
  file.attribute("/", "dimension", std::int64_t{result.cover.dimension});
  file.attribute("/", "sigma_length", result.cover.sigma.length);
  file.attribute("/", "sigma_angle", result.cover.sigma.angle);
  file.attribute("/", "tolerance", result.cover.tolerance);
  file.attribute("/", "configuration_size", std::int64_t{result.configuration_size});
  file.attribute("/", "equations", std::int64_t{result.equations});
  file.attribute("/", "inequalities", std::int64_t{result.inequalities});
  file.text("/model/system", result.system_text);
  write_variables(file, result);
  write_angles(file, result);
  write_options(file, result.options);
  if (!result.outputs.empty()) file.texts("/outputs", result.outputs);
  write_boxes(file, "/boxes", result.cover.boxes, result.variables.size());
  write_reasons(file, "/boxes", result.cover.boxes);
  write_passages(file, "/boxes", result.cover.boxes, result);
  write_parts(file, "/boxes", result.cover.boxes, result);
  write_counts(file, result.cover);
  write_boxes(file, "/points", result.cover.points, result.variables.size());
  write_reasons(file, "/points", result.cover.points);
  write_passages(file, "/points", result.cover.points, result);
  write_parts(file, "/points", result.cover.points, result);
  write_types(file, result.cover);
  write_statistics(file, result.cover.statistics);
  write_certificates(file, result.cover, result.variables.size());
}

}  // namespace

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
