// What the files of claims (result/values/claim_files.h) have in common: how they begin, and how what is printed of their
// check ends.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "corank/result/files/stored_list.h"
#include "corank/result/values/claim_files.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::result {

/// The model with its constants put in. Throws symbolic::ModelError.
symbolic::Mechanism model_of(const ModelSource& source);

/// Writes the source, and then what `write` writes.
void write_certificate(const std::filesystem::path& path, const CertificateKind& kind, const ModelSource& source,
                       const Ended& in_haste, const std::function<void(Hdf5Writer&)>& write);
/// Refuses files of another kind or version.
void read_source(const Hdf5Reader& file, const CertificateKind& kind, ModelSource& source);
/// Of a file of one of these kinds, what it is and how it is read: ", but a certificate of corank map, …"; else nothing.
std::string other_kind_words(const Hdf5Reader& file);
/// Reads the source, and then what `read` reads.
template <class File, class Read>
File read_certificate(const std::filesystem::path& path, const CertificateKind& kind, const Read& read) {
  Hdf5Reader file(path.string());
  File data;
  read_source(file, kind, data);
  read(file, data);
  return data;
}

inline constexpr auto kConstant = [](auto& field, auto& constant) {
  field("names", constant.name);
  field("expressions", constant.expression);
};

std::vector<std::string> names(const System& system);
/// ", of every robot within the tolerances of a, b"; nothing without tolerances.
std::string of_every_robot(const std::vector<std::string>& toleranced);
/// The matrix in the variables of the system's polynomials.
PolynomialMatrix polynomials(const symbolic::TrigonometricSystem& system, const symbolic::ExpressionMatrix& matrix);

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
/// An object's last members.
template <class Report>
std::string ended_json(nlohmann::ordered_json json, const Report& report, const std::vector<std::string>& failures) {
  json["failures"] = failures;
  if (report.interrupted) json["stage"] = report.stage;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}
inline nlohmann::ordered_json or_null(const std::optional<int>& x) {
  return x ? nlohmann::ordered_json(*x) : nlohmann::ordered_json();
}

}  // namespace corank::result
