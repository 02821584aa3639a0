// Numbers over planes of two parameters: whole maps, and their tiles one by one, for the workers of a cluster.
#include <stdexcept>

#include "corank/analyze/parameter_map.h"
#include "corank/python/bindings.h"
#include "corank/python/model.h"
#include "corank/python/watched.h"

namespace corank::python {
namespace {

using symbolic::Expression;

struct Texts {
  std::string json, table;
};

class ParameterMap {
 public:
  ParameterMap(const Model& model, const std::optional<std::string>& set,
               const std::vector<std::tuple<std::string, Expression, Expression>>& over,
               const std::vector<std::pair<std::string, Expression>>& fixed, const std::string& count, int resolution,
               bool boundary)
      : options_{.resolution = resolution, .boundary = boundary, .threads = 1, .progress = {}} {
    const auto answer = analyze::map_answer_from_string(count);
    if (!answer)
      throw std::invalid_argument("count: expected solutions, components, aspects, assembly-modes or working-modes");
    std::optional<std::string> asked = set;
    if (!asked && !model.mechanism().is_plain_system()) asked = "cspace";
    question_.question = question_of(model, asked);
    question_.answer = *answer;
    for (const auto& [name, lower, upper] : over) question_.over.push_back({name, lower, upper});
    for (const auto& [name, value] : fixed) question_.fixed.push_back({name, value});
  }

  py::tuple run(int threads, bool certificate, double time_limit, const py::object& progress) const {
    struct Said {
      Texts texts;
      std::shared_ptr<result::MapFile> file;
    };
    auto [said, raised] =
        run_for(progress, [question = question_, options = options_, threads, certificate, time_limit](Watcher& watcher) {
          solve::Control control({.time = time_limit, .stop = &watcher.stop});
          analyze::ParameterMapOptions own = options;
          own.threads = threads;
          own.certificate = certificate;
          own.progress = [&watcher](std::size_t done, std::size_t all) {
            watcher.show({"map", static_cast<double>(done) / static_cast<double>(all), ""});
          };
          const analyze::ParameterMap map = analyze::parameter_map(question, own, control);
          Said result{{to_json(map), to_table(map)}, {}};
          if (map.claims) result.file = std::make_shared<result::MapFile>(to_file(question, map));
          return result;
        });
    return py::make_tuple(said.texts.json, said.texts.table, said.file, raised);
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
  py::class_<result::MapFile, std::shared_ptr<result::MapFile>>(module, "MapFile")
      .def("write", [](const result::MapFile& file, const std::string& path) { result::write_map(path, file); });
  module.def("verify_map", [](const result::MapFile& file, int threads, const py::object& progress) {
    auto [texts, raised] = run_for(progress, [file, threads](Watcher& watcher) {
      check::Options options;
      options.threads = threads;
      options.ended = [&watcher] { return watcher.stop.load(); };
      const check::MapReport report = result::verify(file, options);
      return Texts{to_json(report, file), to_table(report, file)};
    });
    return py::make_tuple(texts.json, texts.table, raised);
  });
  py::class_<ParameterMap>(module, "ParameterMap")
      .def(py::init<const Model&, const std::optional<std::string>&,
                    const std::vector<std::tuple<std::string, Expression, Expression>>&,
                    const std::vector<std::pair<std::string, Expression>>&, const std::string&, int, bool>())
      .def_property_readonly_static("tiles", [](const py::object&) { return analyze::ParameterMapper::tiles(); })
      .def("run", &ParameterMap::run)
      .def("tile", &ParameterMap::tile)
      .def("assemble", &ParameterMap::assemble);
}

}  // namespace corank::python
