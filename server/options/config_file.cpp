// SPDX-License-Identifier: Apache-2.0
#include "options/config_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "options/config_json.h"
#include "options/option_table.h"

namespace raybundle {
namespace {

using Json = ConfigJson;

constexpr std::size_t max_tokens = 1000;
constexpr const char* scene_key = "scene";
constexpr const char* tokens_key = "tokens";
constexpr const char* jwt_key = "jwt";
// Not on the command line, which others can see.
constexpr const char* redis_user_key = "redisUser";
constexpr const char* redis_password_key = "redisPassword";

/// A value that does not fit; the caller adds file and key.
class BadValue : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Levenshtein distance, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0U);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                              std::tolower(static_cast<unsigned char>(b[j - 1]));
            const std::size_t replaced = diagonal + (same ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// ", did you mean 'listen'?" where a known key is near.
std::string suggestion(const std::string& key, const std::vector<std::string>& known) {
    const auto nearest = std::min_element(known.begin(), known.end(),
                                          [&](const std::string& a, const std::string& b) {
                                              return edit_distance(key, a) < edit_distance(key, b);
                                          });
    constexpr std::size_t max_letters = 64;
    if (key.size() > max_letters || edit_distance(key, *nearest) > nearest->size() / 2) {
        return {};
    }
    return ", did you mean '" + *nearest + "'?";
}

[[noreturn]] void refuse_unknown(const std::string& key, const std::vector<std::string>& known) {
    throw BadValue("unknown key" + suggestion(key, known));
}

std::vector<std::string> known_keys() {
    std::vector<std::string> keys{scene_key, tokens_key, jwt_key, redis_user_key,
                                  redis_password_key};
    for (const OptionRow& option : option_table()) {
        keys.emplace_back(option.key);
    }
    return keys;
}

void read(const Json& value, bool& target) {
    if (!value.is_boolean()) {
        throw BadValue("must be true or false");
    }
    target = value.get<bool>();
}

void read(const Json& value, std::string& target) {
    if (!value.is_string()) {
        throw BadValue("must be a text");
    }
    target = value.get<std::string>();
}

void read(const Json& value, std::vector<std::string>& target) {
    if (!value.is_array()) {
        throw BadValue("must be an array of texts");
    }
    target.clear();
    for (const Json& entry : value) {
        read(entry, target.emplace_back());
    }
}

void read(const Json& value, int& target) {
    constexpr std::int64_t limit = std::numeric_limits<int>::max();
    if (!value.is_number_integer() || value.get<std::int64_t>() > limit ||
        value.get<std::int64_t>() < -limit) {
        throw BadValue("must be a whole number");
    }
    target = value.get<int>();
}

void read(const Json& value, std::uint64_t& target) {
    if (!value.is_number_unsigned()) {
        throw BadValue("must be a whole number of at least 0");
    }
    target = value.get<std::uint64_t>();
}

void read(const Json& value, double& target) {
    if (!value.is_number()) {
        throw BadValue("must be a number");
    }
    target = value.get<double>();
}

void read(const Json& value, float& target) {
    double number = 0.0;
    read(value, number);
    target = static_cast<float>(number);
}

void read(const Json& value, std::optional<float>& target) {
    if (value.is_null()) {
        target.reset();
        return;
    }
    read(value, target.emplace());
}

void read(const Json& value, SkyChoice& target) {
    if (value.is_null()) {
        target.text.clear();
    } else if (value.is_number()) {
        target.text = fmt::format("{}", value.get<double>());
    } else {
        read(value, target.text);
    }
}

/// Text member of a token's entry.
std::string token_text(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    if (found == entry.end() || !found->is_string()) {
        throw BadValue(std::string(key) + ": must be a text");
    }
    return found->get<std::string>();
}

AccessToken read_token(const Json& entry) {
    static const std::vector<std::string> known{"name", "role", "sha256"};
    if (!entry.is_object()) {
        throw BadValue("must be an object with name, role and sha256");
    }
    for (const auto& [key, value] : entry.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw BadValue(key + ": unknown key" + suggestion(key, known));
        }
    }
    const auto role = parse_role(token_text(entry, "role"));
    if (!role) {
        throw BadValue("role: must be VIEWER, REVIEWER or EDITOR");
    }
    const auto digest = parse_digest(token_text(entry, "sha256"));
    if (!digest) {
        throw BadValue("sha256: must be 64 hexadecimal digits, as 'raybundle token' prints them");
    }
    return {token_text(entry, "name"), *role, *digest};
}

std::vector<AccessToken> read_tokens(const Json& value) {
    if (!value.is_array() || value.size() > max_tokens) {
        throw BadValue("must be an array of at most " + std::to_string(max_tokens) + " objects");
    }
    std::vector<AccessToken> tokens;
    for (const Json& entry : value) {
        try {
            tokens.push_back(read_token(entry));
        } catch (const BadValue& bad) {
            throw BadValue("[" + std::to_string(tokens.size()) + "]." + bad.what());
        }
        const auto same = [&](const AccessToken& other) {
            return other.digest == tokens.back().digest;
        };
        if (std::any_of(tokens.begin(), tokens.end() - 1, same)) {
            throw BadValue("[" + std::to_string(tokens.size() - 1) + "].sha256: is there twice");
        }
    }
    return tokens;
}

JwtOptions read_jwt(const Json& value) {
    if (!value.is_object()) {
        throw BadValue("must be an object with issuer, audience and secretFile or keyFiles");
    }
    JwtOptions jwt;
    const std::map<std::string, std::string*> texts{{"issuer", &jwt.issuer},
                                                    {"audience", &jwt.audience},
                                                    {"secretFile", &jwt.secret_file},
                                                    {"roleClaim", &jwt.role_claim},
                                                    {"nameClaim", &jwt.name_claim}};
    std::vector<std::string> known{"keyFiles"};
    for (const auto& [key, target] : texts) {
        known.push_back(key);
    }
    for (const auto& [key, entry] : value.items()) {
        const auto text = texts.find(key);
        try {
            if (text != texts.end()) {
                read(entry, *text->second);
            } else if (key == "keyFiles") {
                read(entry, jwt.key_files);
            } else {
                refuse_unknown(key, known);
            }
        } catch (const BadValue& bad) {
            throw BadValue(key + ": " + bad.what());
        }
    }
    return jwt;
}

void read_key(const std::string& key, const Json& value, Options& options) {
    if (key == scene_key) {
        read(value, options.scene.file);
        return;
    }
    if (key == tokens_key) {
        options.network.tokens = read_tokens(value);
        return;
    }
    if (key == jwt_key) {
        options.network.jwt = read_jwt(value);
        return;
    }
    if (key == redis_user_key || key == redis_password_key) {
        read(value,
             key == redis_user_key ? options.serve.redis_user : options.serve.redis_password);
        return;
    }
    const auto table = option_table();
    const auto option = std::find_if(table.begin(), table.end(),
                                     [&](const OptionRow& row) { return key == row.key; });
    if (option == table.end()) {
        refuse_unknown(key, known_keys());
    }
    std::visit([&](const auto& field) { read(value, field(options)); }, option->field);
    if (const std::string problem = problem_of(*option, options); !problem.empty()) {
        throw BadValue(problem);
    }
}

/// What the command line has said is kept, but checked in the file all the same.
void apply_key(const std::string& key, const Json& value, Options& options) {
    if (options.config.on_command_line.contains(key)) {
        Options overridden;
        read_key(key, value, overridden);
    } else {
        read_key(key, value, options);
    }
}

Json to_json(const std::optional<float>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json to_json(const SkyChoice& value) {
    const std::optional<float> luminance = value.luminance();
    return luminance ? Json(*luminance) : value.text.empty() ? Json(nullptr) : Json(value.text);
}

template <typename Value>
Json to_json(const Value& value) {
    return value;
}

}  // namespace

void apply_config_text(const std::string& name, const std::string& text, Options& options) {
    const Json json = parse_config_json(name, text);
    Options changed = options;
    for (const auto& [key, value] : json.items()) {
        try {
            apply_key(key, value, changed);
        } catch (const BadValue& bad) {
            const bool indexed = bad.what()[0] == '[';
            throw UsageError(fmt::format("{}: {}{}{}", name, key, indexed ? "" : ": ", bad.what()));
        }
    }
    options = std::move(changed);
}

void apply_config_file(const std::string& file, Options& options) {
    apply_config_text(file, read_config_file(file), options);
}

Options reread_config(const Options& options) {
    Options fresh;
    fresh.command = options.command;
    fresh.config.file = options.config.file;
    fresh.config.on_command_line = options.config.on_command_line;
    for (const OptionRow& option : option_table()) {
        if (options.config.on_command_line.contains(option.key)) {
            std::visit([&](const auto& field) { field(fresh) = field(options); }, option.field);
        }
    }
    if (options.config.on_command_line.contains(scene_key)) {
        fresh.scene.file = options.scene.file;
    }
    if (!fresh.config.file.empty()) {
        std::error_code missing;
        if (std::filesystem::is_fifo(fresh.config.file, missing)) {
            throw UsageError(fresh.config.file + ": is a pipe, which cannot be read again");
        }
        apply_config_file(fresh.config.file, fresh);
    }
    return fresh;
}

std::string print_config(const Options& options) {
    Json json;
    json[scene_key] = options.scene.file;
    for (const OptionRow& option : option_table()) {
        json[option.key] =
            std::visit([&](const auto& field) { return to_json(field(options)); }, option.field);
    }
    if (const auto& jwt = options.network.jwt) {
        json[jwt_key] = {{"issuer", jwt->issuer},          {"audience", jwt->audience},
                         {"secretFile", jwt->secret_file}, {"keyFiles", jwt->key_files},
                         {"roleClaim", jwt->role_claim},   {"nameClaim", jwt->name_claim}};
    }
    json[tokens_key] = Json::array();
    for (const AccessToken& token : options.network.tokens) {
        json[tokens_key].push_back({{"name", token.name},
                                    {"role", v1::Role_Name(token.role)},
                                    {"sha256", to_hex(token.digest)}});
    }
    try {
        return json.dump(4) + "\n";
    } catch (const nlohmann::json::exception&) {
        throw UsageError("--print-config: an option holds text that is not UTF-8");
    }
}

std::string light_options(const Options& options) {
    Json json;
    for (const OptionRow& option : option_table()) {
        const std::string_view key = option.key;
        const bool elsewhere = key == "gpu" || key == "bundles" || key == "logLevel";
        if (key == "patchSize" || (option.common && !elsewhere)) {
            json[option.key] = std::visit(
                [&](const auto& field) { return to_json(field(options)); }, option.field);
        }
    }
    return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace raybundle
