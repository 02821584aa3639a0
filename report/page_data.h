// What the scripts of a report's page read: the model as JSON and each result's boxes as numbers in base64.
//
// The boxes are those that are drawn (SetView::drawn), all of them, in the result's order. Their bounds are doubles rounded
// outward to floats, so a box of the page holds the box of the result file and is at most one float wider on each side.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "corank/report/set_view.h"
#include "corank/result/result.h"
#include "corank/symbolic/velocity_equation.h"

namespace corank::report {

/// Constants in doubles: for pictures, not for proofs.
using ConstantValues = std::map<std::string, double>;
ConstantValues constant_values(const symbolic::Mechanism& mechanism);

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// JSON that may stand inside <script>: without "<", since "</script" ends one and "<!--<script" makes the next end not
/// count.
std::string script_safe(std::string json);

/// Little-endian floats, box after box: lower and upper bound of each variable in turn.
std::string box_payload(std::span<const CoverBox> boxes);
/// The same of these variables only.
std::string box_payload(std::span<const CoverBox> boxes, std::span<const int> variables);
/// A byte for each box: the index of its verdict in Verdict.
std::string verdict_payload(std::span<const CoverBox> boxes);

/// CSS: --set-NAME, a set's colour; for elements of the class NAME it is --set, and --swatch that of a small area.
std::string set_style();

/// The coordinates, the drawing and each set with its variables, equations and points: one JSON object.
std::string page_model(const symbolic::Mechanism& mechanism, const symbolic::Derivation& derivation,
                       const std::vector<SetView>& views);

}  // namespace corank::report
