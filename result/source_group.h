// What all certificates' files have in common: their beginning, which program made them and the model that they speak of;
// and the end of what is printed of their check.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "corank/result/hdf5_file.h"
#include "corank/result/result.h"

namespace corank::result {

struct ModelSource {
  std::string version = result::version();  ///< of the corank that made it
  std::string model, model_text;            ///< as Result::model, model_text
  std::vector<ConstantOverride> constants{};
};

/// The model with its constants put in. Throws symbolic::ModelError.
symbolic::Mechanism model_of(const ModelSource& source);

struct CertificateKind {
  const char* format;  ///< what format_of() says of the file
  int version = 1;
};

/// Writes the source, and then what `write` writes. Once `in_haste` says so, what is left is written as it is.
void write_certificate(const std::filesystem::path& path, const CertificateKind& kind, const ModelSource& source,
                       const Ended& in_haste, const std::function<void(Hdf5Writer&)>& write);
/// Refuses files of another kind or version.
void read_source(const Hdf5Reader& file, const CertificateKind& kind, ModelSource& source);

void write_constants(Hdf5Writer& file, const std::string& group, const std::vector<ConstantOverride>& constants);
std::vector<ConstantOverride> read_constants(const Hdf5Reader& file, const std::string& group);

std::vector<std::string> names(const System& system);

/// A line for each of the first ones, printable, and how many more there are.
std::string failure_lines(const std::vector<std::string>& failures);
/// The last lines of a table. `open`: why the claims may not be complete.
template <class Report>
std::string conclusion(const Report& report, const std::vector<std::string>& failures, const std::string& open) {
  const std::string lines = failure_lines(failures);
  if (report.complete()) return lines + "verified\n";
  if (report.verified()) return lines + open + "verified, except for completeness\n";
  return lines + (report.interrupted && failures.empty()
                      ? "interrupted in " + report.stage + "; nothing is said about the rest\n"
                      : "NOT VERIFIED\n");
}

}  // namespace corank::result
