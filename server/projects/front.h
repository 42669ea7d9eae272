// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "projects/visit.h"

namespace raybundle {

/// Many projects behind one address: lists them, and carries whoever visits one to a server of its
/// own, which runs only while somebody is there. One thread; nothing of it waits but poll().
class Front {
  public:
    /// Listens. Blocks SIGTERM, SIGINT, SIGHUP and SIGCHLD, for run(): make it before any thread.
    /// Throws std::runtime_error that names the address or the folder.
    explicit Front(FrontSettings settings);

    /// "http://127.0.0.1:8080"
    [[nodiscard]] std::string address() const;

    /// Serves until SIGTERM or SIGINT, and until all servers have ended then. `reload` makes new
    /// settings at SIGHUP; what it throws is logged, and changes nothing. Address and limits of
    /// connections stay as they are.
    void run(const std::function<FrontSettings()>& reload);

  private:
    void turn(FrontTime now);
    void read_signals();
    void set_settings(const std::function<FrontSettings()>& reload);
    void accept_clients(FrontTime now);
    [[nodiscard]] bool accepts(const PeerAddress& peer) const;
    void stop(FrontTime now);
    [[nodiscard]] int patience_ms() const;

    FrontSettings settings_;
    Projects projects_;
    FrontPages pages_;
    Descriptor listener_, signals_;
    PollSet set_;
    PollSet::Entry listener_entry_ = PollSet::none, signals_entry_ = PollSet::none;
    std::vector<std::unique_ptr<Visit>> visits_;
    AddressCount addresses_;
    FrontTime accept_again_;  ///< after the system had no descriptor left
    bool stop_asked_ = false, reload_asked_ = false;
    FrontTime stop_until_ = FrontTime::max();
};

}  // namespace raybundle
