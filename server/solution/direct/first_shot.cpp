// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/first_shot.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"
#include "solution/direct/many_lamps.h"

namespace raybundle {

namespace {

constexpr float tie_share = 4e-6F;  // of the scene's diameter: closer surfaces coincide
/// Rays to lights that one invocation follows. llvmpipe ends an invocation's loops after 65 535
/// rounds, all loops together: 4000 boxes a ray are left.
constexpr unsigned most_rays = SHOT_LIGHTS;

/// Share of the maps that a change may reach: taking back and adding costs twice.
constexpr double most_touched = 0.5;

/// For a bit of each light.
unsigned mask_words(std::size_t lights) {
    return static_cast<unsigned>((lights + 31) / 32);
}

bool same_place(const layout::PunctualData& a, const layout::PunctualData& b) {
    return a.position == b.position && a.axis_x == b.axis_x && a.axis_y == b.axis_y &&
           a.axis_z == b.axis_z && a.map == b.map;
}

/// Parts along an edge of a patch: many patches are small ones, and many lights average over what
/// each of them misses.
unsigned divisions_of(std::uint32_t patches, std::size_t lights) {
    constexpr std::uint32_t many_patches = 100'000;
    constexpr std::size_t many_pairs = 160'000;
    return patches < many_patches && patches * lights < many_pairs ? 4 : 2;
}

/// A profile at the directions of shaders/solution/first_shot.glsl, cd.
void append_table(const IesProfile& profile, std::vector<float>& values) {
    for (int column = 0; column < IES_COLUMNS; ++column) {
        const double phi = glm::radians(2.5 * column);
        for (int row = 0; row < IES_ROWS; ++row) {
            const double theta = glm::radians(0.5 * row);
            const double across = std::sin(theta);
            values.push_back(static_cast<float>(profile.candela(
                {across * std::cos(phi), across * std::sin(phi), -std::cos(theta)})));
        }
    }
}

}  // namespace

FirstShot::FirstShot(const GpuScene& scene)
    : scene_(scene),
      ies_(profiles_of(scene.punctual_lights())),
      lights_("punctual lights", scene.punctual_lights().size() * sizeof(layout::PunctualData)),
      patches_("first shot", 2 * std::size_t{scene.patch_count()} * sizeof(glm::vec4)) {
    patches_.clear();
    upload_profiles();
    if (scene.many_lamps()) {
        many_ = std::make_unique<ManyLamps>(scene);
    } else {
        maps_.emplace(scene);
        rest_ = Buffer("first shot rest", patches_.bytes());
        rest_.clear();
        masks_ = Buffer("first shot masks", sizeof(std::uint32_t) * scene.patch_count() *
                                                mask_words(scene.punctual_lights().size()));
        shoot_ = ShaderProgram({"solution_first_shot.comp"}, scene.defines());
        shoot_.set("moved_objects", glm::uvec4(NO_PATCH));
        shoot_.set("renewed_material", NO_PATCH);
    }
}

FirstShot::~FirstShot() = default;
FirstShot::FirstShot(FirstShot&&) noexcept = default;

void FirstShot::upload_profiles() {
    std::vector<float> tables;
    for (const auto& profile : ies_) {
        append_table(*profile, tables);
    }
    if (!tables.empty()) {
        check_storage("ies profiles", tables.size() * sizeof(float));
        profiles_ = Buffer::from<float>("ies profiles", tables);
    }
}

/// Those of lights that have been added, or exchanged theirs. The others keep their numbers.
void FirstShot::add_profiles() {
    const std::size_t known = ies_.size();
    for (const auto& profile : profiles_of(scene_.punctual_lights())) {
        if (std::find(ies_.begin(), ies_.end(), profile) == ies_.end()) {
            ies_.push_back(profile);
        }
    }
    if (ies_.size() > known) {
        upload_profiles();
    }
}

void FirstShot::remember(const FirstShot& other) {
    if (remembered_.bytes() == 0) {
        remembered_ = Buffer("first shot before", patches_.bytes());
    }
    glCopyNamedBufferSubData(other.patches_.get(), remembered_.get(), 0, 0,
                             static_cast<GLsizeiptr>(patches_.bytes()));
}

void FirstShot::remember_darkness() {
    if (remembered_.bytes() == 0) {
        remembered_ = Buffer("first shot before", patches_.bytes());
    }
    remembered_.clear();
}

void FirstShot::update(bool radiance_follows, std::span<const std::uint32_t> reflecting) {
    add_profiles();
    if (many_) {
        bind();
        many_->update(lights_, ies_, radiance_follows);
        return;
    }
    bind();
    reflecting_.assign(reflecting.begin(), reflecting.end());
    shoot_.set("radiance_follows", radiance_follows);
    Lights now = maps_->placed(ies_);
    const float tie = tie_share * scene_.diameter();
    const bool first = tie != tie_ || known_.empty();
    const bool same = !first && unit_ == scene_.radiance_unit() && !scene_.openings_changed();
    const bool moves = reach_ == Reach::moves;
    if (!same || !begun_ || (moves && !others_stay(now))) {
        reach_ = Reach::everything;
    }
    const bool all_maps = first || scene_.openings_changed() || !begun_lights_ ||
                          (moves && reach_ == Reach::everything);
    begun_ = begun_lights_ = false;
    tie_ = tie;
    unit_ = scene_.radiance_unit();
    ++version_;
    for (std::size_t k = 0; k < now.size(); ++k) {
        if (reach_ == Reach::everything) {
            touch_all(now[k]);
        } else {
            std::copy_n(known_[k].touched, std::size(now[k].touched), now[k].touched);
            now[k].touched_cone = known_[k].touched_cone;
        }
    }
    known_.swap(now);
    draw_maps(reach_ == Reach::moves || all_maps, now);
    lights_.write<layout::PunctualData>(known_, 0);
    end_change(radiance_follows);
}

/// What is touched of all maps, or else of those of lights that have another place.
void FirstShot::draw_maps(bool all, const Lights& before) {
    if (all) {
        maps_->draw(known_);
    } else {
        Lights elsewhere = known_;
        for (std::size_t k = 0; k < known_.size(); ++k) {
            if (same_place(before[k], known_[k])) {
                touch_nothing(elsewhere[k]);
            }
        }
        maps_->draw(elsewhere);
    }
    bind();
}

/// Lamps that differ are touched, and their light is taken back, by the maps of where they were;
/// everything, where that is less work.
void FirstShot::begin_lights() {
    if (many_ || known_.empty()) {
        return;
    }
    begun_ = begun_lights_ = true;
    add_profiles();
    bind();
    const Lights now = maps_->placed(ies_);
    for (std::size_t k = 0; k < known_.size(); ++k) {
        const bool same = same_place(known_[k], now[k]) &&
                          known_[k].intensity == now[k].intensity &&
                          known_[k].profile == now[k].profile;
        same ? touch_nothing(known_[k]) : touch_all(known_[k]);
    }
    reach_ = touched_share(known_) > most_touched ? Reach::everything : Reach::lamps;
    if (reach_ == Reach::lamps) {
        shoot_.set("radiance_follows", false);
        lights_.write<layout::PunctualData>(known_, 0);
        shoot_patches(SHOT_TAKE_BACK, false);
    }
}

/// Of lamps that move along everything, of the others what their maps show of the objects.
void FirstShot::touch_moves(std::span<const ObjectMove> moves) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
        layout::PunctualData& light = known_[k];
        const int carrier = scene_.punctual_lights()[k].object;
        const bool carried = std::any_of(moves.begin(), moves.end(), [&](const ObjectMove& move) {
            return carrier == static_cast<int>(move.object);
        });
        if (carried) {
            touch_all(light);
            continue;
        }
        for (unsigned face = 0; face < light.map.y; ++face) {
            MapTexels texels;
            for (const ObjectMove& move : moves) {
                texels.add(
                    maps_->showing(light, face, scene_.object_bounds(move.object, Place::now)));
                texels.add(maps_->showing(light, face, scene_.bounds_moved(move)));
            }
            set_touched(light, face, texels);
        }
        enclose_touched(light);
    }
}

