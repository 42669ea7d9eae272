// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/message_rules.h"

#include <gtest/gtest.h>

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace raybundle {
namespace {

struct Case {
    const char* text;
    const char* field;  ///< named by the refusal; null: accepted
};

std::string camera(const std::string& rest) {
    return R"({"setCamera":{"eye":{"x":1},"target":{"z":5})" + rest + "}}";
}

void expect_case(const std::string& text, const char* field) {
    const ParsedMessage parsed = parse_text_message(text);
    const auto* refusal = std::get_if<Refusal>(&parsed);
    if (field == nullptr) {
        EXPECT_EQ(refusal, nullptr) << text << ": " << (refusal != nullptr ? refusal->text : "");
        return;
    }
    ASSERT_NE(refusal, nullptr) << text;
    EXPECT_EQ(refusal->code, v1::Error::INVALID_ARGUMENT);
    EXPECT_EQ(refusal->text.rfind(std::string(field) + ":", 0), 0U) << refusal->text;
}

TEST(MessageRules, EveryMessageHasOne) {
    const auto* const body = v1::ClientMessage::descriptor()->FindOneofByName("body");
    const auto rules = message_rules();
    EXPECT_EQ(rules.size(), static_cast<std::size_t>(body->field_count()));
    for (int i = 0; i < body->field_count(); ++i) {
        const auto number = static_cast<v1::ClientMessage::BodyCase>(body->field(i)->number());
        EXPECT_EQ(std::count_if(rules.begin(), rules.end(),
                                [number](const MessageRule& rule) { return rule.body == number; }),
                  1)
            << body->field(i)->name();
    }
}

/// The row of a role in the table of protocol/README.md.
std::string row_of_role(const std::string& role) {
    std::ifstream page(RAYBUNDLE_PROTOCOL_PAGE);
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("| `" + role + "` | ")) {
            return line;
        }
    }
    return {};
}

TEST(MessageRules, ThePageOfTheProtocolSaysWhoMaySendWhat) {
    const auto* const body = v1::ClientMessage::descriptor()->FindOneofByName("body");
    for (int i = 0; i < body->field_count(); ++i) {
        const auto number = static_cast<v1::ClientMessage::BodyCase>(body->field(i)->number());
        const std::string row = row_of_role(v1::Role_Name(required_role(number)));
        EXPECT_NE(row.find("`" + std::string(body->field(i)->json_name()) + "`"), std::string::npos)
            << body->field(i)->json_name() << " is not in the row: " << row;
    }
}

TEST(MessageValidation, WhatMayStandBesideTheMessage) {
    expect_case(R"({"requestKey":"a b","undo":{}})", "requestKey");
    expect_case(R"({"traceparent":"no trace","undo":{}})", "traceparent");
    expect_case(R"({"traceparent":"none-either","undo":{}})", nullptr);
    const std::string long_text(129, 'a');
    expect_case(R"({"traceparent":")" + long_text + R"(","undo":{}})", "traceparent");
}

TEST(MessageValidation, Camera) {
    expect_case(camera(""), nullptr);
    expect_case(camera(R"(,"verticalFov":3.1)"), nullptr);
    expect_case(camera(R"(,"verticalFov":0)"), "setCamera.verticalFov");
    expect_case(camera(R"(,"verticalFov":3.1416)"), "setCamera.verticalFov");
    expect_case(camera(R"(,"verticalFov":"NaN")"), "setCamera.verticalFov");
    expect_case(camera(R"(,"up":{})"), "setCamera.up");
    expect_case(camera(R"(,"up":{"x":-1,"z":5})"), "setCamera.up");
    expect_case(camera(R"(,"up":{"y":"Infinity"})"), "setCamera.up.y");
    expect_case(R"({"setCamera":{"eye":{"x":1}}})", "setCamera.target");
    expect_case(R"({"setCamera":{"target":{"x":1}}})", "setCamera.eye");
    expect_case(R"({"setCamera":{"eye":{"x":1},"target":{"x":1}}})", "setCamera.target");
    expect_case(R"({"setCamera":{"eye":{"x":1e30},"target":{"x":1}}})", "setCamera.eye.x");
}

TEST(MessageValidation, Sizes) {
    for (const Case& c :
         {Case{R"({"setViewport":{"width":3840,"height":2160}})", nullptr},
          Case{R"({"setViewport":{"width":0,"height":600}})", "setViewport.width"},
          Case{R"({"setViewport":{"width":800}})", "setViewport.height"},
          Case{R"({"setViewport":{"width":65536,"height":600}})", "setViewport.width"},
          Case{R"({"hello":{"protocol":"1.0","viewport":{"width":9}}})",
               "hello.viewport.height"}}) {
        expect_case(c.text, c.field);
    }
}

