// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/near_field.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/contact/world_triangle.h"
#include "scene/light/environment.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/triangle_irradiance.h"
#include "scene/walk/embree_triangles.h"

namespace raybundle {
namespace {

using std::numbers::pi;
constexpr double golden = 0.61803398874989485;
constexpr double emitter_points = 48.0;  // of all lamps together, shared out by their flux
constexpr double least_points = 4.0;     // of a lamp
constexpr std::size_t most_lamps = 24;   // the strongest
constexpr int rays = 16;                 // over a hemisphere
constexpr double offset_share = 1e-6;    // of the scene's extent

/// Of so many rays over the hemisphere, their density as the cosine: cosine and sine of the angle
/// about the normal, and the squared sine of that from it.
std::array<glm::dvec3, rays> make_hemisphere() {
    std::array<glm::dvec3, rays> directions{};
    for (int i = 0; i < rays; ++i) {
        const double sine_squared = (i + 0.5) / rays;
        const double angle = 2.0 * pi * std::fmod(i * golden, 1.0);
        directions[static_cast<std::size_t>(i)] = {std::cos(angle), std::sin(angle), sine_squared};
    }
    return directions;
}

/// Ray i of them about a unit normal.
glm::dvec3 hemisphere_ray(const glm::dvec3& normal, int i) {
    static const std::array<glm::dvec3, rays> directions = make_hemisphere();
    const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(axis, normal));
    const glm::dvec3& ray = directions[static_cast<std::size_t>(i)];
    return std::sqrt(ray.z) * (ray.x * tangent + ray.y * glm::cross(normal, tangent)) +
           std::sqrt(1.0 - ray.z) * normal;
}

RTCRay ray_from(const glm::dvec3& origin, const glm::dvec3& direction, double far) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tfar = static_cast<float>(far);
    ray.mask = ~0U;
    return ray;
}

/// What a material reflects, roughly: without its textures.
double albedo_of(const Material& material) {
    if (material.unlit) {
        return 0.0;
    }
    return double{luminance(material.base_colour)} * double{material.reflectance};
}

/// A point of the unit triangle, barycentric: number i of a sequence.
glm::dvec2 triangle_point(std::size_t i) {
    const auto n = static_cast<double>(i);
    glm::dvec2 p(std::fmod(0.5 + n * 0.75487766624669276, 1.0),  // M. Roberts 2018, R2
                 std::fmod(0.5 + n * 0.56984029099805327, 1.0));
    return p.x + p.y > 1.0 ? 1.0 - p : p;
}

}  // namespace

struct NearField::Hierarchy {
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device{rtcNewDevice(nullptr),
                                                             rtcReleaseDevice};
    std::unique_ptr<RTCSceneTy, void (*)(RTCScene)> scene{rtcNewScene(device.get()),
                                                          rtcReleaseScene};
    std::vector<std::uint32_t> triangles;  // of the scene, by primitive

    explicit Hierarchy(const Scene& source) {
        for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
            if (!is_glass(source.materials[source.triangles[t].material])) {
                triangles.push_back(t);
            }
        }
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        if (!triangles.empty()) {
            attach(source);
        }
        rtcCommitScene(scene.get());
    }

    void attach(const Scene& source) const {
        const std::unique_ptr<RTCGeometryTy, void (*)(RTCGeometry)> geometry{
            rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry};
        set_triangles(geometry.get(), source, triangles);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene.get(), geometry.get());
    }

    [[nodiscard]] bool occluded(const glm::dvec3& origin, const glm::dvec3& direction,
                                double far) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray = ray_from(origin, direction, far);
        rtcOccluded1(scene.get(), &context, &ray);
        return ray.tfar < 0.0F;
    }

    /// Index of the scene's triangle that a ray meets first; none: their number.
    [[nodiscard]] std::size_t first(const Scene& source, const glm::dvec3& origin,
                                    const glm::dvec3& direction, double far) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{ray_from(origin, direction, far), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene.get(), &context, &query);
        return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? source.triangles.size()
                                                           : triangles[query.hit.primID];
    }
};

NearField::NearField(const Scene& scene)
    : scene_(scene),
      sky_(has_sky(scene)),
      offset_(offset_share * double{glm::length(scene.bounds.extent())}),
      hierarchy_(std::make_unique<Hierarchy>(scene)) {
    std::transform(scene.materials.begin(), scene.materials.end(), std::back_inserter(albedo_),
                   albedo_of);
    place_emitters();
    for (const PunctualLight& light : scene.punctual_lights) {
        punctual_.push_back(place_light(scene, light));
    }
    if (punctual_.size() > NearLamps::most) {
        std::vector<float> ranges;
        for (const PunctualLight& light : scene.punctual_lights) {
            ranges.push_back(light.range);
        }
        near_lamps_ = NearLamps(punctual_, ranges, scene.bounds);
    }
}

