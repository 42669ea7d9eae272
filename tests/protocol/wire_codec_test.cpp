// SPDX-License-Identifier: Apache-2.0
#include "net/ws/wire_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "same_json.h"

namespace raybundle {
namespace {

v1::ClientMessage accepted(std::string_view text) {
    const ParsedMessage parsed = parse_text_message(text);
    if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
        ADD_FAILURE() << text << "\nrefused: " << refusal->text;
        return {};
    }
    return std::get<v1::ClientMessage>(parsed);
}

Refusal refused(const ParsedMessage& parsed) {
    if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
        return *refusal;
    }
    ADD_FAILURE() << "was accepted";
    return {};
}

// The published examples, with their elisions filled in.
constexpr std::array kExamples{
    R"({"id":1,"hello":{"protocol":"1.0","name":"meeting room","token":"","codecs":["JPEG"],
        "viewport":{"width":800,"height":600}}})",
    R"({"id":2,"setCamera":{"eye":{"x":2.7,"y":2.7,"z":-7.5},"target":{"x":2.7,"y":2.7,"z":2.7},
        "up":{"x":0,"y":1,"z":0},"verticalFov":0.7}})",
    R"({"setViewport":{"width":1280,"height":720}})",
    R"({"setTarget":{"relativeError":0.02}})",
    R"({"setTarget":{"seconds":10}})",
    R"({"setDisplay":{"mode":"PHOTO","exposure":0.0,"autoExposure":true}})",
    R"({"setDisplay":{"mode":"FALSE_ILLUMINANCE"}})",
    R"({"id":3,"moveObject":{"object":2,"transform":{"translation":{"x":0,"y":0,"z":0},
        "rotation":{"x":0,"y":0,"z":0,"w":1},"scale":{"x":1,"y":1,"z":1}},"final":true}})",
    R"({"id":4,"setLight":{"light":1,"intensity":800,"on":true}})",
    R"({"id":5,"setMaterial":{"material":1,"baseColour":{"x":0.2,"y":0.5,"z":0.2},"roughness":0.4}})",
    R"({"id":6,"probe":{"pixel":{"x":400,"y":300}}})",
    R"({"id":6,"probe":{"ray":{"origin":{"x":1,"y":1,"z":1},"direction":{"x":0,"y":-1,"z":0}}}})",
    R"({"id":7,"addPin":{"text":"glare here","position":{"x":1,"y":0,"z":1},"patch":1234}})",
    R"({"follow":{"viewer":3}})",
    R"({"ack":{"frame":57,"decodeMs":3.1}})",
    R"({"id":8,"ping":{}})",
    R"({"id":9,"snapshot":{"width":1920,"height":1080,"relativeError":0.01,"format":"EXR"}})",
};

TEST(WireCodec, AcceptsEveryPublishedExampleAsTextAndAsBinary) {
    for (const char* example : kExamples) {
        const v1::ClientMessage message = accepted(example);
        EXPECT_NE(message.body_case(), v1::ClientMessage::BODY_NOT_SET) << example;
        const ParsedMessage binary = parse_binary_message(message.SerializeAsString());
        ASSERT_TRUE(std::holds_alternative<v1::ClientMessage>(binary)) << example;
        EXPECT_EQ(std::get<v1::ClientMessage>(binary).SerializeAsString(),
                  message.SerializeAsString());
    }
}

/// The grid of a measurement by name or by numbers, in one field.
TEST(WireCodec, GridOfAMeasurementIsARuleOrNumbers) {
    const auto measure = [](const std::string& grid) {
        return R"({"id":1,"measure":{"quantity":"HORIZONTAL","area":{"origin":{"y":0.75},"u":{"x":5},"v":{"z":4}},"grid":)" +
               grid + "}}";
    };
    EXPECT_EQ(accepted(measure("\"EN12464\"")).measure().grid(), v1::Measure::EN12464);
    const v1::Measure numbers = accepted(measure(R"({"columns":9,"rows":5})")).measure();
    EXPECT_EQ(numbers.columns(), 9U);
    EXPECT_EQ(numbers.rows(), 5U);
    EXPECT_EQ(numbers.area().origin().y(), 0.75F);
    const ParsedMessage wrong = parse_text_message(measure(R"({"columns":9,"row":5})"));
    ASSERT_TRUE(std::holds_alternative<Refusal>(wrong));
    EXPECT_TRUE(std::get<Refusal>(wrong).text.starts_with("measure.row: unknown field"));
}

