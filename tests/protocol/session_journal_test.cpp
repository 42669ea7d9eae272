// SPDX-License-Identifier: Apache-2.0
#include "journal/session_journal.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "journal/request_keys.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

v1::SceneChanged move(std::uint32_t epoch, std::uint32_t object, float x) {
    v1::SceneChanged change;
    change.set_epoch(epoch);
    change.set_by(3);
    change.mutable_move_object()->set_object(object);
    change.mutable_move_object()->mutable_transform()->mutable_translation()->set_x(x);
    return change;
}

v1::SceneChanged light(std::uint32_t epoch, std::uint32_t id) {
    v1::SceneChanged change;
    change.set_epoch(epoch);
    change.mutable_set_light()->set_light(id);
    return change;
}

class SessionJournalTest : public testing::Test {
  protected:
    SessionJournalTest() {
        std::string pattern = fs::temp_directory_path() / "raybundle_journal_XXXXXX";
        folder_ = mkdtemp(pattern.data());
        settings_.file = folder_ / "session.db";
        settings_.scene_name = "room";
        settings_.scene_digest = "digest of the room";
    }
    ~SessionJournalTest() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    [[nodiscard]] std::size_t damaged_files() const {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(folder_)) {
            count += entry.path().string().find(".damaged-") != std::string::npos ? 1 : 0;
        }
        return count;
    }

    fs::path folder_;
    JournalSettings settings_;
};

TEST_F(SessionJournalTest, ANewOneIsEmpty) {
    SessionJournal journal(settings_);
    EXPECT_EQ(journal.epoch(), 0U);
    EXPECT_TRUE(journal.changes().empty());
}

TEST_F(SessionJournalTest, GoesOnWhereItWas) {
    {
        SessionJournal journal(settings_);
        journal.append(move(1, 2, 0.5F));
        journal.append(move(2, 1, 1.5F));
        journal.append(move(3, 2, 2.5F));
    }
    SessionJournal journal(settings_);
    EXPECT_EQ(journal.epoch(), 3U);
    const auto changes = journal.changes();
    ASSERT_EQ(changes.size(), 2U) << "an object's earlier places are forgotten";
    EXPECT_EQ(changes[0].move_object().object(), 1U);
    EXPECT_EQ(changes[1].SerializeAsString(), move(3, 2, 2.5F).SerializeAsString());
}

TEST_F(SessionJournalTest, PartialChangesOfALightAddUp) {
    v1::SceneChanged off = light(1, 4);
    off.mutable_set_light()->set_on(false);
    v1::SceneChanged dim = light(2, 4);
    dim.mutable_set_light()->set_intensity(80.0F);
    {
        SessionJournal journal(settings_);
        journal.append(off);
        journal.append(dim);
        journal.append(light(3, 5));
    }
    const auto changes = SessionJournal(settings_).changes();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_TRUE(changes[0].set_light().has_on());
    EXPECT_FALSE(changes[0].set_light().on());
    EXPECT_EQ(changes[0].set_light().intensity(), 80.0F);
    EXPECT_EQ(changes[0].epoch(), 2U);
}

TEST_F(SessionJournalTest, KnowsWhatWasBeforeTheLastChangesUpToAGap) {
    {
        SessionJournal journal(settings_);
        journal.append(move(1, 2, 0.5F), move(0, 2, 0.0F));
        journal.append(move(2, 2, 1.5F));  // as by a server that keeps none
        journal.append(move(3, 1, 2.5F), move(0, 1, 0.0F));
        journal.append(move(4, 2, 3.5F), move(2, 2, 1.5F));
    }
    SessionJournal journal(settings_);
    const auto past = journal.past();
    ASSERT_EQ(past.size(), 2U);
    EXPECT_EQ(past[0].SerializeAsString(), move(3, 1, 0.0F).SerializeAsString());
    EXPECT_EQ(past[1].SerializeAsString(), move(4, 2, 1.5F).SerializeAsString());
    journal.append(move(5, 2, 4.5F));
    EXPECT_TRUE(journal.past().empty());
}

