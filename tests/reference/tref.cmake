# SPDX-License-Identifier: Apache-2.0
# Reference methods against closed forms and each other. Needs no GL context.
include(GoogleTest)
add_executable(raybundle_reference_tests
    image_estimate_test.cpp
    image_metrics_test.cpp
    path_tracer_test.cpp
    random_test.cpp
    ray_scene_test.cpp
    rooms.cpp
)
target_link_libraries(raybundle_reference_tests PRIVATE
    raybundle_reference raybundle_oracle TBB::tbb GTest::gtest_main)
gtest_discover_tests(raybundle_reference_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
