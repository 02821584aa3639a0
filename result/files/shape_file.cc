// The file of a set's shape.
#include <limits>
#include <numeric>

#include "corank/result/files/cover_group.h"
#include "corank/result/files/source_group.h"
#include "corank/symbolic/sets/critical_points.h"

namespace corank::result {
namespace {

constexpr int kMostHeights = 16, kMostHeightNumber = 1000, kMostCount = 1'000'000'000;
constexpr std::int64_t kNotClaimed = std::numeric_limits<std::int64_t>::min();  // of a number that is not claimed

System space_of(const symbolic::Mechanism& model) {
  return symbolic::algebrize(model.is_plain_system()
                                 ? symbolic::plain_system(model)
                                 : symbolic::singularity_system(model, symbolic::SingularitySet::cspace));
}

check::CriticalSystem critical_system(const symbolic::Mechanism& model, int height) {
  const symbolic::CriticalPoints critical = symbolic::critical_points(model, height);
  return {symbolic::algebrize(critical.system), polynomials(critical.system, critical.hessian),
          polynomials(critical.system, critical.jacobian),
          symbolic::polynomials(critical.system, {critical.multiplier}).front()};
}

std::string height_group(std::size_t k) { return "/heights/" + std::to_string(k); }

// Boxes have n sides; as many variables are held or free as the set has dimensions.
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

template <class File, class Data>
void store_shape(File& to, Data& data) {
  constexpr bool writes = StoredPart<File>::kWrites;
  const StoredPart file(to);
  const symbolic::Mechanism model = model_of(data);
  const System space = space_of(model);
  const std::size_t n = space.variables.size();
  auto& shape = data.shape;
  int heights = static_cast<int>(shape.heights.size());
  if constexpr (writes) to.attribute("/", "variables", static_cast<std::int64_t>(n));
  file("heights", heights, 0, kMostHeights);
  file("at_least", shape.at_least, 0, kMostCount);
  file.optional("at_most", shape.at_most, 0, kMostCount, kNotClaimed);
  file.optional("euler_characteristic", shape.euler_characteristic, -kMostCount, kMostCount, kNotClaimed);
  file.list("/", shape.genus, count_fields("genus"));
  file.same("/variables", names(space), "its variables are not those of the model");
  if constexpr (!writes) shape.space = read_cover(to, "/space", n);
  const std::size_t dimension = shape.space.dimension;
  file.list("/links/", shape.links, link_fields(n, dimension));
  file.list("/bridges/", shape.bridges, bridge_fields(n, dimension));
  if constexpr (writes) write_cover(to, "/space", shape.space, n);
  if constexpr (!writes) shape.heights.resize(heights);
  for (std::size_t k = 0; k < shape.heights.size(); ++k) {
    auto& height = shape.heights[k];
    if constexpr (!writes) {
      to.enter(height_group(k));
      file("height", height.height, 0, kMostHeightNumber);
    }
    const std::vector<std::string> unknowns = names(critical_system(model, height.height).system);
    if constexpr (writes) {
      write_cover(to, height_group(k), height.cover, unknowns.size());
      file("height", height.height);
    }
    file.same("/variables", unknowns, "the variables of a height are not those of the model");
    file.list("/", height.by_index, count_fields("by_index"));
    if constexpr (!writes) height.cover = read_cover(to, height_group(k), unknowns.size());
  }
}

}  // namespace

void write_shape(const std::filesystem::path& path, const ShapeFile& data, const Ended& in_haste) {
  write_certificate(path, kShapeKind, data, in_haste, [&](Hdf5Writer& file) { store_shape(file, data); });
}

ShapeFile read_shape(const std::filesystem::path& path) {
  return read_certificate<ShapeFile>(path, kShapeKind, [](Hdf5Reader& file, ShapeFile& data) { store_shape(file, data); });
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
  const Shape& shape = file.shape;
  return ended_json({{"verified", report.verified()},
                     {"complete", report.complete()},
                     {"interrupted", report.interrupted},
                     {"components", {{"at_least", shape.at_least}, {"at_most", or_null(shape.at_most)}}},
                     {"confirmed", {{"at_least", report.at_least}, {"at_most", report.at_most}}},
                     {"euler_characteristic", or_null(shape.euler_characteristic)},
                     {"genus", shape.genus},
                     {"critical_points", report.by_index},
                     {"sheets", report.sheets},
                     {"links", report.links},
                     {"contacts_excluded", report.apart}},
                    report, report.failures);
}

}  // namespace corank::result
