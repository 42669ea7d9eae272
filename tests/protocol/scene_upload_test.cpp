// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "net/http/scene_name.h"
#include "net/http/snapshot_store.h"
#include "net/http/upload_check.h"

namespace raybundle {
namespace {

int status_of(const UploadRequest& request, const UploadLimits& limits = {1000}) {
    const OriginRules origins{{"https://friend.example"}};
    const auto refusal = refuse_upload(request, limits, origins);
    return refusal ? refusal->status : 0;
}

UploadRequest good_upload() {
    return {"/scenes/a.glb", "", "host:1", v1::EDITOR, 1000};
}

TEST(SceneName, IsOnePlainFileName) {
    for (const char* name : {"a.glb", "a.gltf", "Büro 2.glb", "a..b.glb", "大.glb"}) {
        EXPECT_EQ(scene_name_problem(name), "") << name;
    }
    for (const std::string& name :
         {std::string(), std::string("."), std::string(".."), std::string("../a.glb"),
          std::string("a/b.glb"), std::string("/a.glb"), std::string("a\\b.glb"),
          std::string(".a.glb"), std::string("a.glb/"), std::string("%2e%2e%2fa.glb"),
          std::string("a\0.glb", 6), std::string("a\n.glb"), std::string("a\x7f.glb"),
          std::string("a\xff.glb"), std::string("\xc0\xae\xc0\xae.glb"),
          std::string("\xed\xa0\x80.glb"), std::string("a.png"), std::string("glb"),
          std::string(125, 'a') + ".glb"}) {
        EXPECT_NE(scene_name_problem(name), "") << name;
    }
}

TEST(UploadCheck, RefusesEverythingThatIsNotAnEditorsSceneFile) {
    EXPECT_EQ(status_of(good_upload()), 0);
    UploadRequest request = good_upload();
    request.role = v1::REVIEWER;
    EXPECT_EQ(status_of(request), 403);
    request.role = std::nullopt;
    EXPECT_EQ(status_of(request), 401);
    request = good_upload();
    request.length = 1001;
    EXPECT_EQ(status_of(request), 413);
    request.length = std::nullopt;
    EXPECT_EQ(status_of(request), 411);
    request = good_upload();
    request.path = "/scenes/../a.glb";
    EXPECT_EQ(status_of(request), 400);
    request.path = "/a.glb";
    EXPECT_EQ(status_of(request), 405);
    EXPECT_EQ(status_of(good_upload(), {0}), 405) << "a server without a folder of scenes";
    EXPECT_EQ(status_of(good_upload(), {1000, 2}), 503) << "others are running";
}

TEST(UploadCheck, PagesOfOtherOriginsMayNotUpload) {
    UploadRequest request = good_upload();
    for (const auto& [origin, status] :
         {std::pair("http://host:1", 0), std::pair("https://friend.example", 0),
          std::pair("http://host:2", 403), std::pair("null", 403),
          std::pair("https://friend.example.evil", 403)}) {
        request.origin = origin;
        EXPECT_EQ(status_of(request), status) << origin;
    }
}

TEST(UploadCheck, LengthsArePlainNumbers) {
    EXPECT_EQ(parse_length("123"), 123U);
    for (const char* text : {"", "-1", "+1", "1 ", "0x10", "1e3", "99999999999999999999"}) {
        EXPECT_EQ(parse_length(text), std::nullopt) << text;
    }
}

TEST(SnapshotStoreTest, FilesHaveNamesThatNobodyGuessesAndGoInTime) {
    SnapshotStore store(100);
    const auto start = SnapshotStore::Clock::now();
    const std::string first = *store.add("one", ".exr", start);
    EXPECT_TRUE(first.starts_with("/snapshots/") && first.ends_with(".exr"));
    EXPECT_GE(first.size(), 64U);
    EXPECT_NE(*store.add("two", ".exr", start), first);
    EXPECT_EQ(*store.find(first, start), "one");
    EXPECT_EQ(store.find("/snapshots/", start), nullptr);
    EXPECT_EQ(store.find(first + "x", start), nullptr);
    EXPECT_EQ(store.find(first, start + SnapshotStore::kLifetime), nullptr);
}

TEST(SnapshotStoreTest, TheOldestGoesWhereANewOneNeedsItsRoom) {
    SnapshotStore store(100);
    const std::string first = *store.add(std::string(60, 'a'), ".png");
    const std::string second = *store.add(std::string(60, 'b'), ".png");
    EXPECT_EQ(store.find(first), nullptr);
    EXPECT_NE(store.find(second), nullptr);
    EXPECT_EQ(store.add(std::string(101, 'c'), ".png"), std::nullopt);
    EXPECT_NE(store.find(second), nullptr) << "one that never fits displaces nothing";
}

}  // namespace
}  // namespace raybundle
