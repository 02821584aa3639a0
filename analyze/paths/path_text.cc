#include <fmt/format.h>

#include <array>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/paths/path.h"
#include "corank/result/values/claim_files.h"

namespace corank::analyze {
namespace {

Json values_of(const System& system, const Box& box) {
  Json json = Json::object();
  for (const CoordinateValue& v : coordinate_values(system, box)) json[v.name] = v.value.mid();
  return json;
}

std::string radius_text(const System& system, const Tube& tube) {
  const std::optional<double> length = length_size(system, tube);
  std::string text = fmt::format("{:.3g}", tube.radius());
  if (length) text += fmt::format(" in sines and cosines, {:.3g} in lengths", tube.radius() * *length);
  return text;
}

}  // namespace

std::optional<double> length_size(const System& system, const Tube& tube) {
  for (std::size_t j = 0; j < system.variables.size(); ++j)
    if (system.variables[j].is_plain_length()) return tube.sizes[j];
  return std::nullopt;
}

namespace {
constexpr std::array kAvoids{"forward", "inverse", "both", "requirements"};
}

const char* to_string(Avoid avoid) { return kAvoids.at(static_cast<std::size_t>(avoid)); }

std::optional<Avoid> avoid_from_string(const std::string& text) {
  for (std::size_t k = 0; k < kAvoids.size(); ++k)
    if (text == kAvoids[k]) return static_cast<Avoid>(k);
  return std::nullopt;
}

std::string in_words(Avoid avoid) {
  if (avoid == Avoid::requirements) return "limits of requirements";
  return std::string(avoid == Avoid::both ? "forward and inverse" : to_string(avoid)) + " singularities";
}

const char* to_string(Path::Status status) {
  constexpr std::array kNames{"path", "separated", "unknown"};
  return kNames.at(static_cast<std::size_t>(status));
}

std::string to_text(const PathFinder& finder, const Path& path) {
  std::string text = fmt::format("{}, {} avoided\n", finder.question().model.name(), in_words(finder.options().avoid));
  const auto line = [&](const std::string& name, const std::string& value) {
    text += fmt::format("  {:<10}  {}\n", name, value);
  };
  if (const auto toleranced = finder.question().model.toleranced(); !toleranced.empty())
    line("robots", fmt::format("every one within the tolerances of {}", fmt::join(toleranced, ", ")));
  line("status", path.status == Path::Status::path        ? "path, proven"
                 : path.status == Path::Status::separated ? "separated: it is proven that no such path exists"
                                                          : "unknown");
  if (!path.reason.empty()) line("", path.reason);
  if (finder.options().avoid == Avoid::requirements) {
    const std::vector<std::string> required = finder.question().model.requirement_texts();
    for (const std::string& r : required) line("required", r);
    const char* const where = path.tube ? "all along the path" : "at the start";
    line("", !path.standing ? "whether it is met is not examined where constants have tolerances"
             : *path.standing == Standing::satisfied
                 ? fmt::format("{}met {}, proven", required.size() == 1 ? "" : "all of them ", where)
             : *path.standing == Standing::violated
                 ? fmt::format("{}violated {}, proven", required.size() == 1 ? "" : "one of them ", where)
                 : "whether it is met is not known");
  }
  if (path.tube) {
    line("radius", radius_text(finder.system(), *path.tube));
    line("length", fmt::format("{:.4g}", path.length));
    line("pieces",
         fmt::format("{}, found {}", path.tube->pieces.size(), path.method == "direct" ? "directly" : "by " + path.method));
  } else if (path.resolution > 0) {
    line("resolution", fmt::format("{:g}", path.resolution));
  }
  return text + stopped_line(path.stopped);
}

std::string to_json(const PathFinder& finder, const Path& path) {
  Json json{{"model", finder.question().model.name()},
            {"status", to_string(path.status)},
            {"avoid", to_string(finder.options().avoid)},
            {"from", values_of(finder.system(), path.from)},
            {"to", values_of(finder.system(), path.to)},
            {"waypoints", Json::array()},
            {"radius", nullptr},
            {"length_radius", nullptr},
            {"radii", Json::array()},
            {"length", nullptr},
            {"method", or_null(path.method)},
            {"reason", or_null(path.reason)},
            {"stopped", or_null(path.stopped)},
            {"resolution", path.resolution > 0 ? Json(path.resolution) : Json()},
            {"seconds", path.seconds}};
  if (path.standing) {
    json["require"] = finder.question().model.requirement_texts();
    json["standing"] = to_string(*path.standing);
  }
  if (path.tube) {
    std::vector<std::string> names;
    for (const std::vector<double>& row : node_values(finder.system(), *path.tube, names)) {
      Json point = Json::object();
      for (std::size_t j = 0; j < names.size(); ++j) point[names[j]] = row[j];
      json["waypoints"].push_back(std::move(point));
    }
    json["radius"] = path.tube->radius();
    if (const auto length = length_size(finder.system(), *path.tube)) json["length_radius"] = *length * path.tube->radius();
    json["radii"] = path.tube->radii;
    json["length"] = path.length;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_csv(const PathFinder& finder, const Path& path) {
  if (!path.tube) return "";
  std::vector<std::string> names;
  const auto rows = node_values(finder.system(), *path.tube, names);
  std::string text;
  for (const std::string& name : names) text += name + ",";
  text += "radius\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const double value : rows[k]) text += fmt::format("{:.17g},", value);
    text += k < path.tube->radii.size() ? fmt::format("{:.17g}\n", path.tube->radii[k]) : "\n";
  }
  return text;
}

result::PathFile to_file(const PathFinder& finder, const Path& path) {
  auto file = file_about<result::PathFile>(finder.question());
  file.avoid = to_string(finder.options().avoid);
  for (const Variable& v : finder.system().variables) file.variables.push_back(v.name);
  file.tube = *path.tube;
  return file;
}

}  // namespace corank::analyze
