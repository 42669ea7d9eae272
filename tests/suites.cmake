# SPDX-License-Identifier: Apache-2.0
# One ctest test for each suite of a GoogleTest program. Each process loads some 270 libraries (0.2 s), and those that
# draw make a context: a process for each test would spend a third of the time on that.
#
# raybundle_discover_suites(TARGET [NAME VALUE]...)
#   registers the suites of TARGET, under their names, without the tests whose names contain Heavy; what follows are
#   properties of the tests. The suites are listed when ctest starts, again only after TARGET has been built.

function(raybundle_discover_suites target)
    set(listing ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    file(GENERATE OUTPUT ${listing} CONTENT
"set(program \"$<TARGET_FILE:${target}>\")
set(listed \"${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.txt\")
set(suite_properties \"${ARGN}\")
include(\"${CMAKE_SOURCE_DIR}/tests/add_suites.cmake\")
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${listing})
endfunction()
