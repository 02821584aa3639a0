// The fuzzer's corpus, replayed in the ordinary build.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

TEST(PartFileCorpus, EveryInputIsParsedOrRefusedWithAPlace) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CORANK_SOURCE_DIR "/tests/fuzz/corpus/part_file")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 8);
}
