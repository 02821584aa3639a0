#include "corank/result/files/source_group.h"

#include <fmt/ranges.h>

#include "corank/result/files/output_file.h"

namespace corank::result {

symbolic::Mechanism model_of(const ModelSource& source) {
  Result result;
  result.model = source.model;
  result.model_text = source.model_text;
  result.options.constants = source.constants;
  return model_of(result);
}

void write_certificate(const std::filesystem::path& path, const CertificateKind& kind, const ModelSource& source,
                       const Ended& in_haste, const std::function<void(Hdf5Writer&)>& write) {
  const OutputFile target(path);
  Hdf5Writer file(target.part().string(), 1, in_haste);
  file.attribute("/", "format", std::string(kind.format));
  file.attribute("/", "format_version", std::int64_t{kind.version});
  file.attribute("/", "version", source.version);
  file.attribute("/", "model", source.model);
  file.text("/model/text", source.model_text);
  write_list(file, "/model/constants/", source.constants, kConstant);
  write(file);
  file.close();
  target.finish();
}

std::string other_kind_words(const Hdf5Reader& file) {
  if (!file.has_attribute("/", "format")) return "";
  const auto format = file.attribute<std::string>("/", "format");
  for (const CertificateKind& kind : {kShapeKind, kPiecesKind, kPathKind, kMapKind})
    if (format == kind.format) return fmt::format(", but a certificate of {}, which corank verify reads", format);
  return "";
}

void read_source(const Hdf5Reader& file, const CertificateKind& kind, ModelSource& source) {
  if (!file.has_attribute("/", "format") || file.attribute<std::string>("/", "format") != kind.format)
    file.fail(std::string("this is not a ") + kind.format);
  if (file.attribute<std::int64_t>("/", "format_version") != kind.version)
    file.fail("a format version that this corank cannot read");
  source.version = file.attribute<std::string>("/", "version");
  source.model = file.attribute<std::string>("/", "model");
  source.model_text = file.text("/model/text");
  source.constants = read_list<ConstantOverride>(file, "/model/constants/", kConstant);
}

std::vector<std::string> names(const System& system) {
  std::vector<std::string> list;
  for (const Variable& v : system.variables) list.push_back(v.name);
  return list;
}

std::string of_every_robot(const std::vector<std::string>& toleranced) {
  return toleranced.empty() ? "" : fmt::format(", of every robot within the tolerances of {}", fmt::join(toleranced, ", "));
}

PolynomialMatrix polynomials(const symbolic::TrigonometricSystem& system, const symbolic::ExpressionMatrix& matrix) {
  PolynomialMatrix result{static_cast<int>(matrix.rows.size()), static_cast<int>(matrix.columns.size()), {}};
  for (const auto& row : matrix.rows)
    for (Polynomial& f : symbolic::polynomials(system, row)) result.entries.push_back(std::move(f));
  return result;
}

std::string failure_lines(const std::vector<std::string>& failures) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t k = 0; k < std::min(failures.size(), kShown); ++k) text += "  " + printable_line(failures[k]) + "\n";
  if (failures.size() > kShown) text += fmt::format("  … and {} more\n", failures.size() - kShown);
  return text;
}

}  // namespace corank::result
