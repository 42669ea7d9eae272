// SPDX-License-Identifier: Apache-2.0
#include "options/option_table.h"
#include "net/access/peer_name.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "scene/light/cie_sky.h"
#include "scene/medium.h"
#include "telemetry/http_url.h"

namespace raybundle {
namespace {

constexpr double no_limit = std::numeric_limits<double>::max();

template <std::size_t N>
std::string none_of(const std::string& text, const std::array<std::string_view, N>& choices) {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) {
        return {};
    }
    std::string names;
    for (const std::string_view choice : choices) {
        names += (names.empty() ? "" : ", ") + std::string(choice);
    }
    return "'" + text + "' is none of " + names;
}

std::string log_level_problem(const std::string& text) {
    return none_of<6>(text, {"trace", "debug", "info", "warn", "error", "off"});
}

std::string log_format_problem(const std::string& text) {
    return none_of<2>(text, {"text", "json"});
}

std::string bundles_problem(const std::string& text) {
    return none_of<3>(text, {"auto", "raster", "trace"});
}

std::string unit_problem(const std::string& text) {
    return none_of<5>(text, {"m", "cm", "mm", "in", "ft"});
}

std::string address_problem(const std::string& text) {
    try {
        parse_address(text);
        return {};
    } catch (const UsageError&) {
        return "'" + text + "' is not HOST:PORT, e.g. 127.0.0.1:8080";
    }
}

std::string redis_problem(const std::string& text) {
    return text.empty() ? "" : address_problem(text);
}

std::string project_problem(const std::string& text) {
    constexpr std::size_t max_letters = 64;
    const bool fits =
        text.size() <= max_letters && std::all_of(text.begin(), text.end(), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
                   c == '.';
        });
    return fits ? "" : "'" + text + "' is not a name of at most 64 letters, digits, -, _ and .";
}

std::string otlp_problem(const std::string& text) {
    const bool fits = text.empty() || parse_http_url(text).has_value();
    return fits ? "" : "'" + text + "' is not an address as http://127.0.0.1:4318";
}

std::string ies_problem(const std::string& text) {
    const std::size_t equals = text.find('=');
    const bool fits = equals != std::string::npos && equals > 0 && equals + 1 < text.size();
    return fits ? "" : "'" + text + "' is not LIGHT=FILE, e.g. downlight=spot.ies";
}

std::string origin_problem(const std::string& text) {
    const std::size_t scheme = text.starts_with("https://") ? 8 : 7;
    const bool fits = (text.starts_with("http://") || text.starts_with("https://")) &&
                      text.size() > scheme && text.find('/', scheme) == std::string::npos;
    return fits ? "" : "'" + text + "' is not an origin, e.g. https://example.org";
}

std::string proxy_problem(const std::string& text) {
    return is_address(text) ? "" : "'" + text + "' is not a numeric address, e.g. 127.0.0.1";
}

std::string sky_problem(const std::string& text) {
    if (text.empty() || cie_sky_type(text) != 0) {
        return {};
    }
    const auto luminance = SkyChoice{text}.luminance();
    if (!luminance) {
        return fmt::format("'{}' is neither a luminance in cd/m² nor one of {}", text,
                           cie_sky_names());
    }
    return *luminance >= 0.0F ? "" : "must be a number of at least 0";
}

