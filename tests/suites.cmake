# SPDX-License-Identifier: Apache-2.0
# One ctest test for each suite of a GoogleTest program. Each process loads some 270 libraries (0.5 s), and those that
# draw make a context: a process for each test would spend a third of the time on that.
#
# raybundle_discover_suites(TARGET [NAME VALUE]...)
#   registers the suites of TARGET, under their names, without the tests whose names contain Heavy; what follows are
#   properties of the tests. The suites are listed when ctest starts, again only after TARGET has been built.
# raybundle_add_program(TARGET [NAME VALUE]...)
#   the same, but all suites are one test of ctest, named as TARGET: for those that take milliseconds.

function(raybundle_discover_suites target)
    raybundle_register_suites(${target} FALSE ${ARGN})
endfunction()

function(raybundle_add_program target)
    raybundle_register_suites(${target} TRUE ${ARGN})
endfunction()

function(raybundle_register_suites target together)
    set(listing ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    file(GENERATE OUTPUT ${listing} CONTENT
"set(program \"$<TARGET_FILE:${target}>\")
set(listed \"${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.txt\")
set(suite_properties \"${ARGN}\")
set(target ${target})
set(together ${together})
include(\"${CMAKE_SOURCE_DIR}/tests/add_suites.cmake\")
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${listing})
endfunction()
