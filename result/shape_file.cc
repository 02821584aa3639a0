#include "corank/result/shape_file.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "corank/result/cover_group.h"
#include "corank/result/printable.h"
#include "corank/result/stored_list.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/critical_points.h"

namespace corank::result {
namespace {

constexpr int kMostHeights = 16, kMostHeightNumber = 1000, kMostVariables = 100'000, kMostCount = 1'000'000'000;
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

std::string height_group(std::size_t k) { return "/heights/" + std::to_string(k); }

// Boxes have n sides, and so many variables are held or free as the set has dimensions.
auto link_fields(std::size_t n, std::size_t dimension) {
  return [n, dimension](auto& field, auto& link) {
    field("first", link.first, 0, kMostCount);
    field("second", link.second, 0, kMostCount);
    field.row("held", link.held, dimension, 0, kMostVariables);
    field.row("point", link.point, n);
  };
}

auto bridge_fields(std::size_t n, std::size_t dimension) {
  return [n, dimension](auto& field, auto& bridge) {
    field.row("free", bridge.free, dimension, 0, kMostVariables);
    field.box("", bridge.region, n);
  };
}

auto count_fields(const char* name) {
  return [name](auto& field, auto& count) { field(name, count, 0, kMostCount); };
}

void write_claim(Hdf5Writer& file, const char* name, const std::optional<int>& claim) {
  file.attribute("/", name, claim ? std::int64_t{*claim} : kNone);
}

std::optional<int> read_claim(const Hdf5Reader& file, const char* name, int least) {
  if (file.attribute<std::int64_t>("/", name) == kNone) return std::nullopt;
  return file.integer("/", name, least, kMostCount);
}

}  // namespace

void write_shape(const std::filesystem::path& path, const ShapeFile& data, const Ended& in_haste) {
  const Shape& shape = data.shape;
  const symbolic::Mechanism model = model_of(data);
  const System space = space_of(model);
  const std::size_t n = space.variables.size(), dimension = static_cast<std::size_t>(shape.space.dimension);
  write_certificate(path, kShapeKind, data, in_haste, [&](Hdf5Writer& file) {
    file.attribute("/", "variables", static_cast<std::int64_t>(n));
    file.attribute("/", "heights", static_cast<std::int64_t>(shape.heights.size()));
    file.attribute("/", "at_least", std::int64_t{shape.at_least});
    write_claim(file, "at_most", shape.at_most);
    write_claim(file, "euler_characteristic", shape.euler_characteristic);
    write_list(file, "/", shape.genus, count_fields("genus"));
    file.texts("/variables", names(space));
    write_list(file, "/links/", shape.links, link_fields(n, dimension));
    write_list(file, "/bridges/", shape.bridges, bridge_fields(n, dimension));
    write_cover(file, "/space", shape.space, n);
    for (std::size_t k = 0; k < shape.heights.size(); ++k) {
      const HeightCover& height = shape.heights[k];
      const std::vector<std::string> unknowns = names(critical_system(model, height.height).system);
      write_cover(file, height_group(k), height.cover, unknowns.size());
      file.attribute("/", "height", std::int64_t{height.height});
      file.texts("/variables", unknowns);
      write_list(file, "/", height.by_index, count_fields("by_index"));
    }
  });
}

ShapeFile read_shape(const std::filesystem::path& path) {
  Hdf5Reader file(path.string());
  ShapeFile data;
  read_source(file, kShapeKind, data);
  const symbolic::Mechanism model = model_of(data);
  const std::vector<std::string> expected = names(space_of(model));
  if (file.texts("/variables") != expected) file.fail("its variables are not those of the model");
  const std::size_t n = expected.size();
  Shape& shape = data.shape;
  shape.at_least = file.integer("/", "at_least", 0, kMostCount);
  shape.at_most = read_claim(file, "at_most", 0);
  shape.euler_characteristic = read_claim(file, "euler_characteristic", -kMostCount);
  shape.genus = read_list<int>(file, "/", count_fields("genus"));
  shape.space = read_cover(file, "/space", n);
  const auto dimension = static_cast<std::size_t>(shape.space.dimension);
  shape.links = read_list<SheetLink>(file, "/links/", link_fields(n, dimension));
  shape.bridges = read_list<SheetBridge>(file, "/bridges/", bridge_fields(n, dimension));
  shape.heights.resize(static_cast<std::size_t>(file.integer("/", "heights", 0, kMostHeights)));
  for (std::size_t k = 0; k < shape.heights.size(); ++k) {
    HeightCover& height = shape.heights[k];
    file.enter(height_group(k));
    height.height = file.integer("/", "height", 0, kMostHeightNumber);
    height.by_index = read_list<int>(file, "/", count_fields("by_index"));
    const std::vector<std::string> unknowns = file.texts("/variables");
    if (unknowns != names(critical_system(model, height.height).system))
      file.fail("the variables of a height are not those of the model");
    height.cover = read_cover(file, height_group(k), unknowns.size());
  }
  return data;
}

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
  return text + conclusion(report, report.failures,
                           "the counts are those of the boxes in the file, which does not prove that they hold the whole "
                           "set\n");
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
