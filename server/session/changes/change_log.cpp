// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_log.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "session/messages/addition_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

/// What the journal keeps of a change for its history: the state before it, and who made it when.
v1::SceneChanged signed_state(v1::SceneChanged before, const v1::SceneChanged& change) {
    before.set_by(change.by());
    before.set_by_name(change.by_name());
    before.set_at_ms(change.at_ms());
    if (change.has_animation()) {
        *before.mutable_animation() = change.animation();
    }
    if (before.has_move_object() && change.move_object().has_final()) {
        before.mutable_move_object()->set_final(change.move_object().final());
    }
    if (before.has_set_light() && change.set_light().has_fade_seconds()) {
        before.mutable_set_light()->set_fade_seconds(change.set_light().fade_seconds());
    }
    return before;
}

/// The state alone.
v1::SceneChanged unsigned_state(v1::SceneChanged state) {
    state.clear_by();
    state.clear_by_name();
    state.clear_at_ms();
    state.clear_animation();
    if (state.has_move_object()) {
        state.mutable_move_object()->clear_final();
    }
    if (state.has_set_light()) {
        state.mutable_set_light()->clear_fade_seconds();
    }
    return state;
}

/// The change that led from one state to the other. signature: of signed_state().
v1::SceneChanged change_between(const v1::SceneChanged& signature, v1::SceneChanged after) {
    set_before(unsigned_state(signature), after);
    after.set_by(signature.by());
    after.set_by_name(signature.by_name());
    after.set_at_ms(signature.at_ms());
    if (signature.has_animation()) {
        *after.mutable_animation() = signature.animation();
    }
    if (after.has_move_object() && signature.move_object().has_final()) {
        after.mutable_move_object()->set_final(signature.move_object().final());
    }
    if (after.has_set_light() && signature.set_light().has_fade_seconds()) {
        after.mutable_set_light()->set_fade_seconds(signature.set_light().fade_seconds());
    }
    return after;
}

bool is_addition(const v1::SceneChanged& change) {
    return change.has_add_object() || change.has_add_luminaire();
}

/// What is added comes before what is done to it, in the order of its numbers.
void additions_first(std::vector<v1::SceneChanged>& changes) {
    std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) {
        const bool added = is_addition(a);
        return added != is_addition(b) ? added : added && subject_of(a) < subject_of(b);
    });
}

/// Adds an object of the journal. False: its file is gone, or is another one.
bool grow(Scene& scene, PatchMesh& mesh, const v1::SceneChanged& change) {
    try {
        add_object(scene, mesh, from_message(change.add_object()));
        return true;
    } catch (const SceneError& error) {
        spdlog::error("object {} of the journal is lost: {}", change.add_object().object(),
                      error.what());
        return false;
    }
}

/// Whether a change of the journal can be made. What has been added and removed since is there,
/// and removed.
bool fits(const Scene& scene, v1::SceneChanged change) {
    if (change.has_add_luminaire() && !change.add_luminaire().photometry().empty()) {
        change.mutable_add_luminaire()->set_removed(false);
    }
    if (change.has_add_object()) {
        change.mutable_add_object()->set_removed(false);
    }
    return problem_of(scene, change).code() == v1::Error::CODE_UNSPECIFIED;
}

}  // namespace

ChangeLog::ChangeLog(const JournalSettings& settings)
    : ChangeLog(settings.file, [settings] { return std::make_unique<SessionJournal>(settings); }) {}

ChangeLog::ChangeLog(std::string place, Opener open)
    : place_(std::move(place)), open_(std::move(open)), required_(true) {
    this->open();
    epoch_ = journal_ ? journal_->epoch() : 0;
}

void ChangeLog::suspend() {
    if (journal_ && !journal_->shared()) {
        journal_.reset();
    }
}

void ChangeLog::resume() {
    if (required_ && !journal_) {
        open();
    }
}

void ChangeLog::open() {
    try {
        journal_ = open_();
        working_ = !journal_->outage();
        problem_.clear();
        if (journal_->set_aside()) {
            spdlog::error("the journal was damaged; it is kept as {} and a new one begins",
                          *journal_->set_aside());
        }
    } catch (const JournalError& error) {
        working_ = false;
        if (problem_ != error.what()) {  // each change tries again
            problem_ = error.what();
            spdlog::error("the scene cannot be changed, since changes cannot be saved: {}",
                          problem_);
        }
    }
}

