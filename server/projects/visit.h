// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "net/access/address_count.h"
#include "projects/byte_queue.h"
#include "projects/front_pages.h"

namespace raybundle {

/// A connection of a client: one request, answered by the front or carried to the server of a
/// project, byte by byte once its head has been read. A WebSocket goes on until either side ends.
/// A second request on the same connection is never read, so it cannot reach another project.
class Visit {
  public:
    Visit(Descriptor client, PeerAddress peer, const Projects& projects, const FrontPages& pages,
          FrontTime now);
    ~Visit();
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    [[nodiscard]] bool done() const { return phase_ == Phase::done; }
    /// It waits for a server to listen, which no socket tells.
    [[nodiscard]] bool waits() const { return phase_ == Phase::waiting; }
    [[nodiscard]] const PeerAddress& peer() const { return peer_; }

    void add_to(PollSet& set);
    void step(const PollSet& set, FrontTime now);
    /// The front stops: who is not with a server yet is sent away.
    void say_goodbye(FrontTime now);

  private:
    enum class Phase {
        head,        ///< of the request is read
        waiting,     ///< for the project's server
        connecting,  ///< to it
        carrying,    ///< both ways
        ending,      ///< what is left goes out
        lingering,   ///< the client has everything, and may still be sending
        done
    };
    /// A request that is carried.
    struct Errand {
        std::shared_ptr<Project> project;
        RequestHead head;
        std::string target;                       ///< within the project
        std::string early;                        ///< what has come behind the head
        std::uint64_t to_send = 0;                ///< bytes that the client may still send
        std::string answer_head;                  ///< as far as it has come
        bool answered = false;                    ///< its head is complete
        bool upgraded = false;                    ///< it is a WebSocket now
        bool said_end = false;                    ///< the server knows that the client has ended
        std::optional<std::uint64_t> to_receive;  ///< of the answer; nothing: until the end
    };

    void read_head(const PollSet& set, FrontTime now);
    void begin(const std::string& text, std::string early, FrontTime now);
    void begin_errand(Errand errand, FrontTime now);
    void wait(FrontTime now);
    void connect(const PollSet& set, FrontTime now);
    void carry(const PollSet& set, FrontTime now);
    void carry_to_server(const PollSet& set);
    void carry_to_client(FrontTime now);
    void take_answer(FrontTime now);
    bool take_answer_head();
    void finish(const PollSet& set, FrontTime now);
    void reply(const std::string& answer, FrontTime now);
    void leave(FrontTime now);
    void flush(FrontTime now);
    void end_errand(FrontTime now);

    Descriptor client_, server_;
    PeerAddress peer_;
    const Projects& projects_;
    const FrontPages& pages_;
    Phase phase_ = Phase::head;
    FrontTime until_;  ///< of what it waits for; while it carries, of bytes that the client takes
    ByteQueue to_server_, to_client_;
    bool client_ended_ = false;
    std::optional<Errand> errand_;
    PollSet::Entry client_entry_ = PollSet::none, server_entry_ = PollSet::none;
};

}  // namespace raybundle
