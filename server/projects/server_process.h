// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/descriptor.h"
#include "projects/poll_set.h"

namespace raybundle {

/// What a process uses.
struct ProcessUsage {
    std::uint64_t memory_bytes = 0;  ///< of its own, on disk (swap) included; files it maps are not
    double processor_s = 0.0;        ///< since it has started
};

/// A `raybundle serve` that belongs to this process and ends with it, however that ends. What it
/// writes to its log goes to ours, under its name.
class ServerProcess {
  public:
    /// Starts this executable with other arguments. `name` is for the log. address_file: where the
    /// arguments have it write its address. Throws std::system_error.
    ServerProcess(std::string name, const std::vector<std::string>& arguments,
                  std::string address_file);
    ~ServerProcess();  ///< kills it
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;

    /// How it has ended: its status, or minus the signal. Nothing while it runs, or is stopped.
    std::optional<int> ended();
    /// The port on 127.0.0.1 that it listens on; nothing before it does.
    std::optional<std::uint16_t> port();

    /// Its log says that its scene has been read and accepted.
    [[nodiscard]] bool has_scene() const { return has_scene_; }

    /// It gets no processor time until resume().
    void pause() const;
    void resume() const;
    void end() const;  ///< asks it to end, paused or not
    void kill() const;
    void reload() const;  ///< its settings

    [[nodiscard]] pid_t id() const { return process_; }
    [[nodiscard]] ProcessUsage usage() const;

    void add_to(PollSet& set);
    void step(const PollSet& set);

  private:
    void signal(int number) const;
    void read_log();
    void take_line(std::string_view line);

    std::string name_, address_file_;
    pid_t process_ = -1;
    std::optional<int> status_;
    std::optional<std::uint16_t> port_;
    Descriptor log_;
    std::string line_;  ///< that is not complete yet
    bool has_scene_ = false;
    PollSet::Entry entry_ = PollSet::none;
};

/// A line of a server's log as it stands in ours: with its name before it, or in JSON as `project`.
std::string named_line(std::string_view name, std::string_view line);

}  // namespace raybundle
