# cmake --install: the models and what find_package(corank) reads, besides the program and the libraries with their headers.
include(CMakePackageConfigHelpers)
set(CORANK_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/corank)
set(CORANK_INSTALL_MODELS ${CMAKE_INSTALL_DATADIR}/corank/models)

install(EXPORT corankTargets NAMESPACE corank:: DESTINATION ${CORANK_INSTALL_CMAKE})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/ DESTINATION ${CORANK_INSTALL_MODELS} FILES_MATCHING PATTERN "*.cuik")

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/corankConfig.cmake.in ${PROJECT_BINARY_DIR}/corankConfig.cmake
                              INSTALL_DESTINATION ${CORANK_INSTALL_CMAKE} PATH_VARS CORANK_INSTALL_MODELS)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/corankConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/corankConfig.cmake ${PROJECT_BINARY_DIR}/corankConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/CorankLibraries.cmake ${PROJECT_SOURCE_DIR}/cmake/FindMPFI.cmake ${PROJECT_SOURCE_DIR}/cmake/FindOMPL.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindFLINT.cmake
        DESTINATION ${CORANK_INSTALL_CMAKE})
