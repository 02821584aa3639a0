// The file of a path.
#include "corank/result/files/source_group.h"
#include "corank/symbolic/sets/requirements.h"
#include "corank/symbolic/sets/velocity_blocks.h"

namespace corank::result {
namespace {

constexpr int kMostNodes = 10'000'000;

// Of n variables; at each node a path holds `dimension` combinations, as many as its set has dimensions.
auto node_fields(std::size_t n, std::size_t dimension) {
  return [n, dimension](auto& field, auto& node) {
    field.row("rows", node.rows, dimension * n);
    field.row("values", node.values, dimension);
    field.box("", node.box, n);
  };
}

auto piece_fields(std::size_t n) {
  return [n](auto& field, auto& piece) { field.box("", piece, n); };
}

void store_numbers(Hdf5Writer& file, const std::string& name, const std::vector<double>& numbers, std::size_t size) {
  file.doubles(name, numbers, size, 0);
}
void store_numbers(const Hdf5Reader& file, const std::string& name, std::vector<double>& numbers, std::size_t size) {
  numbers = file.doubles(name, size, 0);
}

std::vector<symbolic::SingularitySet> avoided_sets(const std::string& avoid) {
  using symbolic::SingularitySet;
  if (avoid == "both") return {SingularitySet::forward, SingularitySet::inverse};
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::requirements})
    if (avoid == symbolic::to_string(set)) return {set};
  return {};
}

template <class File, class Data>
void store_path(File& to, Data& data) {
  const StoredPart file(to);
  auto& tube = data.tube;
  double radius = tube.radius();
  int n = static_cast<int>(data.variables.size()), nodes = static_cast<int>(tube.nodes.size()),
      across = nodes > 0 ? static_cast<int>(tube.nodes.front().values.size()) : 0;
  file("avoid", data.avoid);
  file.check(avoided_sets(data.avoid).size() > 0, "it does not say which singularities it avoids");
  file("radius", radius);
  file("variables", n, 1, kMostVariables);
  file("dimension", across, 1, n);
  file("nodes", nodes, 2, kMostNodes);
  const std::size_t variables = n, pieces = nodes - 1;
  file.texts("/variables", data.variables);
  file.check(data.variables.size() == variables, "its variables are not as many as it says");
  file.list("/nodes/", tube.nodes, node_fields(variables, across));
  file.list("/pieces/", tube.pieces, piece_fields(variables));
  file.check(tube.nodes.size() == pieces + 1 && tube.pieces.size() == pieces, "its nodes are not as many as it says");
  store_numbers(to, "/pieces/radius", tube.radii, pieces);
  store_numbers(to, "/sizes", tube.sizes, variables);
  file.check(radius == tube.radius(), "its radius is not the least of its pieces'");
}

}  // namespace

void write_path(const std::filesystem::path& path, const PathFile& data, const Ended& in_haste) {
  CORANK_CHECK(!data.tube.nodes.empty());
  write_certificate(path, kPathKind, data, in_haste, [&](Hdf5Writer& file) { store_path(file, data); });
}

PathFile read_path(const std::filesystem::path& path) {
  return read_certificate<PathFile>(path, kPathKind, [](Hdf5Reader& file, PathFile& data) { store_path(file, data); });
}

check::TubeReport verify(const PathFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  const symbolic::TrigonometricSystem space = symbolic::singularity_system(model, symbolic::SingularitySet::cspace);
  const System system = symbolic::algebrize(space);
  check::TubeReport report;
  if (names(system) != file.variables) {
    report.failures.emplace_back("its variables are not those of the model");
    return report;
  }
  std::vector<PolynomialMatrix> matrices;
  KeptDistances distances;
  const symbolic::Mechanism others = symbolic::without_distances(model);
  for (const symbolic::SingularitySet set : avoided_sets(file.avoid)) {
    if (set == symbolic::SingularitySet::requirements) {
      distances = symbolic::kept_distances(model, space);
      if (!distances.tests.empty() && others.requirements().empty()) continue;
    }
    std::optional<PolynomialMatrix> matrix = symbolic::locked_polynomials(others, set);
    if (!matrix) {
      report.failures.emplace_back("the model's velocity equation is not a matrix of polynomials");
      return report;
    }
    matrices.push_back(std::move(*matrix));
  }
  return check::check_tube(system, matrices, file.tube, options, distances);
}

std::string to_table(const check::TubeReport& report, const PathFile& file) {
  std::string text = fmt::format(
      "{}: a path without {}{}\n  nodes     {} of {} confirmed\n  pieces    {} of {}\n"
      "  radius    {:.3g}\n",
      printable_line(file.model),
      file.avoid == "requirements" ? "limits of requirements"
                                   : (file.avoid == "both" ? "forward and inverse" : file.avoid) + " singularities",
      of_every_robot(model_of(file).toleranced()), report.nodes, file.tube.nodes.size(), report.pieces,
      file.tube.pieces.size(), file.tube.radius());
  text += failure_lines(report.failures);
  return text + (report.verified() ? "verified\n" : report.failures.empty() ? "interrupted\n" : "NOT VERIFIED\n");
}

std::string to_json(const check::TubeReport& report, const PathFile& file) {
  nlohmann::ordered_json json{{"verified", report.verified()}, {"interrupted", report.interrupted}, {"nodes", report.nodes},
                              {"pieces", report.pieces},       {"radius", file.tube.radius()},      {"avoid", file.avoid},
                              {"failures", report.failures}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace corank::result
