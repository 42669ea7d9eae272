// SPDX-License-Identifier: Apache-2.0
#include "view/viewer_image.h"

#include <algorithm>
#include <bit>
#include <string>

#include "gpu/gl_limits.h"

namespace raybundle {

namespace {

constexpr float near_share = 1e-4F;         // of the scene's diameter
constexpr float moving_kept_weight = 0.9F;  // of a reprojected value per camera change

}  // namespace

ViewerImage::ViewerImage(const GpuScene& scene, const RadianceStore& store,
                         const ViewPrograms& programs, glm::uvec2 size)
    : scene_(scene),
      store_(store),
      programs_(programs),
      full_size_(glm::max(size, glm::uvec2(1))),
      pixels_(scene, store, programs, full_size_),
      composer_(full_size_),
      error_(scene) {
    if (programs.continued) {
        specular_view_.emplace(scene, store, *programs.continued);
    }
    if (ShownLuminaires::possible(scene)) {
        luminaires_.emplace();
    }
    surfaces_.emplace(scene, programs, full_size_);
    edges_.emplace(full_size_);
}

/// Room for a picture of another size, of which nothing is known but its pixels.
void ViewerImage::allocate(glm::uvec2 size) {
    full_size_ = size;
    surfaces_.emplace(scene_, programs_, size);
    edges_.emplace(size);
    composer_.allocate(size);
}

float ViewerImage::near_distance() const {
    return std::max(near_share * scene_.diameter(), camera_.near);
}

VisibleSurfaces::Look ViewerImage::look() const {
    return {pixels_.view(), camera_.hidden, grid_, near_distance()};
}

void ViewerImage::set_view(const Camera& camera, glm::uvec2 size) {
    if (glm::max(size, glm::uvec2(1)) == full_size_) {
        set_camera(camera, full_size_);
    } else {
        restart(camera, size);
    }
}

void ViewerImage::restart(const Camera& camera, glm::uvec2 size) {
    size = glm::max(size, glm::uvec2(1));
    grid_ = 1;
    if (size != full_size_) {
        allocate(size);
        pixels_.allocate(size);
    }
    pixels_.set_size(size);
    camera_ = camera;
    error_.forget();
    pixels_.forget_confidence();
    refresh_geometry(0.0F);
}

void ViewerImage::set_camera(const Camera& camera, glm::uvec2 size) {
    camera_ = camera;
    pixels_.set_size(glm::clamp(size, glm::uvec2(1), full_size_));
    refresh_geometry(moving_kept_weight);
}

void ViewerImage::refine(unsigned factor) {
    grid_ *= factor;
    allocate(full_size_ * factor);
    pixels_.refine(factor, [&] { refresh_geometry(1.0F); });
}

bool ViewerImage::smooth_step() {
    if (!pixels_.has_picture() || size() != full_size_ || edges_->complete()) {
        return false;
    }
    surfaces_->see_shifted(look(), edges_->next_offset());
    pixels_.bind_with_solution();
    surfaces_->bind();
    edges_->count(programs_.edges);
    return !edges_->complete();
}

/// moved_objects: the picture still shows them at their old places.
void ViewerImage::refresh_geometry(float kept_weight, Shows shows) {
    pixels_.look_from(camera_, full_size_, grid_, near_distance());
    if (specular_view_) {
        specular_view_->refresh(pixels_.view(), camera_, near_distance(), kept_weight);
    }
    look_into_air();
    pixels_.upload_view();
    surfaces_->see(look(), whole_picture(pixels_.view()));
    bind_surroundings();
    pixels_.renew(*surfaces_, kept_weight, shows);
    error_.restart();
    edges_->restart();
}

/// The camera rests, and objects are elsewhere: only where they are and were the picture differs,
/// and all other pixels keep what they have to the bit.
void ViewerImage::refresh_moved() {
    pixels_.restart_samples();
    error_.restart();
    if (specular_view_) {
        specular_view_->refresh(pixels_.view(), camera_, near_distance(), 1.0F);
    }
    const PixelRectangle rectangle = rectangle_of(scene_.moved_bounds(), pixels_.view());
    if (rectangle.empty()) {
        return;
    }
    pixels_.upload_view();
    surfaces_->see(look(), rectangle);
    bind_surroundings();
    pixels_.renew_moved(*surfaces_, rectangle);
    edges_->restart();
}

/// The air before the pixels of another view.
void ViewerImage::look_into_air() {
    if (store_.air() == nullptr) {
        return;
    }
    if (!air_) {
        air_.emplace();
    }
    air_->begin(pixels_.view(), glm::max(size() / grid_, glm::uvec2(1)), grid_);
    see_air();
}

/// What shows a picture finds some air in it.
void ViewerImage::see_air() {
    if (air_ && air_->empty(*store_.air())) {
        air_->refine(*store_.air(), scene_.radiance_unit());
    }
}

/// The lights' bodies as they are now, for what is made of the pixels next.
void ViewerImage::see_luminaires() {
    if (luminaires_ && store_.first_shot() != nullptr) {
        constexpr unsigned still = 4;  // 16 rays, as many as edges have sub-samples
        constexpr unsigned moving = 2;
        const unsigned rays = grid_ > 1 ? 1 : edges_->complete() ? still : moving;
        luminaires_->update(scene_, *store_.first_shot(), {camera_, near_distance(), rays});
        luminaires_->bind();
    }
}

/// What the pixels show that is not theirs: of mirrors, glass and air.
void ViewerImage::bind_surroundings() const {
    if (specular_view_) {
        specular_view_->bind();
    }
    if (air_) {
        air_->bind();
    }
}

/// The present light of all that the pixels show; for what is made of them next.
void ViewerImage::light_pixels() {
    see_luminaires();
    if (specular_view_) {
        specular_view_->shade();
    }
    see_air();
    bind_surroundings();
    pixels_.light_vertices();
}

void ViewerImage::begin_sample() {
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->begin_sample();
    }
    if (air_ && air_samples_++ % GROUP_SIZE == 0) {
        air_->refine(*store_.air(), scene_.radiance_unit());
    }
    bind_surroundings();
    pixels_.begin_sample();
}

