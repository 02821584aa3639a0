// What the scripts of a report's page read: the model as JSON and each result's boxes as numbers in base64.
//
// The boxes are those of the result, all of them, in its order. Their bounds are doubles rounded outward to floats, so a box
// of the page holds the box of the result file and is at most one float wider on each side.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "corank/result/result.h"
#include "corank/symbolic/mechanism.h"

namespace corank::report {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// JSON that may stand inside <script>: without "<", since "</script" ends one and "<!--<script" makes the next end not
/// count.
std::string script_safe(std::string json);

/// The float below or equal, above or equal.
float float_below(double x);
float float_above(double x);

/// Little-endian floats, box after box: lower and upper bound of each variable in turn.
std::string box_payload(const result::Result& result);
/// The same of these variables only.
std::string box_payload(const result::Result& result, std::span<const int> variables);
/// A byte for each box: the index of its verdict in Verdict.
std::string verdict_payload(const result::Result& result);

/// The coordinates, the drawing and, for each result, its set with variables, equations and points: one JSON object. Throws
/// ResultFileError where a result is none of this mechanism: its variables differ from those of the mechanism's set.
std::string page_model(const symbolic::Mechanism& mechanism, const std::vector<result::Result>& results);

}  // namespace corank::report
