// Pictures without Cairo.
#include <array>

#include "corank/report/pictures/layout.h"
#include "corank/report/pictures/portrait.h"

namespace corank::report {
namespace {

// Of Helvetica's characters from space to ~, in thousandths of its size: Adobe's font metrics, which the oblique cut shares.
constexpr std::array<int, 95> kHelvetica{
    278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,  // space to /
    556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,  // 0 to ?
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,  // @ to O
    667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,  // P to _
    333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,  // ` to o
    556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};      // p to ~
constexpr int kOther = 600;                                                           // Greek, π, the minus sign

double width_of(const TextRun& run, double size) {
  int thousandths = 0;
  for (const char c : run.text) {
    const auto code = static_cast<unsigned char>(c);
    if ((code & 0xC0) == 0x80) continue;  // goes on with a character of several bytes
    thousandths += code >= ' ' && code <= '~' ? kHelvetica[code - std::size_t{' '}] : kOther;
  }
  return thousandths * (run.subscript ? kSubscriptSize * size : size) / 1000;
}

}  // namespace

bool can_write_pdf() { return false; }

TextWidth font_widths() {
  return [](const Label& label, double size) {
    double width = 0;
    for (const TextRun& run : label) width += width_of(run, size);
    return width;
  };
}

std::string to_pdf(const Layout&, const std::string&, const std::string& name) {
  check_can_draw(name);
  return {};
}

std::string to_png(const Layout&, double, const std::string& name) {
  check_can_draw(name);
  return {};
}

}  // namespace corank::report