void ViewerImage::receive_hemicube(const Context& context) {
    pixels_.receive_hemicube(context);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->receive_hemicube(context);
    }
}

void ViewerImage::receive_layers(const Context& context) {
    pixels_.receive_layers(context);
    if (behind_mirrors() != nullptr) {
        if (pixels_.rests()) {
            behind_mirrors()->rest();
        }
        behind_mirrors()->receive_layers(context);
    }
}

void ViewerImage::receive_planes(const Context& context) {
    pixels_.receive_planes(context);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->receive_planes(context);
    }
}

void ViewerImage::receive_opening(const Context& context) {
    pixels_.receive_opening(context);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->receive_opening(context);
    }
}

void ViewerImage::discard_sample(const Context& context) {
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->discard_sample(context);
    }
    pixels_.discard_sample(context);
}

void ViewerImage::complete_start() {
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->complete_start();
    }
    pixels_.complete_start();
}

void ViewerImage::begin_moves() {
    pixels_.take_back_shot(true, FirstShot::Reach::moves);
}

void ViewerImage::begin_lights() {
    pixels_.take_back_shot(true, FirstShot::Reach::lamps);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->take_back_shot(true, FirstShot::Reach::lamps);
    }
}

/// What was known of the error was of another scene.
void ViewerImage::begin_change() {
    pixels_.begin_change();
    error_.begin_change();
}

void ViewerImage::begin_special() {
    begin_change();
    if (pixels_.has_picture() && store_.first_shot() == nullptr) {
        refresh_moved();
    } else {
        refresh_geometry(store_.kept_share(pixels_.view().weights.x), Shows::moved_objects);
    }
    pixels_.clear_increments();
}

void ViewerImage::plan_differences(std::span<const BundleRays> bundles,
                                   std::span<const Bounds> boxes) {
    pixels_.plan_differences(bundles, boxes);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->plan_differences(bundles, boxes);
    }
}

void ViewerImage::begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                                 bool redraw) {
    begin_change();
    if (redraw) {
        refresh_geometry(1.0F, Shows::same_surfaces);
    }
    pixels_.begin_surfaces(scale, reflecting, redraw);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->begin_change();
        behind_mirrors()->begin_surfaces(scale, reflecting, false);
    }
}

void ViewerImage::scale_special(float factor) {
    pixels_.scale_special(factor);
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->scale_special(factor);
    }
}

void ViewerImage::end_special(float bundles_noise, float most_weight) {
    pixels_.end_special(bundles_noise, most_weight);
    error_.restart();
    if (behind_mirrors() != nullptr) {
        behind_mirrors()->end_special(bundles_noise, most_weight);
    }
}

void ViewerImage::compose(DisplayMode mode, float exposure, glm::uvec2 frame_size,
                          const ColourScale& scale) {
    light_pixels();
    composer_.compose(scene_, programs_, pixels_, *edges_,
                      {mode, exposure, scale, false, camera_.near > 0.0F}, frame_size);
    check_picture();
}

/// Throws GlError where the driver has refused a command that the picture depends on.
void ViewerImage::check_picture() const {
    check_gl_errors("making a picture of " + std::to_string(size().x) + "x" +
                    std::to_string(size().y));
}

