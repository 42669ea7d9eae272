// SPDX-License-Identifier: Apache-2.0
#include "projects/visit.h"

#include <sys/socket.h>

#include <algorithm>
#include <limits>

namespace raybundle {
namespace {

using Outcome = ByteQueue::Outcome;

constexpr std::string_view head_end = "\r\n\r\n";
constexpr auto head_time = std::chrono::seconds(10);
/// For a server to start, which a busy machine has time for.
constexpr auto wait_time = std::chrono::seconds(150);
/// A client that takes nothing for so long is gone.
constexpr auto stall_time = std::chrono::seconds(60);
/// For a client to notice that all has been said; its bytes are read meanwhile, since a connection
/// that ends with bytes unread takes what was sent with it.
constexpr auto linger_time = std::chrono::seconds(2);

int error_of(int socket) {
    int error = 0;
    socklen_t size = sizeof error;
    getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
}

}  // namespace

Visit::Visit(Descriptor client, PeerAddress peer, const Projects& projects, const FrontPages& pages,
             FrontTime now)
    : client_(std::move(client)),
      peer_(std::move(peer)),
      projects_(projects),
      pages_(pages),
      until_(now + head_time) {}

Visit::~Visit() {
    leave(FrontClock::now());
}

void Visit::leave(FrontTime now) {
    server_.reset();
    if (errand_) {
        errand_->project->leave(now);
        errand_.reset();
    }
}

void Visit::add_to(PollSet& set) {
    const bool carrying = phase_ == Phase::carrying;
    const bool reads =
        phase_ == Phase::head || phase_ == Phase::lingering ||
        (carrying && !client_ended_ && errand_->to_send > 0 && to_server_.room() > 0);
    const bool writes = !to_client_.empty();
    client_entry_ =
        set.add(client_.get(), static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)));
    const bool sends = phase_ == Phase::connecting || (carrying && !to_server_.empty());
    const bool receives = carrying && to_client_.room() > 0;
    server_entry_ =
        set.add(server_.get(), static_cast<short>((receives ? POLLIN : 0) | (sends ? POLLOUT : 0)));
}

void Visit::step(const PollSet& set, FrontTime now) {
    switch (phase_) {
        case Phase::head:
            read_head(set, now);
            break;
        case Phase::waiting:
            wait(now);
            break;
        case Phase::connecting:
            connect(set, now);
            break;
        case Phase::carrying:
            carry(set, now);
            break;
        default:
            finish(set, now);
            break;
    }
}

void Visit::read_head(const PollSet& set, FrontTime now) {
    if (set.readable(client_entry_)) {
        if (to_server_.fill(client_.get(), max_head_bytes) == Outcome::finished) {
            phase_ = Phase::done;
            return;
        }
        const std::string_view bytes = to_server_.view();
        const std::size_t end = bytes.find(head_end);
        if (end != std::string_view::npos && end <= max_head_bytes) {
            const std::string text(bytes.substr(0, end + head_end.size()));
            std::string early(bytes.substr(text.size()));
            to_server_.drop(bytes.size());
            begin(text, std::move(early), now);
            return;
        }
        if (bytes.size() > max_head_bytes) {
            reply(FrontPages::refuse({}, 431, "the headers are larger than 32768 bytes"), now);
            return;
        }
    }
    if (now > until_) {
        phase_ = Phase::done;
    }
}

void Visit::begin(const std::string& text, std::string early, FrontTime now) {
    auto parsed = parse_request_head(text);
    if (const auto* const problem = std::get_if<HeadProblem>(&parsed)) {
        reply(FrontPages::refuse({}, problem->status, problem->text), now);
        return;
    }
    Errand errand;
    errand.head = std::move(std::get<RequestHead>(parsed));
    auto target = project_target(errand.head.target);
    if (!target) {
        reply(pages_.answer(errand.head, now), now);
        return;
    }
    errand.project = projects_.find(target->project);
    if (!errand.project) {
        reply(FrontPages::refuse(errand.head, 404, "There is no project of this name"), now);
        return;
    }
    if (target->target.empty()) {
        reply(FrontPages::redirect(errand.head, target->project + "/"), now);
        return;
    }
    errand.target = std::move(target->target);
    errand.early = std::move(early);
    errand.to_send = errand.head.body_bytes;
    begin_errand(std::move(errand), now);
}

