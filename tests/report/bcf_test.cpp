// SPDX-License-Identifier: Apache-2.0
// Pins as BCF, read by a reader of the tests that knows only the public schema.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "report/bcf.h"
#include "report/xml_reader.h"
#include "report/zip_file.h"

namespace raybundle {
namespace {

v1::PinChanged pin_at(std::uint32_t number, const std::string& text) {
    v1::PinChanged pin;
    pin.set_pin(number);
    pin.set_text(text);
    pin.set_by_name("Ada & Bo");
    pin.set_set_at_ms(1'780'000'000'000.0);
    pin.mutable_position()->set_x(1.0F);
    pin.mutable_position()->set_y(0.75F);
    pin.mutable_position()->set_z(-2.0F);
    v1::Camera& camera = *pin.mutable_camera();
    camera.mutable_eye()->set_x(1.0F);
    camera.mutable_eye()->set_y(1.75F);
    camera.mutable_eye()->set_z(1.0F);
    camera.mutable_target()->set_x(1.0F);
    camera.mutable_up()->set_y(1.0F);
    camera.set_vertical_fov(1.0F);
    return pin;
}

struct Read {
    int status = -1;
    std::string text;
};

/// What the independent reader says of an archive.
Read read_independently(const std::string& archive) {
    const std::string file = (std::filesystem::temp_directory_path() /
                              ("raybundle-bcf-" + std::to_string(getpid()) + ".bcf"))
                                 .string();
    std::ofstream(file, std::ios::binary) << archive;
    FILE* const pipe = popen(
        (std::string(RAYBUNDLE_PYTHON) + " " RAYBUNDLE_BCF_READER " " + file + " 2>&1").c_str(),
        "r");
    Read result;
    std::array<char, 4096> part;
    for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) {
        result.text.append(part.data(), n);
    }
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::filesystem::remove(file);
    return result;
}

TEST(Bcf, AnIndependentReaderFindsPinsRepliesAndViewpoints) {
    v1::PinChanged first = pin_at(1, "Glare <here> & \"there\"\nsecond line");
    v1::PinReply& reply = *first.add_replies();
    reply.set_by_name("Cy");
    reply.set_text("Turn it by 15°");
    reply.set_at_ms(1'780'000'100'000.0);
    v1::PinChanged second = pin_at(2, "Done");
    second.set_resolved(true);
    second.set_assigned_to("Dee");
    const Read read = read_independently(write_bcf({first, second}, "office"));
    ASSERT_EQ(read.status, 0) << read.text;
    const auto topics = nlohmann::json::parse(read.text);
    ASSERT_EQ(topics.size(), 2U);
    const auto& one = topics[0]["title"] == "Done" ? topics[1] : topics[0];
    const auto& other = topics[0]["title"] == "Done" ? topics[0] : topics[1];
    EXPECT_EQ(one["title"], "Glare <here> & \"there\"");
    EXPECT_EQ(one["description"], "Glare <here> & \"there\"\nsecond line");
    EXPECT_EQ(one["status"], "Open");
    EXPECT_EQ(one["author"], "Ada & Bo");
    ASSERT_EQ(one["comments"].size(), 1U);
    EXPECT_EQ(one["comments"][0]["text"], "Turn it by 15°");
    EXPECT_EQ(other["status"], "Closed");
    EXPECT_EQ(other["assignedTo"], "Dee");
    // Z is up there: (x, -z, y).
    const auto& view = one["viewpoints"][0];
    EXPECT_NEAR(view["eye"][0], 1.0, 1e-5);
    EXPECT_NEAR(view["eye"][1], -1.0, 1e-5);
    EXPECT_NEAR(view["eye"][2], 1.75, 1e-5);
    const double length = std::hypot(3.0, 1.0);
    EXPECT_NEAR(view["direction"][1], 3.0 / length, 1e-5);
    EXPECT_NEAR(view["direction"][2], -1.0 / length, 1e-5);
    EXPECT_NEAR(view["field"], 57.2958, 1e-3);
}

TEST(Bcf, WithoutPinsItIsStillAnArchive) {
    const Read read = read_independently(write_bcf({}, "empty"));
    EXPECT_EQ(read.status, 0) << read.text;
    EXPECT_EQ(nlohmann::json::parse(read.text).size(), 0U);
}

TEST(Bcf, WhatIsWrittenComesBack) {
    v1::PinChanged pin = pin_at(7, "Too dark");
    pin.set_resolved(true);
    pin.set_assigned_to("Dee");
    v1::PinReply& reply = *pin.add_replies();
    reply.set_by_name("Cy");
    reply.set_text("Why?");
    reply.set_at_ms(1'780'000'100'000.0);
    const std::string archive = write_bcf({pin}, "office");
    EXPECT_EQ(archive, write_bcf({pin}, "office"));
    std::string reason;
    const auto back = read_bcf(archive, reason);
    ASSERT_TRUE(back) << reason;
    ASSERT_EQ(back->size(), 1U);
    const v1::PinChanged& read = back->front();
    EXPECT_EQ(read.text(), "Too dark");
    EXPECT_EQ(read.guid(), bcf_guid(pin, "office"));
    EXPECT_TRUE(read.resolved());
    EXPECT_EQ(read.assigned_to(), "Dee");
    EXPECT_EQ(read.by_name(), "Ada & Bo");
    EXPECT_EQ(read.pin(), 7U);
    EXPECT_EQ(read.set_at_ms(), pin.set_at_ms());
    ASSERT_EQ(read.replies_size(), 1);
    EXPECT_EQ(read.replies(0).text(), "Why?");
    EXPECT_EQ(read.replies(0).at_ms(), reply.at_ms());
    EXPECT_EQ(read.replies(0).guid(), bcf_reply_guid(read.guid(), pin, 0));
    EXPECT_NEAR(read.camera().eye().y(), 1.75F, 1e-5);
    EXPECT_NEAR(read.camera().eye().z(), 1.0F, 1e-5);
}

/// 2.1 has comments beside the topic, and other tools' descriptions.
TEST(Bcf, ReadsOlderVersions) {
    ZipEntries entries;
    entries["bcf.version"] = "<Version VersionId=\"2.1\"/>";
    entries["7d9bb6a5-0b41-4b5a-9f2a-0a0a0a0a0a0a/markup.bcf"] =
        "<?xml version=\"1.0\"?><!-- a tool --><Markup>"
        "<Topic Guid=\"7d9bb6a5-0b41-4b5a-9f2a-0a0a0a0a0a0a\" TopicStatus=\"resolved\">"
        "<Title>Lamp</Title><CreationDate>2026-06-21T15:00:00+02:00</CreationDate>"
        "<CreationAuthor>a@b.c</CreationAuthor><Description><![CDATA[too < bright]]></Description>"
        "</Topic><Comment Guid=\"x\"><Date>2026-06-21</Date><Author>d</Author>"
        "<Comment>yes &#xe4;</Comment></Comment></Markup>";
    std::string reason;
    const auto pins = read_bcf(write_zip(entries), reason);
    ASSERT_TRUE(pins) << reason;
    ASSERT_EQ(pins->size(), 1U);
    EXPECT_EQ(pins->front().text(), "Lamp\ntoo < bright");
    EXPECT_TRUE(pins->front().resolved());
    EXPECT_EQ(pins->front().set_at_ms(), 1'782'046'800'000.0);
    ASSERT_EQ(pins->front().replies_size(), 1);
    EXPECT_EQ(pins->front().replies(0).text(), "yes ä");
    EXPECT_EQ(pins->front().replies(0).guid(), "");
}

TEST(Bcf, RefusesWhatIsNone) {
    std::string reason;
    EXPECT_FALSE(read_bcf("not a zip", reason));
    EXPECT_FALSE(read_bcf(write_zip({{"readme.txt", "x"}}), reason));
    EXPECT_NE(reason.find("bcf.version"), std::string::npos);
    EXPECT_FALSE(read_bcf(write_zip({{"bcf.version", "x"}, {"a/markup.bcf", "<Markup>"}}), reason));
    EXPECT_NE(reason.find("a/markup.bcf"), std::string::npos);
}

TEST(Xml, RefusesWhatMightGrow) {
    EXPECT_FALSE(read_xml("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>"));
    EXPECT_FALSE(read_xml("<a>&b;</a>"));
    EXPECT_FALSE(read_xml("<a><b></a></b>"));
    EXPECT_FALSE(read_xml("<a b=\"c></a>"));
    EXPECT_FALSE(read_xml("<a/><b/>"));
    std::string deep;
    for (int i = 0; i < 40; ++i) {
        deep += "<a>";
    }
    EXPECT_FALSE(read_xml(deep));
    const auto good = read_xml("<n:a x='1'> t &lt;<b/>u</n:a>");
    ASSERT_TRUE(good);
    EXPECT_EQ(good->name, "a");
    EXPECT_EQ(good->text, " t <u");
    EXPECT_EQ(good->attributes.at("x"), "1");
}

}  // namespace
}  // namespace raybundle
