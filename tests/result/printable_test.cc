// What a file says cannot steer a terminal.
#include "corank/result/values/words.h"

#include <gtest/gtest.h>

namespace corank::result {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  const std::string text = "θ₂ = −0.5\t(rad)\nnächste Zeile: \U0001F916";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, MakesControlCharactersVisible) {
  EXPECT_EQ(printable("a\x1b[31mb\x07\r"), "a\\x1b[31mb\\x07\\x0d");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "the one character that begins a sequence";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb")
      << "turns the direction of text";
}

TEST(Printable, MakesWhatIsNoUtf8Visible) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "not the shortest form";
  EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80") << "cut short";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last character";
}

TEST(Printable, KeepsALineInOneLine) { EXPECT_EQ(printable_line("a\nb\tc"), "a\\x0ab\\x09c"); }

}  // namespace
}  // namespace corank::result