TEST_F(SessionJournalTest, KnowsWhatWasMadeOfARequestWithAKey) {
    {
        SessionJournal journal(settings_);
        journal.append(move(1, 2, 0.5F), move(0, 2, 0.0F), {{"a"}, {"b"}});
        journal.append(move(2, 2, 1.5F), move(0, 2, 0.5F));
        journal.append(light(3, 5), {}, {{"undo", 1, 2}});
        journal.append(move(4, 2, 2.5F), {}, {{"undo", 2, 2}});
    }
    const auto keyed = SessionJournal(settings_).keyed();
    ASSERT_EQ(keyed.size(), 2U) << "of a request the last change counts";
    EXPECT_EQ(keyed[0].change.SerializeAsString(), move(1, 2, 0.5F).SerializeAsString())
        << "as it was made, whatever came after";
    EXPECT_EQ(keyed[0].before.SerializeAsString(), move(0, 2, 0.0F).SerializeAsString());
    ASSERT_EQ(keyed[0].keys.size(), 2U);
    EXPECT_EQ(keyed[0].keys[1].text, "b");
    EXPECT_TRUE(keyed[0].keys[1].complete());
    EXPECT_EQ(keyed[1].change.epoch(), 4U);
    ASSERT_EQ(keyed[1].keys.size(), 1U);
    EXPECT_EQ(keyed[1].keys[0].part, 2U);
    EXPECT_EQ(keyed[1].keys[0].parts, 2U);
    settings_.scene_digest = "another";
    EXPECT_TRUE(SessionJournal(settings_).keyed().empty());
}

TEST_F(SessionJournalTest, ForgetsKeysThatAreLongAgo) {
    SessionJournal journal(settings_);
    journal.append(move(1, 2, 0.5F), {}, {{"a"}});
    journal.append(move(SessionJournal::most_past, 2, 1.5F), {}, {{"b"}});
    EXPECT_EQ(journal.keyed().size(), 2U);
    journal.append(move(SessionJournal::most_past + 1, 2, 1.5F));
    ASSERT_EQ(journal.keyed().size(), 1U);
    EXPECT_EQ(journal.keyed()[0].keys[0].text, "b");
    std::vector<RequestKey> many;
    for (std::uint32_t i = 0; i < most_request_keys; ++i) {
        many.push_back({"c" + std::to_string(i)});
    }
    journal.append(move(SessionJournal::most_past + 2, 2, 1.5F), {}, many);
    ASSERT_EQ(journal.keyed().size(), 1U) << "the file does not grow with time";
    EXPECT_EQ(journal.keyed()[0].keys.size(), most_request_keys);
}

TEST_F(SessionJournalTest, AnotherSceneIsAnotherSession) {
    SessionJournal(settings_).append(move(1, 1, 1.0F));
    JournalSettings other = settings_;
    other.scene_digest = "digest of the hall";
    EXPECT_EQ(SessionJournal(other).epoch(), 0U);
    EXPECT_EQ(SessionJournal(settings_).epoch(), 1U);
}

TEST_F(SessionJournalTest, OneServerAtATime) {
    const SessionJournal first(settings_);
    EXPECT_THROW(SessionJournal second(settings_), JournalError);
}

/// A process that appends until it is killed; what it has reported before must be there after.
TEST_F(SessionJournalTest, WhatWasAppendedSurvivesKill) {
    for (int round = 0; round < 5; ++round) {
        int reports[2];
        ASSERT_EQ(pipe(reports), 0);
        const pid_t child = fork();
        if (child == 0) {
            SessionJournal journal(settings_);
            for (std::uint32_t epoch = journal.epoch() + 1; true; ++epoch) {
                journal.append(move(epoch, epoch % 7 + 1, static_cast<float>(epoch)));
                if (write(reports[1], &epoch, sizeof epoch) != sizeof epoch) {
                    _exit(1);
                }
            }
        }
        std::uint32_t acknowledged = 0;
        for (int i = 0; i < 20 + round; ++i) {
            ASSERT_EQ(read(reports[0], &acknowledged, sizeof acknowledged),
                      static_cast<ssize_t>(sizeof acknowledged));
        }
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        close(reports[1]);
        for (std::uint32_t later = 0; read(reports[0], &later, sizeof later) == sizeof later;) {
            acknowledged = later;
        }
        close(reports[0]);
        SessionJournal journal(settings_);
        EXPECT_GE(journal.epoch(), acknowledged);
        EXPECT_LE(journal.epoch(), acknowledged + 1);
        const auto changes = journal.changes();
        ASSERT_FALSE(changes.empty());
        EXPECT_EQ(changes.back().epoch(), journal.epoch());
        EXPECT_LE(changes.size(), 7U);
        EXPECT_FALSE(journal.set_aside());
    }
}

TEST_F(SessionJournalTest, ADamagedFileIsSetAside) {
    SessionJournal(settings_).append(move(1, 1, 1.0F));
    std::ofstream(settings_.file, std::ios::binary) << "this is no database at all, not even close";
    SessionJournal journal(settings_);
    ASSERT_TRUE(journal.set_aside().has_value());
    EXPECT_TRUE(fs::exists(*journal.set_aside()));
    EXPECT_EQ(journal.epoch(), 0U);
    EXPECT_NO_THROW(journal.append(move(1, 1, 1.0F)));
}

