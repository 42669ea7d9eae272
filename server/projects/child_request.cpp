// SPDX-License-Identifier: Apache-2.0
#include "projects/child_request.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>

#include "projects/http_head.h"

namespace raybundle {
namespace {

constexpr std::size_t max_answer = 16U << 20U;

}  // namespace

Descriptor connect_to(std::uint16_t port) {
    Descriptor result(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int yes = 1;
    setsockopt(result.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const int failed =
        connect(result.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
    if (failed != 0 && errno != EINPROGRESS) {
        result.reset();
    }
    return result;
}

ChildRequest::ChildRequest(std::uint16_t port, const Question& question, FrontTime until)
    : socket_(connect_to(port)), until_(until), done_(!socket_.open()) {
    RequestHead head{question.method, question.target, {{"Host", "127.0.0.1"}}};
    if (!question.token.empty()) {
        head.headers.emplace_back("Authorization", "Bearer " + question.token);
    }
    if (!question.body.empty()) {
        head.headers.emplace_back("Content-Type", "application/json");
        head.headers.emplace_back("Content-Length", std::to_string(question.body.size()));
    }
    out_.append(forwarded_head(head, question.target, "127.0.0.1") + question.body);
}

void ChildRequest::add_to(PollSet& set) {
    entry_ = done_ ? PollSet::none : set.add(socket_.get(), out_.empty() ? POLLIN : POLLOUT);
}

void ChildRequest::step(const PollSet& set, FrontTime now) {
    if (done_) {
        return;
    }
    if (!out_.empty()) {
        if (set.writable(entry_) && out_.flush(socket_.get()) == ByteQueue::Outcome::finished) {
            finish(false);
        }
    } else if (set.readable(entry_)) {
        const auto outcome = in_.fill(socket_.get());
        answer_ += in_.view();
        in_.drop(in_.view().size());
        if (outcome == ByteQueue::Outcome::finished || answer_.size() > max_answer) {
            finish(outcome == ByteQueue::Outcome::finished);
        }
    }
    if (!done_ && now > until_) {
        finish(false);
    }
}

/// The server ends the connection behind its answer.
void ChildRequest::finish(bool complete) {
    done_ = true;
    socket_.reset();
    constexpr std::string_view head_end = "\r\n\r\n";
    const std::size_t end = answer_.find(head_end);
    if (!complete || end == std::string::npos) {
        return;
    }
    const std::size_t size = end + head_end.size();
    const auto head =
        forwarded_response(std::string_view(answer_).substr(0, size), RequestHead{"GET"}, "");
    answer_.erase(0, size);
    if (head && head->body_bytes == answer_.size()) {
        status_ = head->status;
    }
}

}  // namespace raybundle
