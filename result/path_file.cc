#include "corank/result/path_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corank/core/check.h"
#include "corank/result/printable.h"
#include "corank/result/stored_list.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/velocity_blocks.h"

namespace corank::result {
namespace {

constexpr std::int64_t kMostNodes = 10'000'000, kMostVariables = 100'000;

// n variables, of which a path of a set of such a dimension holds so many combinations at each node.
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

}  // namespace

void write_path(const std::filesystem::path& path, const PathFile& data) {
  const std::size_t n = data.variables.size(), nodes = data.tube.nodes.size();
  CORANK_CHECK(nodes > 0);
  const std::size_t across = data.tube.nodes.front().values.size();
  write_certificate(path, kPathKind, data, {}, [&](Hdf5Writer& file) {
    file.attribute("/", "avoid", data.avoid);
    file.attribute("/", "radius", data.tube.radius());
    file.attribute("/", "variables", static_cast<std::int64_t>(n));
    file.attribute("/", "dimension", static_cast<std::int64_t>(across));
    file.attribute("/", "nodes", static_cast<std::int64_t>(nodes));
    file.texts("/variables", data.variables);
    write_list(file, "/nodes/", data.tube.nodes, node_fields(n, across));
    write_list(file, "/pieces/", data.tube.pieces, piece_fields(n));
    file.doubles("/pieces/radius", data.tube.radii, data.tube.radii.size(), 0);
    file.doubles("/sizes", data.tube.sizes, n, 0);
  });
}

PathFile read_path(const std::filesystem::path& path) {
  const Hdf5Reader file(path.string());
  PathFile data;
  read_source(file, kPathKind, data);
  data.avoid = file.attribute<std::string>("/", "avoid");
  if (data.avoid != "forward" && data.avoid != "inverse" && data.avoid != "both")
    file.fail("it does not say which singularities it avoids");
  const auto n = static_cast<std::size_t>(file.integer("/", "variables", 1, kMostVariables)),
             across = static_cast<std::size_t>(file.integer("/", "dimension", 1, static_cast<std::int64_t>(n))),
             nodes = static_cast<std::size_t>(file.integer("/", "nodes", 2, kMostNodes));
  data.variables = file.texts("/variables");
  if (data.variables.size() != n) file.fail("its variables are not as many as it says");
  data.tube.nodes = read_list<TubeNode>(file, "/nodes/", node_fields(n, across));
  data.tube.pieces = read_list<Box>(file, "/pieces/", piece_fields(n));
  if (data.tube.nodes.size() != nodes || data.tube.pieces.size() != nodes - 1)
    file.fail("its nodes are not as many as it says");
  data.tube.radii = file.doubles("/pieces/radius", nodes - 1, 0);
  data.tube.sizes = file.doubles("/sizes", n, 0);
  if (file.attribute<double>("/", "radius") != data.tube.radius()) file.fail("its radius is not the least of its pieces'");
  return data;
}

check::TubeReport verify(const PathFile& file, const check::Options& options) {
  const symbolic::Mechanism model = model_of(file);
  const System system =
      symbolic::algebrize(symbolic::singularity_system(model, symbolic::SingularitySet::cspace, std::nullopt, {}, 1));
  check::TubeReport report;
  if (names(system) != file.variables) {
    report.failures.emplace_back("its variables are not those of the model");
    return report;
  }
  std::vector<PolynomialMatrix> matrices;
  for (const auto& [set, block, other] : {std::tuple(symbolic::SingularitySet::forward, Block::forward, "inverse"),
                                          std::tuple(symbolic::SingularitySet::inverse, Block::inverse, "forward")}) {
    if (file.avoid == other) continue;
    const auto blocks = symbolic::velocity_blocks(model, set);
    if (!blocks) {
      report.failures.emplace_back("the model's velocity equation is not a matrix of polynomials");
      return report;
    }
    matrices.push_back(blocks->matrices[static_cast<std::size_t>(block)]);
  }
  return check::check_tube(system, matrices, file.tube, options);
}

std::string to_table(const check::TubeReport& report, const PathFile& file) {
  std::string text = fmt::format(
      "{}: a path without {} singularities\n  nodes     {} of {} confirmed\n  pieces    {} of {}\n"
      "  radius    {:.3g}\n",
      printable_line(file.model), file.avoid == "both" ? "forward and inverse" : file.avoid, report.nodes,
      file.tube.nodes.size(), report.pieces, file.tube.pieces.size(), file.tube.radius());
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