TEST_F(SessionJournalTest, DamageInTheMiddleIsFound) {
    {
        SessionJournal journal(settings_);
        for (std::uint32_t i = 1; i <= 400; ++i) {
            journal.append(move(i, i, 1.0F));
        }
    }
    const auto size = fs::file_size(settings_.file);
    ASSERT_GT(size, 20000U);
    std::fstream stream(settings_.file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(8192);
    stream << std::string(size - 8192 - 4096, '\x55');
    stream.close();
    EXPECT_TRUE(SessionJournal(settings_).set_aside().has_value());
    EXPECT_EQ(damaged_files(), 1U);
}

/// Damage that SQLite does not see costs one change, not the session.
TEST_F(SessionJournalTest, AChangeThatCannotBeReadIsLostAlone) {
    {
        SessionJournal journal(settings_);
        for (std::uint32_t i = 1; i <= 3; ++i) {
            journal.append(move(i, i, 1.0F));
        }
    }
    SqliteDatabase(settings_.file).execute("UPDATE change SET body=x'ff00ff' WHERE epoch=2");
    SessionJournal journal(settings_);
    const auto changes = journal.changes();
    ASSERT_EQ(changes.size(), 3U);
    EXPECT_EQ(changes[1].epoch(), 2U);
    EXPECT_EQ(changes[1].change_case(), v1::SceneChanged::CHANGE_NOT_SET);
    EXPECT_EQ(changes[2].move_object().object(), 3U);
    EXPECT_EQ(journal.epoch(), 3U);
    EXPECT_NO_THROW(journal.append(move(4, 2, 2.0F))) << "it replaces what cannot be read";
    EXPECT_EQ(journal.changes().back().move_object().transform().translation().x(), 2.0F);
}

TEST_F(SessionJournalTest, AFullDiskIsAnErrorAndChangesNothing) {
    settings_.max_bytes = 16 * 4096;  // its tables and indices alone take a page each
    SessionJournal journal(settings_);
    std::uint32_t epoch = 0;
    bool full = false;
    for (std::uint32_t i = 1; i <= 2000 && !full; ++i) {
        try {
            journal.append(move(i, i, 1.0F));
            epoch = i;
        } catch (const JournalError& error) {
            full = true;
            EXPECT_NE(std::string(error.what()).find("full"), std::string::npos) << error.what();
        }
    }
    ASSERT_TRUE(full);
    EXPECT_EQ(journal.epoch(), epoch);
    EXPECT_EQ(journal.changes().size(), epoch);
    EXPECT_NO_THROW(journal.append(move(epoch + 1, 1, 2.0F))) << "it replaces another";
}

TEST_F(SessionJournalTest, ABackupIsMadeWhileAServerWrites) {
    SessionJournal journal(settings_);
    journal.append(move(1, 2, 0.5F));
    journal.append(move(2, 1, 1.5F));
    const std::string copy = folder_ / "copy.db";
    SqliteDatabase(settings_.file).execute("VACUUM INTO '" + copy + "'");
    EXPECT_NO_THROW(journal.append(move(3, 3, 2.5F)));
    JournalSettings of_copy = settings_;
    of_copy.file = copy;
    SessionJournal restored(of_copy);
    EXPECT_EQ(restored.epoch(), 2U);
    EXPECT_EQ(restored.changes().size(), 2U);
}

/// A reader holds a lock of SQLite as long as it likes: changes go on.
TEST_F(SessionJournalTest, WhoReadsDoesNotHoldUpChanges) {
    SessionJournal journal(settings_);
    journal.append(move(1, 2, 0.5F));
    SqliteDatabase reader(settings_.file);
    reader.execute("BEGIN");
    auto select = reader.prepare("SELECT epoch FROM change");
    ASSERT_TRUE(select.step());
    EXPECT_NO_THROW(journal.append(move(2, 3, 2.5F)));
    EXPECT_FALSE(select.step()) << "it sees what was there when it began";
}

TEST_F(SessionJournalTest, ASecondServerIsToldAndMayComeLater) {
    std::optional<SessionJournal> first(settings_);
    first->append(move(1, 2, 0.5F));
    try {
        const SessionJournal second(settings_);
        ADD_FAILURE() << "two servers write";
    } catch (const JournalError& error) {
        EXPECT_EQ(std::string(error.what()), settings_.file + ": another server uses it");
    }
    EXPECT_EQ(damaged_files(), 0U);
    first.reset();
    EXPECT_EQ(SessionJournal(settings_).epoch(), 1U);
}

TEST_F(SessionJournalTest, NewerVersionsAndMissingFoldersAreErrorsThatNameTheFile) {
    SessionJournal(settings_).append(move(1, 1, 1.0F));
    SqliteDatabase(settings_.file).execute("PRAGMA user_version=99");
    try {
        const SessionJournal journal(settings_);
        ADD_FAILURE() << "version 99 was accepted";
    } catch (const JournalError& error) {
        EXPECT_NE(std::string(error.what()).find("version 99"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find(settings_.file), std::string::npos);
    }
    EXPECT_EQ(damaged_files(), 0U) << "it belongs to a newer server";
    settings_.file = folder_ / "missing" / "session.db";
    EXPECT_THROW(SessionJournal journal(settings_), JournalError);
}

TEST(FileDigest, IsSha256) {
    const auto file = fs::temp_directory_path() / "raybundle_digest_test";
    std::ofstream(file) << "abc";
    EXPECT_EQ(file_digest(file),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    fs::remove(file);
    EXPECT_FALSE(file_digest(file));
}

TEST_F(SessionJournalTest, KeepsNotesUntilTheyAreDropped) {
    {
        SessionJournal journal(settings_);
        EXPECT_TRUE(journal.notes(NoteKind::pin).empty());
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 2, std::string("zero \0 inside", 13)),
                  Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 1, "glare here"), Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::viewpoint, 1, "from the door"), Appended::yes);
        journal.append(move(1, 2, 0.5F));
    }
    SessionJournal journal(settings_);
    EXPECT_EQ(journal.notes(NoteKind::pin),
              (std::vector<std::string>{"glare here", std::string("zero \0 inside", 13)}));
    EXPECT_EQ(journal.epoch(), 1U);
    journal.drop_note(NoteKind::pin, 1);
    journal.drop_note(NoteKind::pin, 99);
    EXPECT_EQ(journal.notes(NoteKind::pin).size(), 1U);
    EXPECT_EQ(journal.notes(NoteKind::viewpoint), std::vector<std::string>{"from the door"});
}

