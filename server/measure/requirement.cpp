// SPDX-License-Identifier: Apache-2.0
#include "measure/requirement.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace raybundle {
namespace {

Verdict at_least(const Interval& found, double least) {
    if (found.low >= least) {
        return Verdict::met;
    }
    return found.high < least ? Verdict::missed : Verdict::unknown;
}

Verdict at_most(std::span<const GlareRating> ratings, double most) {
    const std::optional<GlareRange> range = range_of(ratings);
    if (range && range->maximum.low > most) {
        return Verdict::missed;
    }
    Verdict verdict = ratings.empty() ? Verdict::unknown : Verdict::met;
    for (const GlareRating& rating : ratings) {
        const bool rated = rating.state == GlareRating::State::rated;
        const bool holds =
            rated ? rating.value.high <= most : rating.state == GlareRating::State::no_source;
        verdict = holds ? verdict : Verdict::unknown;
    }
    return verdict;
}

/// Names in the order in which they come, each once with its number: "panel (12), spot".
std::string listed(std::span<const std::string> names) {
    constexpr std::size_t most = 3;
    std::vector<std::pair<std::string, int>> counted;
    for (const std::string& name : names) {
        const auto known = std::find_if(counted.begin(), counted.end(),
                                        [&](const auto& one) { return one.first == name; });
        if (known == counted.end()) {
            counted.emplace_back(name, 1);
        } else {
            ++known->second;
        }
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(counted.size(), most); ++i) {
        const auto& [name, count] = counted[i];
        text += (text.empty() ? "" : ", ") + name +
                (count > 1 ? fmt::format(" ({} of them)", count) : "");
    }
    return text + (counted.size() > most ? fmt::format(" and {} more", counted.size() - most) : "");
}

Check check_colour_rendering(double least, std::span<const ZoneLuminaire> luminaires) {
    Check check{"Ra", least, false, Verdict::unknown, "", false};
    std::vector<std::string> short_of;
    std::vector<std::string> silent;
    std::vector<std::string> vague;
    for (const ZoneLuminaire& luminaire : luminaires) {
        const std::string name = luminaire.name.empty() ? "a lamp without a name" : luminaire.name;
        const std::optional<ColourRendering>& known = luminaire.colour_rendering;
        if (!known) {
            silent.push_back(name);
        } else if (static_cast<double>(known->most) < least) {
            short_of.push_back(name + " has Ra " + text_of(known));
        } else if (static_cast<double>(known->least) < least) {
            vague.push_back(name + " has Ra " + text_of(known));
        }
    }
    const auto add = [&check](const std::vector<std::string>& names, const char* before) {
        check.words +=
            names.empty() ? "" : (check.words.empty() ? "" : "; ") + (before + listed(names));
    };
    add(short_of, "");
    add(vague, "");
    add(silent, "not stated by ");
    if (luminaires.empty()) {
        check.words = "no luminaire lights it";
    } else if (!short_of.empty()) {
        check.verdict = Verdict::missed;
    } else if (vague.empty() && silent.empty()) {
        check.verdict = Verdict::met;
    }
    return check;
}

const char* symbol_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::vertical:
            return "Ev";
        case Quantity::cylindrical:
            return "Ez";
        case Quantity::semicylindrical:
            return "Esz";
        case Quantity::daylight_factor:
            return "D";
        case Quantity::ugr:
            return "UGR";
        case Quantity::dgp:
            return "DGP";
        default:
            return "Em";
    }
}

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::met:
            return "met";
        case Verdict::missed:
            return "missed";
        default:
            return "not yet known";
    }
}

std::vector<Check> check(const Requirement& requirement, Quantity quantity,
                         const std::optional<MeasurementSummary>& found,
                         std::span<const GlareRating> ratings,
                         std::span<const ZoneLuminaire> luminaires) {
    std::vector<Check> checks;
    if (is_glare(quantity)) {
        if (requirement.most) {
            checks.push_back({symbol_of(quantity), *requirement.most, true,
                              at_most(ratings, *requirement.most)});
        }
        return checks;
    }
    if (requirement.mean) {
        checks.push_back({symbol_of(quantity), *requirement.mean, false,
                          found ? at_least(found->mean, *requirement.mean) : Verdict::unknown});
    }
    if (requirement.uniformity) {
        checks.push_back(
            {"Uo", *requirement.uniformity, false,
             found ? at_least(found->uniformity, *requirement.uniformity) : Verdict::unknown});
    }
    if (requirement.colour_rendering) {
        checks.push_back(
            found ? check_colour_rendering(*requirement.colour_rendering, luminaires)
                  : Check{"Ra", *requirement.colour_rendering, false, Verdict::unknown, "", false});
    }
    return checks;
}

Verdict verdict_of(std::span<const Check> checks) {
    const auto has = [&](Verdict verdict) {
        return std::any_of(checks.begin(), checks.end(),
                           [verdict](const Check& one) { return one.verdict == verdict; });
    };
    return has(Verdict::missed)    ? Verdict::missed
           : has(Verdict::unknown) ? Verdict::unknown
                                   : Verdict::met;
}

}  // namespace raybundle
