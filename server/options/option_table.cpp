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
    ServeOption{"listen", "Address and port; port 0: any free one", &Options::listen, 0, 0,
                address_problem},
    ServeOption{"allowRemote", "Listen beyond this machine without tokens", &Options::allow_remote},
    ServeOption{"tlsCert", "PEM certificate chain; the server then speaks https",
                &Options::tls_cert},
    ServeOption{"tlsKey", "PEM private key, without passphrase", &Options::tls_key},
    ServeOption{"allowedOrigins", "Origins of pages that may connect, besides the server's own",
                &Options::allowed_origins, 0, 0, origin_problem},
    ServeOption{"trustedProxies", "Addresses of proxies whose X-Forwarded-For the log believes",
                &Options::trusted_proxies, 0, 0, proxy_problem},
    ServeOption{"maxViewers", "Viewers at a time", &Options::max_viewers, 1, 1000},
    ServeOption{"minFramesPerSecond",
                "A viewer is refused where the others would get fewer (0: all "
                "get fewer instead)",
                &Options::min_frames_per_second, 0, 60},
    ServeOption{"maxConnections", "Connections at a time, viewers and HTTP together",
                &Options::max_connections, 1, 100000},
    ServeOption{"maxConnectionsPerAddress",
                "Connections of one address; this machine's own are not limited",
                &Options::max_connections_per_address, 1, 100000},
    ServeOption{"maxMessagesPerSecond", "Messages of one viewer a second, on average",
                &Options::max_messages_per_second, 1, 1e6},
    ServeOption{"journal",
                "File that keeps changes and pins over a restart (SQLite); none: nothing is kept; "
                "by default "
                "a file in ~/.local/state/raybundle, one for each scene",
                &Options::journal},
    ServeOption{"watch", "Read the scene again when its file is replaced", &Options::watch},
    ServeOption{"scenes", "Folder of .gltf and .glb files that editors may open", &Options::scenes},
    ServeOption{"maxUploadMegabytes", "Of one scene that an editor adds to it (0: none may be)",
                &Options::max_upload_megabytes, 0, 4000},
    ServeOption{"maxUploadSeconds", "Until all bytes of an upload have come",
                &Options::max_upload_seconds, 0.1, 86400},
    ServeOption{"logFormat", "Log lines as text or as one JSON object each", &Options::log_format,
                0, 0, log_format_problem},
    ServeOption{"patchSize", "Target edge of the patches, m (0: about 25 000 patches)",
                &Options::patch_size, 0, no_limit},
    ServeOption{"seed", "Of all random numbers", &Options::seed, 0, no_limit},
    ServeOption{"gpu", "EGL device number, see --list-gpus (-1: the first usable one)",
                &Options::gpu, -1, 1000, nullptr, true},
    ServeOption{"bundles",
                "What finds the surfaces that bundles and pictures see: raster, trace (rays on the "
                "processor), or auto, which is quicker",
                &Options::bundles, 0, 0, bundles_problem, true},
    ServeOption{"unit", "Length unit of the scene file: m, cm, mm, in, ft", &Options::unit, 0, 0,
                unit_problem, true},
    ServeOption{"sky",
                "Luminance of a uniform sky, cd/m², or a standard sky: overcast, intermediate, "
                "clear, cie-1 to cie-15",
                &Options::sky, 0, no_limit, sky_problem, true},
    ServeOption{"skyZenith", "Luminance of a standard sky's zenith, cd/m² (default: typical)",
                &Options::sky_zenith, 0, 1e9, nullptr, true},
    ServeOption{"sunElevation", "Of a standard sky's sun, degrees above the horizon (default: 45)",
                &Options::sun_elevation, 0, 90, nullptr, true},
    ServeOption{"sunAzimuth", "From north (-Z) over east (+X), degrees (default: 180)",
                &Options::sun_azimuth, -360, 360, nullptr, true},
    ServeOption{"sunIlluminance", "Of a surface that faces the sun, lx (default: typical; 0: none)",
                &Options::sun_illuminance, 0, 1e9, nullptr, true},
    ServeOption{"sunDiameter", "Of the sun's disc, degrees (default: 0.533)",
                &Options::sun_diameter, 0, 10, nullptr, true},
    ServeOption{"groundAlbedo", "Of the plain below a standard sky (default: 0.2)",
                &Options::ground_albedo, 0, 1, nullptr, true},
    ServeOption{"environment", "Equirectangular image of the surroundings, .hdr or .exr",
                &Options::environment, 0, 0, nullptr, true},
    ServeOption{"environmentRotation", "Clockwise as seen from above, degrees",
                &Options::environment_rotation, -360, 360, nullptr, true},
    ServeOption{"environmentScale", "cd/m² of one unit of the image (default: 1)",
                &Options::environment_scale, 0, 1e9, nullptr, true},
    ServeOption{"ies", "LIGHT=FILE: photometry of a light, by its name, from an IES file",
                &Options::ies, 0, 0, ies_problem, true},
    ServeOption{"logLevel", "trace, debug, info, warn, error, off", &Options::log_level, 0, 0,
                log_level_problem, true},
};

std::string range_problem(const ServeOption& option, double value) {
    if (std::isfinite(value) && value >= option.min && value <= option.max) {
        return {};
    }
    return option.max == no_limit
               ? fmt::format("must be a number of at least {}", option.min)
               : fmt::format("must be a number from {} to {}", option.min, option.max);
}

std::string value_problem(const ServeOption& option, const std::string& value) {
    return option.problem == nullptr ? "" : option.problem(value);
}

std::string value_problem(const ServeOption& option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
        if (std::string problem = value_problem(option, value); !problem.empty()) {
            return problem;
        }
    }
    return {};
}

std::string value_problem(const ServeOption& option, const std::optional<float>& value) {
    return value ? range_problem(option, *value) : "";
}

std::string value_problem(const ServeOption& option, const SkyChoice& value) {
    return value_problem(option, value.text);
}

std::string value_problem(const ServeOption& /*option*/, bool /*value*/) {
    return {};
}

template <typename Number>
std::string value_problem(const ServeOption& option, const Number& value) {
    return range_problem(option, static_cast<double>(value));
}

}  // namespace

std::optional<float> SkyChoice::luminance() const {
    float value = 0.0F;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value);
    return number ? std::optional(value) : std::nullopt;
}

std::span<const ServeOption> serve_options() {
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

std::string problem_of(const ServeOption& option, const Options& options) {
    return std::visit([&](const auto member) { return value_problem(option, options.*member); },
                      option.member);
}

}  // namespace raybundle