TEST(MessageValidation, SceneChanges) {
    for (const Case& c :
         {Case{R"({"moveObject":{"object":1,"transform":{}}})", nullptr},
          Case{R"({"moveObject":{"object":1}})", "moveObject.transform"},
          Case{R"({"moveObject":{"transform":{}}})", "moveObject.object"},
          Case{R"({"moveObject":{"object":1,"transform":{"rotation":{}}}})",
               "moveObject.transform.rotation"},
          Case{R"({"moveObject":{"object":1,"transform":{"scale":{"x":1,"y":1}}}})",
               "moveObject.transform.scale"},
          Case{R"({"moveObject":{"object":1,"transform":{"translation":{"x":"NaN"}}}})",
               "moveObject.transform.translation.x"},
          Case{R"({"setLight":{"light":1,"intensity":-1}})", "setLight.intensity"},
          Case{R"({"setLight":{"intensity":1}})", "setLight.light"},
          Case{R"({"setLight":{"light":1,"colour":{}}})", "setLight.colour"},
          Case{R"({"setLight":{"light":1,"aim":{}}})", "setLight.aim"},
          Case{R"({"setLight":{"light":1,"rotation":400}})", "setLight.rotation"},
          Case{R"({"setLight":{"light":1,"innerCone":30,"outerCone":20}})", "setLight.innerCone"},
          Case{R"({"setLight":{"light":1,"outerCone":91}})", "setLight.outerCone"},
          Case{R"({"setLight":{"light":1,"flux":1,"intensity":1}})", "setLight.flux"},
          Case{R"({"setLight":{"light":1,"colourTemperature":900}})", "setLight.colourTemperature"},
          Case{R"({"setLight":{"light":1,"colourTemperature":3000,"colour":{"x":1}}})",
               "setLight.colourTemperature"},
          Case{R"({"setLight":{"light":1,"dim":1.5}})", "setLight.dim"},
          Case{R"({"setLight":{"light":1,"maintenanceFactor":0}})", "setLight.maintenanceFactor"},
          Case{R"({"setLight":{"light":1,"position":{"x":1},"group":"desks"}})", nullptr},
          Case{R"({"setDaylight":{}})", "setDaylight"},
          Case{R"({"setDaylight":{"place":{"latitude":91}}})", "setDaylight.place.latitude"},
          Case{R"({"setDaylight":{"time":"2026-06-21T15:00Z","sunElevation":3}})",
               "setDaylight.sunElevation"},
          Case{R"({"setDaylight":{"turbidity":0}})", "setDaylight.turbidity"},
          Case{R"({"setDaylight":{"sky":"clear","lights":[{"id":1}]}})", "setDaylight.lights"},
          Case{R"({"setGroup":{"dim":1}})", "setGroup.group"},
          Case{R"({"setGroup":{"group":"desks"}})", "setGroup"},
          Case{R"({"setGroup":{"group":"desks","dim":2}})", "setGroup.dim"},
          Case{R"({"setGroup":{"group":"desks","dim":0.2,"fadeSeconds":61}})",
               "setGroup.fadeSeconds"},
          Case{R"({"setGroup":{"group":"desks","fadeSeconds":3}})", "setGroup"},
          Case{R"({"setGroup":{"group":"desks","on":true,"fadeSeconds":60}})", nullptr},
          Case{R"({"applyLightingScene":{"name":"a","fadeSeconds":-1}})",
               "applyLightingScene.fadeSeconds"},
          Case{R"({"applyLightingScene":{"name":"a","fadeSeconds":2.5}})", nullptr},
          Case{R"({"setLight":{"light":1,"fadeSeconds":3}})", "setLight"},
          Case{R"({"setLight":{"light":1,"on":true,"fadeSeconds":100}})", "setLight.fadeSeconds"},
          Case{R"({"setLight":{"light":1,"group":"a","fadeSeconds":3}})", "setLight.fadeSeconds"},
          Case{R"({"setLight":{"light":1,"dim":0,"aim":{"y":-1},"fadeSeconds":3}})",
               "setLight.fadeSeconds"},
          Case{R"({"setLight":{"light":1,"colourTemperature":3000,"dim":0.5,"fadeSeconds":3}})",
               nullptr},
          Case{R"({"saveLightingScene":{}})", "saveLightingScene.name"},
          Case{R"({"applyLightingScene":{"name":""}})", "applyLightingScene.name"},
          Case{R"({"setMaterial":{"material":1,"baseColour":{"x":1.5}}})",
               "setMaterial.baseColour"},
          Case{R"({"setMaterial":{"material":1,"roughness":2}})", "setMaterial.roughness"},
          Case{R"({"setMaterial":{"material":1,"metallic":1}})", nullptr}}) {
        expect_case(c.text, c.field);
    }
}

