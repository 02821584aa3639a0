// The beginning of a certificate's file (result/model_source.h), and the end of what is printed of its check.
#pragma once

#include "corank/result/hdf5_file.h"
#include "corank/result/model_source.h"

namespace corank::result {

/// `format`: what format_of() says of the file.
void write_source(Hdf5Writer& file, const std::string& format, std::int64_t format_version, const ModelSource& source);
/// Refuses files of another format or version.
void read_source(const Hdf5Reader& file, const std::string& format, std::int64_t format_version, ModelSource& source);

std::vector<std::string> names(const System& system);

/// A line for each of the first ones, printable, and how many more there are.
std::string failure_lines(const std::vector<std::string>& failures);

}  // namespace corank::result
