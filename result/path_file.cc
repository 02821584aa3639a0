#include "corank/result/path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/core/check.h"
#include "corank/result/hdf5_file.h"
#include "corank/result/output_file.h"
#include "corank/result/printable.h"
#include "corank/result/source_group.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/velocity_blocks.h"

namespace corank::result {
namespace {

constexpr std::int64_t kPathVersion = 2;
constexpr std::int64_t kMostNodes = 10'000'000, kMostVariables = 100'000;

void write_boxes(Hdf5Writer& file, const std::string& group, const std::vector<const Box*>& boxes, std::size_t n) {
  std::vector<double> lower, upper;
  for (const Box* box : boxes) {
    CORANK_CHECK(box->size() == n);
    for (const Interval& side : *box) {
      lower.push_back(side.lo());
      upper.push_back(side.hi());
    }
  }
  file.doubles(group + "/lower", lower, boxes.size(), n);
  file.doubles(group + "/upper", upper, boxes.size(), n);
}

std::vector<Box> read_boxes(const Hdf5Reader& file, const std::string& group, std::size_t count, std::size_t n) {
  const std::vector<double> lower = file.doubles(group + "/lower", count, n),
                            upper = file.doubles(group + "/upper", count, n);
  std::vector<Box> boxes(count);
  for (std::size_t k = 0; k < count * n; ++k) {
    if (!(lower[k] <= upper[k]))
      throw ResultFileError(file.path() + ": a box in " + group + " has a side that is not an interval");
    boxes[k / n].emplace_back(lower[k], upper[k]);
  }
  return boxes;
}

}  // namespace

void write_path(const std::filesystem::path& path, const PathFile& data) {
  const OutputFile target(path);
  Hdf5Writer file(target.part().string());
  const std::size_t n = data.variables.size(), nodes = data.tube.nodes.size();
  CORANK_CHECK(nodes > 0);
  const std::size_t across = data.tube.nodes.front().values.size();
  write_source(file, kPathFormat, kPathVersion, data);
  file.attribute("/", "avoid", data.avoid);
  file.attribute("/", "radius", data.tube.radius());
  file.attribute("/", "variables", static_cast<std::int64_t>(n));
  file.attribute("/", "dimension", static_cast<std::int64_t>(across));
  file.attribute("/", "nodes", static_cast<std::int64_t>(nodes));
  file.texts("/variables", data.variables);
  std::vector<double> rows, values;
  std::vector<const Box*> boxes, pieces;
  for (const TubeNode& node : data.tube.nodes) {
    rows.insert(rows.end(), node.rows.begin(), node.rows.end());
    values.insert(values.end(), node.values.begin(), node.values.end());
    boxes.push_back(&node.box);
  }
  for (const Box& piece : data.tube.pieces) pieces.push_back(&piece);
  file.doubles("/nodes/rows", rows, nodes, across * n);
  file.doubles("/nodes/values", values, nodes, across);
  write_boxes(file, "/nodes", boxes, n);
  write_boxes(file, "/pieces", pieces, n);
  file.doubles("/pieces/radius", data.tube.radii, data.tube.radii.size(), 0);
  file.doubles("/sizes", data.tube.sizes, n, 0);
  file.close();
  target.finish();
}

bool is_path_file(const std::filesystem::path& path) { return format_of(path.string()) == kPathFormat; }

PathFile read_path(const std::filesystem::path& path) {
  const Hdf5Reader file(path.string());
  const auto refuse = [&](const std::string& what) { throw ResultFileError(file.path() + ": " + what); };
  const auto count = [&](const std::string& name, std::int64_t least, std::int64_t most) {
    const std::int64_t value = file.integer_attribute("/", name);
    if (value < least || value > most) refuse("the attribute " + name + " is out of range");
    return static_cast<std::size_t>(value);
  };
  PathFile data;
  read_source(file, kPathFormat, kPathVersion, data);
  data.avoid = file.text_attribute("/", "avoid");
  if (data.avoid != "forward" && data.avoid != "inverse" && data.avoid != "both")
    refuse("it does not say which singularities it avoids");
  const std::size_t n = count("variables", 1, kMostVariables), across = count("dimension", 1, static_cast<std::int64_t>(n)),
                    nodes = count("nodes", 2, kMostNodes);
  data.variables = file.texts("/variables");
  if (data.variables.size() != n) refuse("its variables are not as many as it says");
  const std::vector<double> rows = file.doubles("/nodes/rows", nodes, across * n),
                            values = file.doubles("/nodes/values", nodes, across);
  const std::vector<Box> boxes = read_boxes(file, "/nodes", nodes, n);
  for (std::size_t k = 0; k < nodes; ++k) {
    const auto part = [&](const std::vector<double>& list, std::size_t size) {
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(k * size);
      return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(size));
    };
    data.tube.nodes.push_back({part(rows, across * n), part(values, across), boxes[k]});
  }
  data.tube.pieces = read_boxes(file, "/pieces", nodes - 1, n);
  data.tube.radii = file.doubles("/pieces/radius", nodes - 1, 0);
  data.tube.sizes = file.doubles("/sizes", n, 0);
  if (file.double_attribute("/", "radius") != data.tube.radius()) refuse("its radius is not the least of its pieces'");
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