TEST_F(SessionJournalTest, KnowsWhichRequestsHaveLeftNotes) {
    {
        SessionJournal journal(settings_);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 1, "glare", "a"), Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::viewpoint, 1, "from the door"), Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 1, "glare, 3 %", "b"), Appended::yes);
        journal.drop_note(NoteKind::pin, 1);
    }
    SessionJournal journal(settings_);
    const auto keyed = journal.keyed_notes();
    ASSERT_EQ(keyed.size(), 2U);
    EXPECT_EQ(keyed[0].key, "a");
    EXPECT_EQ(keyed[1].key, "b");
    EXPECT_EQ(keyed[1].kind, NoteKind::pin);
    EXPECT_EQ(keyed[1].number, 1U) << "also of one that is gone";
}

TEST_F(SessionJournalTest, NeverGivesTheNumberOfANoteAgain) {
    {
        SessionJournal journal(settings_);
        EXPECT_EQ(journal.new_number(NoteKind::pin, 1), 1U);
        EXPECT_EQ(journal.new_number(NoteKind::pin, 7), 7U) << "as who asks knows none below";
        for (const std::uint32_t number : {1U, 2U, 3U}) {
            EXPECT_EQ(journal.keep_note(NoteKind::pin, number, "glare"), Appended::yes);
        }
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 2, "glare here"), Appended::yes);
        journal.drop_note(NoteKind::pin, 3);
        journal.drop_note(NoteKind::pin, 99);  // which no note has had
    }
    SessionJournal journal(settings_);
    EXPECT_EQ(journal.new_number(NoteKind::pin, 3), 4U);
    EXPECT_EQ(journal.new_number(NoteKind::viewpoint, 1), 1U);
}

TEST_F(SessionJournalTest, OfAServerThatKeptNoNumbersGoesOnBehindItsNotes) {
    {
        SessionJournal journal(settings_);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 5, "glare"), Appended::yes);
        EXPECT_EQ(journal.keep_note(NoteKind::viewpoint, 4, "door", "key"), Appended::yes);
        journal.drop_note(NoteKind::viewpoint, 4);
    }
    SqliteDatabase(settings_.file).execute("DROP TABLE note_number");
    {
        SessionJournal journal(settings_);
        journal.drop_note(NoteKind::pin, 5);
        EXPECT_EQ(journal.new_number(NoteKind::viewpoint, 1), 5U) << "the key knows of it";
    }
    SessionJournal journal(settings_);
    EXPECT_EQ(journal.new_number(NoteKind::pin, 1), 6U);
}

TEST_F(SessionJournalTest, NotesOfAnotherSceneAreNotThisOnes) {
    {
        SessionJournal journal(settings_);
        EXPECT_EQ(journal.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
    }
    settings_.scene_digest = "digest of another room";
    SessionJournal journal(settings_);
    EXPECT_TRUE(journal.notes(NoteKind::pin).empty());
}

}  // namespace
}  // namespace raybundle