void ViewerImage::request_depths(std::uint32_t columns) {
    composer_.request_depths(programs_.depths, surfaces_->depths(), size(), columns,
                             near_distance());
}

std::vector<glm::vec4> ViewerImage::read_radiance() {
    light_pixels();
    pixels_.set_display({scene_.radiance_unit(), 1.0F, 0.0F, 0.0F});
    Buffer linear("linear frame", pixel_count(size()) * sizeof(glm::vec4));
    pixels_.write_radiance(linear);
    if (edges_->complete()) {
        linear = edges_->average_linear(programs_.edges, linear);
    }
    std::vector<glm::vec4> result(pixel_count(size()));
    linear.read<glm::vec4>(result);
    check_picture();
    for (glm::vec4& pixel : result) {
        pixel.w = 1.0F;  // less where luminaires are seen
    }
    return result;
}

std::vector<std::optional<PixelProbe>> ViewerImage::probe(std::span<const glm::uvec2> pixels) {
    std::vector<layout::PickResult> picks(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::uvec2 pixel = glm::min(pixels[i], size() - 1U);
        picks[i].position.x = std::bit_cast<float>((size().y - 1 - pixel.y) * size().x + pixel.x);
    }
    light_pixels();
    pixels_.set_display({scene_.radiance_unit(), 1.0F, 0.0F, 0.0F});
    auto buffer = Buffer::from<layout::PickResult>("probes", picks);
    buffer.bind_storage(BINDING_PICK);
    programs_.probe.set("triangle_count", scene_.triangle_count());
    programs_.probe.set("error_before", static_cast<float>(error_.error_before()));
    programs_.probe.set("variance_of_mean", static_cast<float>(variance_of_mean(
                                                pixels_.scatter_samples(), sample_order())));
    programs_.probe.dispatch(pixels.size());
    buffer.read<layout::PickResult>(picks);
    check_picture();
    std::vector<std::optional<PixelProbe>> found(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (picks[i].position.w > 0.0F) {
            found[i] = from_pick(picks[i], scene_);
        }
    }
    return found;
}

void ViewerImage::request_statistics() {
    const auto sum = [&](PixelAccumulator& pixels) {
        pixels.set_display({scene_.radiance_unit(), 1.0F, 0.0F, 0.0F});
        pixels.sum_statistics(error_.error_before());
    };
    see_luminaires();
    if (PixelAccumulator* const behind = behind_mirrors(); behind != nullptr) {
        behind->light_vertices();
        sum(*behind);
        behind->sums().request(behind->scatter_samples());
    }
    light_pixels();
    sum(pixels_);
    if (pixels_.sums().detail_due(pixels_.scatter_samples())) {
        measure_detail();
    }
    pixels_.sums().request(pixels_.scatter_samples());
}

/// What is finer than the pixels.
void ViewerImage::measure_detail() {
    const Buffer unsmoothed("pixels not smoothed", pixel_count(size()) * sizeof(glm::vec4));
    pixels_.write_radiance(unsmoothed);
    const Buffer smoothed =
        edges_->complete() ? edges_->average_linear(programs_.edges, unsmoothed) : Buffer();
    unsmoothed.bind_storage(BINDING_FRAME);
    (edges_->complete() ? smoothed : unsmoothed).bind_storage(BINDING_SMOOTHED);
    PixelSums::run(programs_.detail);
    pixels_.sums().note_detail(pixels_.scatter_samples());
}

const ImageStatistics& ViewerImage::statistics() {
    if (pixels_.sums().ready()) {
        finish_statistics();
    }
    return error_.statistics();
}

void ViewerImage::finish_statistics() {
    PixelSums::Sums sums = pixels_.sums().take();
    if (behind_mirrors() != nullptr) {
        const PixelSums::Sums behind = behind_mirrors()->sums().take();
        sums.light += behind.light;
        sums.drift += behind.drift;
        sums.difference += behind.difference;
        sums.batches += behind.batches;
    }
    error_.evaluate(
        sums, {pixels_.sums().requested_samples(), sample_order(), grid_, pixels_.keeps_light()},
        pixels_.sums().batches());
}

std::size_t ViewerImage::bytes() const {
    constexpr std::size_t surface_and_depth = 8;
    return surface_and_depth * pixel_count(full_size_) + pixels_.bytes() + edges_->bytes() +
           composer_.bytes() + (specular_view_ ? specular_view_->bytes() : 0) +
           (air_ ? air_->bytes() : 0) + (luminaires_ ? luminaires_->bytes() : 0);
}

}  // namespace raybundle
