# Writes the suites of the test program PROGRAM as tests of ctest's into the file TO. A case is not a process of its own: to start one
# takes as long as most cases, and what a suite computes once it would compute for each.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
set(tests "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  string(APPEND tests "add_test([==[${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
                      # Skipped where no case passed and, as the output's end tells, none failed.
                      "set_tests_properties([==[${suite}]==] PROPERTIES TIMEOUT 1200 WORKING_DIRECTORY [==[${FOLDER}]==]\n"
                      "  SKIP_REGULAR_EXPRESSION [==[PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$]==])\n")
endforeach()
file(WRITE ${TO} "${tests}")
