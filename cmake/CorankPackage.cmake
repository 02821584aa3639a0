# Debian packages by `cpack` in the build folder: corank (the programs), libcorank-dev, python3-corank.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME corank)
set(CPACK_PACKAGE_VENDOR "The corank developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CORANK_MAINTAINER "The corank developers <corank@example.org>" CACHE STRING "Who makes the Debian packages")
set(CPACK_PACKAGE_CONTACT "${CORANK_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program dev)
if(CORANK_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME corank)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "singularities of robot mechanisms, each with a proof
corank takes the model of a robot mechanism, as equations, as links and
joints or as URDF, and returns all its singularities in boxes, with a proof
of what each box holds. This package has the command line and the models.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libcorank-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(dependencies
    "corank (= ${version})" coinor-libipopt-dev libblas-dev libcln-dev libflint-dev libfmt-dev libginac-dev
    libgmp-dev libhdf5-dev liblapack-dev libmpfi-dev libmpfr-dev libpugixml-dev libtbb-dev pkg-config zlib1g-dev)
if(CORANK_HAS_CAIRO)
  list(APPEND dependencies libcairo2-dev)
endif()
list(JOIN dependencies ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_DESCRIPTION "singularities of robot mechanisms (C++ library)
corank takes the model of a robot mechanism and returns all its
singularities in boxes, with a proof of what each box holds. This package
has the static libraries and the headers, for CMake's find_package and for
pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-corank)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy (>= 1:1.22)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-pandas, python3-sympy, python3-tqdm, python3-distributed")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "singularities of robot mechanisms (Python package)
corank takes the model of a robot mechanism and returns all its
singularities in boxes, with a proof of what each box holds: as arrays of
NumPy, data frames of pandas, numbers of SymPy, plots of matplotlib, and
pages in notebooks.")

# What Debian wants beside the files: whose they are, and a log of the package's versions.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(place ${PROJECT_BINARY_DIR}/debian/${package})
  file(WRITE ${place}/changelog.Debian
       "corank (${version}) unstable; urgency=medium\n\n  * CHANGELOG.md of the sources says what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9nf ${place}/changelog.Debian)
  install(FILES ${place}/changelog.Debian.gz ${PROJECT_SOURCE_DIR}/cmake/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

# Without these flags the headers' interval arithmetic would prove nothing.
file(WRITE ${PROJECT_BINARY_DIR}/debian/libcorank-dev.overrides
     "# the headers' interval arithmetic is rigorous with these flags only\nlibcorank-dev: pkg-config-bad-directive *\n")
install(FILES ${PROJECT_BINARY_DIR}/debian/libcorank-dev.overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
        RENAME libcorank-dev COMPONENT dev)

include(CPack)
