// SPDX-License-Identifier: Apache-2.0
#include "options/config_file.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

#include "options/option_table.h"
#include "options/serve_settings.h"

namespace raybundle {
namespace {

const std::string kDigest(64, 'a');

/// Message of the UsageError that a configuration causes; empty where it is fine.
std::string problem(const std::string& json) {
    Options options;
    try {
        apply_config_text("site.json", json, options);
        return {};
    } catch (const UsageError& error) {
        return error.what();
    }
}

Options parsed(std::vector<std::string> arguments) {
    CLI::App app;
    Options options;
    define_options(app, options);
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    return options;
}

TEST(ConfigFile, EveryOptionCanBeSet) {
    Options options;
    apply_config_text("site.json",
                      R"({"scene":"a.gltf","listen":"[::1]:9","allowRemote":true,
        "tlsCert":"c","tlsKey":"k","allowedOrigins":["https://a.example"],"maxViewers":3,
        "minFramesPerSecond":2,"maxConnections":9,"maxConnectionsPerAddress":4,"maxMessagesPerSecond":50.5,
        "journal":"j.db","watch":true,
        "logFormat":"json","patchSize":0.25,"seed":18446744073709551615,"gpu":2,"unit":"cm",
        "sky":5000,"sunElevation":30,"groundAlbedo":0.5,"environment":"e.hdr","logLevel":"warn",
        "tokens":[{"name":"lead","role":"EDITOR","sha256":")" +
                          kDigest + R"("}]})",
                      options);
    EXPECT_EQ(options.scene.file, "a.gltf");
    EXPECT_EQ(options.network.listen, "[::1]:9");
    EXPECT_TRUE(options.network.allow_remote);
    EXPECT_EQ(options.network.allowed_origins, std::vector<std::string>{"https://a.example"});
    EXPECT_EQ(options.serve.max_viewers, 3);
    EXPECT_DOUBLE_EQ(options.network.max_messages_per_second, 50.5);
    EXPECT_FLOAT_EQ(options.scene.patch_size, 0.25F);
    EXPECT_EQ(options.scene.seed, 18446744073709551615U);
    EXPECT_EQ(options.daylight.sky.luminance(), 5000.0F);
    ASSERT_EQ(options.network.tokens.size(), 1U);
    EXPECT_EQ(options.network.tokens[0].role, v1::EDITOR);
}

TEST(ConfigFile, WhatIsPrintedIsReadBackTheSame) {
    Options options;
    apply_config_text("site.json",
                      R"({"maxViewers":3,"sky":12.5,"tokens":[{"name":"lead",
        "role":"REVIEWER","sha256":")" +
                          kDigest + R"("}]})",
                      options);
    const std::string printed = print_config(options);
    Options again;
    apply_config_text("printed", printed, again);
    EXPECT_EQ(print_config(again), printed);
    EXPECT_NE(print_config(Options()), printed);
    for (const OptionRow& option : option_table()) {
        EXPECT_NE(printed.find("\"" + std::string(option.key) + "\""), std::string::npos);
    }
}

TEST(ConfigFile, ErrorsNameFileKeyAndReason) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"listn":"a:1"})", "site.json: listn: unknown key, did you mean 'listen'?"},
        {R"({"maxviewers":1})", "site.json: maxviewers: unknown key, did you mean 'maxViewers'?"},
        {R"({"quite-something-else":1})", "site.json: quite-something-else: unknown key"},
        {R"({"maxViewers":"9"})", "site.json: maxViewers: must be a whole number"},
        {R"({"maxViewers":1.5})", "site.json: maxViewers: must be a whole number"},
        {R"({"maxViewers":0})", "site.json: maxViewers: must be a number from 1 to 1000"},
        {R"({"allowRemote":1})", "site.json: allowRemote: must be true or false"},
        {R"({"listen":"here"})", "site.json: listen: 'here' is not HOST:PORT"},
        {R"({"sky":-1})", "site.json: sky: must be a number of at least 0"},
        {R"({"sky":"blue"})", "site.json: sky: 'blue' is neither a luminance"},
        {R"({"sky":[1]})", "site.json: sky: must be a text"},
        {R"({"sunElevation":100})", "site.json: sunElevation: must be a number from 0 to 90"},
        {R"({"unit":"mile"})", "site.json: unit: 'mile' is none of m, cm, mm, in, ft"},
        {R"({"allowedOrigins":["a.example"]})", "site.json: allowedOrigins: 'a.example' is not an"},
        {R"({"allowedOrigins":"x"})", "site.json: allowedOrigins: must be an array of texts"},
        {R"({"tokens":[{"name":"a","role":"ADMIN","sha256":""}]})",
         "site.json: tokens[0].role: must be VIEWER, REVIEWER or EDITOR"},
        {R"({"tokens":[{"name":"a","role":"VIEWER","sha256":"12"}]})",
         "site.json: tokens[0].sha256: must be 64 hexadecimal digits"},
        {R"({"tokens":[{"name":"a","rolle":"VIEWER"}]})",
         "site.json: tokens[0].rolle: unknown key, did you mean 'role'?"},
        {R"({"tokens":{}})", "site.json: tokens: must be an array"},
        {R"({"seed":1,"seed":2})", "site.json: seed: is there twice"},
        {R"({"seed":1)", "site.json: parse error at line 1, column 10"},
        {R"([])", "site.json: must hold one JSON object"},
        {R"()", "site.json: parse error"}};
    for (const auto& [json, expected] : cases) {
        const std::string text = problem(json);
        EXPECT_TRUE(text.starts_with(expected)) << json << "\n got: " << text;
    }
}

