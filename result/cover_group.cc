#include "corank/result/cover_group.h"

#include <algorithm>

#include "corank/core/check.h"
#include "corank/result/certificate_file.h"
#include "corank/result/stored_list.h"

namespace corank::result {

namespace {
const EnumWords kVerdictWords = words_of<Verdict>(kVerdicts);
}  // namespace

void write_boxes(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, std::size_t n) {
  std::vector<std::uint8_t> verdict;
  for (const CoverBox& box : boxes) {
    CORANK_CHECK(box.box.size() == n);
    verdict.push_back(static_cast<std::uint8_t>(box.verdict));
  }
  file.doubles(group + "/lower", boxes.size(), n, [&](std::size_t i, std::span<double> to) {
    for (std::size_t j = 0; j < n; ++j) to[j] = boxes[i].box[j].lo();
  });
  file.doubles(group + "/upper", boxes.size(), n, [&](std::size_t i, std::span<double> to) {
    for (std::size_t j = 0; j < n; ++j) to[j] = boxes[i].box[j].hi();
  });
  file.enumeration(group + "/verdict", verdict, kVerdictWords);
  file.bytes(group + "/free", boxes.size(), n, [&](std::size_t i, std::span<std::uint8_t> to) {
    for (const int f : boxes[i].free) {
      CORANK_CHECK(static_cast<std::size_t>(f) < n);
      to[static_cast<std::size_t>(f)] = 1;
    }
  });
}

std::vector<CoverBox> read_boxes(Hdf5Reader& file, const std::string& group, std::size_t n, const std::vector<int>* sides,
                                 bool with_free) {
  const std::vector<std::uint8_t> verdict = file.enumeration(group + "/verdict", kVerdictWords);
  std::vector<CoverBox> boxes(verdict.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].verdict = static_cast<Verdict>(verdict[i]);
  file.take_rows({group + "/lower", group + "/upper"}, group + "/free", boxes.size(), n,
                 [&](std::size_t i, std::span<const std::span<const double>> ends, std::span<const std::uint8_t> free) {
                   CoverBox& b = boxes[i];
                   b.box.reserve(sides ? sides->size() : n);  // no more: there may be many
                   const auto add = [&](std::size_t j) {
                     if (!(ends[0][j] <= ends[1][j])) file.fail(group + " holds an empty interval");
                     b.box.emplace_back(ends[0][j], ends[1][j]);
                   };
                   for (std::size_t k = 0; k < (sides ? sides->size() : n); ++k)
                     add(sides ? static_cast<std::size_t>((*sides)[k]) : k);
                   if (!with_free) return;
                   b.free.reserve(n - static_cast<std::size_t>(std::count(free.begin(), free.end(), 0)));
                   for (std::size_t j = 0; j < n; ++j)
                     if (free[j] != 0) b.free.push_back(static_cast<int>(j));
                 });
  return boxes;
}

void write_cover(Hdf5Writer& file, const std::string& group, const Cover& cover, std::size_t variables) {
  file.enter(group);
  file.attribute("/", "dimension", std::int64_t{cover.dimension});
  file.attribute("/", "sigma_length", cover.sigma.length);
  file.attribute("/", "sigma_angle", cover.sigma.angle);
  write_boxes(file, "/boxes", cover.boxes, variables);
  write_boxes(file, "/points", cover.points, variables);
  write_certificates(file, cover, variables);
}

Cover read_cover(Hdf5Reader& file, const std::string& group, std::size_t variables) {
  file.enter(group);
  Cover cover;
  cover.dimension = file.integer("/", "dimension", 0, static_cast<std::int64_t>(variables));
  cover.sigma = {file.attribute<double>("/", "sigma_length"), file.attribute<double>("/", "sigma_angle")};
  cover.boxes = read_boxes(file, "/boxes", variables);
  cover.points = read_boxes(file, "/points", variables);
  read_certificates(file, cover, variables);
  file.enter("");
  return cover;
}

}  // namespace corank::result