void Visit::begin_errand(Errand errand, FrontTime now) {
    if (errand.project->state() != ProjectState::awake) {
        const std::string answer = FrontPages::answer_asleep(errand.head, errand.target);
        if (!answer.empty()) {
            reply(answer, now);
            return;
        }
    }
    if (!errand.project->has_room()) {
        reply(FrontPages::refuse(errand.head, 503, "Too many people look at this project"), now);
        return;
    }
    errand.project->arrive();
    errand_ = std::move(errand);
    phase_ = Phase::waiting;
    until_ = now + wait_time;
    wait(now);
}

void Visit::wait(FrontTime now) {
    if (projects_.find(errand_->project->settings().name) != errand_->project) {
        reply(FrontPages::refuse(errand_->head, 404, "There is no such project any more"), now);
        return;
    }
    const std::string problem = errand_->project->problem(now);
    if (!problem.empty() || now > until_) {
        const std::string reason = problem.empty() ? "its server does not start" : problem;
        reply(FrontPages::refuse(errand_->head, 503, "This project cannot be shown now: " + reason),
              now);
        return;
    }
    if (const auto port = errand_->project->visit()) {
        server_ = connect_to(*port);
        phase_ = server_.open() ? Phase::connecting : phase_;
    }
}

/// A server that has just ended is waited for again.
void Visit::connect(const PollSet& set, FrontTime now) {
    if (!set.writable(server_entry_)) {
        return;
    }
    if (error_of(server_.get()) != 0) {
        server_.reset();
        phase_ = Phase::waiting;
        return;
    }
    Errand& errand = *errand_;
    to_server_.append(forwarded_head(errand.head, errand.target, peer_.text));
    if (!errand.head.upgrade) {  // frames that come before it is let in wait
        errand.early.resize(std::min<std::uint64_t>(errand.early.size(), errand.to_send));
        to_server_.append(errand.early);
        errand.to_send -= errand.early.size();
    }
    if (errand.head.expects_continue) {
        to_client_.append("HTTP/1.1 100 Continue\r\n\r\n");
    }
    phase_ = Phase::carrying;
    until_ = now + stall_time;
}

void Visit::carry(const PollSet& set, FrontTime now) {
    carry_to_server(set);
    if (set.readable(server_entry_) && to_client_.room() > 0) {
        carry_to_client(now);
    }
    if (phase_ == Phase::carrying) {
        flush(now);
    }
}

void Visit::carry_to_server(const PollSet& set) {
    Errand& errand = *errand_;
    if (errand.to_send > 0 && !client_ended_ && set.readable(client_entry_)) {
        const std::size_t before = to_server_.view().size();
        const std::uint64_t limit = std::min<std::uint64_t>(errand.to_send, ByteQueue::most);
        client_ended_ = to_server_.fill(client_.get(), limit) == Outcome::finished;
        errand.to_send -= to_server_.view().size() - before;
    }
    if (to_server_.flush(server_.get()) == Outcome::finished) {
        to_server_.drop(to_server_.view().size());  // what it answers may still be read
        errand.to_send = 0;
    }
    // The end of a request's sender is no news: some say so while they wait for the answer.
    if (client_ended_ && errand.upgraded && to_server_.empty() && !errand.said_end) {
        errand.said_end = true;
        shutdown(server_.get(), SHUT_WR);
    }
}