/// Takes up a journal that could not be used before, if it goes on where this scene is.
void ChangeLog::open_again() {
    open();
    if (journal_ && journal_->epoch() != epoch_) {
        spdlog::error("the journal can be used again, but has changes that are not shown: restart");
        journal_.reset();
        working_ = false;
    }
}

void ChangeLog::restore(Scene& scene, PatchMesh& mesh) {
    if (!journal_) {
        return;
    }
    std::vector<v1::SceneChanged> changes;
    try {
        changes = journal_->changes();
    } catch (const JournalError& error) {
        working_ = false;
        journal_.reset();
        spdlog::error("the scene is shown without the changes made to it and cannot be changed: {}",
                      error.what());
        return;
    }
    additions_first(changes);
    bool surfaces = false;
    for (const v1::SceneChanged& change : changes) {
        if (change.change_case() == v1::SceneChanged::CHANGE_NOT_SET) {
            spdlog::error("change {} of the journal cannot be read and is lost", change.epoch());
            note_lost();
            continue;
        }
        if (!fits(scene, change)) {
            spdlog::warn("change {} of the journal does not fit the scene", change.epoch());
            note_lost();
            continue;
        }
        if (grows(scene, change) && !grow(scene, mesh, change)) {
            note_lost();
            continue;
        }
        apply(scene, change);
        note_animation(change);
        surfaces |= !change.has_move_object();
    }
    if (surfaces) {
        std::vector<std::uint32_t> materials(scene.materials.size());
        std::iota(materials.begin(), materials.end(), 0U);
        refresh_surfaces(scene, materials, mesh);
    }
    restore_history(scene);
    restore_keys();
    if (epoch_ > 0) {
        spdlog::info("the session goes on after change {}", epoch_);
    }
}

/// changes come in their order.
void ChangeLog::note_animation(const v1::SceneChanged& change) {
    if (change.has_animation()) {
        const std::string& name = change.animation().animation();
        std::erase_if(animation_steps_, [&name](const auto& s) { return s.animation() == name; });
        animation_steps_.push_back(change.animation());
    }
}

/// What can be gone back to in this session. scene: at its present state.
void ChangeLog::restore_history(const Scene& scene) {
    history_ = SceneHistory(epoch_);
    std::vector<v1::SceneChanged> past;
    try {
        past = journal_->past();
    } catch (const JournalError& error) {
        spdlog::error("changes before the restart cannot be undone: {}", error.what());
    }
    const bool fit = std::all_of(past.begin(), past.end(),
                                 [&scene](const auto& before) { return fits(scene, before); });
    if (past.empty() || !fit) {
        return;
    }
    // After a change its subject is what it is before its next one.
    std::vector<v1::SceneChanged> after(past.size());
    std::map<ChangeSubject, v1::SceneChanged> later;
    for (std::size_t i = past.size(); i-- > 0;) {
        const auto known = later.find(subject_of(past[i]));
        after[i] = known != later.end() ? unsigned_state(known->second) : state_of(scene, past[i]);
        after[i].set_epoch(past[i].epoch());
        later[subject_of(past[i])] = past[i];
    }
    history_ = SceneHistory(past.front().epoch() - 1);
    for (std::size_t i = 0; i < past.size(); ++i) {
        history_.note(unsigned_state(past[i]), after[i], past[i].animation().first_epoch());
        records_.add(change_between(past[i], after[i]));
    }
}

/// What has been answered before a restart is known again.
void ChangeLog::restore_keys() {
    try {
        for (const KeyedChange& keyed : journal_->keyed()) {
            v1::SceneChanged record = keyed.change;
            set_before(unsigned_state(keyed.before), record);
            made_.note(keyed.keys, record);
        }
        for (const KeyedNote& note : journal_->keyed_notes()) {
            made_.note(note);
        }
    } catch (const JournalError& error) {
        spdlog::error("what is asked for again may be made twice: {}", error.what());
    }
}

