#include "corank/result/shape_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corank/core/check.h"
#include "corank/result/cover_group.h"
#include "corank/result/hdf5_file.h"
#include "corank/result/output_file.h"
#include "corank/result/printable.h"
#include "corank/result/source_group.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/critical_points.h"

namespace corank::result {
namespace {

constexpr std::int64_t kShapeVersion = 1;
constexpr std::int64_t kMostHeights = 16, kMostHeightNumber = 1000, kMostVariables = 100'000;
constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();  // of a number that is not claimed

System space_of(const symbolic::Mechanism& model) {
  return symbolic::algebrize(
      model.is_plain_system() ? symbolic::plain_system(model)
                              : symbolic::singularity_system(model, symbolic::SingularitySet::cspace, std::nullopt, {}, 1));
}

check::CriticalSystem critical_system(const symbolic::Mechanism& model, int height) {
  const symbolic::CriticalPoints critical = symbolic::critical_points(model, height);
  const auto matrix = [&](const symbolic::ExpressionMatrix& m) {
    PolynomialMatrix result{static_cast<int>(m.rows.size()), static_cast<int>(critical.names.size()), {}};
    for (const auto& row : m.rows)
      for (Polynomial& f : symbolic::polynomials(critical.system, row)) result.entries.push_back(std::move(f));
    return result;
  };
  return {symbolic::algebrize(critical.system), matrix(critical.hessian), matrix(critical.jacobian),
          symbolic::polynomials(critical.system, {critical.multiplier}).front()};
}

std::vector<std::int64_t> wide(const std::vector<int>& list) { return {list.begin(), list.end()}; }

std::string height_group(std::size_t k) { return "/heights/" + std::to_string(k); }

}  // namespace

void write_shape(const std::filesystem::path& path, const ShapeFile& data, const Ended& in_haste) {
  const Shape& shape = data.shape;
  const System space = space_of(model_of(data));
  const std::size_t n = space.variables.size();
  const OutputFile target(path);
  Hdf5Writer file(target.part().string(), 1, in_haste);
  write_source(file, kShapeFormat, kShapeVersion, data);
  file.attribute("/", "variables", static_cast<std::int64_t>(n));
  file.attribute("/", "heights", static_cast<std::int64_t>(shape.heights.size()));
  file.attribute("/", "at_least", std::int64_t{shape.at_least});
  file.attribute("/", "at_most", shape.at_most ? std::int64_t{*shape.at_most} : kNone);
  file.attribute("/", "euler_characteristic",
                 shape.euler_characteristic ? std::int64_t{*shape.euler_characteristic} : kNone);
  file.integers("/genus", wide(shape.genus));
  file.texts("/variables", names(space));
  const std::size_t dimension = static_cast<std::size_t>(shape.space.dimension);
  std::vector<std::int64_t> first, second, held, free;
  std::vector<double> points, lower, upper;
  for (const SheetLink& link : shape.links) {
    CORANK_CHECK(link.held.size() == dimension && link.point.size() == n);
    first.push_back(link.first);
    second.push_back(link.second);
    held.insert(held.end(), link.held.begin(), link.held.end());
    points.insert(points.end(), link.point.begin(), link.point.end());
  }
  file.integers("/links/first", first);
  file.integers("/links/second", second);
  file.integers("/links/held", held);
  file.doubles("/links/point", points, shape.links.size(), n);
  for (const SheetBridge& bridge : shape.bridges) {
    CORANK_CHECK(bridge.free.size() == dimension && bridge.region.size() == n);
    free.insert(free.end(), bridge.free.begin(), bridge.free.end());
    for (const Interval& side : bridge.region) {
      lower.push_back(side.lo());
      upper.push_back(side.hi());
    }
  }
  file.integers("/bridges/free", free);
  file.doubles("/bridges/lower", lower, shape.bridges.size(), n);
  file.doubles("/bridges/upper", upper, shape.bridges.size(), n);
  write_cover(file, "/space", shape.space, n);
  for (std::size_t k = 0; k < shape.heights.size(); ++k) {
    const HeightCover& height = shape.heights[k];
    const std::vector<std::string> unknowns = names(critical_system(model_of(data), height.height).system);
    write_cover(file, height_group(k), height.cover, unknowns.size());
    file.attribute("/", "height", std::int64_t{height.height});
    file.texts("/variables", unknowns);
    file.integers("/by_index", wide(height.by_index));
  }
  file.close();
  target.finish();
}

bool is_shape_file(const std::filesystem::path& path) { return format_of(path.string()) == kShapeFormat; }

namespace {

class ShapeReader {
 public:
  explicit ShapeReader(const std::filesystem::path& path) : file_(path.string()) {}