constexpr std::array serve_table{
    OptionRow{"listen", "Address and port; port 0: any free one",
              field<&Options::network, &NetworkOptions::listen>(), 0, 0, address_problem},
    OptionRow{"addressFile", "File that gets the server's address once it listens, for port 0",
              field<&Options::network, &NetworkOptions::address_file>()},
    OptionRow{"allowRemote",
              "Listen beyond this machine, or stand behind a proxy that does, without tokens",
              field<&Options::network, &NetworkOptions::allow_remote>()},
    OptionRow{"tlsCert", "PEM certificate chain; the server then speaks https",
              field<&Options::network, &NetworkOptions::tls_cert>()},
    OptionRow{"tlsKey", "PEM private key, without passphrase",
              field<&Options::network, &NetworkOptions::tls_key>()},
    OptionRow{"allowedOrigins", "Origins of pages that may connect, besides the server's own",
              field<&Options::network, &NetworkOptions::allowed_origins>(), 0, 0, origin_problem},
    OptionRow{"trustedProxies", "Addresses of proxies whose X-Forwarded-For the log believes",
              field<&Options::network, &NetworkOptions::trusted_proxies>(), 0, 0, proxy_problem},
    OptionRow{"auditLog",
              "File that gets a JSON line for each connection, refusal, change and download",
              field<&Options::network, &NetworkOptions::audit_log>()},
    OptionRow{"maxViewers", "Viewers at a time",
              field<&Options::serve, &ServeOptions::max_viewers>(), 1, 1000},
    OptionRow{"minFramesPerSecond",
              "A viewer is refused where the others would get fewer (0: all "
              "get fewer instead)",
              field<&Options::serve, &ServeOptions::min_frames_per_second>(), 0, 60},
    OptionRow{"maxConnections", "Connections at a time, viewers and HTTP together",
              field<&Options::network, &NetworkOptions::max_connections>(), 1, 100000},
    OptionRow{"maxConnectionsPerAddress",
              "Connections of one address; this machine's own are not limited",
              field<&Options::network, &NetworkOptions::max_connections_per_address>(), 1, 100000},
    OptionRow{"maxMessagesPerSecond", "Messages of one viewer a second, on average",
              field<&Options::network, &NetworkOptions::max_messages_per_second>(), 1, 1e6},
    OptionRow{"journal",
              "File that keeps changes and pins over a restart (SQLite); none: nothing is kept; "
              "by default "
              "a file in ~/.local/state/raybundle, one for each scene",
              field<&Options::serve, &ServeOptions::journal>()},
    OptionRow{
        "redis",
        "HOST:PORT of a Redis that keeps changes and pins for several servers of one project, "
        "in place of a journal",
        field<&Options::serve, &ServeOptions::redis>(), 0, 0, redis_problem},
    OptionRow{"redisWait",
              "Replicas of it that must have a change before it is acknowledged (WAIT)",
              field<&Options::serve, &ServeOptions::redis_wait>(), 0, 100},
    OptionRow{"project", "Name of the project in Redis (default: by the scene file)",
              field<&Options::serve, &ServeOptions::project>(), 0, 0, project_problem},
    OptionRow{"watch", "Read the scene again when its file is replaced",
              field<&Options::serve, &ServeOptions::watch>()},
    OptionRow{"scenes", "Folder of .gltf and .glb files that editors may open",
              field<&Options::serve, &ServeOptions::scenes>()},
    OptionRow{"maxUploadMegabytes", "Of one scene that an editor adds to it (0: none may be)",
              field<&Options::serve, &ServeOptions::max_upload_megabytes>(), 0, 4000},
    OptionRow{"maxUploadSeconds", "Until all bytes of an upload have come",
              field<&Options::serve, &ServeOptions::max_upload_seconds>(), 0.1, 86400},
    OptionRow{"logFormat", "Log lines as text or as one JSON object each",
              field<&Options::log, &LogOptions::format>(), 0, 0, log_format_problem},
    OptionRow{"otlp",
              "Collector of OpenTelemetry that gets a trace of each change, e.g. "
              "http://127.0.0.1:4318 (OTLP over HTTP; default: OTEL_EXPORTER_OTLP_ENDPOINT)",
              field<&Options::serve, &ServeOptions::otlp>(), 0, 0, otlp_problem},
    OptionRow{"patchSize", "Target edge of the patches, m (0: about 25 000 patches)",
              field<&Options::scene, &SceneOptions::patch_size>(), 0, no_limit},
    OptionRow{"seed", "Of all random numbers", field<&Options::scene, &SceneOptions::seed>(), 0,
              no_limit},
    OptionRow{"gpu", "EGL device number, see --list-gpus (-1: the first usable one)",
              field<&Options::device, &DeviceOptions::gpu>(), -1, 1000, nullptr, true},
    OptionRow{"bundles",
              "What finds the surfaces that bundles and pictures see: raster, trace (rays on the "
              "processor), or auto, which is quicker",
              field<&Options::device, &DeviceOptions::bundles>(), 0, 0, bundles_problem, true},
    OptionRow{"unit", "Length unit of the scene file: m, cm, mm, in, ft",
              field<&Options::scene, &SceneOptions::unit>(), 0, 0, unit_problem, true},
    OptionRow{"sky",
              "Luminance of a uniform sky, cd/m², or a standard sky: overcast, intermediate, "
              "clear, cie-1 to cie-15",
              field<&Options::daylight, &DaylightOptions::sky>(), 0, no_limit, sky_problem, true},
    OptionRow{"skyZenith", "Luminance of a standard sky's zenith, cd/m² (default: typical)",
              field<&Options::daylight, &DaylightOptions::sky_zenith>(), 0, 1e9, nullptr, true},
    OptionRow{"sunElevation", "Of a standard sky's sun, degrees above the horizon (default: 45)",
              field<&Options::daylight, &DaylightOptions::sun_elevation>(), 0, 90, nullptr, true},
    OptionRow{"sunAzimuth", "From north (-Z) over east (+X), degrees (default: 180)",
              field<&Options::daylight, &DaylightOptions::sun_azimuth>(), -360, 360, nullptr, true},
    OptionRow{"sunIlluminance", "Of a surface that faces the sun, lx (default: typical; 0: none)",
              field<&Options::daylight, &DaylightOptions::sun_illuminance>(), 0, 1e9, nullptr,
              true},
    OptionRow{"sunDiameter", "Of the sun's disc, degrees (default: 0.533)",
              field<&Options::daylight, &DaylightOptions::sun_diameter>(), 0, 10, nullptr, true},
    OptionRow{"groundAlbedo", "Of the plain below a standard sky (default: 0.2)",
              field<&Options::daylight, &DaylightOptions::ground_albedo>(), 0, 1, nullptr, true},
    OptionRow{"environment", "Equirectangular image of the surroundings, .hdr or .exr",
              field<&Options::daylight, &DaylightOptions::environment>(), 0, 0, nullptr, true},
    OptionRow{"environmentRotation", "Clockwise as seen from above, degrees",
              field<&Options::daylight, &DaylightOptions::environment_rotation>(), -360, 360,
              nullptr, true},
    OptionRow{"environmentScale", "cd/m² of one unit of the image (default: 1)",
              field<&Options::daylight, &DaylightOptions::environment_scale>(), 0, 1e9, nullptr,
              true},
    OptionRow{"fog", "Air that scatters light: visibility, m (0: clear; default: as the file says)",
              field<&Options::air, &AirOptions::fog>(), 0, Medium::most_visibility, nullptr, true},
    OptionRow{"fogAlbedo", "Share of what it takes out of light that it scatters (default: 1)",
              field<&Options::air, &AirOptions::fog_albedo>(), 0, 1, nullptr, true},
    OptionRow{"fogAnisotropy",
              "Mean cosine of the deflection, Henyey and Greenstein's g (default: 0, evenly)",
              field<&Options::air, &AirOptions::fog_anisotropy>(), -Medium::most_anisotropy,
              Medium::most_anisotropy, nullptr, true},
    OptionRow{"ies", "LIGHT=FILE: photometry of a light, by its name, from an IES or EULUMDAT file",
              field<&Options::scene, &SceneOptions::ies>(), 0, 0, ies_problem, true},
    OptionRow{"logLevel", "trace, debug, info, warn, error, off",
              field<&Options::log, &LogOptions::level>(), 0, 0, log_level_problem, true},
};