TEST(WireCodec, AbsentIsNotFalse) {
    EXPECT_FALSE(accepted(R"({"setLight":{"light":1,"intensity":800}})").set_light().has_on());
    EXPECT_TRUE(accepted(R"({"setLight":{"light":1,"on":false}})").set_light().has_on());
    EXPECT_FALSE(accepted(R"({"ping":{}})").has_id());
}

TEST(WireCodec, IgnoresUnknownFieldsAndUnknownCodecs) {
    const auto hello =
        accepted(R"({"hello":{"protocol":"1.7","codecs":["AV1","PNG"],"mood":{"a":[1]}},"x":1})");
    ASSERT_TRUE(hello.has_hello());
    const auto& codecs = hello.hello().codecs();
    EXPECT_NE(std::find(codecs.begin(), codecs.end(), v1::PNG), codecs.end());
}

TEST(WireCodec, LenientReadingIgnoresWhatANewerClientSays) {
    const std::string light = R"({"setLight":{"light":1,"on":true,"lumens":{"lm":[900]}},"x":1})";
    const ParsedMessage lenient = parse_text_message(light, {}, Reading::lenient);
    ASSERT_TRUE(std::holds_alternative<v1::ClientMessage>(lenient));
    EXPECT_TRUE(std::get<v1::ClientMessage>(lenient).set_light().on());
    EXPECT_EQ(refused(parse_text_message(light)).code, v1::Error::INVALID_ARGUMENT);
    accepted(R"({"hello":{"protocol":"1.0","lenient":true,"codecs":["AV1"],"mood":1},"x":1})");
    const std::string typo = R"({"setLight":{"light":1,"color":{"x":1}}})";
    EXPECT_EQ(refused(parse_text_message(typo, {}, Reading::lenient)).text.substr(0, 9),
              "setLight:")
        << "nothing that is known would change";
}

TEST(WireCodec, RefusesUnknownPartsOfBinaryMessages) {
    v1::ClientMessage message;
    message.mutable_set_light()->set_light(1);
    auto* const colour = message.mutable_set_light()->mutable_colour();
    colour->set_x(1.0F);
    colour->GetReflection()->MutableUnknownFields(colour)->AddVarint(900, 1);
    const std::string bytes = message.SerializeAsString();
    EXPECT_EQ(refused(parse_binary_message(bytes)).text,
              "setLight.colour: unknown field number 900");
    EXPECT_TRUE(std::holds_alternative<v1::ClientMessage>(
        parse_binary_message(bytes, {}, Reading::lenient)));
    v1::ClientMessage hello;
    hello.mutable_hello()->set_protocol("1.0");
    hello.mutable_hello()->add_codecs(static_cast<v1::Codec>(77));
    EXPECT_TRUE(refused(parse_binary_message(hello.SerializeAsString()))
                    .text.starts_with("hello.codecs: unknown value 77"));
    hello.mutable_hello()->set_lenient(true);
    EXPECT_TRUE(
        std::holds_alternative<v1::ClientMessage>(parse_binary_message(hello.SerializeAsString())));
}

TEST(WireCodec, ErrorsDoNotShowTheParser) {
    for (const char* text :
         {R"({"setCamera":{"eye":{"x":"left"}}})", R"({"ping":{},"ack":{"frame":1}})",
          R"({"ack":{"frame":4294967296}})", R"({"ack":{"frame":"1e2"}})",
          R"({"setDisplay":{"mode":3e9}})", R"({"hello":{"codecs":[1e99]}})",
          R"({"setTarget":{"seconds":1,"relativeError":1}})", R"({"setLight":"x"})",
          R"({"setLight":{"light":1,"intensity":"1,5"}})"}) {
        const std::string said = refused(parse_text_message(text)).text;
        for (const char* word : {"proto", "oneof", "TYPE_", "INVALID_ARGUMENT", "google"}) {
            EXPECT_EQ(said.find(word), std::string::npos) << text << ": " << said;
        }
    }
}

TEST(WireCodec, AnswersUnknownMessagesWithTheirId) {
    const Refusal refusal = refused(parse_text_message(R"({"id":12,"teleport":{"where":"moon"}})"));
    EXPECT_EQ(refusal.code, v1::Error::UNIMPLEMENTED);
    EXPECT_EQ(refusal.text, "unknown message \"teleport\"");
    EXPECT_EQ(refusal.id, 12U);
    EXPECT_EQ(refused(parse_text_message(R"({"id":13})")).code, v1::Error::INVALID_ARGUMENT);
    EXPECT_EQ(refused(parse_text_message(R"({"id":13,"ping":null})")).code,
              v1::Error::INVALID_ARGUMENT);
    const std::string unknown_field("\xA2\x38\x00", 3);  // field 900, empty
    EXPECT_EQ(refused(parse_binary_message(unknown_field)).code, v1::Error::UNIMPLEMENTED);
}

