// SPDX-License-Identifier: Apache-2.0
// usage: raybundle_change_coverage FOLDER [CASE ...]
// How often what a picture states of its error after a change holds, and how wide that is, beside
// the same of new solves: a table by time since the change. The true errors are those against path
// tracing. FOLDER: third-party scenes; cases whose file is not there are left out. Some minutes.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "changed_scene.h"
#include "gpu/egl_context.h"
#include "stated_error.h"

namespace raybundle {
namespace {

constexpr std::uint64_t iterations_before = 400;
/// Some 0.2, 0.5, 1 and 3 s on two cores.
const std::vector<std::uint64_t> after = {16, 32, 64, 192};

int seeds_asked() {
    const char* text = std::getenv("RAYBUNDLE_CHANGE_SEEDS");
    return text != nullptr ? std::max(std::atoi(text), 1) : 3;
}

std::vector<ChangeCase> third_party(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return (folder / name).string(); };
    ChangeCase bevy{.name = "bevy_small_move",
                    .file = file("bevy_cornell_box/CornellBox.glb"),
                    .before = {},
                    .changes = {{shift_by("small.box", {15.0F, 0.0F, 10.0F})}},
                    .eye = {-278.0F, 274.4F, 1121.0F},
                    .target = {-278.0F, 274.4F, -279.6F},
                    .field_of_view = 40.1F,
                    .patch_size = 40.0F};
    ChangeCase bevy_far = bevy;
    bevy_far.name = "bevy_box_out";
    bevy_far.changes = {{shift_by("small.box", {0.0F, 0.0F, 700.0F})}};
    ChangeCase nvpro{.name = "nvpro_small_move",
                     .file = file("nvpro_cornell_box/cornellBox.gltf"),
                     .before = {},
                     .changes = {{shift_by("sphere_instance", {0.4F, 0.0F, 0.3F})}},
                     .eye = {0.0F, 0.0F, 19.99F},
                     .target = {0.0F, 0.0F, 0.0F},
                     .field_of_view = 41.1F,
                     .patch_size = 0.7F};
    ChangeCase living{.name = "living_pole_moves",
                      .file = file("godot_living_room/living_room.glb"),
                      .before = {},
                      .changes = {{shift_by("Cylinder", {0.4F, 0.0F, 0.3F})}},
                      .eye = {3.575F, 2.6F, -1.36F},
                      .target = {2.961F, 2.6F, -0.5709F},
                      .field_of_view = 60.0F,
                      .patch_size = 0.6F};
    std::vector<ChangeCase> cases = {bevy, bevy_far, nvpro, living};
    std::erase_if(cases, [](const ChangeCase& c) { return !std::filesystem::exists(c.file); });
    return cases;
}

void print(const std::vector<StatedError>& stated, std::uint64_t at, const std::string& name) {
    const StatedSummary s = summary_of(stated);
    std::printf(
        "%-24s %4llu  true %7.2f %%  stated %7.2f %% [%6.2f, %6.2f]  covered %3u of %3u, above %3u "
        " "
        "high/true %5.2f  ln(true/stated) %+5.2f +- %4.2f  level %5.2f\n",
        name.c_str(), static_cast<unsigned long long>(at), 100.0 * s.error, 100.0 * s.stated,
        100.0 * s.low, 100.0 * s.high, s.covered, s.pictures, s.above, s.high_over_error,
        s.log_mean, s.log_deviation, s.level);
    std::fflush(stdout);
}

/// Pictures by their samples since the change, in the order of `after`.
using ByTime = std::vector<std::vector<StatedError>>;

void print(const ByTime& stated, const std::string& name) {
    for (std::size_t k = 0; k < after.size(); ++k) {
        print(stated[k], after[k], name);
    }
}

void judge(const KnownPicture& truth, const std::vector<Served>& run, ByTime& of_case,
           ByTime& of_all) {
    for (std::size_t k = 0; k < after.size(); ++k) {
        of_case[k].push_back(truth.judge(run[k]));
        if (truth.light() > 0.0) {
            of_all[k].push_back(of_case[k].back());
        }
    }
}

int run(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: raybundle_change_coverage FOLDER [CASE ...]\n", stderr);
        return 2;
    }
    spdlog::set_level(spdlog::level::err);
    const EglContext context = create_egl_context();
    std::vector<ChangeCase> cases = change_cases();
    const std::vector<ChangeCase> more = third_party(argv[1]);
    cases.insert(cases.end(), more.begin(), more.end());
    ByTime all_changed(after.size()), all_anew(after.size());
    std::set<double> solved;  // several cases end with the same scene
    for (ChangeCase& c : cases) {
        if (argc > 2 && std::find(argv + 2, argv + argc, c.name) == argv + argc) {
            continue;
        }
        c.picture = 48;
        const KnownPicture truth(c);
        std::printf("%s: reference noise %.2f %%, %.3g cd/m2\n", c.name.c_str(),
                    100.0 * truth.noise(), truth.light());
        ByTime changed(after.size()), anew(after.size());
        for (int seed = 1; seed <= seeds_asked(); ++seed) {
            const auto s = static_cast<std::uint64_t>(seed);
            judge(truth, change_and_solve(c, s, iterations_before, after), changed, all_changed);
            if (!solved.contains(truth.light())) {
                judge(truth, solve_anew(c, s, after), anew, all_anew);
            }
        }
        print(changed, c.name);
        if (solved.insert(truth.light()).second) {
            print(anew, c.name + ", anew");
        }
    }
    print(all_changed, "all");
    print(all_anew, "all, anew");
    return 0;
}

}  // namespace
}  // namespace raybundle

int main(int argc, char** argv) {
    return raybundle::run(argc, argv);
}
