// SPDX-License-Identifier: Apache-2.0
// The log of a project in Redis, without a server around it.
#include "journal/redis/redis_log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "redis_server.h"

namespace raybundle {
namespace {

v1::SceneChanged light_of(std::uint32_t epoch, float intensity, std::uint32_t light = 1) {
    v1::SceneChanged change;
    change.set_epoch(epoch);
    change.mutable_set_light()->set_light(light);
    change.mutable_set_light()->set_intensity(intensity);
    return change;
}

/// Entries until there are so many; an outage or a lack of them ends in the test's time limit.
std::vector<LogEntry> entries_of(RedisLog& log, std::size_t count) {
    std::vector<LogEntry> entries;
    while (entries.size() < count) {
        for (LogEntry& entry : log.take_entries()) {
            entries.push_back(std::move(entry));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return entries;
}

void wait_for_outage(const RedisLog& log, bool away) {
    while (log.outage().has_value() != away) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

class RedisLogTest : public testing::Test {
  protected:
    RedisLogSettings settings() {
        RedisLogSettings settings;
        settings.address = server.address();
        settings.project = "office";
        settings.scene_digest = "abc";
        settings.retry_ms = 10;
        return settings;
    }
    RedisServer server;
};

TEST_F(RedisLogTest, AChangeOfOneArrivesAtTheOther) {
    RedisLog one(settings());
    RedisLog other(settings());
    EXPECT_EQ(one.append(light_of(1, 5.0F), light_of(0, 9.0F), {{"key"}}, "00-trace"),
              Appended::yes);
    const auto entries = entries_of(other, 1);
    EXPECT_EQ(entries[0].change.epoch(), 1U);
    EXPECT_EQ(entries[0].change.set_light().intensity(), 5.0F);
    ASSERT_EQ(entries[0].keys.size(), 1U);
    EXPECT_EQ(entries[0].keys[0].text, "key");
    EXPECT_TRUE(entries[0].keys[0].complete());
    EXPECT_EQ(entries[0].traceparent, "00-trace");
    EXPECT_EQ(other.append(light_of(2, 6.0F), {}, {}), Appended::yes);
    EXPECT_EQ(entries_of(one, 1)[0].change.epoch(), 2U) << "its own change does not come back";
}

TEST_F(RedisLogTest, WhoComesSecondHasAConflictAndTheOthersChange) {
    RedisLog one(settings());
    RedisLog other(settings());
    EXPECT_EQ(one.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    EXPECT_EQ(other.append(light_of(1, 6.0F), {}, {}), Appended::conflict);
    const auto entries = other.take_entries();  // at once
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].change.set_light().intensity(), 5.0F);
    EXPECT_EQ(other.append(light_of(2, 6.0F), {}, {}), Appended::yes);
}

TEST_F(RedisLogTest, ALaterOneHasTheSumTheStatesBeforeTheNotesAndTheKeys) {
    {
        RedisLog log(settings());
        ASSERT_EQ(log.append(light_of(1, 5.0F), light_of(0, 9.0F), {}), Appended::yes);
        EXPECT_EQ(log.keep_note(NoteKind::pin, log.new_number(NoteKind::pin, 1), "glare"),
                  Appended::yes);
        ASSERT_EQ(log.append(light_of(2, 6.0F), light_of(0, 5.0F), {{"k"}}), Appended::yes);
        ASSERT_EQ(log.append(light_of(3, 7.0F, 2), light_of(0, 1.0F, 2), {}), Appended::yes);
        EXPECT_EQ(log.keep_note(NoteKind::pin, log.new_number(NoteKind::pin, 1), "gone"),
                  Appended::yes);
        log.drop_note(NoteKind::pin, 2);
    }
    server.kill_it();
    server.start();
    RedisLog log(settings());
    EXPECT_EQ(log.epoch(), 3U);
    const auto changes = log.changes();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].set_light().intensity(), 6.0F);
    const auto past = log.past();
    ASSERT_EQ(past.size(), 3U);
    EXPECT_EQ(past[0].set_light().intensity(), 9.0F);
    EXPECT_EQ(past[2].epoch(), 3U);
    EXPECT_EQ(log.notes(NoteKind::pin), std::vector<std::string>{"glare"});
    EXPECT_EQ(log.new_number(NoteKind::pin, 2), 3U) << "the one that is gone has had 2";
    ASSERT_EQ(log.keyed().size(), 1U);
    EXPECT_EQ(log.keyed()[0].change.epoch(), 2U);
    EXPECT_EQ(log.keyed()[0].before.set_light().intensity(), 5.0F);
}

TEST_F(RedisLogTest, OfSeveralChangesThatOneRequestStandsForTheKeySaysWhichIsMade) {
    {
        RedisLog log(settings());
        ASSERT_EQ(log.append(light_of(1, 5.0F), {}, {{"undo", 1, 12}}), Appended::yes);
        ASSERT_EQ(log.append(light_of(2, 6.0F), {}, {{"undo", 2, 12}, {"k"}}), Appended::yes);
    }
    RedisLog log(settings());
    const auto keyed = log.keyed();
    ASSERT_EQ(keyed.size(), 2U);
    ASSERT_EQ(keyed[1].keys.size(), 2U);
    EXPECT_EQ(keyed[1].keys[0].text, "undo");
    EXPECT_EQ(keyed[1].keys[0].part, 2U);
    EXPECT_EQ(keyed[1].keys[0].parts, 12U);
    EXPECT_TRUE(keyed[1].keys[1].complete());
}

TEST_F(RedisLogTest, NumbersOfNotesAreOfOneAlone) {
    RedisLog one(settings());
    RedisLog other(settings());
    EXPECT_EQ(one.new_number(NoteKind::pin, 1), 1U);
    EXPECT_EQ(other.new_number(NoteKind::pin, 1), 2U);
    EXPECT_EQ(one.new_number(NoteKind::pin, 7), 7U);
    EXPECT_EQ(other.new_number(NoteKind::viewpoint, 1), 1U);
}

TEST_F(RedisLogTest, NotesComeInOrderWithChanges) {
    RedisLog one(settings());
    RedisLog other(settings());
    EXPECT_EQ(one.keep_note(NoteKind::pin, 1, "before"), Appended::yes);
    ASSERT_EQ(other.append(light_of(1, 5.0F), {}, {}), Appended::yes)
        << "a note of somebody else is no conflict";
    EXPECT_EQ(one.keep_note(NoteKind::pin, 2, "behind"), Appended::yes);
    EXPECT_EQ(entries_of(one, 1)[0].change.epoch(), 1U);
    const auto entries = entries_of(other, 2);
    EXPECT_EQ(entries[0].body, "before");
    EXPECT_EQ(entries[1].body, "behind");
}

TEST_F(RedisLogTest, ANoteIsNotOverwrittenByWhoHasNotSeenWhatOthersMadeOfIt) {
    RedisLog one(settings());
    RedisLog other(settings());
    ASSERT_EQ(one.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
    ASSERT_EQ(other.keep_note(NoteKind::pin, 2, "dark"), Appended::yes);
    EXPECT_EQ(other.keep_note(NoteKind::pin, 1, "glare, 3 %"), Appended::conflict);
    EXPECT_EQ(entries_of(other, 1)[0].body, "glare");
    EXPECT_EQ(other.keep_note(NoteKind::pin, 1, "glare, 3 %"), Appended::yes);
    ASSERT_EQ(other.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    EXPECT_EQ(other.keep_note(NoteKind::pin, 1, "glare, 4 %"), Appended::yes) << "after a change";
    EXPECT_EQ(RedisLog(settings()).notes(NoteKind::pin),
              (std::vector<std::string>{"glare, 4 %", "dark"}));
}

TEST_F(RedisLogTest, ANoteThatHasBeenForgottenStaysSo) {
    RedisLog one(settings());
    RedisLog other(settings());
    ASSERT_EQ(one.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
    entries_of(other, 1);
    ASSERT_EQ(other.keep_note(NoteKind::pin, 1, "glare, 3 %"), Appended::yes);
    one.drop_note(NoteKind::pin, 1);
    EXPECT_EQ(other.keep_note(NoteKind::pin, 1, "glare, 4 %"), Appended::conflict)
        << "the other one has not seen that it is gone";
    ASSERT_EQ(other.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    EXPECT_EQ(entries_of(one, 1)[0].change.epoch(), 1U)
        << "what came before it was forgotten does not bring it back";
    EXPECT_TRUE(entries_of(other, 1)[0].body.empty());
    EXPECT_TRUE(RedisLog(settings()).notes(NoteKind::pin).empty());
}

TEST_F(RedisLogTest, WhatHasLeftANoteUnderAKeyLeavesNoSecondOne) {
    RedisLog one(settings());
    RedisLog other(settings());
    ASSERT_EQ(one.keep_note(NoteKind::pin, 1, "glare", "a-1"), Appended::yes);
    EXPECT_EQ(other.keep_note(NoteKind::pin, 2, "glare", "a-1"), Appended::conflict);
    const auto entries = entries_of(other, 1);
    EXPECT_EQ(entries[0].number, 1U);
    ASSERT_EQ(entries[0].keys.size(), 1U);
    EXPECT_EQ(entries[0].keys[0].text, "a-1");
    RedisLog later(settings());
    ASSERT_EQ(later.keyed_notes().size(), 1U);
    EXPECT_EQ(later.keyed_notes()[0].key, "a-1");
    EXPECT_EQ(later.keyed_notes()[0].number, 1U);
}

TEST_F(RedisLogTest, AProjectHasOneScene) {
    const RedisLog log(settings());
    RedisLogSettings wrong = settings();
    wrong.scene_digest = "def";
    EXPECT_THROW(RedisLog{wrong}, JournalError);
}

TEST_F(RedisLogTest, WithoutRedisNothingIsStoredAndAllComesLater) {
    RedisLog one(settings());
    server.kill_it();
    wait_for_outage(one, true);
    EXPECT_THROW(static_cast<void>(one.append(light_of(1, 5.0F), {}, {})), JournalError);
    EXPECT_THROW(static_cast<void>(one.keep_note(NoteKind::pin, 1, "glare")), JournalError);
    RedisLog other(settings());  // begins without it
    EXPECT_TRUE(other.outage().has_value());
    EXPECT_EQ(other.epoch(), 0U);
    server.start();
    wait_for_outage(one, false);
    EXPECT_EQ(one.append(light_of(1, 6.0F), {}, {}), Appended::yes);
    const auto entries = entries_of(other, 1);
    EXPECT_EQ(entries[0].change.set_light().intensity(), 6.0F) << "what was refused is not there";
}

TEST_F(RedisLogTest, WhoseAnswerWasLostComesBackOnce) {
    RedisLogSettings impatient = settings();
    impatient.timeout_ms = 300;
    RedisLog log(impatient);
    server.freeze();  // the command arrives, its answer does not in time
    EXPECT_THROW(static_cast<void>(log.append(light_of(1, 5.0F), {}, {{"k"}})), JournalError);
    server.thaw();
    wait_for_outage(log, false);
    const auto entries = entries_of(log, 1);
    EXPECT_EQ(entries[0].change.epoch(), 1U);
    ASSERT_EQ(entries[0].keys.size(), 1U);
    EXPECT_EQ(entries[0].keys[0].text, "k");
    EXPECT_EQ(log.append(light_of(2, 6.0F), {}, {}), Appended::yes);
    EXPECT_EQ(server.command({"XLEN", "raybundle:{office}:log"}).number, 2);
}

TEST_F(RedisLogTest, ARestartOfRedisBetweenTwoChangesIsNotNoticed) {
    RedisLog log(settings());
    ASSERT_EQ(log.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    server.kill_it();
    wait_for_outage(log, true);
    server.start();
    wait_for_outage(log, false);
    EXPECT_EQ(log.append(light_of(2, 6.0F), {}, {}), Appended::yes);
}

TEST_F(RedisLogTest, ALogThatHasLostWhatIsShownIsNotGoneOnWith) {
    RedisLog log(settings());
    ASSERT_EQ(log.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    server.command({"DEL", "raybundle:{office}:log"});
    EXPECT_THROW(static_cast<void>(log.append(light_of(2, 6.0F), {}, {})), JournalError);
    EXPECT_EQ(server.command({"EXISTS", "raybundle:{office}:log"}).number, 0);
}

TEST_F(RedisLogTest, RedisThatComesBackEmptyIsNotGoneOnWith) {
    ASSERT_EQ(RedisLog(settings()).append(light_of(1, 5.0F), {}, {}), Appended::yes);
    const RedisLog log(settings());
    server.kill_it();
    wait_for_outage(log, true);
    server.lose_data();
    server.start();
    while (log.outage().value_or("").find("lacks changes") == std::string::npos) {
        ASSERT_TRUE(log.outage().has_value());
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

TEST_F(RedisLogTest, TheBeginningIsForgottenAndTheStateStays) {
    RedisLogSettings small = settings();
    small.snapshot_every = 8;
    small.most_past = 4;
    {
        RedisLog log(small);
        EXPECT_EQ(log.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
        for (std::uint32_t epoch = 1; epoch <= 20; ++epoch) {
            const std::uint32_t light = 1 + epoch % 3;
            ASSERT_EQ(log.append(light_of(epoch, static_cast<float>(epoch), light),
                                 light_of(0, 0.5F, light), {}),
                      Appended::yes);
        }
        const auto first = [this] {
            return server.command({"XRANGE", "raybundle:{office}:log", "-", "+", "COUNT", "1"})
                .list.at(0)
                .list.at(0)
                .text;
        };
        while (first() != "12-0") {  // 4 before change 16, which the state was kept at
            EXPECT_TRUE(log.take_entries().empty());
        }
    }
    RedisLog log(small);
    EXPECT_EQ(log.epoch(), 20U);
    EXPECT_EQ(log.notes(NoteKind::pin), std::vector<std::string>{"glare"});
    const auto changes = log.changes();
    ASSERT_EQ(changes.size(), 3U);
    EXPECT_EQ(changes[2].set_light().intensity(), 20.0F);
    EXPECT_EQ(log.past().size(), 4U);
}

/// Until Redis' replicas are so many.
void wait_for_replicas(const RedisServer& server, std::int64_t count) {
    while (server.command({"WAIT", "1", "20"}).number != count) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

TEST(RedisReplicas, AChangeIsAcknowledgedOnceSoManyHaveIt) {
    const RedisServer master({"--repl-diskless-sync-delay", "0"});
    RedisLogSettings settings;
    settings.address = master.address();
    settings.project = "office";
    settings.scene_digest = "abc";
    settings.timeout_ms = 4000;  // on a slow machine a replica's disk takes a second
    settings.replicas = 1;
    RedisLog log(settings);
    EXPECT_THROW(static_cast<void>(log.append(light_of(1, 5.0F), {}, {})), JournalError);
    EXPECT_THROW(static_cast<void>(log.keep_note(NoteKind::pin, 1, "glare")), JournalError);
    EXPECT_EQ(master.command({"XLEN", "raybundle:{office}:log"}).number, 0)
        << "what is refused for want of replicas is not made";
    const RedisServer replica({"--replicaof", "127.0.0.1", std::to_string(master.address().port)});
    wait_for_replicas(master, 1);
    const auto length = [&replica] {
        return replica.command({"XLEN", "raybundle:{office}:log"}).number;
    };
    EXPECT_EQ(log.append(light_of(1, 5.0F), {}, {}), Appended::yes);
    EXPECT_EQ(length(), 1);
    EXPECT_EQ(log.keep_note(NoteKind::pin, 1, "glare"), Appended::yes);
    EXPECT_EQ(length(), 2);
    replica.freeze();
    EXPECT_THROW(static_cast<void>(log.append(light_of(2, 6.0F), {}, {})), JournalError);
    replica.thaw();
    EXPECT_EQ(entries_of(log, 1)[0].change.epoch(), 2U) << "the log has it";
}

TEST(RedisAccess, APasswordComesFromTheSettingsAndIsInNoMessage) {
    const RedisServer server({"--requirepass", "open sesame"});
    RedisLogSettings settings;
    settings.address = server.address();
    settings.project = "office";
    settings.scene_digest = "abc";
    settings.address.password = "wrong word";
    try {
        const RedisLog log(settings);
        FAIL() << "a wrong password is taken";
    } catch (const JournalError& error) {
        EXPECT_EQ(std::string(error.what()).find("wrong word"), std::string::npos) << error.what();
    }
    settings.address.password = "open sesame";
    RedisLog log(settings);
    EXPECT_EQ(log.append(light_of(1, 5.0F), {}, {}), Appended::yes);
}

}  // namespace
}  // namespace raybundle