/// Whether there is a journal, where there has to be one.
bool ChangeLog::usable() {
    overtaken_ = false;
    if (required_ && !journal_) {
        open_again();
    }
    if (required_ && !journal_) {
        ++failures_;
        return false;
    }
    return true;
}

void ChangeLog::refused(const std::string& what, const std::string& reason) {
    ++failures_;
    working_ = false;
    outage_ = journal_ && journal_->shared() ? reason : "";
    spdlog::error("{} was refused, since it could not be saved: {}", what, reason);
}

v1::Error ChangeLog::refusal(const std::string& text) const {
    v1::Error error;
    if (overtaken_) {
        error.set_code(v1::Error::UNAVAILABLE);
        error.set_message(text + ": somebody on another server has just changed it; ask again");
        return error;
    }
    error.set_code(outage_.empty() ? v1::Error::INTERNAL : v1::Error::UNAVAILABLE);
    error.set_message(outage_.empty() ? text
                                      : text +
                                            ": what keeps the project does not answer. Looking "
                                            "goes on; ask again later");
    return error;
}

Recorded ChangeLog::record(v1::SceneChanged& change, const v1::SceneChanged& before,
                           const std::vector<RequestKey>& keys, const std::string& traceparent) {
    change.set_epoch(epoch_ + 1);
    if (!usable()) {
        return Recorded::no;
    }
    try {
        if (journal_ && journal_->append(change, signed_state(before, change), keys, traceparent) ==
                            Appended::conflict) {
            return Recorded::later;
        }
    } catch (const JournalError& error) {
        refused("a change", error.what());
        return Recorded::no;
    }
    working_ = true;
    return accept(change, before, keys) ? Recorded::yes : Recorded::no;
}

std::vector<LogEntry> ChangeLog::take_entries() {
    if (!shared()) {
        return {};
    }
    working_ = !journal_->outage();
    std::vector<LogEntry> entries = journal_->take_entries();
    for (const LogEntry& entry : entries) {
        if (entry.change.epoch() == 0 && !entry.keys.empty()) {
            made_.note(KeyedNote{entry.keys.front().text, entry.kind, entry.number});
        }
    }
    return entries;
}

bool ChangeLog::accept(const v1::SceneChanged& change, const v1::SceneChanged& before,
                       const std::vector<RequestKey>& keys) {
    if (change.epoch() != epoch_ + 1) {
        return false;
    }
    ++epoch_;
    v1::SceneChanged record = change;
    set_before(before, record);
    made_.note(keys, record);
    records_.add(std::move(record));
    return true;
}

void ChangeLog::publish(const v1::ServerMessage& message, bool lasting) {
    if (shared()) {
        journal_->publish(message.SerializeAsString(), lasting);
    }
}

std::vector<PeerNews> ChangeLog::take_news() {
    return shared() ? journal_->take_news() : std::vector<PeerNews>();
}

std::optional<std::uint32_t> ChangeLog::new_number(NoteKind kind, std::uint32_t free) {
    if (!usable()) {
        return std::nullopt;
    }
    try {
        return journal_ ? journal_->new_number(kind, free) : free;
    } catch (const JournalError& error) {
        refused("a note", error.what());
        return std::nullopt;
    }
}

bool ChangeLog::keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                          const std::string& key) {
    if (!usable()) {
        return false;
    }
    try {
        if (journal_ && body.empty()) {
            journal_->drop_note(kind, number);
        } else if (journal_) {
            overtaken_ = journal_->keep_note(kind, number, body, key) == Appended::conflict;
        }
    } catch (const JournalError& error) {
        refused("a note", error.what());
        return false;
    }
    if (!overtaken_) {
        made_.note(KeyedNote{key, kind, number});
    }
    return !overtaken_;
}

void ChangeLog::remember_scene(const std::string& started_with, const std::string& shown) {
    try {
        if (journal_) {
            journal_->remember_scene(started_with, shown);
        }
    } catch (const JournalError& error) {
        spdlog::error("after a restart another scene will be shown: {}", error.what());
    }
}

std::vector<std::string> ChangeLog::notes(NoteKind kind) {
    try {
        return journal_ ? journal_->notes(kind) : std::vector<std::string>();
    } catch (const JournalError& error) {
        spdlog::error("notes are missing: {}", error.what());
        return {};
    }
}

}  // namespace raybundle
