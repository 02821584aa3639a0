#include "corank/study/images.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "corank/certify/angle.h"
#include "corank/certify/compiled_system.h"
#include "corank/certify/projection.h"
#include "corank/certify/trigonometric.h"
#include "corank/core/rounding.h"
#include "corank/result/files/verification.h"
#include "corank/symbolic/sets/boundary.h"
#include "corank/symbolic/sets/idle_coordinates.h"

namespace corank::study {
namespace {

constexpr std::size_t kLeastSteps = 24, kMostSteps = 128;  // of a joint's range

// Joints of which some part is a product with the range.
struct Joint {
  std::string name;
  const Angle* angle = nullptr;  // or a variable
  int variable = -1;

  Interval range(const Box& x) const {
    return angle ? certify::angle_enclosure(x[angle->cosine], x[angle->sine], angle->range) : x[variable];
  }
  void set(const Interval& value, Box& x) const {
    if (!angle) {
      x[variable] = value;
      return;
    }
    x[angle->cosine] = certify::cosine(value);
    x[angle->sine] = certify::sine(value);
  }
};

class Images {
 public:
  Images(const symbolic::Mechanism& model, const result::Result& whole, const System& system)
      : domain_(system.domain()), compiled_(system) {
    const std::vector<std::string> idle = symbolic::idle_coordinates(model.without_rates()).free;
    for (const result::Result& part : whole.parts)
      for (const std::string& name : result::left_out(part)) {
        const auto is_named = [&](const auto& thing) { return thing.name == name; };
        if (std::ranges::find(idle, name) != idle.end() || std::ranges::any_of(joints_, is_named)) continue;
        const auto angle = std::ranges::find_if(whole.angles, is_named);
        const auto variable = std::ranges::find_if(whole.variables, is_named);
        joints_.push_back(
            {name, angle == whole.angles.end() ? nullptr : &*angle, static_cast<int>(variable - whole.variables.begin())});
      }
  }

  /// Those over whose ranges the box is a product.
  std::vector<const Joint*> joints_of(const CoverBox& box) const {
    constexpr double kWhole = 0.99;
    std::vector<const Joint*> result;
    for (const Joint& joint : joints_) {
      const double width = joint.range(box.box).width();
      if (width > 0 && width >= kWhole * joint.range(domain_).width()) result.push_back(&joint);
    }
    return result;
  }

  /// In so many steps of the joint; nullptr: in one.
  std::vector<CoverBox> of(const CoverBox& box, const Joint* joint, std::size_t steps) const {
    const UpwardRounding rounding;
    const Interval range = joint ? joint->range(box.box) : Interval(0);
    const auto end = [&](std::size_t k) {
      return k == steps ? range.hi() : range.lo() + range.width() / static_cast<double>(steps) * static_cast<double>(k);
    };
    std::vector<CoverBox> result;
    for (std::size_t k = 0; k < (joint ? steps : 1); ++k) {
      CoverBox image = box;
      if (joint) joint->set(Interval(end(k), end(k + 1)), image.box);
      if (contract(image.box)) result.push_back(std::move(image));
    }
    return result;
  }

 private:
  // False: no configuration.
  bool contract(Box& box) const {
    constexpr int kSweeps = 2;  // an arm's equations give one coordinate after the other
    std::vector<std::uint8_t> changed(box.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (int row = 0; row < compiled_.rows(); ++row)
        if (!certify::project(compiled_, row, std::span(box).first(domain_.size()), 1, changed.data())) return false;
    return true;
  }

  Box domain_;
  certify::CompiledSystem compiled_;
  std::vector<Joint> joints_;
};

struct Plan {
  Images images;
  std::size_t steps = 0;
  std::vector<const Joint*> joints{};  // of each box, or nullptr
};

// Over two joints of a box images would be as wide as all that they show.
std::optional<Plan> plan(const result::Result& whole, std::uint64_t most) {
  if (!lacks_sides(whole)) return std::nullopt;
  const symbolic::Mechanism model = result::model_of(whole);
  const System system = symbolic::configurations(model);
  const auto same = [](const Variable& a, const result::ResultVariable& b) { return a.name == b.name; };
  if (system.size() != whole.configuration_size ||
      !std::equal(system.variables.begin(), system.variables.end(), whole.variables.begin(), same))
    return std::nullopt;
  std::optional<Plan> plan;
  plan.emplace(Images(model, whole, system));
  std::uint64_t products = 0;
  for (const CoverBox& box : whole.cover.boxes) {
    const std::vector<const Joint*> joints = plan->images.joints_of(box);
    if (joints.size() > 1) return std::nullopt;
    plan->joints.push_back(joints.empty() ? nullptr : joints.front());
    products += joints.size();
  }
  const std::uint64_t others = plan->joints.size() - products;
  if (products == 0) return plan;
  if (most < others + products * kLeastSteps) return std::nullopt;
  plan->steps = std::min<std::uint64_t>(kMostSteps, (most - others) / products);
  return plan;
}

}  // namespace

bool lacks_sides(const result::Result& whole) {
  return std::ranges::any_of(whole.parts, [](const result::Result& part) { return !result::left_out(part).empty(); });
}

bool can_have_images(const result::Result& whole, std::uint64_t most) { return plan(whole, most).has_value(); }

std::optional<result::Result> with_images(const result::Result& whole, std::uint64_t most) {
  const std::optional<Plan> p = plan(whole, most);
  if (!p) return std::nullopt;
  std::vector<std::vector<CoverBox>> found(p->joints.size());
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t i) { found[i] = p->images.of(whole.cover.boxes[i], p->joints[i], p->steps); });
  result::Result result = whole;
  result.cover.boxes.clear();
  for (std::vector<CoverBox>& boxes : found) std::ranges::move(boxes, std::back_inserter(result.cover.boxes));
  return result;
}

}  // namespace corank::study
