// SPDX-License-Identifier: Apache-2.0
#include "net/audit/audit_log.h"
#include "../daemon/test_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "net/ws/session.h"
#include "options/serve_settings.h"

namespace raybundle {
namespace {

using Line = nlohmann::json;

class AuditLogTest : public testing::Test {
  protected:
    [[nodiscard]] static std::vector<std::string> texts(const std::string& file) {
        std::vector<std::string> result;
        std::ifstream stream(file);
        for (std::string text; std::getline(stream, text);) {
            result.push_back(text);
        }
        return result;
    }
    [[nodiscard]] std::vector<Line> lines() const {
        std::vector<Line> result;
        for (const std::string& text : texts(file_)) {
            result.push_back(Line::parse(text));
        }
        return result;
    }

    const AuditIdentity ada_{"Ada \"\n\xff", v1::EDITOR, "office", "10.0.0.7"};
    const TestFolder folder_;
    const std::string file_ = folder_.path("audit.jsonl");
};

v1::SceneChanged dimmed_by(ViewerId viewer) {
    v1::SceneChanged change;
    change.set_by(viewer);
    change.mutable_set_light()->set_light(4);
    return change;
}

TEST_F(AuditLogTest, SaysWhoDidWhatAndWhen) {
    AuditLog audit(file_);
    audit.connect(3, ada_);
    audit.request(3, "addPin");
    audit.change(dimmed_by(3), 17);
    audit.transfer({"", v1::VIEWER, "", "::1"}, false, "/report.pdf");
    audit.disconnect(3);
    audit.change(dimmed_by(3), 18);  // was asked for before
    const std::vector<Line> said = lines();
    ASSERT_EQ(said.size(), 6U);
    EXPECT_TRUE(std::regex_match(said[0].at("time").get<std::string>(),
                                 std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
    EXPECT_EQ(said[0].at("event"), "connect");
    EXPECT_EQ(said[0].at("viewer"), 3);
    EXPECT_EQ(said[0].at("name"), "Ada \"\n\xef\xbf\xbd") << "what is no UTF-8 is replaced";
    EXPECT_EQ(said[0].at("role"), "EDITOR");
    EXPECT_EQ(said[0].at("token"), "office");
    EXPECT_EQ(said[0].at("address"), "10.0.0.7");
    EXPECT_EQ(said[1].at("request"), "addPin");
    EXPECT_EQ(said[2].at("change"), "setLight");
    EXPECT_EQ(said[2].at("light"), 4);
    EXPECT_EQ(said[2].at("epoch"), 17);
    EXPECT_EQ(said[3].at("event"), "download");
    EXPECT_EQ(said[3].at("path"), "/report.pdf");
    EXPECT_FALSE(said[3].contains("token"));
    EXPECT_EQ(said[4].at("event"), "disconnect");
    EXPECT_EQ(said[5].at("token"), "office") << "who has left is still known";
}

TEST_F(AuditLogTest, IsItsOwnersAlone) {
    const AuditLog audit(file_);
    struct stat status {};
    ASSERT_EQ(stat(file_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(AuditLogTest, LivesThroughRotation) {
    AuditLog audit(file_);
    audit.request(ada_, "a");
    std::filesystem::resize_file(file_, 0);  // copytruncate
    audit.request(ada_, "b");
    ASSERT_EQ(lines().size(), 1U);
    EXPECT_EQ(lines()[0].at("request"), "b");
    std::filesystem::rename(file_, file_ + ".1");
    audit.request(ada_, "c");
    audit.reopen();
    audit.request(ada_, "d");
    EXPECT_EQ(texts(file_ + ".1").size(), 2U);
    ASSERT_EQ(lines().size(), 1U);
    EXPECT_EQ(lines()[0].at("request"), "d");
    std::filesystem::remove_all(folder_.path());
    audit.reopen();  // there is no folder any more: the old file stays
    audit.request(ada_, "e");
    EXPECT_EQ(audit.failures(), 0U);
}

TEST_F(AuditLogTest, AFullDiskIsCounted) {
    AuditLog audit("/dev/full");
    audit.request(ada_, "a");
    audit.request(ada_, "b");
    EXPECT_EQ(audit.failures(), 2U);
}

TEST_F(AuditLogTest, ALineThatWasTornEndsBeforeTheNext) {
    AuditLog audit(file_);
    audit.request(ada_, "a");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{std::filesystem::file_size(file_) + 10, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    audit.request(ada_, "torn");
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    audit.request(ada_, "c");
    EXPECT_EQ(audit.failures(), 1U);
    const std::vector<std::string> said = texts(file_);
    ASSERT_EQ(said.size(), 3U);
    EXPECT_EQ(said[1].size(), 10U);
    EXPECT_EQ(Line::parse(said[2]).at("request"), "c");
}

TEST_F(AuditLogTest, RefusalsFillNoDisk) {
    AuditLog audit(file_);
    constexpr int many = 1000;
    for (int i = 0; i < many; ++i) {
        audit.refuse(ada_, "hello", "hello.token: is not valid");
    }
    EXPECT_GE(lines().size(), 20U);
    EXPECT_LT(lines().size(), 200U) << "20 a second";
    EXPECT_EQ(lines()[0].at("reason"), "hello.token: is not valid");
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    audit.refuse(ada_, "hello", "again");
    std::int64_t told = 0;
    for (const Line& line : lines()) {
        told += 1 + line.value("unsaid", 0);
    }
    EXPECT_EQ(told, many + 1);
}

TEST_F(AuditLogTest, HearsOfAllThatAViewerMayAndMayNot) {
    AuditLog audit(file_);
    Access access;
    const std::string token(64, 'a');
    access.tokens = AccessTokens({{"guest", v1::VIEWER, token_digest(token)}});
    Gate gate(4, access);
    Inbox inbox;
    ViewerLink link(9, 1000000, {});
    {
        Session session(link, inbox, gate, {}, 1000.0, "10.0.0.9", &audit);
        const auto say = [&](const std::string& text) {
            session.on_fragment(text, true, true, false, 0.0);
        };
        say(R"({"hello":{"protocol":"1.0","name":"Eve","token":"wrong"}})");
        say(R"({"hello":{"protocol":"1.0","name":"Bob","token":")" + token + R"("}})");
        say(R"({"setLight":{"light":1,"on":false}})");
        say(R"({"snapshot":{"width":8,"height":8,"relativeError":1,"format":"PNG"}})");
        say(R"({"listChanges":{}})");
        session.on_closed();
    }
    std::string events;
    for (const Line& line : lines()) {
        events += line.at("event").get<std::string>() + " " + line.value("request", "") + ";";
        EXPECT_EQ(line.at("address"), "10.0.0.9");
        EXPECT_EQ(line.dump().find(token), std::string::npos);
    }
    EXPECT_EQ(events, "refuse hello;connect ;refuse setLight;request snapshot;disconnect ;");
    EXPECT_EQ(lines().at(1).at("name"), "guest") << "the token's name wins";
    EXPECT_EQ(lines().at(2).at("token"), "guest");
}

TEST_F(AuditLogTest, NamesWhatIsRemoved) {
    AuditLog audit(file_);
    v1::SceneChanged change;
    change.mutable_remove_object()->set_object(5);
    audit.change(change, 1);
    change.mutable_remove_light()->set_light(6);
    audit.change(change, 2);
    EXPECT_EQ(lines().at(0).at("object"), 5);
    EXPECT_EQ(lines().at(1).at("light"), 6);
}

TEST_F(AuditLogTest, AFileThatCannotBeWrittenKeepsTheServerFromStarting) {
    Options options;
    EXPECT_EQ(open_audit_log(options), nullptr);
    options.network.audit_log = folder_.path("missing/audit.jsonl");
    EXPECT_THROW(open_audit_log(options), UsageError);
    options.network.audit_log = file_;
    EXPECT_NE(open_audit_log(options), nullptr);
}

}  // namespace
}  // namespace raybundle
