// SPDX-License-Identifier: Apache-2.0
// The one translation unit with tinygltf's code; its options are set in CMakeLists.txt.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
