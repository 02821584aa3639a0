# cmake --install: the models, the gallery and what find_package(corank) reads, besides the program and the libraries with their headers.
include(CMakePackageConfigHelpers)
set(CORANK_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/corank)
set(CORANK_INSTALL_MODELS ${CMAKE_INSTALL_DATADIR}/corank/models)

install(EXPORT corankTargets NAMESPACE corank:: DESTINATION ${CORANK_INSTALL_CMAKE} COMPONENT dev)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/ DESTINATION ${CORANK_INSTALL_MODELS} COMPONENT program
        FILES_MATCHING PATTERN "*.cuik")
# Beside them: its entries name them by relative paths, and the program finds it from its own place.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/gallery/ DESTINATION ${CMAKE_INSTALL_DATADIR}/corank/gallery COMPONENT program
        FILES_MATCHING PATTERN "*.cuik" PATTERN "*.toml")

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/corankConfig.cmake.in ${PROJECT_BINARY_DIR}/corankConfig.cmake
                              INSTALL_DESTINATION ${CORANK_INSTALL_CMAKE} PATH_VARS CORANK_INSTALL_MODELS)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/corankConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/corankConfig.cmake ${PROJECT_BINARY_DIR}/corankConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/CorankLibraries.cmake ${PROJECT_SOURCE_DIR}/cmake/FindMPFI.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindFLINT.cmake
        DESTINATION ${CORANK_INSTALL_CMAKE} COMPONENT dev)

# The same for pkg-config: every library, each before those that it uses.
set(CORANK_PKGCONFIG_LIBRARIES "")
foreach(folder IN LISTS CORANK_FOLDERS)
  if(TARGET corank_${folder} AND NOT folder MATCHES "^(app|bench|python)$")
    string(PREPEND CORANK_PKGCONFIG_LIBRARIES " -lcorank_${folder}")
  endif()
endforeach()
set(CORANK_PKGCONFIG_CAIRO "")
if(CORANK_HAS_CAIRO)
  set(CORANK_PKGCONFIG_CAIRO " cairo >= 1.16, cairo-pdf,")
endif()
file(RELATIVE_PATH CORANK_PKGCONFIG_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" CORANK_PKGCONFIG_PREFIX "${CORANK_PKGCONFIG_PREFIX}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/corank.pc.in ${PROJECT_BINARY_DIR}/corank.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/corank.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

if(PROJECT_IS_TOP_LEVEL)
  include(CorankPackage)
endif()
