// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "raybundle.pb.h"

namespace raybundle {

/// The journal cannot be used; the text names the file or server and the reason, for the operator.
class JournalError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What viewers leave in a session besides changes; the numbers are stored.
enum class NoteKind : std::uint8_t {
    pin = 1,
    viewpoint = 2,
    target = 3,
    lighting_scene = 4,
    zone = 140,
    requirements = 141,
    played = 180  ///< by number of the animation: its last request with a key
};

/// By what a request is known again that has been answered.
struct RequestKey {
    std::string text;         ///< ClientMessage.request_key
    std::uint32_t part = 0;   ///< of the changes that the request stands for this one, from 1
    std::uint32_t parts = 0;  ///< how many these are; 0: this change is what was asked for

    [[nodiscard]] bool complete() const { return part == parts; }
};

/// What another server of the project has added to its log: a change, or a note.
struct LogEntry {
    v1::SceneChanged change;  ///< unset: a note
    NoteKind kind = NoteKind::pin;
    std::uint32_t number = 0;
    std::string body;              ///< of the note; empty: it is gone
    std::vector<RequestKey> keys;  ///< of the requests for it
    std::string traceparent;       ///< of the trace that the change is part of (W3C); empty: none
};

/// A change that somebody may ask for again.
struct KeyedChange {
    v1::SceneChanged change;
    v1::SceneChanged before;  ///< as append() had it; unset: not known any more
    std::vector<RequestKey> keys;
};

/// A note that somebody may ask for again.
struct KeyedNote {
    std::string key;  ///< ClientMessage.request_key
    NoteKind kind = NoteKind::pin;
    std::uint32_t number = 0;  ///< which may be gone meanwhile
};

/// What another server of the project tells and nobody keeps.
struct PeerNews {
    std::uint32_t server = 0;  ///< its number
    std::string body;
};

/// What has become of a change that was to be added.
enum class Appended : std::uint8_t {
    yes,
    conflict,  ///< another server was first: take_entries() has its changes
};

/// The ordered log of a project: its scene's changes and what reviewers left. It belongs to one
/// server (SessionJournal) or to several at a time (RedisLog); who uses it need not know which. All
/// functions are for one thread.
class ProjectLog {
  public:
    ProjectLog() = default;
    virtual ~ProjectLog() = default;
    ProjectLog(const ProjectLog&) = delete;
    ProjectLog& operator=(const ProjectLog&) = delete;

    /// Changes that the log had when it was opened, and those appended since.
    [[nodiscard]] virtual std::uint32_t epoch() const = 0;

    /// What brings the scene file to the state when the log was opened, in order of epochs. One
    /// that cannot be read has its epoch only. Throws JournalError.
    [[nodiscard]] virtual std::vector<v1::SceneChanged> changes() = 0;
    /// What the subjects of the last changes were like before them, in order and each with the
    /// epoch of its change; without gaps up to the epoch at opening, so maybe none. Throws
    /// JournalError.
    [[nodiscard]] virtual std::vector<v1::SceneChanged> past() = 0;

    /// Adds a change, whose epoch must be one more than that of the last change known, and what its
    /// subject was like before. traceparent: what other servers go on with; empty: nothing. What it
    /// has returned `yes` of survives the process and the machine.
    /// Throws JournalError: the change is not in the log, or, where the connection broke meanwhile,
    /// comes back by take_entries().
    [[nodiscard]] virtual Appended append(const v1::SceneChanged& change,
                                          const v1::SceneChanged& before,
                                          const std::vector<RequestKey>& keys,
                                          const std::string& traceparent) = 0;

    /// What other servers have added, in order; empty where there are no others.
    [[nodiscard]] virtual std::vector<LogEntry> take_entries() { return {}; }
    /// Changes of before the log was opened that had a key, newest last, as far as they are known.
    /// Throws JournalError.
    [[nodiscard]] virtual std::vector<KeyedChange> keyed() = 0;

    /// A number that no note of that kind has, on any server; `free` is one that this one knows
    /// none of. Throws JournalError.
    [[nodiscard]] virtual std::uint32_t new_number(NoteKind kind, std::uint32_t free) = 0;
    /// Keeps a note, in place of an earlier one of its number. Survives as a change does. key: of
    /// the request for it; empty: none. `conflict`: another server has kept or forgotten it
    /// meanwhile, or kept what the key asks for, which is in what take_entries() gives next;
    /// nothing is written then. Throws JournalError: likewise.
    [[nodiscard]] virtual Appended keep_note(NoteKind kind, std::uint32_t number,
                                             const std::string& body, const std::string& key) = 0;
    /// Notes of before the log was opened that had a key, newest last, as far as they are known.
    /// Throws JournalError.
    [[nodiscard]] virtual std::vector<KeyedNote> keyed_notes() = 0;
    /// Forgets a note, whatever others have kept meanwhile; no error where there is none.
    virtual void drop_note(NoteKind kind, std::uint32_t number) = 0;
    /// Bodies of all notes of a kind, by number. Throws JournalError.
    [[nodiscard]] virtual std::vector<std::string> notes(NoteKind kind) = 0;

    /// Keeps in mind which scene of the library is shown in place of the one that the server was
    /// started with. Throws JournalError.
    virtual void remember_scene(const std::string& started_with, const std::string& shown) = 0;

    /// Tells other servers what nobody keeps. lasting: what is so until the next one of the kind.
    virtual void publish(const std::string& /*body*/, bool /*lasting*/) {}
    [[nodiscard]] virtual std::vector<PeerNews> take_news() { return {}; }

    /// Of a damaged journal that was set aside: its name now.
    [[nodiscard]] virtual std::optional<std::string> set_aside() const { return std::nullopt; }
    /// Why nothing can be appended at present, as far as that is known without trying.
    [[nodiscard]] virtual std::optional<std::string> outage() const { return std::nullopt; }
    /// Others use it, too: what one server lacks it takes up by take_entries().
    [[nodiscard]] virtual bool shared() const { return false; }
};

}  // namespace raybundle
