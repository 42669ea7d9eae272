// SPDX-License-Identifier: Apache-2.0
// Configuration files: an error that names the file, or options that print to the same file again.
#include "fuzz_target.h"
#include "options/config_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace raybundle;
    Options options;
    try {
        apply_config_text("f", {reinterpret_cast<const char*>(data), size}, options);
    } catch (const UsageError& error) {
        FUZZ_REQUIRE(std::string_view(error.what()).starts_with("f: "));
        return 0;
    }
    const std::string printed = print_config(options);
    Options again;
    apply_config_text("printed", printed, again);
    FUZZ_REQUIRE(print_config(again) == printed);
    return 0;
}