TEST(MessageValidation, Additions) {
    const auto luminaire = [](const std::string& rest) {
        return R"({"addLuminaire":{"photometry":"panel.ldt","position":{"y":2.7})" + rest + "}}";
    };
    expect_case(luminaire(""), nullptr);
    expect_case(luminaire(R"(,"aim":{"y":-1},"rotation":90,"group":"desks","name":"a")"), nullptr);
    expect_case(luminaire(R"(,"columns":4,"columnStep":{"x":2})"), nullptr);
    expect_case(luminaire(R"(,"columns":4)"), "addLuminaire.columnStep");
    expect_case(luminaire(R"(,"rows":2)"), "addLuminaire.rowStep");
    expect_case(luminaire(R"(,"columns":100,"rows":100)"), "addLuminaire.columns");
    expect_case(luminaire(R"(,"aim":{})"), "addLuminaire.aim");
    expect_case(luminaire(R"(,"light":7)"), "addLuminaire.light");
    expect_case(R"({"addLuminaire":{"light":7}})", nullptr);
    expect_case(R"({"addLuminaire":{"photometry":"a.ies"}})", "addLuminaire.position");
    expect_case(R"({"addLuminaire":{"photometry":"a.txt","position":{}}})",
                "addLuminaire.photometry");
    expect_case(R"({"addLuminaire":{"photometry":"../a.ies","position":{}}})",
                "addLuminaire.photometry");
    expect_case(R"({"setLight":{"light":1,"photometry":"a.ies"}})", nullptr);
    expect_case(R"({"setLight":{"light":1,"photometry":""}})", nullptr);
    expect_case(R"({"setLight":{"light":1,"photometry":"a/b.ies"}})", "setLight.photometry");
    expect_case(R"({"removeLight":{}})", "removeLight.light");
    expect_case(R"({"removeObject":{}})", "removeObject.object");
    expect_case(R"({"addObject":{"copyOf":2}})", nullptr);
    expect_case(R"({"addObject":{"object":2}})", nullptr);
    expect_case(R"({"addObject":{"library":"chair.glb"}})", nullptr);
    expect_case(R"({"addObject":{}})", "addObject");
    expect_case(R"({"addObject":{"copyOf":2,"library":"chair.glb"}})", "addObject");
    expect_case(R"({"addObject":{"library":"../chair.glb"}})", "addObject.library");
    expect_case(R"({"addObject":{"copyOf":2,"transform":{"scale":{}}}})",
                "addObject.transform.scale");
    expect_case(R"({"addObject":{"copyOf":2,"removed":true}})", "addObject.removed");
}

TEST(MessageValidation, ChangesOfNothingAreRefused) {
    expect_case(R"({"setLight":{"light":1}})", "setLight");
    expect_case(R"({"setMaterial":{"material":1}})", "setMaterial");
    expect_case(R"({"setDisplay":{}})", "setDisplay");
}

TEST(MessageValidation, MisspeltFieldsAndValuesAreNamed) {
    for (const Case& c :
         {Case{R"({"setLight":{"light":1,"color":{"x":1,"y":1,"z":1}}})", "setLight.color"},
          Case{R"({"setLight":{"light":1,"on":true,"intensty":5}})", "setLight.intensty"},
          Case{R"({"setMaterial":{"material":1,"metallic":1,"baseColor":{}}})",
               "setMaterial.baseColor"},
          Case{R"({"moveObject":{"object":1,"transform":{"position":{"x":1}}}})",
               "moveObject.transform.position"},
          Case{R"({"moveObject":{"object":1,"transform":{"scale":{"X":1}}}})",
               "moveObject.transform.scale.X"},
          Case{R"({"setDisplay":{"mode":"PHOTOGRAPH"}})", "setDisplay.mode"},
          Case{R"({"setDisplay":{"mode":77}})", "setDisplay.mode"},
          Case{R"({"snapshot":{"width":9,"height":9,"relativeError":0.1,"format":"exr"}})",
               "snapshot.format"},
          Case{R"({"hello":{"protocol":"1.0","codecs":["PNG","AV1"]}})", "hello.codecs"},
          Case{R"({"hello":{"protocol":"1.0","tokn":"x"}})", "hello.tokn"},
          Case{R"({"ping":{},"foo":1})", "\"foo\""}, Case{R"({"ack":{"frame":1,"":2}})", "ack."}}) {
        expect_case(c.text, c.field);
    }
}