  ShapeFile read() {
    ShapeFile data;
    read_source(file_, kShapeFormat, kShapeVersion, data);
    const symbolic::Mechanism model = model_of(data);
    const std::vector<std::string> expected = names(space_of(model));
    if (file_.texts("/variables") != expected) refuse("its variables are not those of the model");
    n_ = expected.size();
    Shape& shape = data.shape;
    shape.at_least = static_cast<int>(in("at_least", file_.integer_attribute("/", "at_least"), 0, kMostCount));
    shape.at_most = claim("at_most", 0);
    shape.euler_characteristic = claim("euler_characteristic", -kMostCount);
    shape.genus = small("/genus", kMostCount);
    shape.space = read_cover(file_, "/space", n_);
    read_links(shape);
    const std::int64_t heights = in("heights", file_.integer_attribute("/", "heights"), 0, kMostHeights);
    for (std::int64_t k = 0; k < heights; ++k) {
      const std::string group = height_group(static_cast<std::size_t>(k));
      HeightCover& height = shape.heights.emplace_back();
      file_.enter(group);
      height.height = static_cast<int>(in("height", file_.integer_attribute("/", "height"), 0, kMostHeightNumber));
      height.by_index = small("/by_index", kMostCount);
      const std::vector<std::string> unknowns = file_.texts("/variables");
      if (unknowns != names(critical_system(model, height.height).system))
        refuse("the variables of a height are not those of the model");
      height.cover = read_cover(file_, group, unknowns.size());
    }
    return data;
  }

 private:
  static constexpr std::int64_t kMostCount = 1'000'000'000;

  [[noreturn]] void refuse(const std::string& what) const { throw ResultFileError(file_.path() + ": " + what); }
  std::int64_t in(const std::string& name, std::int64_t value, std::int64_t least, std::int64_t most) const {
    if (value < least || value > most) refuse(name + " is out of range");
    return value;
  }
  std::optional<int> claim(const std::string& name, std::int64_t least) const {
    const std::int64_t value = file_.integer_attribute("/", name);
    if (value == kNone) return std::nullopt;
    return static_cast<int>(in(name, value, least, kMostCount));
  }
  std::vector<int> small(const std::string& name, std::int64_t most) const {
    std::vector<int> list;
    for (const std::int64_t value : file_.integers(name)) list.push_back(static_cast<int>(in(name, value, 0, most)));
    return list;
  }

