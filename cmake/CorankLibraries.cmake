# The libraries that corank's own libraries link. Read twice: by the build, and by corankConfig.cmake on behalf of whoever links
# the installed static libraries.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_dependency(PkgConfig)
find_dependency(Threads)
find_dependency(MPFI)
find_dependency(FLINT)
find_dependency(TBB 2021)
find_dependency(fmt 9)
list(POP_FRONT CMAKE_MODULE_PATH)
# Debian's libhdf5-dev offers the serial build under its own name, whatever MPI flavours stand beside it.
pkg_check_modules(corank_ginac REQUIRED IMPORTED_TARGET GLOBAL ginac>=1.8)
pkg_check_modules(corank_cln REQUIRED IMPORTED_TARGET GLOBAL cln)
pkg_check_modules(corank_ipopt REQUIRED IMPORTED_TARGET GLOBAL ipopt)
pkg_search_module(corank_hdf5 REQUIRED IMPORTED_TARGET GLOBAL hdf5-serial hdf5)
pkg_check_modules(corank_cairo REQUIRED IMPORTED_TARGET GLOBAL cairo>=1.16 cairo-pdf)
pkg_check_modules(corank_pugixml REQUIRED IMPORTED_TARGET GLOBAL pugixml)
pkg_check_modules(corank_zlib REQUIRED IMPORTED_TARGET GLOBAL zlib)
