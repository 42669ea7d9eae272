// SPDX-License-Identifier: Apache-2.0
// Printing by a program that takes its time.
#include "report/print_pdf.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include "../daemon/test_folder.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// A folder with a "chromium" that hangs, alone on the PATH with what a shell needs.
class HangingBrowser {
  public:
    HangingBrowser() : path_(std::getenv("PATH")) {
        const fs::path program = folder_.path("chromium");
        std::ofstream(program) << "#!/bin/sh\necho $$ > " << started() << "\nsleep 50\n";
        fs::permissions(program, fs::perms::owner_all);
        setenv("PATH", (folder_.path() + ":" + path_).c_str(), 1);
    }
    ~HangingBrowser() { setenv("PATH", path_.c_str(), 1); }
    [[nodiscard]] std::string started() const { return folder_.path("started"); }

  private:
    std::string path_;
    TestFolder folder_;
};

TEST(Printing, EndsAtOnceWhereItIsToStop) {
    const HangingBrowser browser;
    std::stop_source stop;
    std::string reason;
    auto printed = std::async(std::launch::async,
                              [&] { return print_pdf("<p>x</p>", reason, stop.get_token()); });
    while (!fs::exists(browser.started())) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    stop.request_stop();
    ASSERT_EQ(printed.wait_for(std::chrono::seconds(1)), std::future_status::ready);
    EXPECT_FALSE(printed.get());
    EXPECT_FALSE(reason.empty());
}

}  // namespace
}  // namespace raybundle