NearField::~NearField() = default;

/// The strongest lamps get points by their flux, spread over their triangles by area.
void NearField::place_emitters() {
    struct Lamp {
        std::vector<std::uint32_t> triangles;
        double area = 0.0;
        double luminance = 0.0;  // cd/m²

        [[nodiscard]] double power() const { return area * luminance; }
    };
    std::vector<Lamp> lamps(scene_.materials.size());
    for (const Light& light : scene_.lights) {
        Lamp& lamp = lamps[static_cast<std::size_t>(light.material)];
        lamp.luminance = double{luminance(light.radiance)};
    }
    const auto area = [&](std::uint32_t t) {
        return 0.5 * glm::length(double_area(world_corners(scene_, scene_.triangles[t])));
    };
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
        Lamp& lamp = lamps[scene_.triangles[t].material];
        if (lamp.luminance > 0.0) {
            lamp.triangles.push_back(t);
            lamp.area += area(t);
        }
    }
    std::erase_if(lamps, [](const Lamp& lamp) { return !(lamp.power() > 0.0); });
    std::stable_sort(lamps.begin(), lamps.end(),
                     [](const Lamp& a, const Lamp& b) { return a.power() > b.power(); });
    lamps.resize(std::min(lamps.size(), most_lamps));
    double all = 0.0;
    for (const Lamp& lamp : lamps) {
        all += lamp.power();
    }
    std::size_t point_count = 0;
    for (const Lamp& lamp : lamps) {
        const double count =
            std::max(least_points, std::round(emitter_points * lamp.power() / all));
        const double step = lamp.area / count;
        const bool exact = static_cast<double>(lamp.triangles.size()) <= count;
        double before = 0.0;
        unsigned placed = 0;
        for (const std::uint32_t t : lamp.triangles) {
            const auto corners = world_corners(scene_, scene_.triangles[t]);
            Emitter emitter{corners,        glm::normalize(double_area(corners)),
                            lamp.luminance, two_sided(scene_, scene_.triangles[t]),
                            exact,          {}};
            before += area(t);
            for (; (placed + 0.5) * step < before; ++placed) {
                const glm::dvec2 at = triangle_point(point_count++);
                emitter.points.push_back({corners[0] + at.x * (corners[1] - corners[0]) +
                                              at.y * (corners[2] - corners[0]),
                                          step});
            }
            if (exact || !emitter.points.empty()) {
                emitters_.push_back(std::move(emitter));
            }
        }
    }
}

/// lx, by one triangle of a lamp.
double NearField::from_emitter(const Emitter& emitter, const Place& place, bool shadows) const {
    // In its own plane a lamp is not lit by itself, wherever rounding puts the place.
    const double height = glm::dot(place.position - emitter.corners[0], emitter.normal);
    if (emitter.exact && (emitter.two_sided ? std::abs(height) : height) <= offset_) {
        return 0.0;
    }
    const double unshadowed =
        emitter.exact ? triangle_irradiance(emitter.corners, place.position, place.normal) : 1.0;
    if (!(unshadowed > 0.0)) {
        return 0.0;
    }
    double all = 0.0;
    double visible = 0.0;
    for (const EmitterPoint& point : emitter.points) {
        const glm::dvec3 way = point.position - place.position;
        const double squared = glm::dot(way, way);
        const double distance = std::sqrt(squared);
        const double cosine = glm::dot(place.normal, way) / distance;
        double sending = -glm::dot(emitter.normal, way) / distance;
        sending = emitter.two_sided ? std::abs(sending) : sending;
        if (!(cosine > 0.0) || !(sending > 0.0)) {
            continue;
        }
        // As of a disc of that area: finite close by.
        const double value = point.area * cosine * sending / (squared + point.area / pi);
        const glm::dvec3 origin = place.position + offset_ * place.normal;
        all += value;
        if (!shadows || !hierarchy_->occluded(origin, point.position - origin, 1.0 - 1e-4)) {
            visible += value;
        }
    }
    if (!emitter.exact) {
        return emitter.luminance * visible;
    }
    return emitter.luminance * unshadowed * (all > 0.0 ? visible / all : 1.0);
}

double NearField::from_emitters(const Place& place, bool shadows) const {
    double sum = 0.0;
    for (const Emitter& emitter : emitters_) {
        sum += from_emitter(emitter, place, shadows);
    }
    return sum;
}