TEST(MessageValidation, WrongTypesAreNamed) {
    for (const Case& c :
         {Case{R"({"setCamera":{"eye":{"x":"left"}}})", "setCamera.eye.x"},
          Case{R"({"setCamera":{"eye":[1,2,3]}})", "setCamera.eye"},
          Case{R"({"setCamera":{"eye":7}})", "setCamera.eye"},
          Case{R"({"setLight":7})", "setLight"},
          Case{R"({"setLight":[{"light":1}]})", "setLight"},
          Case{R"({"setLight":{"light":-1}})", "setLight.light"},
          Case{R"({"setLight":{"light":1.5}})", "setLight.light"},
          Case{R"({"setLight":{"light":4294967296}})", "setLight.light"},
          Case{R"({"setLight":{"light":1,"on":"yes"}})", "setLight.on"},
          Case{R"({"setLight":{"light":1,"on":1}})", "setLight.on"},
          Case{R"({"setLight":{"light":1,"intensity":true}})", "setLight.intensity"},
          Case{R"({"setLight":{"light":1,"intensity":1e300}})", "setLight.intensity"},
          Case{R"({"setLight":{"light":1,"intensity":1,"intensity":2}})", "setLight.intensity"},
          Case{R"({"hello":{"protocol":1.0}})", "hello.protocol"},
          Case{R"({"hello":{"protocol":"1.0","codecs":"PNG"}})", "hello.codecs"},
          Case{R"({"hello":{"protocol":"1.0","codecs":[null]}})", "hello.codecs"},
          Case{R"({"hello":{"protocol":"1.0","codecs":[["PNG"]]}})", "hello.codecs"},
          Case{R"({"setDisplay":{"mode":{}}})", "setDisplay.mode"},
          Case{R"({"setTarget":{"seconds":1,"relativeError":0.1}})", "setTarget"},
          Case{R"({"id":"one","ping":{}})", "id"},
          Case{R"({"id":null,"ping":{}})", nullptr},
          Case{R"({"id":"7","setLight":{"light":"1","intensity":"1.5","on":true}})", nullptr},
          Case{R"({"setLight":{"light":1.0,"on":null,"intensity":1}})", nullptr}}) {
        expect_case(c.text, c.field);
    }
}

