// SPDX-License-Identifier: Apache-2.0
#include "scene/object_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace raybundle {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::array<std::string_view, 16> door_words = {
    "door",  "doors",  "doorleaf", "tür",     "türe",  "türblatt",      "tuer", "tuere",
    "porte", "portes", "puerta",   "puertas", "porta", "porte-fenêtre", "deur", "deuren"};
/// Compounds end so: "Haustür", "Zimmertuer", "frontdoor".
constexpr std::array<std::string_view, 4> door_endings = {"tür", "tuer", "door", "deur"};
constexpr std::array<std::string_view, 2> no_doors = {"indoor", "outdoor"};

constexpr std::array<std::string_view, 62> structure_words = {
    "wall",    "walls",   "wallstandardcase", "curtainwall", "slab",        "slabs",   "roof",
    "floor",   "floors",  "ceiling",          "ceilings",    "column",      "columns", "beam",
    "beams",   "stair",   "stairs",           "staircase",   "stairflight", "ramp",    "foundation",
    "footing", "facade",  "covering",         "plate",       "building",    "ground",  "terrain",
    "site",    "window",  "windows",          "wand",        "wände",       "waende",  "decke",
    "dach",    "boden",   "fußboden",         "fussboden",   "stütze",      "stuetze", "treppe",
    "fassade", "gelände", "fenster",          "mur",         "murs",        "dalle",   "toit",
    "plafond", "sol",     "escalier",         "pared",       "muro",        "suelo",   "techo",
    "losa",    "parete",  "pavimento",        "soffitto",    "muur",        "vloer"};
/// Compounds end so, too: "Trennwand", "Außenwände".
constexpr std::array<std::string_view, 5> structure_endings = {"wand", "wände", "waende",
                                                               "partition", "partitions"};
constexpr std::array<std::string_view, 10> no_structure = {
    "leinwand",  "gewand",     "schrankwand", "wohnwand",  "rückwand",
    "rueckwand", "seitenwand", "pinnwand",    "stellwand", "fotowand"};

constexpr std::array<std::string_view, 41> thing_words = {
    "lamp",    "lamps",   "light",     "lights",  "lighting", "luminaire", "sconce",
    "leuchte", "lampe",   "lampada",   "lampara", "rug",      "mat",       "carpet",
    "teppich", "tapis",   "clock",     "uhr",     "picture",  "bild",      "mirror",
    "spiegel", "art",     "poster",    "cabinet", "schrank",  "shelf",     "regal",
    "unit",    "switch",  "socket",    "chair",   "stuhl",    "table",     "tisch",
    "plant",   "pflanze", "plant pot", "fan",     "radiator", "furniture"};

/// What comes behind one of these says where something is, not what: "wall left of the door".
constexpr std::array<std::string_view, 22> place_words = {
    "of",    "at",    "by",   "near", "beside", "behind", "above", "over",
    "under", "below", "next", "with", "neben",  "hinter", "vor",   "über",
    "unter", "bei",   "mit",  "am",   "an",     "zu"};

/// Letters of UTF-8 are all bytes above 127, whatever they are.
bool is_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 128 || std::isalpha(byte) != 0;
}

bool is_upper(char c) {
    return c >= 'A' && c <= 'Z';
}

/// Lower case, Ä, Ö and Ü too.
std::string lowered(std::string word) {
    for (std::size_t i = 0; i < word.size(); ++i) {
        const auto byte = static_cast<unsigned char>(word[i]);
        if (is_upper(word[i])) {
            word[i] = static_cast<char>(byte + 32);
        } else if (byte == 0xc3 && i + 1 < word.size()) {
            const auto next = static_cast<unsigned char>(word[i + 1]);
            if (next >= 0x80 && next <= 0x9e) {
                word[i + 1] = static_cast<char>(next + 0x20);
            }
        }
    }
    return word;
}

/// The words of a name, in lower case: also of CamelCase; IFC's classes without "Ifc".
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words;
    std::string word;
    const auto end = [&] {
        std::string text = lowered(word);
        if (text.size() > 3 && text.starts_with("ifc")) {
            text.erase(0, 3);
        }
        if (!text.empty() && text != "ifc") {
            words.push_back(text);
        }
        word.clear();
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (!is_letter(name[i])) {
            end();
            continue;
        }
        const bool hump =
            !word.empty() && is_upper(name[i]) && word.back() >= 'a' && word.back() <= 'z';
        if (hump && word != "Ifc") {
            end();
        }
        word += name[i];
    }
    end();
    return words;
}

