// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "net/access/access_tokens.h"
#include "research/reference_method.h"
#include "transport/strategy_probabilities.h"

namespace CLI {
class App;
}

namespace raybundle {

/// Exit statuses of the program; scripts depend on them.
enum ExitStatus : int {
    exit_done = 0,
    exit_failed = 1,  ///< selftest failed, or output not writable
    exit_usage = 2,
    exit_scene_rejected = 3,
    exit_no_gpu = 4,
    exit_requirement_missed = 5,   ///< measure --require: some true value is too low
    exit_requirement_unknown = 6,  ///< an interval holds the required value
};

/// A command line that cannot be understood. Exit status 2.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What --sky says: nothing, a luminance or the name of a standard sky. A number in a configuration
/// file is a luminance too.
struct SkyChoice {
    std::string text;

    [[nodiscard]] std::optional<float> luminance() const;  ///< cd/m², of a uniform sky
};

// What each option means, with its unit and range: option_table.cpp (for `serve`, and what all
// commands know) and cli_options.cpp.

/// Where light is computed.
struct DeviceOptions {
    int gpu = -1;
    std::string bundles = "auto";
    bool list_gpus = false;
};

struct SceneOptions {
    std::string file;
    std::string unit = "m";
    float patch_size = 0.0F;  ///< m, 0: about 25 000 patches
    std::uint64_t seed = 1;
    std::vector<std::string> ies;  ///< LIGHT=FILE
};

struct DaylightOptions {
    SkyChoice sky;
    std::optional<float> sky_zenith, sun_elevation, sun_azimuth, sun_illuminance, sun_diameter;
    std::optional<float> ground_albedo;
    std::string environment;  ///< file
    std::optional<float> environment_rotation, environment_scale;
};

/// Air between the surfaces; nothing: as the file says.
struct AirOptions {
    std::optional<float> fog;             ///< visibility, m; 0: clear
    std::optional<float> fog_albedo;      ///< 0..1
    std::optional<float> fog_anisotropy;  ///< g of Henyey and Greenstein
};

struct LogOptions {
    std::string level = "info";
    std::string format = "text";
};

struct ConfigOptions {
    std::string file;
    std::set<std::string> on_command_line;  ///< keys that the file does not override
    bool print = false;
};

/// Whose JSON Web Tokens open a server; see JwtSettings.
struct JwtOptions {
    std::string issuer, audience;
    std::string secret_file;             ///< of HS256
    std::vector<std::string> key_files;  ///< PEM, of RS256
    std::string role_claim = "raybundle_role";
    std::string name_claim = "name";
};

/// Who may connect to a server, and how.
struct NetworkOptions {
    std::string listen = "127.0.0.1:8080";
    std::string address_file;  ///< empty: none
    std::string tls_cert, tls_key;
    std::vector<std::string> allowed_origins;
    std::vector<std::string> trusted_proxies;
    std::string audit_log;            ///< file; empty: none
    std::vector<AccessToken> tokens;  ///< from the configuration file only
    std::optional<JwtOptions> jwt;    ///< likewise
    double max_messages_per_second = 1000.0;
    int max_connections = 256;
    int max_connections_per_address = 32;
    bool allow_remote = false;
};

/// What a server does for its viewers.
struct ServeOptions {
    std::string journal;  ///< file, "none", or empty: one of the user's folder
    std::string redis;    ///< HOST:PORT, in place of a journal; empty: none
    int redis_wait = 0;   ///< replicas that must have each change
    std::string project;  ///< its name there; empty: by the scene file
    /// From the configuration file or the environment only.
    std::string redis_user, redis_password;
    std::string scenes;  ///< folder
    std::string otlp;    ///< URL of a collector of traces; empty: as the environment says
    double min_frames_per_second = 0.0;
    int max_viewers = 64;
    int max_upload_megabytes = 256;
    double max_upload_seconds = 600.0;
    bool watch = false;
};

struct TokenOptions {
    std::string name;
    std::string role = "VIEWER";
};

/// Many projects behind one address; what their file can say besides: projects_file.h.
struct ProjectsOptions {
    std::string source;  ///< configuration file, or a folder of scenes
    std::string state;   ///< folder of journals and pictures; empty: one of the user's
    double sleep_after_s = 60.0;
    int memory_megabytes = 0;  ///< of all projects together; 0: no limit
};

struct CameraOptions {
    std::string name;  ///< or index
    std::string eye, target;
    float fov = 40.0F;  ///< degrees
};

/// When a solve ends.
struct StopOptions {
    std::optional<double> seconds;
    std::optional<std::uint64_t> iterations;
    std::optional<double> error;
};

struct OutputOptions {
    std::string file;  ///< of accuracy and export a folder
    std::string json_file;
};

struct RenderOptions {
    std::string size = "800x600";
    std::string method = "combined";
    std::uint64_t bias_for_noise = 0;  ///< iterations planned
    bool constant_radiance = false;
    bool random_faces = false;
    bool patches = false;
    std::string shares, first_shares;  ///< P1,P2,P3; empty: as the light asks for
    unsigned planes_per_direction = 1;
    std::string roulette;  ///< of paths; empty: by throughput
    std::string stats;     ///< file
    std::string script;    ///< file
};

struct BenchOptions {
    bool changes = false;  ///< nothing else
};

struct ExportOptions {
    bool force = false;
};

struct AccuracyOptions {
    std::string size = "128x128";
    std::string methods;  ///< between commas; empty: all that solve the whole transport
    std::string reference;
    std::optional<double> reference_seconds;
    std::size_t repeats = 1;
    bool knobs = false;
    bool early = false;
};

struct InspectOptions {
    bool costs = false;
    bool json_to_stdout = false;
    std::string contact_sheet;  ///< file
    std::string effect;
};

struct MeasureOptions {
    std::vector<std::string> plane;  ///< corner and two edges, each x,y,z in metres
    std::vector<std::string> points;
    std::vector<std::string> outline;  ///< corners, likewise
    double surrounding = 0.0;          ///< m
    std::uint32_t directions = 0;      ///< of glare
    bool small_sources = false;
    bool maintained = false;
    std::string quantity = "HORIZONTAL";
    std::string direction;
    std::string grid = "EN12464";
    double margin = 0.0;  ///< m
    bool direct = false;
    std::optional<double> maintenance;
    std::string require;  ///< Em, Em/Uo or Em/Uo/Ra; of glare the most
    bool json_to_stdout = false;
};

struct SelftestOptions {
    bool photometry = false;
};

/// Everything the command line can say.
struct Options {
    enum class Command {
        none,
        serve,
        work,
        projects,
        render,
        export_scene,
        save,
        accuracy,
        inspect,
        bench,
        measure,
        selftest,
        token
    };
    Command command = Command::none;

