# Everything comes from Debian 12 packages: scripts/packages.txt.
foreach(package PkgConfig Threads MPFI FLINT OMPL "TBB 2021" "fmt 9")
  separate_arguments(arguments UNIX_COMMAND "${package}")
  find_package(${arguments} REQUIRED)
endforeach()
include(CorankLibraries)

# Needed to build corank, not to use it: no installed header shows them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(cereal 1.3 REQUIRED)
find_package(pegtl 3.2 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
if(CORANK_BUILD_TESTS)
  find_package(GTest REQUIRED)
  pkg_check_modules(corank_urdfdom REQUIRED IMPORTED_TARGET GLOBAL urdfdom)  # reads the tests' URDF files as well
endif()
if(CORANK_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