void FirstShot::begin_moves(std::span<const ObjectMove> moves) {
    if (many_ || known_.empty()) {
        return;
    }
    begun_ = true;
    touch_moves(moves);
    reach_ = touched_share(known_) > most_touched ? Reach::everything : Reach::moves;
    if (reach_ == Reach::moves) {
        bind();
        glm::uvec4 objects(NO_PATCH);
        for (std::size_t i = 0; i < moves.size(); ++i) {
            objects[static_cast<int>(i)] = moves[i].object;
        }
        shoot_.set("moved_objects", objects);
        shoot_.set("radiance_follows", true);
        lights_.write<layout::PunctualData>(known_, 0);
        shoot_patches(SHOT_FIND, false);
        shoot_patches(SHOT_TAKE_BACK, false);
        shoot_.set("moved_objects", glm::uvec4(NO_PATCH));
    }
}

/// Whether all lamps that do not move along are where they were. The sun's map is placed by the
/// bounds of the scene.
bool FirstShot::others_stay(const Lights& now) const {
    for (std::size_t k = 0; k < now.size(); ++k) {
        const bool whole = touched_share(std::span(&known_[k], 1)) == 1.0;
        if (!whole && !same_place(known_[k], now[k])) {
            return false;
        }
    }
    return true;
}

/// Adds what has been taken back, as it is now.
void FirstShot::end_change(bool radiance_follows) {
    if (reach_ == Reach::everything) {
        shoot_patches(SHOT_ALL, true);
        return;
    }
    const glm::uvec4 moved = reach_ == Reach::moves ? scene_.moved_objects() : glm::uvec4(NO_PATCH);
    shoot_.set("moved_objects", moved);
    shoot_patches(SHOT_ADD, true);
    if (reach_ == Reach::moves) {
        shoot_patches(SHOT_RENEW, radiance_follows);
        shoot_.set("moved_objects", glm::uvec4(NO_PATCH));
    }
    for (const std::uint32_t material : reflecting_) {
        shoot_.set("renewed_material", material);
        shoot_patches(SHOT_RENEW, true);
        shoot_.set("renewed_material", NO_PATCH);
    }
}