    // All commands but token.
    DeviceOptions device;
    SceneOptions scene;
    DaylightOptions daylight;
    AirOptions air;
    LogOptions log;

    // serve; of these work has config and what is said of Redis
    ConfigOptions config;
    NetworkOptions network;
    ServeOptions serve;

    ProjectsOptions projects;  // with network and log

    CameraOptions camera;  // render, export, accuracy
    StopOptions stop;      // render, export, accuracy, inspect, bench, measure
    OutputOptions output;  // render, export, save, accuracy, bench, selftest
    RenderOptions render;
    BenchOptions bench;
    ExportOptions export_scene;
    AccuracyOptions accuracy;
    InspectOptions inspect;
    MeasureOptions measure;
    SelftestOptions selftest;
    TokenOptions token;
};

/// Parses the command line into options, and for `serve` the configuration file under it. Tables:
/// option_table.cpp for `serve` and what all commands know, the .cpp file for the rest. Parsing
/// throws CLI::ParseError (help and version included), which app.exit() turns into text, and
/// UsageError.
void define_options(CLI::App& app, Options& options);

/// "800x600" -> (800, 600). Throws UsageError.
glm::uvec2 parse_size(const std::string& text);
/// "1,2.5,-3" -> vector. Throws UsageError naming the option.
glm::vec3 parse_vector(const std::string& option, const std::string& text);
/// "127.0.0.1:8080" or "[::1]:8080" -> host and port. Throws UsageError.
std::pair<std::string, std::uint16_t> parse_address(const std::string& text);
/// Metres of one unit of length: m, cm, mm, in, ft. Throws UsageError.
float metres_per_unit(const std::string& unit);
/// What a --method stands for: probabilities of the ray-bundle strategies, or a reference method.
using RenderMethod = std::variant<StrategyProbabilities, ReferenceKind>;
/// Throws UsageError.
RenderMethod parse_method(const std::string& method);
/// All that --method can be, in the order of the one table.
std::vector<std::string> method_names();

}  // namespace raybundle
