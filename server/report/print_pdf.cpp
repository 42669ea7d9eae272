// SPDX-License-Identifier: Apache-2.0
#include "report/print_pdf.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>
#include <vector>

extern "C" char** environ;  // NOLINT(readability-redundant-declaration)

namespace raybundle {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds longest_printing(60);

/// A new folder that goes with all that is in it.
class PrintFolder {
  public:
    PrintFolder() {
        std::error_code error;
        std::string name = (fs::temp_directory_path(error) / "raybundle-print-XXXXXX").string();
        if (!error && mkdtemp(name.data()) != nullptr) {
            path_ = name;
        }
    }
    ~PrintFolder() {
        std::error_code error;
        if (!path_.empty()) {
            fs::remove_all(path_, error);
        }
    }
    PrintFolder(const PrintFolder&) = delete;
    PrintFolder& operator=(const PrintFolder&) = delete;

    [[nodiscard]] bool exists() const { return !path_.empty(); }
    [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

  private:
    fs::path path_;
};

/// Runs a program in a group of its own, without standard streams; false where it does not end
/// well in time, or is to stop.
bool run_program(const std::vector<std::string>& arguments, const std::stop_token& stop) {
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) {
        pointers.push_back(const_cast<char*>(argument.c_str()));
    }
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
    }
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    pid_t child = 0;
    const int failed =
        posix_spawn(&child, pointers[0], &files, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) {
        return false;
    }
    const auto end = std::chrono::steady_clock::now() + longest_printing;
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (stop.stop_requested() || std::chrono::steady_clock::now() > end) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string find_browser() {
    const char* const path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
    std::stringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        for (const char* name :
             {"chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "chrome"}) {
            const std::string file = folder + "/" + name;
            if (!folder.empty() && access(file.c_str(), X_OK) == 0) {
                return file;
            }
        }
    }
    return "";
}

std::optional<std::string> print_pdf(const std::string& html, std::string& reason,
                                     const std::stop_token& stop) {
    const std::string browser = find_browser();
    if (browser.empty()) {
        reason = "Chromium is not installed on the server: open report.html and print that";
        return std::nullopt;
    }
    const PrintFolder folder;
    if (!folder.exists()) {
        reason = "there is no temporary folder to print in";
        return std::nullopt;
    }
    std::ofstream(folder.file("report.html"), std::ios::binary) << html;
    std::vector<std::string> command = {browser,
                                        "--headless",
                                        "--disable-gpu",
                                        "--disable-dev-shm-usage",
                                        "--no-first-run",
                                        "--no-pdf-header-footer",
                                        "--user-data-dir=" + folder.file("profile"),
                                        "--print-to-pdf=" + folder.file("report.pdf"),
                                        "file://" + folder.file("report.html")};
    if (geteuid() == 0) {  // its sandbox does not work for root; the document has no scripts
        command.insert(command.begin() + 2, "--no-sandbox");
    }
    const bool printed = run_program(command, stop);
    std::ifstream file(folder.file("report.pdf"), std::ios::binary);
    std::string pdf((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!printed || !pdf.starts_with("%PDF-")) {
        reason = "Chromium could not print it: open report.html and print that";
        return std::nullopt;
    }
    return pdf;
}

}  // namespace raybundle
