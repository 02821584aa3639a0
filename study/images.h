// An arm's set in its joints, in the space of its outputs: for pictures.
#pragma once

#include <cstdint>
#include <optional>

#include "corank/result/values/result.h"

namespace corank::study {

/// Are parts about an arm's joints alone?
bool lacks_sides(const result::Result& whole);

/// Would with_images() have steps that are narrow enough?
bool can_have_images(const result::Result& whole, std::uint64_t most);

/// Where parts are about an arm's joints alone, the boxes of the whole say nothing of its other coordinates, and nothing of
/// the joints over whose ranges a part is a product. Here those ranges are cut into steps, as many as give at most `most`
/// boxes, and the other coordinates enclosed by the arm's equations (certify::project). What is left of a box holds its
/// solutions with joints in those steps; what was proven of them, a kernel's dimension or a passage, is as true of these.
/// Whether it holds some is not asked again: for pictures, not for files. Nothing unless can_have_images().
std::optional<result::Result> with_images(const result::Result& whole, std::uint64_t most);

}  // namespace corank::study
