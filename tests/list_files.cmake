# cmake -DPROGRAM=... -DPREFIX=... -DSERIAL=... -DFILE_OUT=... -P list_files.cmake: writes a list for ctest with a test
# for each source file of a doctest program, which runs all cases of the file in one process.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml OUTPUT_VARIABLE listed
  COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "" listed "${listed}")  # of "&quot;": it would part an item of a list
string(REGEX MATCHALL "<TestCase [^>]*skipped=\"false\"" cases "${listed}")
set(files)
set(serial)
foreach(case IN LISTS cases)
  string(REGEX REPLACE ".* filename=\"([^\"]*)\".*" "\\1" file "${case}")
  list(APPEND files ${file})
  if(NOT SERIAL STREQUAL "" AND case MATCHES "name=\"[^\"]*(${SERIAL})")
    list(APPEND serial ${file})
  endif()
endforeach()
list(REMOVE_DUPLICATES files)
set(list)
foreach(file IN LISTS files)
  set(name "${PREFIX}${file}")
  string(APPEND list "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--source-file=*${file}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT 1800 FAIL_REGULAR_EXPRESSION \"test cases: +0 \"")
  if(file IN_LIST serial)
    string(APPEND list " RUN_SERIAL ON")
  endif()
  string(APPEND list ")\n")
endforeach()
file(WRITE ${FILE_OUT} "${list}")
