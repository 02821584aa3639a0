// Result files as a stranger may make them: what HDF5 can do beyond a result is refused before it is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include <functional>

#include "corank/result/files/result_file.h"
#include "corank/tests/report/portrait_reader.h"
#include "corank/tests/result/sample_result.h"

namespace corank::report {
namespace {

using testing::HasSubstr;

class Stranger : public testing::Test {
 protected:
  // Why a good result is refused after the change; nothing where it is read.
  std::string refusal(const std::function<void(hid_t)>& change) const {
    result::write_result(path(), result::sample_result());
    const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    EXPECT_GE(H5Fclose(file), 0);
    return refusal();
  }
  std::string refusal() const {
    try {
      result::read_result(path());
    } catch (const result::ResultFileError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path path() const { return folder_.file("r.h5"); }
  PictureFolder folder_;
};

// An array in place of the one that there is; `prepare` gives it its properties.
void replace(hid_t file, const char* name, hid_t type, std::vector<hsize_t> sizes,
             const std::function<void(hid_t)>& prepare = {}, std::vector<hsize_t> most = {}) {
  EXPECT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  if (prepare) prepare(properties);
  const hid_t space =
      sizes.empty() ? H5Screate(H5S_SCALAR)
                    : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), most.empty() ? nullptr : most.data());
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  EXPECT_GE(set, 0) << name;
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(properties);
}

hid_t text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length);
  return type;
}

TEST_F(Stranger, WhoChangesNothingIsRead) {
  EXPECT_EQ(refusal([](hid_t) {}), "");
}

TEST_F(Stranger, MayNotReadAnotherFileThroughExternalStorage) {
  std::ofstream(folder_.file("secret")) << "what stands in another file of this machine";
  const std::string secret = folder_.file("secret").string();
  EXPECT_THAT(refusal([&](hid_t f) {
                replace(f, "/model/text", text_type(10), {},
                        [&](hid_t p) { H5Pset_external(p, secret.c_str(), 0, H5F_UNLIMITED); });
              }),
              HasSubstr("/model/text is stored in another file"));
}

TEST_F(Stranger, MayNotLinkToElsewhere) {
  const auto link = [&](const std::function<void(hid_t)>& make) {
    return refusal([&](hid_t f) {
      H5Ldelete(f, "/model/text", H5P_DEFAULT);
      make(f);
    });
  };
  EXPECT_THAT(
      link([](hid_t f) { H5Lcreate_external("other.h5", "/model/text", f, "/model/text", H5P_DEFAULT, H5P_DEFAULT); }),
      HasSubstr("/model/text is a link to elsewhere"));
  EXPECT_THAT(link([](hid_t f) { H5Lcreate_soft("/model/system", f, "/model/text", H5P_DEFAULT, H5P_DEFAULT); }),
              HasSubstr("/model/text is a link to elsewhere"));
  EXPECT_THAT(refusal([](hid_t f) { H5Lcreate_soft("/nowhere", f, "/unknown", H5P_DEFAULT, H5P_DEFAULT); }),
              HasSubstr("/unknown is a link to elsewhere"))
      << "whether or not a result has such an item";
}

