// SPDX-License-Identifier: Apache-2.0
#include "net/ws/upgrade_check.h"

#include <gtest/gtest.h>

#include <string>

namespace raybundle {
namespace {

TEST(UpgradeCheck, OnlyOnePath) {
    EXPECT_EQ(refusal_status({"/ws", "", "a:1"}, {}), 0);
    EXPECT_EQ(refusal_status({"/", "", "a:1"}, {}), 404);
    EXPECT_EQ(refusal_status({"/ws/", "", "a:1"}, {}), 404);
}

TEST(UpgradeCheck, VersionKeyAndSubprotocolAreThoseOfTheStandard) {
    const auto status = [](UpgradeRequest request) {
        const auto refusal = refuse_upgrade(request, {});
        return refusal ? refusal->status : 0;
    };
    UpgradeRequest good{"/ws", "", "a:1"};
    EXPECT_EQ(status(good), 0);
    for (const char* version : {"", "12", "14", "13 ", "+13", "013"}) {
        UpgradeRequest request = good;
        request.version = version;
        EXPECT_EQ(status(request), 426) << version;
    }
    for (const char* key : {"", "dGhl", "dGhlIHNhbXBsZSBub25jZQ=", "dGhlIHNhbXBsZSBub25jZQ===",
                            "dGhlIHNhbXBsZSBub2 jZQ==", "dGhlIHNhbXBsZSBub25jZQ--"}) {
        UpgradeRequest request = good;
        request.key = key;
        EXPECT_EQ(status(request), 400) << key;
    }
    for (const auto& [protocols, expected] :
         {std::pair("raybundle.v1", 0), std::pair("chat, raybundle.v1", 0), std::pair("", 0),
          std::pair(" raybundle.v1 ,x", 0), std::pair("raybundle.v2", 400), std::pair("chat", 400),
          std::pair("Raybundle.v1", 400), std::pair(" , ", 0)}) {
        UpgradeRequest request = good;
        request.protocols = protocols;
        EXPECT_EQ(status(request), expected) << protocols;
    }
}

TEST(UpgradeCheck, PagesOfOtherOriginsAreRefused) {
    EXPECT_EQ(refusal_status({"/ws", "http://a:8080", "A:8080"}, {}), 0);
    EXPECT_EQ(refusal_status({"/ws", "https://a", "a"}, {}), 0);
    for (const char* origin : {"http://a:8081", "http://b:8080", "null", "http://", "a:8080",
                               "ftp://a:8080", "http://a:8080.evil"}) {
        EXPECT_EQ(refusal_status({"/ws", origin, "a:8080"}, {}), 403) << origin;
    }
    EXPECT_EQ(refusal_status({"/ws", "http://", ""}, {}), 403);
}

TEST(UpgradeCheck, AllowedOriginsAreAccepted) {
    const OriginRules rules{{"https://review.example"}};
    EXPECT_EQ(refusal_status({"/ws", "https://Review.example", "a:8080"}, rules), 0);
    EXPECT_EQ(refusal_status({"/ws", "http://review.example", "a:8080"}, rules), 403);
}

TEST(UpgradeCheck, ANameThatWasMadeToMeanThisMachineIsNotItsOwn) {
    const OriginRules rules{{"https://review.example"}, true};
    for (const char* host : {"127.0.0.1:8080", "127.0.0.1", "localhost:8080", "LOCALHOST",
                             "[::1]:8080", "192.0.2.7:80"}) {
        EXPECT_EQ(refusal_status({"/ws", std::string("http://") + host, host}, rules), 0) << host;
    }
    for (const char* host :
         {"evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", "1.2.3.4a",
          "a:8080", ":8080", "review.example"}) {
        EXPECT_EQ(refusal_status({"/ws", std::string("http://") + host, host}, rules), 403) << host;
    }
    EXPECT_EQ(refusal_status({"/ws", "https://review.example", "review.example"}, rules), 0);
    EXPECT_EQ(refusal_status({"/ws", "", "evil.example"}, rules), 0) << "no page, so no browser";
}

}  // namespace
}  // namespace raybundle