void FirstShot::shoot_patches(unsigned pass, bool ends) {
    const GlScope scope("first shot");
    const unsigned divisions = divisions_of(scene_.patch_count(), scene_.punctual_lights().size());
    set_uniforms(shoot_);
    rest_.bind_storage(BINDING_FIRST_SHOT_REST);
    masks_.bind_storage(BINDING_SHOT_MASKS);
    shoot_.set("mask_words", mask_words(known_.size()));
    shoot_.set("whole_lights", reach_ != Reach::moves);
    shoot_.set("patch_count", scene_.patch_count());
    shoot_.set("divisions", divisions);
    const auto lights = static_cast<unsigned>(known_.size());
    shoot(shoot_, pass, scene_.patch_count(),
          pass == SHOT_FIND ? lights : most_rays / (divisions * divisions), ends);
}

void FirstShot::shoot(const ShaderProgram& program, unsigned pass, std::size_t threads) const {
    shoot(program, pass, threads, most_rays, true);
}

void FirstShot::shoot(const ShaderProgram& program, unsigned pass, std::size_t threads,
                      unsigned most_lights, bool ends) const {
    const bool whole = pass != SHOT_TAKE_BACK && pass != SHOT_ADD;
    const auto lights = static_cast<unsigned>(known_.size());
    std::vector<glm::uvec2> ranges;
    for (unsigned first = 0; first < lights;) {
        if (!whole && !is_touched(known_[first])) {
            ++first;
            continue;
        }
        unsigned end = first + 1;
        while (end < std::min(first + most_lights, lights) && (whole || is_touched(known_[end]))) {
            ++end;
        }
        ranges.emplace_back(first, end);
        first = end;
    }
    program.set("shot_pass", pass);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        program.set("first_light", ranges[i].x);
        program.set("end_light", ranges[i].y);
        glm::vec4 cones[SHOT_LIGHTS] = {};
        glm::vec4 places[SHOT_LIGHTS] = {};
        for (unsigned k = ranges[i].x; k < std::min(ranges[i].y, ranges[i].x + SHOT_LIGHTS); ++k) {
            cones[k - ranges[i].x] = known_[k].touched_cone;
            places[k - ranges[i].x] = known_[k].position;
        }
        program.set("touched_cones", std::span<const glm::vec4>(cones));
        program.set("light_places", std::span<const glm::vec4>(places));
        program.set("begins", i == 0);
        program.set("ends", ends && i + 1 == ranges.size());
        program.dispatch(threads);
    }
}

void FirstShot::bind() const {
    if (maps_) {
        maps_->bind();
    } else {
        many_->bind();
    }
    lights_.bind_storage(BINDING_PUNCTUAL);
    patches_.bind_storage(BINDING_FIRST_SHOT);
    if (profiles_.bytes() > 0) {
        profiles_.bind_storage(BINDING_IES);
    }
}

std::optional<std::uint32_t> FirstShot::profile_number(const IesProfile* profile) const {
    for (std::size_t i = 0; i < ies_.size(); ++i) {
        if (ies_[i].get() == profile) {
            return static_cast<std::uint32_t>(i);
        }
    }
    return std::nullopt;
}

void FirstShot::set_uniforms(const ShaderProgram& program) const {
    program.set("punctual_count", static_cast<unsigned>(scene_.punctual_lights().size()));
    program.set("shadow_tie", many_ ? tie_share * scene_.diameter() : tie_);
}

std::vector<glm::vec3> FirstShot::read_irradiance() const {
    std::vector<glm::vec4> values(2 * std::size_t{scene_.patch_count()});
    patches_.read<glm::vec4>(values);
    std::vector<glm::vec3> irradiance;
    irradiance.reserve(scene_.patch_count());
    for (std::size_t i = 0; i < values.size(); i += 2) {
        irradiance.emplace_back(values[i]);
    }
    return irradiance;
}

glm::vec3 FirstShot::read_irradiance(std::uint32_t patch) const {
    glm::vec4 value(0.0F);
    patches_.read<glm::vec4>(std::span(&value, 1), 2 * sizeof(glm::vec4) * patch);
    return glm::vec3(value);
}

std::vector<glm::vec4> FirstShot::read_reflected() const {
    std::vector<glm::vec4> values(2 * std::size_t{scene_.patch_count()});
    patches_.read<glm::vec4>(values);
    std::vector<glm::vec4> reflected;
    reflected.reserve(scene_.patch_count());
    for (std::size_t i = 1; i < values.size(); i += 2) {
        reflected.push_back(values[i]);
    }
    return reflected;
}

std::size_t FirstShot::bytes() const {
    return (maps_ ? maps_->bytes() : many_->bytes()) + lights_.bytes() + patches_.bytes() +
           profiles_.bytes() + remembered_.bytes() + rest_.bytes() + masks_.bytes();
}

}  // namespace raybundle
