// A map's file: numbers of solutions over cells of a plane of parameters (core/map_claims.h) with the model that they belong
// to, as HDF5; and its verification by check/, which shares nothing with what made it.
#pragma once

#include <filesystem>
#include <string>

#include "corank/check/map.h"
#include "corank/core/ended.h"
#include "corank/core/map_claims.h"
#include "corank/result/source_group.h"
#include "corank/symbolic/family_system.h"

namespace corank::result {

struct MapFile : ModelSource {
  symbolic::FamilyQuestion family;
  MapClaims claims;
};

inline constexpr CertificateKind kMapKind{"corank map", 1};

/// Layout: doc/certificates.md. Throw ResultFileError; symbolic::ModelError where the model has no such family.
/// Once `in_haste` says so, what is left is written as it is.
void write_map(const std::filesystem::path& path, const MapFile& file, const Ended& in_haste = {});
MapFile read_map(const std::filesystem::path& path);

/// Rebuilds the family's equations from the model's text, and checks the claims. Throws symbolic::ModelError where the text
/// is no model of such a family.
check::MapReport verify(const MapFile& file, const check::Options& options = {});

std::string to_table(const check::MapReport& report, const MapFile& file);
/// {"verified", "complete", "interrupted", "over", "cells": {"claimed", "at_least", "complete"}, "sheets", "shares" …}:
/// doc/certificates.md.
std::string to_json(const check::MapReport& report, const MapFile& file);

}  // namespace corank::result