void Visit::carry_to_client(FrontTime now) {
    Errand& errand = *errand_;
    if (!errand.answered) {
        take_answer(now);
        return;
    }
    const std::size_t before = to_client_.view().size();
    const std::uint64_t limit = errand.to_receive.value_or(ByteQueue::most);
    const Outcome outcome =
        to_client_.fill(server_.get(), std::min<std::uint64_t>(limit, ByteQueue::most));
    if (errand.to_receive) {
        *errand.to_receive -= to_client_.view().size() - before;
    }
    if (outcome == Outcome::finished || errand.to_receive == 0U) {
        end_errand(now);
    }
}

/// Reads the answer as far as it has come, until its head is complete.
void Visit::take_answer(FrontTime now) {
    ByteQueue bytes;
    const Outcome outcome = bytes.fill(server_.get());
    errand_->answer_head += bytes.view();
    const bool understood = take_answer_head();
    if (!understood || (outcome == Outcome::finished && !errand_->answered)) {
        reply(FrontPages::refuse(errand_->head, 502, "The project's server has ended"), now);
    } else if (errand_->answered && errand_->to_receive == 0U) {
        end_errand(now);
    }
}

/// False where it is none of HTTP.
bool Visit::take_answer_head() {
    Errand& errand = *errand_;
    for (;;) {
        const std::size_t end = errand.answer_head.find(head_end);
        if (end == std::string::npos) {
            return errand.answer_head.size() <= ByteQueue::most;
        }
        const std::size_t size = end + head_end.size();
        auto head = forwarded_response(std::string_view(errand.answer_head).substr(0, size),
                                       errand.head, "/p/" + errand.project->settings().name);
        if (!head || (head->status == 101 && !errand.head.upgrade)) {
            return false;
        }
        errand.answer_head.erase(0, size);
        to_client_.append(head->text);
        if (head->status >= 200 || head->status == 101) {
            errand.answered = true;
            errand.upgraded = head->status == 101;
            errand.to_receive = head->body_bytes;
            break;
        }
    }
    if (errand.upgraded) {
        errand.to_send = std::numeric_limits<std::uint64_t>::max();
        to_server_.append(errand.early);
    }
    if (errand.to_receive) {
        errand.answer_head.resize(
            std::min<std::uint64_t>(errand.answer_head.size(), *errand.to_receive));
        *errand.to_receive -= errand.answer_head.size();
    }
    to_client_.append(errand.answer_head);
    return true;
}

void Visit::end_errand(FrontTime now) {
    leave(now);
    phase_ = Phase::ending;
    until_ = now + stall_time;
}

void Visit::reply(const std::string& answer, FrontTime now) {
    to_client_.append(answer);
    end_errand(now);
}

void Visit::flush(FrontTime now) {
    const Outcome outcome = to_client_.flush(client_.get());
    if (outcome == Outcome::moved || to_client_.empty()) {
        until_ = now + stall_time;
    } else if (outcome == Outcome::finished || now > until_) {
        leave(now);
        phase_ = Phase::done;
    }
}

void Visit::finish(const PollSet& set, FrontTime now) {
    if (phase_ == Phase::ending) {
        flush(now);
        if (phase_ == Phase::ending && to_client_.empty()) {
            shutdown(client_.get(), SHUT_WR);
            phase_ = Phase::lingering;
            until_ = now + linger_time;
        }
    } else if (phase_ == Phase::lingering) {
        ByteQueue unread;
        const bool over =
            set.readable(client_entry_) && unread.fill(client_.get()) == Outcome::finished;
        if (over || now > until_) {
            phase_ = Phase::done;
        }
    }
}

void Visit::say_goodbye(FrontTime now) {
    if (phase_ == Phase::head) {
        phase_ = Phase::done;
    } else if (phase_ == Phase::waiting || phase_ == Phase::connecting) {
        reply(FrontPages::refuse(errand_->head, 503, "The server is stopping"), now);
    }
}

}  // namespace raybundle