TEST_F(Stranger, MayNotMakeGroupsWithoutEnd) {
  EXPECT_THAT(refusal([](hid_t f) { H5Lcreate_hard(f, "/", f, "/model/again", H5P_DEFAULT, H5P_DEFAULT); }),
              HasSubstr("too deep"));
  EXPECT_THAT(refusal([](hid_t f) {
                for (int k = 0; k < 1200; ++k)
                  H5Gclose(H5Gcreate2(f, ("g" + std::to_string(k)).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
              }),
              HasSubstr("holds too much"));
}

TEST_F(Stranger, MayNotPutAVirtualOrACompactArray) {
  const auto virtual_layout = [](hid_t p) {
    const hsize_t size = 4;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    H5Pset_virtual(p, space, "other.h5", "/reals", space);
    H5Sclose(space);
  };
  EXPECT_THAT(refusal([&](hid_t f) { replace(f, "/certificates/proof/reals", H5T_NATIVE_DOUBLE, {4}, virtual_layout); }),
              HasSubstr("not stored like an array of a result"));
  EXPECT_THAT(refusal([&](hid_t f) {
                replace(f, "/certificates/proof/reals", H5T_NATIVE_DOUBLE, {4},
                        [](hid_t p) { H5Pset_layout(p, H5D_COMPACT); });
              }),
              HasSubstr("not stored like an array of a result"));
}

TEST_F(Stranger, MayNotDeclareMoreThanTheFileHolds) {
  const auto chunked = [](hid_t p) {
    const hsize_t chunk = 1 << 16;
    H5Pset_chunk(p, 1, &chunk);
    H5Pset_deflate(p, 6);
  };
  constexpr hsize_t kHuge = hsize_t{16} << 30;
  EXPECT_THAT(refusal([&](hid_t f) { replace(f, "/certificates/proof/steps", H5T_NATIVE_UINT8, {kHuge}, chunked); }),
              HasSubstr("/certificates/proof/steps declares more than the file holds"));
  EXPECT_THAT(refusal([&](hid_t f) {
                replace(f, "/boxes/lower", H5T_NATIVE_DOUBLE, {kHuge, 4});
              }),
              HasSubstr("/boxes/lower declares more than the file holds"));
  EXPECT_THAT(refusal([&](hid_t f) { replace(f, "/model/text", text_type(std::size_t{1} << 31), {}); }),
              HasSubstr("/model/text declares more than the file holds"));
  EXPECT_THAT(refusal([&](hid_t f) { replace(f, "/certificates/proof/reals", H5T_NATIVE_DOUBLE, {70000}, chunked); }),
              HasSubstr("declares more than the file holds"))
      << "not even a little";
}

TEST_F(Stranger, MayNotPutOtherTypesShapesOrFilters) {
  const char* const reals = "/certificates/proof/reals";
  const auto refused = [&](hid_t type, std::vector<hsize_t> sizes, std::vector<hsize_t> most = {}) {
    const auto chunked = [](hid_t p) {
      const hsize_t chunk = 16;
      H5Pset_chunk(p, 1, &chunk);
    };
    return refusal(
        [&](hid_t f) { replace(f, reals, type, sizes, most.empty() ? std::function<void(hid_t)>() : chunked, most); });
  };
  EXPECT_THAT(refused(H5T_IEEE_F64BE, {1}), HasSubstr("a type that no result has"));
  EXPECT_THAT(refused(H5T_STD_I16LE, {1}), HasSubstr("a type that no result has"));
  EXPECT_THAT(refused(H5T_STD_REF_OBJ, {1}), HasSubstr("a type that no result has"));
  EXPECT_THAT(refused(text_type(H5T_VARIABLE), {1}), HasSubstr("a type that no result has"));
  EXPECT_THAT(refused(H5T_NATIVE_FLOAT, {0}), HasSubstr("holds no numbers of its kind"));
  EXPECT_THAT(refused(H5T_NATIVE_DOUBLE, {1, 1, 1}), HasSubstr("not have the shape of an item of a result"));
  EXPECT_THAT(refused(H5T_NATIVE_DOUBLE, {0, 1}), HasSubstr("is not a vector"));
  EXPECT_THAT(refused(H5T_NATIVE_DOUBLE, {0}, {H5S_UNLIMITED}), HasSubstr("can grow"));
  const auto checksummed = [](hid_t p) {
    const hsize_t chunk = 16;
    H5Pset_chunk(p, 1, &chunk);
    H5Pset_fletcher32(p);
  };
  EXPECT_THAT(refusal([&](hid_t f) { replace(f, reals, H5T_NATIVE_DOUBLE, {0}, checksummed); }),
              HasSubstr("a filter that no result has"));
  EXPECT_THAT(refusal([](hid_t f) {
                H5Ldelete(f, "/statistics", H5P_DEFAULT);
                const hid_t type = H5Tcopy(H5T_NATIVE_INT);
                H5Tcommit2(f, "/statistics", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
                H5Tclose(type);
              }),
              HasSubstr("/statistics is neither a group nor an array"));
}

TEST_F(Stranger, MayNotPutAnAttributeOfSeveralValues) {
  EXPECT_THAT(refusal([](hid_t f) {
                const hsize_t size = 1 << 12;
                const hid_t space = H5Screate_simple(1, &size, nullptr);
                H5Aclose(H5Acreate2(f, "more", H5T_NATIVE_UINT8, space, H5P_DEFAULT, H5P_DEFAULT));
                H5Sclose(space);
              }),
              HasSubstr("/@more is not one value"));
}

TEST_F(Stranger, CannotSteerATerminalWithANameOrAMessage) {
  result::Result result = result::sample_result();
  result.model = "a\x1b]0;owned\x07";
  result.variables[0].name = "x\x1b[31m";
  result::write_result(path(), result);
  EXPECT_EQ(result::read_result(path()).model, "a\\x1b]0;owned\\x07");
  EXPECT_EQ(result::read_result(path()).variables[0].name, "x\\x1b[31m");
  EXPECT_THAT(refusal([](hid_t f) { H5Lcreate_soft("/", f, "/a\x1b[31m", H5P_DEFAULT, H5P_DEFAULT); }),
              HasSubstr("/a\\x1b[31m is a link"));
  result = result::sample_result();
  result.options.kernel = "<b>\x1b";
  result::write_result(path(), result);
  EXPECT_THAT(refusal(), HasSubstr("neither right nor left: '<b>\\x1b'"));
}

TEST_F(Stranger, CannotBringMarkupInADecimal) {
  result::Result result = result::sample_result();
  result.cover.decimals = {{"0.5", "<script>", "1", "2"}, {}};
  result::write_result(path(), result);
  EXPECT_THAT(refusal(), HasSubstr("decimals holds a text that is not a number"));
}

TEST_F(Stranger, CannotNameMoreCoordinatesThanVariables) {
  result::Result result = result::sample_result();
  result.configuration_size = 1'000'000;
  result::write_result(path(), result);
  EXPECT_THAT(refusal(), HasSubstr("configuration_size is above the number of variables"));
}

TEST_F(Stranger, IsNotWaitedForBehindAPipe) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("is not a regular file"));
}

}  // namespace
}  // namespace corank::report