bool among(const std::string& word, Words words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_door(const std::string& word) {
    return among(word, door_words) ||
           (!among(word, no_doors) &&
            std::any_of(door_endings.begin(), door_endings.end(),
                        [&](std::string_view ending) { return word.ends_with(ending); }));
}

bool is_structure(const std::string& word) {
    return among(word, structure_words) ||
           (!among(word, no_structure) &&
            std::any_of(structure_endings.begin(), structure_endings.end(),
                        [&](std::string_view ending) { return word.ends_with(ending); }));
}

/// Whether a name is that of a door, not of what stands beside one.
bool names_door(const std::vector<std::string>& words) {
    const auto place =
        std::find_if(words.begin() + (words.empty() ? 0 : 1), words.end(),
                     [](const std::string& word) { return among(word, place_words); });
    return std::any_of(words.begin(), place, is_door);
}

bool is_global_id(std::string_view text) {
    return text.size() == 22 && text.front() >= '0' && text.front() <= '3' &&
           std::all_of(text.begin(), text.end(), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
           });
}

bool is_uuid(std::string_view text) {
    if (text.size() != 36) {
        return false;
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
        if (dash ? text[i] != '-' : std::isxdigit(static_cast<unsigned char>(text[i])) == 0) {
            return false;
        }
    }
    return true;
}

std::string_view bare(std::string_view name) {
    constexpr std::string_view before = "product-";
    constexpr std::string_view after = "-body";
    if (name.starts_with(before)) {
        name.remove_prefix(before.size());
    }
    if (name.ends_with(after)) {
        name.remove_suffix(after.size());
    }
    return name;
}

/// "IfcWallStandardCase/Wall 3" -> "Wall 3"; "IfcWall" -> "Wall".
std::string without_class(const std::string& name) {
    const std::size_t slash = name.find('/');
    if (name.starts_with("Ifc") && slash != std::string::npos && slash + 1 < name.size()) {
        return name.substr(slash + 1);
    }
    return name.size() > 3 && name.starts_with("Ifc") && is_upper(name[3]) ? name.substr(3) : name;
}

bool is_storey(const std::string& name) {
    constexpr std::array<std::string_view, 22> words = {"storey",
                                                        "story",
                                                        "level",
                                                        "floor",
                                                        "buildingstorey",
                                                        "geschoss",
                                                        "geschoß",
                                                        "etage",
                                                        "stockwerk",
                                                        "eg",
                                                        "og",
                                                        "ug",
                                                        "dg",
                                                        "kg",
                                                        "erdgeschoss",
                                                        "obergeschoss",
                                                        "untergeschoss",
                                                        "dachgeschoss",
                                                        "keller",
                                                        "basement",
                                                        "planta",
                                                        "piano"};
    const std::vector<std::string> own = words_of(name);
    const auto names_one = [&](const std::string& word) {
        return among(word, words) || word.ends_with("geschoss");
    };
    return std::any_of(own.begin(), own.end(), names_one);
}

}  // namespace

ObjectKind kind_of_names(std::span<const std::string> names) {
    ObjectKind kind = ObjectKind::thing;
    for (const std::string& name : names) {
        const std::vector<std::string> words = words_of(name);
        const auto any = [&](const auto& test) {
            return std::any_of(words.begin(), words.end(), test);
        };
        if (any([](const std::string& word) { return among(word, thing_words); })) {
            continue;
        }
        if (names_door(words)) {
            return ObjectKind::door;
        }
        if (any(is_structure)) {
            kind = ObjectKind::structure;
        }
    }
    return kind;
}

bool is_identifier(std::string_view name) {
    const std::string_view core = bare(name);
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return is_global_id(core) || is_uuid(core) ||
           (!core.empty() && std::all_of(core.begin(), core.end(), digit));
}

std::string storey_of(std::span<const std::string> path) {
    for (std::size_t i = path.size(); i-- > 0;) {
        if (is_storey(path[i])) {
            return without_class(path[i]);
        }
    }
    return {};
}

std::string readable_name(const std::string& name, std::span<const std::string> others,
                          std::span<const std::string> path) {
    if (!is_identifier(name)) {
        return without_class(name);
    }
    const auto found = std::find_if(others.begin(), others.end(), [](const std::string& other) {
        return !other.empty() && !is_identifier(other);
    });
    if (found == others.end()) {
        return name;
    }
    std::string text = without_class(*found);
    const std::string storey = storey_of(path);
    if (!storey.empty()) {
        text += ", " + storey;
    }
    return text + ", " + std::string(bare(name).substr(0, 8));
}

}  // namespace raybundle