TEST(WireCodec, RefusesTwoBodiesAndWrongTypesNamingTheField) {
    const Refusal two = refused(parse_text_message(R"({"ping":{},"ack":{"frame":1}})"));
    EXPECT_EQ(two.code, v1::Error::INVALID_ARGUMENT);
    EXPECT_TRUE(two.text.starts_with("invalid value")) << two.text;
    const Refusal wrong =
        refused(parse_text_message(R"({"id":4,"setCamera":{"eye":{"x":"left"}}})"));
    EXPECT_EQ(wrong.id, 4U);
    EXPECT_NE(wrong.text.find("setCamera"), std::string::npos) << wrong.text;
    EXPECT_EQ(refused(parse_text_message(R"({"ack":{"frame":-1}})")).code,
              v1::Error::INVALID_ARGUMENT);
    EXPECT_EQ(refused(parse_text_message(R"({"ack":{"frame":4294967296}})")).code,
              v1::Error::INVALID_ARGUMENT);
}

TEST(WireCodec, RefusesWhatIsNotStrictJson) {
    for (const char* text : {"", " ", "null", "[]", "7", "{", "{'id':1}", "{id:1}", "{\"id\":1,}",
                             "{\"ping\":{}} x", "{\"a\":1e999}", "{\"a\":NaN}", "{\"a\":\"\xff\"}",
                             "{\"a\":\"\xed\xa0\x80\"}", "{\"a\":\"\\ud800\"}", "\xef\xbb\xbf{"}) {
        EXPECT_EQ(refused(parse_text_message(text)).code, v1::Error::INVALID_ARGUMENT) << text;
    }
}

TEST(WireCodec, BoundsSizeAndDepth) {
    const WireLimits limits;
    const std::string deep = "{\"a\":" + std::string(50000, '[');
    EXPECT_NE(refused(parse_text_message(deep)).text.find("nested"), std::string::npos);
    std::string large = R"({"ping":{}})";
    large.resize(limits.max_message_bytes, ' ');
    EXPECT_TRUE(std::holds_alternative<v1::ClientMessage>(parse_text_message(large)));
    large += ' ';
    EXPECT_EQ(refused(parse_text_message(large)).code, v1::Error::RESOURCE_EXHAUSTED);
    EXPECT_EQ(refused(parse_binary_message(large)).code, v1::Error::RESOURCE_EXHAUSTED);
}

TEST(WireCodec, KeepsForeignTextInErrorsShort) {
    const std::string key(20000, 'k');
    EXPECT_LT(refused(parse_text_message("{\"" + key + "\":1}")).text.size(), 256U);
    EXPECT_LT(refused(parse_text_message("{\"ack\":{\"frame\":\"" + key + "\"}}")).text.size(),
              256U);
}

TEST(WireCodec, SurvivesBrokenBinary) {
    const std::string whole = accepted(kExamples[1]).SerializeAsString();
    for (std::size_t size = 1; size < whole.size(); ++size) {
        parse_binary_message(whole.substr(0, size));
    }
    EXPECT_EQ(refused(parse_binary_message("\xff\xff\xff")).code, v1::Error::INVALID_ARGUMENT);
    EXPECT_EQ(refused(parse_binary_message("")).code, v1::Error::INVALID_ARGUMENT);
}

TEST(WireCodec, PrintsFrameHeaderAsPublished) {
    v1::FrameHeader header;
    header.set_frame(57);
    header.set_epoch(1);
    header.set_camera_id(2);
    header.set_codec(v1::JPEG);
    header.set_width(800);
    header.set_height(600);
    header.set_quality(85);
    header.set_iterations(640);
    header.set_settled(0.97F);
    header.set_relative_error(0.018F);
    header.set_error_low(0.015F);
    header.set_error_high(0.022F);
    header.set_exposure(-3.2F);
    header.set_server_time_ms(123456);
    EXPECT_PRED_FORMAT2(
        SameJson, to_json(header),
        R"({"frame":57,"epoch":1,"cameraId":2,"codec":"JPEG","width":800,"height":600,)"
        R"("quality":85,"iterations":640,"settled":0.97,"relativeError":0.018,)"
        R"("errorLow":0.015,"errorHigh":0.022,"exposure":-3.2,"serverTimeMs":123456})");
}