  void read_links(Shape& shape) const {
    const std::size_t dimension = static_cast<std::size_t>(shape.space.dimension);
    const std::vector<int> first = small("/links/first", kMostCount), second = small("/links/second", kMostCount),
                           held = small("/links/held", kMostVariables), free = small("/bridges/free", kMostVariables);
    if (second.size() != first.size() || held.size() != first.size() * dimension) refuse("its links differ in length");
    const std::vector<double> points = file_.doubles("/links/point", first.size(), n_);
    const auto part = [](const auto& list, std::size_t k, std::size_t size) {
      const auto begin = list.begin() + static_cast<std::ptrdiff_t>(k * size);
      return std::vector(begin, begin + static_cast<std::ptrdiff_t>(size));
    };
    for (std::size_t k = 0; k < first.size(); ++k)
      shape.links.push_back({first[k], second[k], part(held, k, dimension), part(points, k, n_)});
    if (dimension == 0 ? !free.empty() : free.size() % dimension != 0) refuse("its bridges differ in length");
    const std::size_t bridges = dimension == 0 ? 0 : free.size() / dimension;
    const std::vector<double> lower = file_.doubles("/bridges/lower", bridges, n_),
                              upper = file_.doubles("/bridges/upper", bridges, n_);
    for (std::size_t k = 0; k < bridges; ++k) {
      shape.bridges.push_back({part(free, k, dimension), {}});
      for (std::size_t j = k * n_; j < (k + 1) * n_; ++j) {
        if (!(lower[j] <= upper[j])) refuse("a bridge's box has a side that is not an interval");
        shape.bridges.back().region.emplace_back(lower[j], upper[j]);
      }
    }
  }

  Hdf5Reader file_;
  std::size_t n_ = 0;
};

}  // namespace

ShapeFile read_shape(const std::filesystem::path& path) { return ShapeReader(path).read(); }

check::ShapeReport verify(const ShapeFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  std::vector<check::CriticalSystem> heights;
  for (const HeightCover& height : file.shape.heights) heights.push_back(critical_system(model, height.height));
  return check::check_shape(space_of(model), file.shape, heights, options);
}

std::string to_table(const check::ShapeReport& report, const ShapeFile& file) {
  const Shape& shape = file.shape;
  std::string text =
      fmt::format("{}: the shape of a set of dimension {}\n", printable_line(file.model), shape.space.dimension);
  text += fmt::format("  boxes                 {}, {} sheets of {} confirmed, {} links of {}, {} contacts excluded\n",
                      shape.space.boxes.size(), report.sheets, shape.space.regions.size() + shape.bridges.size(),
                      report.links, shape.links.size(), report.apart);
  text += fmt::format("  components            claimed: at least {}{}; confirmed: {} to {}\n", shape.at_least,
                      shape.at_most ? fmt::format(", at most {}", *shape.at_most) : "", report.at_least, report.at_most);
  if (shape.euler_characteristic) text += fmt::format("  Euler characteristic  {}\n", *shape.euler_characteristic);
  if (!shape.genus.empty()) text += fmt::format("  genus                 {}\n", fmt::join(shape.genus, ", "));
  for (const std::vector<int>& by_index : report.by_index)
    text += fmt::format("  critical points       {} confirmed, by index: {}\n",
                        std::accumulate(by_index.begin(), by_index.end(), 0), fmt::join(by_index, ", "));
  text += failure_lines(report.failures);
  if (report.complete()) return text + "verified\n";
  if (report.verified())
    return text + "the counts are those of the boxes in the file, which does not prove that they hold the whole set\n" +
           "verified, except for completeness\n";
  return text + (report.failures.empty() ? "interrupted in " + report.stage + "; nothing is said about the rest\n"
                                         : "NOT VERIFIED\n");
}

std::string to_json(const check::ShapeReport& report, const ShapeFile& file) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<int>& x) { return x ? Json(*x) : Json(); };
  Json json{{"verified", report.verified()},
            {"complete", report.complete()},
            {"interrupted", report.interrupted},
            {"components", {{"at_least", file.shape.at_least}, {"at_most", or_null(file.shape.at_most)}}},
            {"confirmed", {{"at_least", report.at_least}, {"at_most", report.at_most}}},
            {"euler_characteristic", or_null(file.shape.euler_characteristic)},
            {"genus", file.shape.genus},
            {"critical_points", report.by_index},
            {"sheets", report.sheets},
            {"links", report.links},
            {"contacts_excluded", report.apart},
            {"failures", report.failures}};
  if (report.interrupted) json["stage"] = report.stage;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::result
