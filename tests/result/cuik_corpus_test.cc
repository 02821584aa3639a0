// The fuzzers' corpora, replayed in the ordinary build. CMakeLists.txt gives each fuzzer's function a name of its own.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int fuzz_cuik_sol(const std::uint8_t* data, std::size_t size);
extern "C" int fuzz_cuik_param(const std::uint8_t* data, std::size_t size);
extern "C" int fuzz_result_file(const std::uint8_t* data, std::size_t size);

namespace {

void replay(const std::string& corpus, int (*fuzz)(const std::uint8_t*, std::size_t), int least = 15) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CORANK_SOURCE_DIR "/tests/fuzz/corpus/" + corpus)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(fuzz(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, least);
}

TEST(CuikSolCorpus, EveryInputIsReadOrRefusedWithItsLine) { replay("cuik_sol", fuzz_cuik_sol); }
TEST(CuikParamCorpus, EveryInputIsReadOrRefusedWithItsLine) { replay("cuik_param", fuzz_cuik_param); }
TEST(ResultFileCorpus, EveryInputIsReadOrRefused) { replay("result_file", fuzz_result_file, 2); }

}  // namespace
