# SPDX-License-Identifier: Apache-2.0
# Run by ctest: adds a test for each suite of `program`, with `suite_properties`; where they are `together`, one test for
# all of them, named `target`. `listed` keeps the names.
# Suites named Cases... (what others' files broke) have the label cases.

if(NOT EXISTS "${program}")
    add_test("${program}_NOT_BUILT" "${program}")
    return()
endif()
if("${program}" IS_NEWER_THAN "${listed}")
    execute_process(COMMAND "${program}" --gtest_list_tests --gtest_filter=-*Heavy*
        OUTPUT_VARIABLE output RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        add_test("${program}_DOES_NOT_LIST_ITS_TESTS" "${program}" --gtest_list_tests)
        return()
    endif()
    # A suite's name ends with a dot, before a comment or the end of the line; tests are indented.
    string(REGEX MATCHALL "\n[^ \n.]+\\." names "\n${output}")
    string(REGEX REPLACE "[\n.]" "" names "${names}")
    file(WRITE "${listed}" "${names}")
endif()
file(READ "${listed}" names)
set(quick ${names})
list(FILTER quick EXCLUDE REGEX "(^|/)Cases")
if(together AND quick)
    list(FILTER names INCLUDE REGEX "(^|/)Cases")
    list(JOIN quick ".*:" filter)
    add_test("${target}" "${program}" "--gtest_filter=${filter}.*-*Heavy*")
    set_tests_properties("${target}" PROPERTIES ${suite_properties})
endif()
foreach(name IN LISTS names)
    add_test("${name}" "${program}" "--gtest_filter=${name}.*-*Heavy*")
    set_tests_properties("${name}" PROPERTIES ${suite_properties})
    if(name MATCHES "(^|/)Cases")
        set_tests_properties("${name}" PROPERTIES LABELS cases)
    endif()
endforeach()
