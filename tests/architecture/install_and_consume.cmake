# Installs the build, moves the installed tree to another place, and lets a small project find, link and run it from there.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${WORK}/installed)
file(RENAME ${WORK}/installed ${WORK}/moved)

# Nothing that is installed may remember where it was built.
file(GLOB_RECURSE files ${WORK}/moved/*.cmake)
foreach(file ${files})
  file(READ ${file} text)
  foreach(place ${BUILD} ${SOURCE})
    string(FIND "${text}" "${place}/" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file} names ${place}")
    endif()
  endforeach()
endforeach()

run(${WORK}/moved/bin/corank --version)
if(NOT output STREQUAL "corank ${VERSION}\n")
  message(FATAL_ERROR "corank --version printed: ${output}")
endif()

set(each_header OFF)
if(DEFINED ENV{CORANK_SEEDS})  # a long run (tests/seeds.h): that takes two minutes
  set(each_header ON)
endif()
set(flags "")
if(SANITIZE)
  set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/tests/architecture/consumer -B ${WORK}/build
    -DCMAKE_PREFIX_PATH=${WORK}/moved -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX} ${flags}
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DEACH_HEADER=${each_header})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
string(CONCAT expected "8 isolated, complete\n4 isolated, complete\n"
                       "planar, mobility 2\nforward: dimension 1, complete\ncspace-singular: none, complete\n")
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the consumer printed:\n${output}")
endif()

# And without CMake: by what pkg-config says.
if(SANITIZE)
  return()
endif()
set(ENV{PKG_CONFIG_PATH} ${WORK}/moved/lib/pkgconfig)
run(pkg-config --cflags --libs corank)
separate_arguments(arguments UNIX_COMMAND "${output}")
run(${CXX} -std=c++20 "-DMODELS=\"${WORK}/moved/share/corank/models\"" ${SOURCE}/tests/architecture/consumer/main.cc
    -o ${WORK}/by_pkg_config ${arguments})
run(${WORK}/by_pkg_config)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the consumer built by pkg-config printed:\n${output}")
endif()
