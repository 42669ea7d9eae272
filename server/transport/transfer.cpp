// SPDX-License-Identifier: Apache-2.0
#include "transport/transfer.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "gpu/egl_context.h"

namespace raybundle {

namespace {

// Pixels of a row that one invocation sums.
constexpr unsigned hemicube_run = 8;  // run_length of transport_hemicube_patches.comp

/// The same in parallel bundles. Few and long runs share the work of finding a surface's patch;
/// a GPU wants many invocations (H100, Cornell box, 800-pixel window: 2.2 ms with 32
/// pixels, 0.2 with 2).
unsigned parallel_run() {
    return is_software_renderer() ? 32 : 2;
}

/// Program of a parallel bundle whose invocations sum `run` pixels each.
ShaderProgram parallel_program(const std::string& file, const GpuScene& scene, unsigned run,
                               unsigned longest_list = 0, bool sorted = false) {
    std::vector<std::string> defines = scene.defines();
    if (sorted) {
        defines.emplace_back("SORTED 1");
    }
    defines.push_back("RUN_LENGTH " + std::to_string(run));
    defines.push_back("LONGEST_LIST " + std::to_string(longest_list));
    return ShaderProgram({file}, defines);
}

/// Pixels that one invocation sorts and sums where lists may be so long. llvmpipe ends an
/// invocation's loops after 65 535 rounds, all loops together.
unsigned layered_run(std::uint32_t longest_list) {
    constexpr unsigned most_rounds = 50'000;
    const unsigned rounds = longest_list * (longest_list / 2 + 8);  // insertion sort, exchange
    unsigned run = parallel_run();
    while (run > 1 && run * rounds > most_rounds) {
        run /= 2;
    }
    return run;
}

/// Lists that a program has room for: few sizes, since each takes time to compile, on a GPU
/// seconds.
std::uint32_t longest_list(std::uint32_t capacity) {
    if (!is_software_renderer()) {
        return std::bit_ceil(std::max(capacity, 64U));
    }
    constexpr std::uint32_t grain = 16;
    return (capacity + grain - 1) / grain * grain;
}

/// Patches are summed over every row_stride-th pixel row: unbiased, since the phase is drawn at
/// random, and the noise that it adds is below that of the choice of the bundle (Cornell box,
/// 512x512, 300 iterations, 8 seeds: relRMSE 4.4, 3.7, 4.3 % for 2, 4, 8). The few bundles of a
/// special phase sample more.
constexpr unsigned row_stride = 4;
constexpr unsigned special_row_stride = 2;

std::size_t square(int size) {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
}

glm::ivec4 to_vector(const PixelRectangle& r) {
    return {r.x0, r.y0, r.x1, r.y1};
}

/// Which pixel rows from first_row on a transfer samples: those that it would sample of the whole
/// picture too. Returns how many of `rows`, at most.
unsigned set_rows(const ShaderProgram& program, int first_row, int rows,
                  const TransferSettings& settings) {
    const unsigned stride = settings.context.special ? special_row_stride : row_stride;
    const auto phase = static_cast<unsigned>(settings.row_phase * stride);
    program.set("row_stride", stride);
    program.set("row_phase", (phase + stride - static_cast<unsigned>(first_row) % stride) % stride);
    return (static_cast<unsigned>(rows) + stride - 1) / stride;
}

}  // namespace

Transfer::Transfer(const GpuScene& scene, const RadianceStore& store,
                   const BundleResolution& resolution)
    : scene_(scene),
      store_(store),
      hemicube_(resolution.hemicube, scene.defines(),
                scene.traces(SeenAs::hemicube, 3 * square(resolution.hemicube))),
      layers_(resolution.window, scene.defines(),
              scene.traces(SeenAs::layers, square(resolution.window))),
      parameters_("bundle parameters", sizeof(layout::BundleParameters)),
      hemicube_patches_({"transport_hemicube_patches.comp"}, scene.defines()),
      hemicube_patches_coloured_({"transport_hemicube_patches.comp"},
                                 with(scene.defines(), "COLOURED 1")),
      layers_patches_(layered_patches(longest_list(layers_.capacity()))),
      openings_("openings to the sky", sizeof(layout::OpeningParameters)),
      no_openings_("no openings", sizeof(layout::OpeningParameters)),
      sheltered_("sheltered patches", (scene.patch_count() + 31) / 32 * sizeof(std::uint32_t)) {
    const layout::OpeningParameters none{};
    openings_.write(std::span(&none, 1), 0);
    no_openings_.write(std::span(&none, 1), 0);
    if (scene.reflectance().any_glossy()) {
        hemicube_patches_glossy_ = ShaderProgram({"transport_hemicube_patches.comp"},
                                                 with(scene.defines(), "SHOOTER_GLOSSY 1"));
    }
}

Transfer::LayeredPatches Transfer::layered_patches(std::uint32_t longest_list) const {
    if (layers_.in_order()) {
        return {std::numeric_limits<std::uint32_t>::max(), parallel_run(),
                parallel_program("transport_layers_patches.comp", scene_, parallel_run(), 0, true)};
    }
    const unsigned run = layered_run(longest_list);
    return {longest_list, run,
            parallel_program("transport_layers_patches.comp", scene_, run, longest_list)};
}

ParallelWindow Transfer::parallel_window(const IterationSample& sample) const {
    ParallelWindow window =
        make_parallel_window(layers_.size(), sample.direction, static_cast<float>(sample.angle),
                             sample.shift, scene_.bounds().centre(), scene_.diameter());
    window.plane_depth = static_cast<float>(sample.plane) * window.depth;
    return window;
}

layout::BundleParameters Transfer::common_parameters(const BundleFrame& frame,
                                                     const TransferSettings& settings) const {
    constexpr float two_pi = glm::two_pi<float>();
    layout::BundleParameters p{};
    p.origin = glm::vec4(frame.origin, static_cast<float>(NEAR_SHARE) * scene_.diameter());
    p.axis_x = glm::vec4(frame.x, 0.0F);
    p.axis_y = glm::vec4(frame.y, 0.0F);
    p.axis_z = glm::vec4(frame.z, 0.0F);
    p.densities = {settings.probabilities.layered / two_pi,
                   settings.probabilities.plane / (two_pi * parallel_depth(scene_.diameter())),
                   settings.probabilities.perspective, 0.0F};
    p.densities *= settings.density_error;
    const auto sky = [&](const glm::vec3& direction) {
        return settings.sky == SkyTransfer::whole    ? scene_.sky_towards(direction)
               : settings.sky == SkyTransfer::change ? scene_.sky_change_towards(direction)
                                                     : glm::vec3(0.0F);
    };
    p.sky = glm::vec4(sky(frame.z) - settings.constant,
                      static_cast<float>(TIE_SHARE) * scene_.diameter());
    p.sky_behind = glm::vec4(sky(-frame.z) - settings.constant, 0.0F);
    p.constant = glm::vec4(settings.constant, settings.face_weights[0]);
    p.side_weights = {settings.face_weights[1], settings.face_weights[2], settings.face_weights[3],
                      settings.face_weights[4]};
    p.weights = {settings.weight, settings.context.sample_weight, 0.0F, 0.0F};
    p.slopes.w = store_.sends_slopes() ? 1.0F : 0.0F;
    p.resolution.w = static_cast<unsigned>(settings.context.place);
    p.moved = scene_.moved_objects();
    for (int k = 0; k < MOST_MOVED && p.moved[k] != NO_PATCH; ++k) {
        p.before_from_now[k] = glm::transpose(scene_.now_from_before(p.moved[k]));
    }
    return p;
}

void Transfer::upload(const layout::BundleParameters& parameters, bool special) {
    parameters_.write(std::span(&parameters, 1), 0);
    parameters_.bind_uniform(BINDING_BUNDLE);
    (special ? no_openings_ : openings_).bind_uniform(BINDING_OPENINGS);
    if (!special) {
        sheltered_.bind_storage(BINDING_SHELTERED);
    }
}

/// Pixel rows of one face, or of all as one stacked picture whose row first_row it begins at.
void Transfer::transfer_rows(const ShaderProgram& patches, const PixelRectangle& rectangle,
                             int first_row, const TransferSettings& settings) const {
    const PixelRectangle& r = rectangle;
    const auto columns = static_cast<unsigned>(r.width() + hemicube_run - 1) / hemicube_run;
    patches.set("first_column", static_cast<unsigned>(r.x0));
    patches.set("last_column", static_cast<unsigned>(r.x1));
    patches.set("first_row", static_cast<unsigned>(first_row + r.y0));
    patches.set("run_columns", columns);
    patches.set("rows", static_cast<unsigned>(r.height()));
    const unsigned sampled = set_rows(patches, first_row + r.y0, r.height(), settings);
    patches.dispatch(std::size_t{columns} * ((sampled + 7) / 8 * 8));
}

void Transfer::perspective(const BundleFrame& frame, const layout::Shooter& shooter,
                           const Hemicube::FaceRectangles& rectangles,
                           const TransferSettings& settings,
                           std::span<BundleReceiver* const> receivers) {
    const Place place = settings.context.place;
    store_.bind();
    layout::BundleParameters p = common_parameters(frame, settings);
    p.densities.w = shooter.density;
    p.slopes = glm::vec4(glm::vec3(shooter.weights), p.slopes.w);
    p.axis_z.w = shooter.probability;
    p.weights.z = 2.0F * glm::pi<float>() * settings.noise_horizon;
    p.axis_x.w = frame.pixel_shift.x;
    p.axis_y.w = frame.pixel_shift.y;
    p.resolution.x = p.resolution.y = static_cast<unsigned>(hemicube_.size());
    p.resolution.z = shooter.patch_id;
    for (std::size_t face = 0; face < rectangles.size(); ++face) {
        p.scissor[face] = to_vector(rectangles[face]);
    }
    upload(p, settings.context.special);
    hemicube_.draw(scene_, frame, p.origin.w, place, rectangles);
    hemicube_.bind_textures();

    const ShaderProgram& patches = shooter.glossy != 0 ? hemicube_patches_glossy_
                                   : settings.coloured ? hemicube_patches_coloured_
                                                       : hemicube_patches_;
    set_bases(patches, place);
    const bool whole = !settings.context.special && settings.face_weights == all_faces;
    if (whole) {  // all faces are one stacked picture
        transfer_rows(patches, {0, 0, hemicube_.size(), 3 * hemicube_.size()}, 0, settings);
    } else {
        for (int face = 0; face < Hemicube::face_count; ++face) {
            const PixelRectangle& r = rectangles[static_cast<std::size_t>(face)];
            if (!r.empty()) {
                transfer_rows(patches, r, hemicube_.first_row(face), settings);
            }
        }
    }
    BundleReceiver::Context context = settings.context;
    context.glossy_shooter = shooter.glossy != 0;
    for (BundleReceiver* receiver : receivers) {
        receiver->receive_hemicube(context);
    }
}

void Transfer::set_openings(const SkyOpenings& found, const TransferSettings& settings) {
    layout::OpeningParameters p{};
    const auto across = [](const glm::vec3& edge) {
        return glm::vec4(edge / glm::dot(edge, edge), 0.0F);
    };
    for (const SkyOpening& opening : found.openings) {
        const float density = settings.probabilities.opening * opening.share / opening.volume() *
                              settings.density_error;
        p.opening[p.number.x++] = {glm::vec4(opening.corner, density), across(opening.edges[0]),
                                   across(opening.edges[1]), across(opening.edges[2]),
                                   glm::vec4(opening.inward, 0.0F)};
    }
    openings_.write<layout::OpeningParameters>(std::span(&p, 1), 0);
    if (p.number.x > 0) {
        sheltered_.write<std::uint32_t>(found.sheltered, 0);
    }
}

void Transfer::opening(const BundleFrame& frame, const TransferSettings& settings,
                       std::span<BundleReceiver* const> receivers) {
    if (!outside_) {
        outside_ = Outside{Hemicube(hemicube_.size(), scene_.defines(),
                                    scene_.traces(SeenAs::hemicube, 3 * square(hemicube_.size()))),
                           ShaderProgram({"transport_opening_patches.comp"}, scene_.defines())};
    }
    const Place place = settings.context.place;
    const auto parameters_of = [&](const BundleFrame& half) {
        layout::BundleParameters p = common_parameters(half, settings);
        p.axis_x.w = frame.pixel_shift.x;
        p.axis_y.w = frame.pixel_shift.y;
        p.resolution.x = p.resolution.y = static_cast<unsigned>(hemicube_.size());
        const Sky& sky = scene_.sky();
        p.sky = glm::vec4(sky.uniform / scene_.radiance_unit() - settings.constant, p.sky.w);
        p.sky_behind.w = sky.environment ? 1.0F / scene_.radiance_unit() : 0.0F;
        const Hemicube::FaceRectangles all = hemicube_.full();
        for (std::size_t face = 0; face < all.size(); ++face) {
            p.scissor[face] = to_vector(all[face]);
        }
        return p;
    };
    store_.bind();
    BundleFrame outwards = frame;
    outwards.x = -frame.x;
    outwards.y = -frame.y;
    outwards.z = -frame.z;
    const layout::BundleParameters behind = parameters_of(outwards);
    upload(behind);
    outside_->picture.draw(scene_, outwards, behind.origin.w, place, hemicube_.full());
    upload(parameters_of(frame));
    hemicube_.draw(scene_, frame, behind.origin.w, place, hemicube_.full());
    hemicube_.bind_textures();
    glBindTextureUnit(UNIT_OUTSIDE_IDS, outside_->picture.surface_ids().get());

    set_bases(outside_->patches, place);
    transfer_rows(outside_->patches, {0, 0, hemicube_.size(), 3 * hemicube_.size()}, 0, settings);
    for (BundleReceiver* receiver : receivers) {
        receiver->receive_opening(settings.context);
    }
}

layout::BundleParameters Transfer::parallel_parameters(const ParallelWindow& window,
                                                       const TransferSettings& settings) const {
    layout::BundleParameters p = common_parameters(window.frame, settings);
    p.axis_x.w = window.plane_depth;
    p.axis_y.w = window.depth;
    p.weights.z = window.pixel_size;
    p.resolution.x = p.resolution.y = static_cast<unsigned>(window.size);
    return p;
}

void Transfer::layered(const ParallelWindow& window, const PixelRectangle& rectangle,
                       const TransferSettings& settings,
                       std::span<BundleReceiver* const> receivers) {
    if (rectangle.empty()) {
        return;
    }
    const Place place = settings.context.place;
    store_.bind();
    layout::BundleParameters p = parallel_parameters(window, settings);
    p.resolution.z = layers_.capacity();
    p.scissor[0] = to_vector(rectangle);
    upload(p, settings.context.special);
    store_.send_along_bundle(place);
    layers_.draw(scene_, window, place, rectangle, store_.counters());

    const ShaderProgram& patches = layers_patches_.program;
    patches.set("first_column", static_cast<unsigned>(rectangle.x0));
    patches.set("first_row", static_cast<unsigned>(rectangle.y0));
    patches.set("last_column", static_cast<unsigned>(rectangle.x1));
    const auto columns =
        (static_cast<unsigned>(rectangle.width()) + layers_patches_.run - 1) / layers_patches_.run;
    patches.set("run_columns", columns);
    patches.set("rows", static_cast<unsigned>(rectangle.height()));
    patches.set("slot", settings.slot);
    set_bases(patches, place);
    const unsigned rows = set_rows(patches, rectangle.y0, rectangle.height(), settings);
    patches.dispatch(std::size_t{columns} * ((rows + 7) / 8 * 8));
    BundleReceiver::Context context = settings.context;
    context.window_pixel = window.pixel_size;
    for (BundleReceiver* receiver : receivers) {
        receiver->receive_layers(context);
    }
}

void Transfer::plane(const ParallelWindow& window, const TransferSettings& settings,
                     std::span<BundleReceiver* const> receivers) {
    if (!planes_) {
        planes_ = Planes{PlaneWindow(layers_.size(), scene_.defines(),
                                     scene_.traces(SeenAs::planes, 2 * square(layers_.size()))),
                         parallel_program("transport_planes_patches.comp", scene_, parallel_run())};
    }
    const Place place = settings.context.place;
    store_.bind();
    upload(parallel_parameters(window, settings));
    store_.send_along_bundle(place);
    planes_->pictures.draw(scene_, window, place);
    planes_->pictures.bind_textures();
    const unsigned run = parallel_run();
    const unsigned columns = (static_cast<unsigned>(window.size) + run - 1) / run;
    planes_->patches.set("run_columns", columns);
    set_bases(planes_->patches, place);
    const unsigned rows = set_rows(planes_->patches, 0, window.size, settings);
    planes_->patches.dispatch(std::size_t{columns} * ((rows + 7) / 8 * 8));
    for (BundleReceiver* receiver : receivers) {
        receiver->receive_planes(settings.context);
    }
}

void Transfer::set_bases(const ShaderProgram& program, Place place) const {
    program.set("patch_base", scene_.patch_base(place));
    program.set("facet_base", scene_.facet_base(place));
    program.set("vertex_base", scene_.vertex_base(place));
}

std::size_t Transfer::bytes() const {
    return hemicube_.bytes() + layers_.bytes() + (planes_ ? planes_->pictures.bytes() : 0) +
           (outside_ ? outside_->picture.bytes() : 0);
}

std::uint32_t Transfer::take_overflow() {
    const layout::Counters counters = store_.take_counters();
    non_finite_ += counters.non_finite;
    if (counters.overflow_mask != 0) {
        layers_.grow(counters.wanted + counters.wanted / 4);
        if (layers_.capacity() > layers_patches_.longest_list) {
            layers_patches_ = layered_patches(longest_list(layers_.capacity()));
        }
    }
    return counters.overflow_mask;
}

}  // namespace raybundle
