# One library per folder. Headers stand beside their sources and are included as "corank/<folder>/<header>.h" both here and
# by users of the installed package, so the build tree offers the source tree under the name include/corank.

set(CORANK_BUILD_INCLUDE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${CORANK_BUILD_INCLUDE})
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${CORANK_BUILD_INCLUDE}/corank SYMBOLIC)

# Warnings, sanitizers and, everywhere, no silent contraction of a*b+c into one rounding.
add_library(corank_flags INTERFACE)
target_compile_options(corank_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                              -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False positives: on std::string (gcc bug 105651), and on vectors where less is optimized.
  target_compile_options(corank_flags INTERFACE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # The compiler collects its garbage more seldom: a tenth of its time, for a fifth more memory.
  target_compile_options(corank_flags INTERFACE --param=ggc-min-expand=400 --param=ggc-min-heapsize=600000)
endif()
if(CORANK_WARNINGS_AS_ERRORS)
  target_compile_options(corank_flags INTERFACE -Werror)
endif()
if(CORANK_SANITIZE)
  # GCC warns of members of variants that are not there, where sanitizers keep it from seeing that.
  target_compile_options(corank_flags INTERFACE -Wno-maybe-uninitialized -fsanitize=${CORANK_SANITIZE} -fno-omit-frame-pointer
                                                -fno-sanitize-recover=all)
  target_link_options(corank_flags INTERFACE -fsanitize=${CORANK_SANITIZE})
endif()

# cmake/folders.txt: CORANK_FOLDERS in order, CORANK_USES_<folder> what a folder may use.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/folders.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/folders.txt lines REGEX "^[a-z]+:")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([a-z]+): ?(.*)$" matched ${line})
  set(folder ${CMAKE_MATCH_1})
  string(REPLACE " " ";" CORANK_USES_${folder} "${CMAKE_MATCH_2}")
  list(APPEND CORANK_FOLDERS ${folder})
endforeach()

# corank_uses(<target> PUBLIC|PRIVATE <folder>): links what the folder may use.
function(corank_uses target scope folder)
  foreach(used IN LISTS CORANK_USES_${folder})
    target_link_libraries(${target} ${scope} corank::${used})
  endforeach()
endfunction()

# corank_compile_together(<target> <source>…): where CMAKE_UNITY_BUILD is on, the sources are compiled as two, since most of a source's time goes into
# what it includes and instantiates: by the first letter of their inner folder, in a folder without such of their own. What is in an anonymous
# namespace must then differ between them.
function(corank_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    cmake_path(RELATIVE_PATH source OUTPUT_VARIABLE relative)
    cmake_path(GET relative PARENT_PATH group)
    if(NOT group MATCHES "^[a-z]+$")
      cmake_path(GET source FILENAME group)
    endif()
    string(SUBSTRING ${group} 0 1 letter)
    if(letter MATCHES "[a-l]")
      set(group a_l)
    else()
      set(group m_z)
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# corank_link_fast_first(<target> <folder>…): of several definitions of a template the linker keeps the first. Links the libraries of these
# folders first, and whole, so that these definitions are their own, not those of libraries that are compiled with less optimization.
function(corank_link_fast_first target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_FILE:corank_\\1>" OUTPUT_VARIABLE archives)
    target_link_options(${target} BEFORE PRIVATE LINKER:--whole-archive ${archives} LINKER:--no-whole-archive)
  endif()
endfunction()

# corank_choose(<list> <variable> <source> <other source>): leaves in the list the first source where the variable is true, the second where it is
# false. Each is compiled by itself, so that tests can link the other one in its place.
function(corank_choose list found source stand_in)
  if(${found})
    set(other ${stand_in})
  else()
    set(other ${source})
  endif()
  set(chosen ${${list}})
  list(REMOVE_ITEM chosen ${CMAKE_CURRENT_SOURCE_DIR}/${other})
  set_source_files_properties(${source} ${stand_in} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set(${list} ${chosen} PARENT_SCOPE)
endfunction()

# corank_library(<folder> SOURCES … PUBLIC_HEADERS … PRIVATE_LINK … HEADER_ONLY …): the target corank_<folder>, alias corank::<folder>, linked to what
# cmake/folders.txt says. PUBLIC_HEADERS are installed. HEADER_ONLY libraries are private, and nothing is left of them for whoever links the
# installed library.
function(corank_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC_HEADERS;PRIVATE_LINK;HEADER_ONLY" ${ARGN})
  add_library(corank_${folder} STATIC ${ARG_SOURCES})
  add_library(corank::${folder} ALIAS corank_${folder})
  set_target_properties(corank_${folder} PROPERTIES EXPORT_NAME ${folder} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(corank_${folder} PUBLIC cxx_std_20)
  target_include_directories(corank_${folder} PUBLIC $<BUILD_INTERFACE:${CORANK_BUILD_INCLUDE}>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_HEADER_ONLY REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(corank_${folder} PRIVATE ${ARG_PRIVATE_LINK} ${ARG_HEADER_ONLY} $<BUILD_INTERFACE:corank_flags>)
  corank_uses(corank_${folder} PUBLIC ${folder})
  corank_compile_together(corank_${folder} ${ARG_SOURCES})
  install(TARGETS corank_${folder} EXPORT corankTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  foreach(header IN LISTS ARG_PUBLIC_HEADERS)
    cmake_path(ABSOLUTE_PATH header)
    set_property(GLOBAL APPEND PROPERTY CORANK_PUBLIC_HEADERS ${header})
    cmake_path(RELATIVE_PATH header)
    cmake_path(GET header PARENT_PATH inner)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/corank/${folder}/${inner} COMPONENT dev)
  endforeach()
endfunction()
