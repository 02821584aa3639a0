#include "corank/result/cover_group.h"

#include "corank/core/check.h"
#include "corank/result/certificate_file.h"

namespace corank::result {

std::vector<std::string> verdict_words() {
  std::vector<std::string> words;
  for (int i = 0; i < kVerdicts; ++i) words.emplace_back(to_string(static_cast<Verdict>(i)));
  return words;
}

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
  file.enumeration(group + "/verdict", verdict, verdict_words());
  file.bytes(group + "/free", boxes.size(), n, [&](std::size_t i, std::span<std::uint8_t> to) {
    for (const int f : boxes[i].free) {
      CORANK_CHECK(static_cast<std::size_t>(f) < n);
      to[static_cast<std::size_t>(f)] = 1;
    }
  });
}

namespace {

std::vector<CoverBox> read_boxes(Hdf5Reader& file, const std::string& group, std::size_t n) {
  const std::vector<std::uint8_t> verdict = file.enumeration(group + "/verdict", verdict_words());
  std::vector<CoverBox> boxes(verdict.size());
  file.take_rows({group + "/lower", group + "/upper"}, group + "/free", boxes.size(), n,
                 [&](std::size_t i, std::span<const std::span<const double>> ends, std::span<const std::uint8_t> free) {
                   for (std::size_t j = 0; j < n; ++j) {
                     const double lower = ends[0][j], upper = ends[1][j];
                     if (!(lower <= upper))
                       throw ResultFileError(file.path() + ": a box in " + group + " has a side that is not an interval");
                     boxes[i].box.emplace_back(lower, upper);
                     if (free[j] != 0) boxes[i].free.push_back(static_cast<int>(j));
                   }
                 });
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].verdict = static_cast<Verdict>(verdict[i]);
  return boxes;
}

}  // namespace

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
  const std::int64_t dimension = file.integer_attribute("/", "dimension");
  if (dimension < 0 || dimension > static_cast<std::int64_t>(variables))
    throw ResultFileError(file.path() + ": the attribute dimension of " + group + " is out of range");
  cover.dimension = static_cast<int>(dimension);
  cover.sigma = {file.double_attribute("/", "sigma_length"), file.double_attribute("/", "sigma_angle")};
  cover.boxes = read_boxes(file, "/boxes", variables);
  cover.points = read_boxes(file, "/points", variables);
  read_certificates(file, cover, variables);
  file.enter("");
  return cover;
}

}  // namespace corank::result