TEST(MessageValidation, Requests) {
    const std::string long_text(501, 'a');
    for (
        const Case& c :
        {Case{R"({"setTarget":{}})", nullptr},
         Case{R"({"setTarget":{"relativeError":0}})", "setTarget.relativeError"},
         Case{R"({"setTarget":{"seconds":-1}})", "setTarget.seconds"},
         Case{R"({"setDisplay":{"exposure":31}})", "setDisplay.exposure"},
         Case{R"({"setDisplay":{"mode":"MODE_UNSPECIFIED"}})", "setDisplay.mode"},
         Case{R"({"setDepths":{}})", nullptr},
         Case{R"({"setDepths":{"columns":512}})", nullptr},
         Case{R"({"setDepths":{"columns":1}})", "setDepths.columns"},
         Case{R"({"setDepths":{"columns":513}})", "setDepths.columns"},
         Case{R"({"probe":{}})", "probe"},
         Case{R"({"probe":{"pixel":{"x":-1}}})", "probe.pixel"},
         Case{R"({"probe":{"ray":{"origin":{},"direction":{}}}})", "probe.ray.direction"},
         Case{R"({"ack":{"frame":1,"decodeMs":-1}})", "ack.decodeMs"},
         Case{R"({"addPin":{"text":"","position":{}}})", "addPin.text"},
         Case{R"({"addPin":{"text":"a"}})", "addPin.position"},
         Case{R"({"removePin":{}})", "removePin.pin"},
         Case{R"({"removeViewpoint":{}})", "removeViewpoint.viewpoint"},
         Case{R"({"pointAt":{}})", "pointAt.position"},
         Case{R"({"setDisplay":{"scaleMaximum":-1}})", "setDisplay.scaleMaximum"},
         Case{R"({"setDisplay":{"scaleUnit":0}})", "setDisplay.scaleUnit"},
         Case{R"({"saveViewpoint":{"name":"","eye":{},"target":{"z":1},"verticalFov":1}})",
              "saveViewpoint.name"},
         Case{R"({"saveViewpoint":{"name":"a","eye":{},"target":{},"verticalFov":1}})",
              "saveViewpoint.target"},
         Case{R"({"saveViewpoint":{"name":"a","eye":{},"target":{"z":1}}})",
              "saveViewpoint.verticalFov"},
         Case{R"({"probeGrid":{"stepX":{"x":1},"stepY":{"z":1},"columns":1,"rows":1}})",
              "probeGrid.origin"},
         Case{R"({"probeGrid":{"origin":{},"stepX":{"x":1},"stepY":{"x":2},"columns":1,"rows":1}})",
              "probeGrid.stepY"},
         Case{
             R"({"probeGrid":{"origin":{},"stepX":{"x":1},"stepY":{"z":1},"columns":33,"rows":32}})",
             "probeGrid.columns"},
         Case{R"({"measure":{"points":[{"position":{}}]}})", "measure.quantity"},
         Case{R"({"measure":{"quantity":"HORIZONTAL"}})", "measure.area"},
         Case{R"({"measure":{"quantity":"HORIZONTAL","points":[{}]}})", "measure.points.position"},
         Case{R"({"measure":{"quantity":"VERTICAL","points":[{"position":{}}]}})",
              "measure.points.normal"},
         Case{
             R"({"measure":{"quantity":"VERTICAL","direction":{"y":1},"points":[{"position":{}}]}})",
             "measure.direction"},
         Case{R"({"measure":{"quantity":"NORMAL","points":[{"position":{},"normal":{"x":1e12}}]}})",
              "measure.points.normal.x"},
         Case{
             R"({"measure":{"quantity":"HORIZONTAL","columns":1,"rows":1,"area":{"origin":{},"u":{"x":1},"v":{"x":2}}}})",
             "measure.area.v"},
         Case{
             R"({"measure":{"quantity":"HORIZONTAL","columns":65,"rows":64,"area":{"origin":{},"u":{"x":1},"v":{"z":2}}}})",
             "measure.columns"},
         Case{
             R"({"measure":{"quantity":"HORIZONTAL","grid":"EN12464","margin":0.5,"area":{"origin":{},"u":{"x":1},"v":{"z":2}}}})",
             "measure.margin"},
         Case{
             R"({"measure":{"quantity":"HORIZONTAL","relativeError":0,"points":[{"position":{}}]}})",
             "measure.relativeError"},
         Case{R"({"measure":{"quantity":"UGR","points":[{"position":{}}]}})", "measure.direction"},
         Case{R"({"measure":{"quantity":"UGR","directions":5,"points":[{"position":{}}]}})",
              "measure.directions"},
         Case{R"({"measure":{"quantity":"UGR","direction":{"y":1},"points":[{"position":{}}]}})",
              "measure.direction"},
         Case{
             R"({"measure":{"quantity":"HORIZONTAL","columns":1,"rows":1,"outline":[{},{"x":1}]}})",
             "measure.outline"},
         Case{R"({"measure":{"quantity":"HORIZONTAL","name":"a","points":[{"position":{}}]}})",
              "measure.name"},
         Case{R"({"measure":{"quantity":"HORIZONTAL","surrounding":1,"points":[{"position":{}}]}})",
              "measure.surrounding"},
         Case{R"({"setZone":{"measurement":1,"name":""}})", "setZone.name"},
         Case{R"({"setRequirement":{}})", "setRequirement.requirement.name"},
         Case{R"({"setRequirement":{"requirement":{"name":"a","uniformity":2}}})",
              "setRequirement.requirement.uniformity"},
         Case{R"({"replyToPin":{"pin":1}})", "replyToPin.text"},
         Case{R"({"removeMeasurement":{}})", "removeMeasurement.measurement"},
         Case{R"({"snapshot":{"width":9,"height":9,"relativeError":0.1}})", "snapshot.format"},
         Case{R"({"hello":{}})", "hello.protocol"}}) {
        expect_case(c.text, c.field);
    }
    expect_case(R"({"addPin":{"position":{},"text":")" + long_text + "\"}}", "addPin.text");
}

}  // namespace
}  // namespace raybundle
