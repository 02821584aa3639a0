// Numbers over planes of two parameters: whole maps, and their tiles one by one, for the workers of a cluster.
#include <stdexcept>

#include "corank/analyze/postures/posture_map.h"
#include "corank/python/bindings.h"
#include "corank/python/watched.h"

namespace corank::python {
namespace {

using symbolic::Expression;

class ParameterMap {
 public:
  ParameterMap(const study::Question& question, const std::vector<std::tuple<std::string, Expression, Expression>>& over,
               const std::vector<std::pair<std::string, Expression>>& fixed, const std::string& count, int resolution,
               bool boundary, const std::optional<std::string>& orientation, const std::string& orientation_of)
      : options_{.resolution = resolution, .boundary = boundary, .threads = 1, .progress = {}} {
    const auto answer = analyze::map_answer_from_string(count);
    if (!answer)
      throw std::invalid_argument("count: expected solutions, components, aspects, assembly-modes or working-modes");
    question_.question = question;
    question_.answer = *answer;
    for (const auto& [name, lower, upper] : over) question_.over.push_back({name, lower, upper});
    for (const auto& [name, value] : fixed) question_.fixed.push_back({name, value});
    if (orientation)
      question_ = analyze::posture_map(question, question_.over, question_.fixed, analyze::parse_rotation(*orientation),
                                       orientation_of);
  }

  py::tuple run(int threads, bool certificate, bool cusps, double time_limit, const py::object& progress) const {
    analyze::ParameterMapOptions options = options_;
    options.threads = threads;
    options.certificate = certificate;
    options.cusps = cusps;
    return said(progress, [question = question_, options, time_limit](Watcher& watcher) {
      solve::Control control({.time = time_limit, .stop = &watcher.stop});
      analyze::ParameterMapOptions shown = options;
      shown.progress = [&watcher](std::size_t done, std::size_t all) {
        watcher.show({"map", static_cast<double>(done) / static_cast<double>(all), ""});
      };
      const analyze::ParameterMap map = analyze::parameter_map(question, shown, control);
      std::shared_ptr<result::MapFile> file;
      if (map.claims) file = std::make_shared<result::MapFile>(to_file(question, map));
      return std::tuple(to_json(map), to_table(map), file);
    });
  }

  std::string tile(int number) {
    prepare();
    if (number < 0 || number >= analyze::ParameterMapper::tiles()) throw std::invalid_argument("no such tile");
    return run_whole(py::none(), [mapper = mapper_, number](Watcher& watcher) {
      solve::Control control({.stop = &watcher.stop});
      return to_json(mapper->tile(number, control));
    });
  }

  py::tuple assemble(const std::vector<std::string>& texts) {
    prepare();
    std::vector<analyze::MapTile> tiles;
    for (const std::string& text : texts) tiles.push_back(analyze::tile_from_json(text));
    const analyze::ParameterMap map = mapper_->assemble(std::move(tiles));
    return py::make_tuple(to_json(map), to_table(map));
  }

 private:
  void prepare() {
    if (!mapper_) mapper_ = std::make_shared<const analyze::ParameterMapper>(question_, options_);
  }

  analyze::MapQuestion question_;
  analyze::ParameterMapOptions options_;
  std::shared_ptr<const analyze::ParameterMapper> mapper_;
};

}  // namespace

void bind_maps(py::module_& module) {
  bind_certificate<result::MapFile>(module, "MapFile", &result::write_map);
  py::class_<ParameterMap>(module, "ParameterMap")
      .def(py::init<const study::Question&, const std::vector<std::tuple<std::string, Expression, Expression>>&,
                    const std::vector<std::pair<std::string, Expression>>&, const std::string&, int, bool,
                    const std::optional<std::string>&, const std::string&>())
      .def_property_readonly_static("tiles", [](const py::object&) { return analyze::ParameterMapper::tiles(); })
      .def("run", &ParameterMap::run)
      .def("tile", &ParameterMap::tile)
      .def("assemble", &ParameterMap::assemble);
}

}  // namespace corank::python