TEST(ConfigFile, AnErrorChangesNothing) {
    Options options;
    EXPECT_THROW(apply_config_text("f", R"({"maxViewers":3,"nonsense":1})", options), UsageError);
    EXPECT_EQ(options.serve.max_viewers, Options().serve.max_viewers);
}

TEST(ConfigFile, TheCommandLineWins) {
    const auto file = std::filesystem::temp_directory_path() / "raybundle_config_test.json";
    std::ofstream(file) << R"({"scene":"file.gltf","maxViewers":3,"listen":"127.0.0.1:1"})";
    const Options options =
        parsed({"serve", "--config", file.string(), "--listen", "127.0.0.1:2", "cli.gltf"});
    std::filesystem::remove(file);
    EXPECT_EQ(options.scene.file, "cli.gltf");
    EXPECT_EQ(options.network.listen, "127.0.0.1:2");
    EXPECT_EQ(options.serve.max_viewers, 3);
    EXPECT_THROW(parsed({"serve", "--config", "/nonexistent.json", "a.gltf"}), UsageError);
}

TEST(ConfigFile, WhatTheCommandLineOverridesMustBeRightToo) {
    Options options;
    options.config.on_command_line = {"scene", "maxViewers"};
    options.serve.max_viewers = 7;
    apply_config_text("f", R"({"scene":"a.gltf","maxViewers":3})", options);
    EXPECT_EQ(options.serve.max_viewers, 7);
    EXPECT_THROW(apply_config_text("f", R"({"scene":5})", options), UsageError);
    EXPECT_THROW(apply_config_text("f", R"({"maxViewers":0})", options), UsageError);
}

TEST(ConfigFile, TextThatIsNotUtf8CannotBePrinted) {
    Options options;
    options.scene.file = "\xff.gltf";
    EXPECT_THROW(print_config(options), UsageError);
}

TEST(ConfigFile, IsReadAgainUnderTheSameCommandLine) {
    const auto file = std::filesystem::temp_directory_path() / "raybundle_reread_test.json";
    std::ofstream(file) << R"({"maxViewers":3,"seed":5,"tokens":[{"name":"a","role":"EDITOR",
        "sha256":")" << kDigest
                        << R"("}]})";
    const Options before = parsed({"serve", "a.gltf", "--config", file.string(), "--seed", "7"});
    ASSERT_EQ(before.network.tokens.size(), 1U);
    std::ofstream(file) << R"({"maxConnections":9,"seed":6})";
    const Options after = reread_config(before);
    std::filesystem::remove(file);
    EXPECT_TRUE(after.network.tokens.empty()) << "they are gone from the file";
    EXPECT_EQ(after.serve.max_viewers, Options().serve.max_viewers);
    EXPECT_EQ(after.network.max_connections, 9);
    EXPECT_EQ(after.scene.seed, 7U);
    EXPECT_EQ(after.scene.file, "a.gltf");
}

/// It would be waited for, and no signal heard meanwhile.
TEST(ConfigFile, APipeIsNotReadAgain) {
    const auto file = std::filesystem::temp_directory_path() / "raybundle_pipe_test.json";
    std::filesystem::remove(file);
    std::ofstream(file) << R"({"maxViewers":3})";
    const Options before = parsed({"serve", "a.gltf", "--config", file.string()});
    std::filesystem::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    EXPECT_THROW(reread_config(before), UsageError);
    std::filesystem::remove(file);
}

TEST(ConfigFile, TheCommandLineIsCheckedByTheSameTable) {
    EXPECT_THROW(parsed({"serve", "a.gltf", "--max-viewers", "0"}), UsageError);
    EXPECT_THROW(parsed({"serve", "a.gltf", "--log-format", "xml"}), UsageError);
    EXPECT_THROW(parsed({"serve"}), UsageError) << "no scene";
    EXPECT_EQ(parsed({"serve", "--print-config"}).network.listen, "127.0.0.1:8080");
}

TEST(ServeSettings, BeyondThisMachineNeedsTokensOrPermission) {
    Options options;
    for (const char* local : {"127.0.0.1:1", "localhost:1", "[::1]:1", "127.8.8.8:1"}) {
        options.network.listen = local;
        EXPECT_NO_THROW(server_settings(options)) << local;
    }
    for (const char* remote : {"0.0.0.0:1", "[::]:1", "192.0.2.1:1", "127.0.0.1.example.org:1"}) {
        options.network.listen = remote;
        EXPECT_THROW(server_settings(options), UsageError) << remote;
    }
    options.network.listen = "0.0.0.0:1";
    options.network.allow_remote = true;
    EXPECT_NO_THROW(server_settings(options));
    options.network.allow_remote = false;
    options.network.tokens = {{"lead", v1::EDITOR, token_digest("x")}};
    EXPECT_NO_THROW(server_settings(options));
    EXPECT_FALSE(server_settings(options).access.tokens.empty());
}

TEST(ServeSettings, OnThisMachineWithoutTokensNamesOfOthersAreNotTrusted) {
    Options options;
    options.network.listen = "127.0.0.1:1";
    EXPECT_TRUE(server_settings(options).access.origins.no_foreign_names);
    options.network.tokens = {{"lead", v1::EDITOR, token_digest("x")}};
    EXPECT_FALSE(server_settings(options).access.origins.no_foreign_names);
    options.network.tokens.clear();
    options.network.listen = "0.0.0.0:1";
    options.network.allow_remote = true;
    EXPECT_FALSE(server_settings(options).access.origins.no_foreign_names);
}

TEST(ServeSettings, CertificateAndKeyBelongTogether) {
    Options options;
    options.network.tls_cert = "certificate.pem";
    EXPECT_THROW(server_settings(options), UsageError);
}

}  // namespace
}  // namespace raybundle
