# SPDX-License-Identifier: MIT
# octreel_add_image_test(): a test of CTest that runs a program, and compares its pictures with a reference.
#
#   octreel_add_image_test(NAME name COMMAND program [argument...] REFERENCE path [ACTUAL path]
#                          [TOLERANCE option...] [LABELS label...])
#
# NAME       the name of the test.
# COMMAND    the program, a target or an absolute path, and its arguments. It runs in an empty folder of the test below
#            the build folder. <ACTUAL> in an argument becomes the absolute path of ACTUAL. Generator expressions are
#            allowed.
# REFERENCE  a PNG, a folder of PNGs, or a baseline of `octreel accept`, relative to the current source folder. It may
#            be missing at first: the test then fails, and prints the command that creates it.
# ACTUAL     the PNG or the folder that the program writes, relative to its folder. Default: the last part of REFERENCE.
# TOLERANCE  options of `octreel diff`: --max-delta D, --max-channel N, --flip X, --max-pixels N, --antialias,
#            --ignore X,Y,W,H, --ignore-layer LIST, --pixels-per-degree N, --background RRGGBB, --store DIR,
#            --today DATE, --no-recursive. Without them the pictures must be equal, or within the rules of a baseline,
#            which need --store with an absolute path.
# LABELS     labels of the test, besides `image`.
#
# The test fails if the program fails, with the program's exit status, if ACTUAL is missing, or if pictures differ. The
# folder image_tests/NAME below the current build folder then has run/ (what the program wrote), report/report.html, and
# beside it the reference, the actual and the difference as PNGs. The output names them, has measurements for CDash, and
# ends with the command that accepts the new pictures. Other properties are set with set_tests_properties().

find_program(OCTREEL_PROGRAM octreel HINTS "${CMAKE_CURRENT_LIST_DIR}/${OCTREEL_TO_BIN}"
             DOC "The program octreel, which compares the pictures of image tests")

# octreel_refuse_image_test(NAME REASON): stops with an error about this test's definition.
function(octreel_refuse_image_test name reason)
  message(FATAL_ERROR "octreel_add_image_test(NAME ${name}): ${reason}")
endfunction()

# octreel_check_tolerance(NAME OPTION...): refuses options that `octreel diff` would refuse when the test runs, and
# options that do not say what counts as the same.
function(octreel_check_tolerance name)
  set(flags --antialias --no-recursive)
  set(valued --max-delta --max-channel --flip --pixels-per-degree --max-pixels --ignore --ignore-layer --background --store
      --today)
  set(expects_value FALSE)
  foreach(word IN LISTS ARGN)
    if(expects_value)
      set(expects_value FALSE)
    elseif(word IN_LIST valued)
      set(expects_value TRUE)
      set(last ${word})
    elseif(NOT word IN_LIST flags)
      list(JOIN valued ", " names)
      octreel_refuse_image_test(${name} "TOLERANCE: unknown option ${word}; use ${names}, --antialias, --no-recursive")
    endif()
  endforeach()
  if(expects_value)
    octreel_refuse_image_test(${name} "TOLERANCE: ${last} needs a value")
  endif()
endfunction()

function(octreel_add_image_test)
  cmake_parse_arguments(PARSE_ARGV 0 TEST "" "NAME;REFERENCE;ACTUAL" "COMMAND;TOLERANCE;LABELS")
  if(TEST_UNPARSED_ARGUMENTS)
    octreel_refuse_image_test("${TEST_NAME}" "unknown arguments: ${TEST_UNPARSED_ARGUMENTS}")
  endif()
  foreach(member NAME COMMAND REFERENCE)
    if("${TEST_${member}}" STREQUAL "")
      octreel_refuse_image_test("${TEST_NAME}" "${member} is missing")
    endif()
  endforeach()
  if(NOT OCTREEL_PROGRAM)
    octreel_refuse_image_test("${TEST_NAME}" "the program octreel was not found; install it, or set OCTREEL_PROGRAM")
  endif()
  octreel_check_tolerance("${TEST_NAME}" ${TEST_TOLERANCE})
  get_filename_component(reference "${TEST_REFERENCE}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT TEST_ACTUAL AND reference MATCHES "[.]txt$")
    octreel_refuse_image_test("${TEST_NAME}" "REFERENCE is a baseline; ACTUAL must name what the program writes")
  elseif(NOT TEST_ACTUAL)
    get_filename_component(TEST_ACTUAL "${reference}" NAME)
  endif()
  string(REGEX REPLACE "[^A-Za-z0-9_.-]" "_" folder "${TEST_NAME}")
  if(NOT folder STREQUAL TEST_NAME) # two names may have become one
    string(SHA1 digest "${TEST_NAME}")
    string(SUBSTRING ${digest} 0 8 digest)
    string(APPEND folder "_${digest}")
  endif()
  list(GET TEST_COMMAND 0 program)
  if(TARGET "${program}") # list(PREPEND) would take the backslashes from the semicolons of other arguments
    string(LENGTH "${program}" length)
    string(SUBSTRING "${TEST_COMMAND}" ${length} -1 arguments)
    set(TEST_COMMAND "$<TARGET_FILE:${program}>${arguments}")
  endif()
  list(LENGTH TEST_TOLERANCE options)
  set(tag CTestMeasurementFile)
  if(CMAKE_VERSION VERSION_LESS 3.22) # whose ctest knows only the older name
    set(tag DartMeasurementFile)
  endif()
  add_test(NAME "${TEST_NAME}"
           COMMAND "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/octreel_image_test" "${OCTREEL_PROGRAM}" ${tag}
                   "${CMAKE_CURRENT_BINARY_DIR}/image_tests/${folder}" "${reference}" "${TEST_ACTUAL}" ${options}
                   ${TEST_TOLERANCE} ${TEST_COMMAND})
  list(APPEND TEST_LABELS image)
  set_tests_properties("${TEST_NAME}" PROPERTIES LABELS "${TEST_LABELS}")
endfunction()