std::string range_problem(const OptionRow& row, double value) {
    if (std::isfinite(value) && value >= row.min && value <= row.max) {
        return {};
    }
    return row.max == no_limit ? fmt::format("must be a number of at least {}", row.min)
                               : fmt::format("must be a number from {} to {}", row.min, row.max);
}

std::string value_problem(const OptionRow& row, const std::string& value) {
    return row.problem == nullptr ? "" : row.problem(value);
}

std::string value_problem(const OptionRow& row, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
        if (std::string problem = value_problem(row, value); !problem.empty()) {
            return problem;
        }
    }
    return {};
}

std::string value_problem(const OptionRow& row, const std::optional<float>& value) {
    return value ? range_problem(row, *value) : "";
}

std::string value_problem(const OptionRow& row, const SkyChoice& value) {
    return value_problem(row, value.text);
}

std::string value_problem(const OptionRow& /*row*/, bool /*value*/) {
    return {};
}

template <typename Number>
std::string value_problem(const OptionRow& row, const Number& value) {
    return range_problem(row, static_cast<double>(value));
}

}  // namespace

std::optional<float> SkyChoice::luminance() const {
    float value = 0.0F;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value);
    return number ? std::optional(value) : std::nullopt;
}

std::span<const OptionRow> option_table() {
    return serve_table;
}

std::string flag_of(std::string_view key) {
    std::string flag = "--";
    for (const char c : key) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isupper(byte) != 0) {
            flag += '-';
        }
        flag += static_cast<char>(std::tolower(byte));
    }
    return flag;
}

std::string problem_of(const OptionRow& row, const Options& options) {
    return std::visit([&](const auto& field) { return value_problem(row, field(options)); },
                      row.field);
}

}  // namespace raybundle
