#include "corank/result/source_group.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/result/printable.h"

namespace corank::result {

symbolic::Mechanism model_of(const ModelSource& source) {
  Result result;
  result.model = source.model;
  result.model_text = source.model_text;
  result.options.constants = source.constants;
  return model_of(result);
}

void write_source(Hdf5Writer& file, const std::string& format, std::int64_t format_version, const ModelSource& source) {
  file.attribute("/", "format", format);
  file.attribute("/", "format_version", format_version);
  file.attribute("/", "version", source.version);
  file.attribute("/", "model", source.model);
  file.text("/model/text", source.model_text);
  std::vector<std::string> constants, expressions;
  for (const ConstantOverride& c : source.constants) {
    constants.push_back(c.name);
    expressions.push_back(c.expression);
  }
  file.texts("/model/constants/names", constants);
  file.texts("/model/constants/expressions", expressions);
}

void read_source(const Hdf5Reader& file, const std::string& format, std::int64_t format_version, ModelSource& source) {
  const auto refuse = [&](const std::string& what) { throw ResultFileError(file.path() + ": " + what); };
  if (!file.has_attribute("/", "format") || file.text_attribute("/", "format") != format) refuse("this is not a " + format);
  if (file.integer_attribute("/", "format_version") != format_version)
    refuse("a format version that this corank cannot read");
  source.version = file.text_attribute("/", "version");
  source.model = file.text_attribute("/", "model");
  source.model_text = file.text("/model/text");
  const std::vector<std::string> constants = file.texts("/model/constants/names"),
                                 expressions = file.texts("/model/constants/expressions");
  if (constants.size() != expressions.size()) refuse("its constants do not have a value each");
  for (std::size_t k = 0; k < constants.size(); ++k) source.constants.push_back({constants[k], expressions[k]});
}

std::vector<std::string> names(const System& system) {
  std::vector<std::string> list;
  for (const Variable& v : system.variables) list.push_back(v.name);
  return list;
}

std::string failure_lines(const std::vector<std::string>& failures) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t k = 0; k < std::min(failures.size(), kShown); ++k) text += "  " + printable_line(failures[k]) + "\n";
  if (failures.size() > kShown) text += fmt::format("  … and {} more\n", failures.size() - kShown);
  return text;
}

}  // namespace corank::result