/// lx, by one light without extent.
double NearField::from_light(const PlacedLight& light, const Place& place, bool shadows) const {
    const bool far = light.kind == PunctualKind::directional;
    const glm::dvec3 way = far ? -light.direction() : light.position - place.position;
    const double squared = glm::dot(way, way);
    const double cosine = glm::dot(place.normal, way) / std::sqrt(squared);
    if (!(cosine > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 towards = light.towards(-way / std::sqrt(squared));
    const double value = double{luminance(glm::vec3(towards))} * cosine / squared;
    const double reach = far ? std::numeric_limits<double>::infinity() : 1.0 - 1e-4;
    const bool lit =
        value > 0.0 &&
        (!shadows || !hierarchy_->occluded(place.position + offset_ * place.normal, way, reach));
    return lit ? value : 0.0;
}

double NearField::from_punctual(const Place& place, bool shadows) const {
    double sum = 0.0;
    if (punctual_.size() > NearLamps::most) {
        for (const std::uint32_t k : near_lamps_.at(place.position)) {
            sum += from_light(punctual_[k], place, shadows);
        }
        return sum;
    }
    for (const PlacedLight& light : punctual_) {
        sum += from_light(light, place, shadows);
    }
    return sum;
}

double NearField::from_sky(const Place& place, bool shadows) const {
    double sum = 0.0;
    for (int i = 0; sky_ && i < rays; ++i) {
        const glm::dvec3 direction = hemisphere_ray(place.normal, i);
        if (!shadows || !hierarchy_->occluded(place.position + offset_ * place.normal, direction,
                                              std::numeric_limits<double>::infinity())) {
            sum += pi / rays * double{luminance(glm::vec3(sky_towards(scene_, direction)))};
        }
    }
    return sum;
}

double NearField::illuminance(const Place& place) const {
    return from_emitters(place, true) + from_punctual(place, true) + from_sky(place, true);
}

/// Share of the light that a Lambert surface sends which others reflect that are so close.
double NearField::reflected_within(const Place& place, double distance) const {
    double sum = 0.0;
    for (int i = 0; i < rays; ++i) {
        const glm::dvec3 direction = hemisphere_ray(place.normal, i);
        const std::size_t met =
            hierarchy_->first(scene_, place.position + offset_ * place.normal, direction, distance);
        if (met == scene_.triangles.size()) {
            continue;
        }
        const Triangle& triangle = scene_.triangles[met];
        const bool front = glm::dot(double_area(world_corners(scene_, triangle)), direction) < 0.0;
        if (front || two_sided(scene_, triangle)) {
            sum += albedo_[triangle.material] / rays;
        }
    }
    return sum;
}

double NearField::misplaced_on_side(const Corners& corners, const glm::dvec3& normal,
                                    double reflecting_area, double least) const {
    const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    // The face may reach into a slot whose light or depth its middle does not see.
    constexpr int count = 4;
    std::array<Place, count> places;
    const double sky = from_sky({middle, normal}, false);  // the same everywhere on the face
    double brightest = 0.0;                                // lx, without shadows
    for (std::size_t k = 0; k < count; ++k) {
        places[k] = {k < 3 ? glm::mix(middle, corners[k], 0.75) : middle, normal};
        brightest = std::max(
            brightest, from_emitters(places[k], false) + from_punctual(places[k], false) + sky);
    }
    // A standard deviation is at most half of the largest value.
    if (reflecting_area * brightest < least) {
        return 0.0;
    }
    const double edge =
        std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                  glm::distance(corners[2], corners[0])});
    double reflected = 0.0;
    for (const Place& place : places) {
        reflected += reflected_within(place, edge) / count;
    }
    if (!(reflected > 0.0)) {
        return 0.0;
    }
    double sum = 0.0;
    double squares = 0.0;
    for (const Place& place : places) {
        const double value = illuminance(place);
        sum += value / count;
        squares += value * value / count;
    }
    return reflecting_area * reflected * std::sqrt(std::max(squares - sum * sum, 0.0));
}

double NearField::misplaced_flux(const Face& face, double least) const {
    const glm::dvec3 twice = double_area(face.corners);
    const double length = glm::length(twice);
    if (!(length > 0.0) || !(albedo_[face.material] > 0.0)) {
        return 0.0;
    }
    const double area = 0.5 * length * albedo_[face.material];
    const double front = misplaced_on_side(face.corners, twice / length, area, least);
    return face.two_sided
               ? std::max(front, misplaced_on_side(face.corners, -twice / length, area, least))
               : front;
}

double NearField::direct_flux(const Face& face) const {
    const glm::dvec3 twice = double_area(face.corners);
    const double length = glm::length(twice);
    if (!(length > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
    const double front = illuminance({middle, twice / length});
    const double back = face.two_sided ? illuminance({middle, -twice / length}) : 0.0;
    return 0.5 * length * (front + back);
}

}  // namespace raybundle
