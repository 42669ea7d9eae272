// SPDX-License-Identifier: Apache-2.0
#include "telemetry/otlp_settings.h"

#include <gtest/gtest.h>

#include <map>

namespace raybundle {
namespace {

std::optional<OtlpSettings> settings_of(const std::string& option,
                                        const std::map<std::string, std::string>& environment) {
    return otlp_settings(option, [&](const char* name) -> const char* {
        const auto found = environment.find(name);
        return found == environment.end() ? nullptr : found->second.c_str();
    });
}

TEST(OtlpSettings, AreNoneUnlessSomebodyAsks) {
    EXPECT_FALSE(settings_of("", {}));
    EXPECT_FALSE(settings_of("", {{"OTEL_SERVICE_NAME", "x"}}));
    EXPECT_FALSE(settings_of("", {{"OTEL_EXPORTER_OTLP_ENDPOINT", ""}}));
}

TEST(OtlpSettings, OfTheEnvironmentAreTheStandardsOnes) {
    const auto settings = settings_of(
        "", {{"OTEL_EXPORTER_OTLP_ENDPOINT", "http://collector:4318/"},
             {"OTEL_SERVICE_NAME", "office"},
             {"OTEL_RESOURCE_ATTRIBUTES", "service.name=other, deployment.environment=a%20b"},
             {"OTEL_EXPORTER_OTLP_HEADERS", "api-key=a%3Db,x-tenant=7"},
             {"OTEL_EXPORTER_OTLP_TIMEOUT", "2500"}});
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->url.text(), "http://collector:4318/v1/traces");
    EXPECT_EQ(settings->source.service, "office");
    ASSERT_EQ(settings->source.attributes.size(), 1U);
    EXPECT_EQ(settings->source.attributes[0].first, "deployment.environment");
    EXPECT_EQ(std::get<std::string>(settings->source.attributes[0].second), "a b");
    const HttpPost::Headers headers{{"api-key", "a=b"}, {"x-tenant", "7"}};
    EXPECT_EQ(settings->headers, headers);
    EXPECT_EQ(settings->timeout, std::chrono::milliseconds(2500));
}

TEST(OtlpSettings, OptionAndOwnAddressOfTracesComeFirst) {
    const std::map<std::string, std::string> environment{
        {"OTEL_EXPORTER_OTLP_ENDPOINT", "http://a:1"},
        {"OTEL_EXPORTER_OTLP_TRACES_ENDPOINT", "http://b:2/in"}};
    EXPECT_EQ(settings_of("", environment)->url.text(), "http://b:2/in");
    EXPECT_EQ(settings_of("http://c:3/x", environment)->url.text(), "http://c:3/x/v1/traces");
}

TEST(OtlpSettings, IgnoreWhatDoesNotFit) {
    const auto at = [](std::map<std::string, std::string> more) {
        more.emplace("OTEL_EXPORTER_OTLP_ENDPOINT", "http://a:1");
        return settings_of("", more);
    };
    EXPECT_FALSE(at({{"OTEL_SDK_DISABLED", "true"}}));
    EXPECT_FALSE(at({{"OTEL_TRACES_EXPORTER", "none"}}));
    EXPECT_FALSE(at({{"OTEL_EXPORTER_OTLP_PROTOCOL", "grpc"}}));
    EXPECT_TRUE(at({{"OTEL_EXPORTER_OTLP_PROTOCOL", "http/protobuf"}}));
    EXPECT_FALSE(settings_of("", {{"OTEL_EXPORTER_OTLP_ENDPOINT", "collector:4317"}}));
    EXPECT_EQ(at({{"OTEL_EXPORTER_OTLP_TIMEOUT", "soon"}})->timeout,
              std::chrono::milliseconds(10000));
    const auto headers = at({{"OTEL_EXPORTER_OTLP_HEADERS", "a=b%0d%0aHost: c,d=e,=f,g"}})->headers;
    ASSERT_EQ(headers.size(), 1U) << "no line ends in headers";
    EXPECT_EQ(headers[0].first, "d");
}

}  // namespace
}  // namespace raybundle