TEST(WireCodec, PrintsDefaultsButNotAbsentFields) {
    v1::ServerMessage message;
    message.mutable_probe_result();
    EXPECT_PRED_FORMAT2(SameJson, to_json(message), R"({"probeResult":{"hit":false,"epoch":0}})");
    message.set_reply_to(0);
    message.mutable_probe_result()->mutable_position();
    message.mutable_probe_result()->set_object(0);
    EXPECT_PRED_FORMAT2(SameJson, to_json(message),
                        R"({"replyTo":0,"probeResult":{"hit":false,)"
                        R"("position":{"x":0,"y":0,"z":0},"object":0,"epoch":0}})");
    message.mutable_ok();
    EXPECT_PRED_FORMAT2(SameJson, to_json(message), R"({"replyTo":0,"ok":{}})");
    message.mutable_presence();
    EXPECT_PRED_FORMAT2(SameJson, to_json(message), R"({"replyTo":0,"presence":{"viewers":[]}})");
    message.Clear();
    message.mutable_pin_changed()->set_pin(1);
    message.mutable_pin_changed()->set_text("glare here");
    EXPECT_PRED_FORMAT2(SameJson, to_json(message),
                        R"({"pinChanged":{"pin":1,"by":0,"text":"glare here",)"
                        R"("illuminance":0,"epoch":0,"removed":false,)"
                        R"("byName":"","setAtMs":0,"object":0,)"
                        R"("replies":[],"resolved":false,"assignedTo":"","guid":""}})");
}

TEST(WireCodec, PrintsWelcomeAsPublished) {
    v1::ServerMessage message;
    message.set_reply_to(1);
    auto& welcome = *message.mutable_welcome();
    welcome.set_protocol("1.0");
    welcome.set_role(v1::EDITOR);
    auto& light = *welcome.mutable_scene()->add_lights();
    light.set_id(1);
    light.set_kind(v1::Light::AREA);
    light.set_unit(v1::Light::CD_PER_M2);
    light.set_intensity(1355.8F);
    light.set_on(true);
    auto& effect = *welcome.mutable_scene()->add_effects();
    effect.set_name("glossy");
    EXPECT_PRED_FORMAT2(
        SameJson, to_json(message),
        R"({"replyTo":1,"welcome":{"protocol":"1.0","server":"","viewer":0,"role":"EDITOR",)"
        R"("epoch":0,"scene":{"name":"","objects":[],"lights":[{"id":1,"name":"",)"
        R"("kind":"AREA","intensity":1355.8,"unit":"CD_PER_M2","on":true,"loadedIntensity":0,"photometry":"","added":false}],"cameras":[],)"
        R"("materials":[],"effects":[{"name":"glossy","active":false,"reason":"","pathClass":"","shareBound":0,"bytesPerPatch":0}],"groups":[],"lightingScenes":[],"luminaires":[],"animations":[],"fades":[]},)"
        R"("pins":[],"viewpoints":[],"zones":[],"requirements":[],"renderer":"","softwareRendering":false,"canOpenScenes":false}})");
}

TEST(WireCodec, PrintsErrorsAndOneofChanges) {
    EXPECT_PRED_FORMAT2(SameJson, to_json(to_message({v1::Error::NOT_FOUND, "no", 3U})),
                        R"({"replyTo":3,"error":{"code":"NOT_FOUND","message":"no"}})");
    v1::ServerMessage message;
    message.mutable_scene_changed()->set_epoch(1);
    message.mutable_scene_changed()->mutable_set_light()->set_light(2);
    EXPECT_PRED_FORMAT2(SameJson, to_json(message),
                        R"({"sceneChanged":{"epoch":1,"by":0,"objects":[],"lights":[],)"
                        R"("materials":[],"setLight":{"light":2,"sameType":false}}})");
}

TEST(WireCodec, FramesHaveLittleEndianHeaderLength) {
    v1::FrameHeader header;
    header.set_frame(300);
    const std::array<std::uint8_t, 3> image{1, 2, 3};
    const auto message = frame_message(header, image, 5);
    const std::string json = to_json(header);
    ASSERT_EQ(message.size(), 5 + 4 + json.size() + image.size());
    EXPECT_EQ(message[5] + 256U * message[6], json.size());
    EXPECT_EQ(message[7] + message[8], 0);
    EXPECT_EQ(std::string(message.begin() + 9, message.end() - 3), json);
    EXPECT_EQ(message.back(), 3);
}

}  // namespace
}  // namespace raybundle
