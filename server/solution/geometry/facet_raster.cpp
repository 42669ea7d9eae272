// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/facet_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace raybundle {

namespace {

/// Left, right, bottom, top and near planes of a clip matrix, normals inwards, unit.
std::array<glm::vec4, 5> frustum_planes(const glm::mat4& clip_from_world) {
    const glm::mat4 rows = glm::transpose(clip_from_world);
    std::array<glm::vec4, 5> planes = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                       rows[3] - rows[1], rows[3]};
    for (glm::vec4& plane : planes) {
        const float length = glm::length(glm::vec3(plane));
        plane = length > 0.0F ? plane / length : glm::vec4(0.0F);
    }
    return planes;
}

float largest_scale(const glm::mat4& matrix) {
    return std::sqrt(std::max({glm::dot(matrix[0], matrix[0]), glm::dot(matrix[1], matrix[1]),
                               glm::dot(matrix[2], matrix[2])}));
}

/// The facets of a mesh and their roots; its triangles, where it names no facets.
struct Facets {
    std::vector<glm::uvec3> corners;
    std::vector<FacetNode> roots;
    std::vector<std::uint32_t> materials;
};

Facets facets_of(const PatchMesh& mesh) {
    if (!mesh.facets.empty()) {
        return {mesh.facets, mesh.facet_roots, mesh.facet_material};
    }
    Facets facets{mesh.triangles, {}, mesh.triangle_material};
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        facets.roots.push_back(FacetNode::leaf(i));
    }
    return facets;
}

}  // namespace

FacetRaster::FacetRaster(const PatchMesh& mesh, const Buffer& world_positions)
    : count_(0),
      vertex_count_(static_cast<std::uint32_t>(mesh.positions.size())),
      nodes_(Buffer::from<FacetNode>("facet nodes", mesh.facet_tree)),
      place_facets_({"scene_place_facets.comp"}) {
    const Facets facets = facets_of(mesh);
    count_ = static_cast<std::uint32_t>(facets.corners.size());
    std::vector<layout::FacetGeometry> geometry(2 * facets.corners.size());
    for (std::size_t i = 0; i < geometry.size(); ++i) {
        const std::size_t facet = i % facets.corners.size();
        geometry[i].root_code = facets.roots[facet].code;
        geometry[i].root_first = facets.roots[facet].first;
        geometry[i].material = facets.materials[facet];
        geometry[i].object = mesh.vertex_object[facets.corners[facet].x];
    }
    if (!mesh.coverage.empty()) {
        uvs_ = Buffer::from<glm::vec2>("facet uvs", mesh.uvs);
    }
    indices_ = Buffer::from<glm::uvec3>("facet indices", facets.corners);
    geometry_ = Buffer::from<layout::FacetGeometry>("facets", geometry);
    geometry_texture_ = create_buffer_texture("facets", GL_RGBA32F, geometry_);
    node_texture_ = create_buffer_texture("facet nodes", GL_RG32UI, nodes_);
    build_clusters(mesh, facets.corners);
    for (unsigned place = 0; place < 2; ++place) {
        GLuint name = 0;
        glCreateVertexArrays(1, &name);
        vertex_array_[place] = VertexArray(name);
        glVertexArrayVertexBuffer(
            name, 0, world_positions.get(),
            static_cast<GLintptr>(std::size_t{place} * vertex_count_ * sizeof(glm::vec4)),
            sizeof(glm::vec4));
        glEnableVertexArrayAttrib(name, 0);
        glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(name, 0, 0);
        glVertexArrayElementBuffer(name, indices_.get());
        if (!mesh.coverage.empty()) {
            glVertexArrayVertexBuffer(name, 1, uvs_.get(), 0, sizeof(glm::vec2));
            glEnableVertexArrayAttrib(name, 1);
            glVertexArrayAttribFormat(name, 1, 2, GL_FLOAT, GL_FALSE, 0);
            glVertexArrayAttribBinding(name, 1, 1);
        }
    }
}

void FacetRaster::build_clusters(const PatchMesh& mesh, std::span<const glm::uvec3> facets) {
    constexpr std::uint32_t cluster_size = 256;
    for (std::uint32_t first = 0; first < count_;) {
        Cluster cluster{first, 0, mesh.vertex_object[facets[first].x], glm::vec3(0.0F), 0.0F};
        Bounds box;
        while (first < count_ && cluster.count < cluster_size &&
               mesh.vertex_object[facets[first].x] == cluster.object) {
            for (int k = 0; k < 3; ++k) {
                box.add(mesh.positions[facets[first][k]]);
            }
            ++cluster.count;
            ++first;
        }
        cluster.centre = box.centre();
        cluster.radius = 0.5F * glm::length(box.extent());
        clusters_.push_back(cluster);
    }
}

void FacetRaster::place(unsigned place) const {
    bind();
    place_facets_.set("place", place);
    place_facets_.set("vertex_count", vertex_count_);
    place_facets_.set("facet_count", count_);
    place_facets_.dispatch(count_);
}

void FacetRaster::settle() const {
    const auto half = static_cast<GLsizeiptr>(geometry_.bytes() / 2);
    glCopyNamedBufferSubData(geometry_.get(), geometry_.get(), 0, half, half);
}

void FacetRaster::bind() const {
    indices_.bind_storage(BINDING_FACET_INDICES);
    geometry_.bind_storage(BINDING_FACETS);
    glBindTextureUnit(UNIT_FACETS, geometry_texture_.get());
    glBindTextureUnit(UNIT_FACET_NODES, node_texture_.get());
}

void FacetRaster::draw(unsigned place, std::span<const glm::mat4> world_from_object,
                       const glm::mat4& clip_from_world, bool fronts_first,
                       const ShaderProgram& program, std::span<const std::uint32_t> hidden) const {
    const auto planes = frustum_planes(clip_from_world);
    const auto visible = [&](const Cluster& cluster) {
        const glm::mat4& matrix = world_from_object[cluster.object];
        const glm::vec4 centre = matrix * glm::vec4(cluster.centre, 1.0F);
        const float radius = cluster.radius * largest_scale(matrix) * 1.001F;
        return std::all_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
            return glm::dot(plane, centre) >= -radius;
        });
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;  // first facet, count
    for (const Cluster& cluster : clusters_) {
        if (std::find(hidden.begin(), hidden.end(), cluster.object) != hidden.end() ||
            !visible(cluster)) {
            continue;
        }
        if (!ranges.empty() && ranges.back().first + ranges.back().second == cluster.first) {
            ranges.back().second += cluster.count;
        } else {
            ranges.emplace_back(cluster.first, cluster.count);
        }
    }
    glBindVertexArray(vertex_array_[place].get());
    const auto draw_ranges = [&] {
        for (const auto& [first, count] : ranges) {
            program.set("first_facet", first);
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(std::size_t{first} * sizeof(glm::uvec3)));
        }
    };
    if (!fronts_first) {
        draw_ranges();
        return;
    }
    // Where a front and a back have equal depths the front, drawn first, is seen. No polygon
    // offset: a back pushed away would uncover what stands right behind it.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    draw_ranges();
    glCullFace(GL_FRONT);
    draw_ranges();
    glDisable(GL_CULL_FACE);
}

std::size_t FacetRaster::bytes() const {
    return indices_.bytes() + geometry_.bytes() + nodes_.bytes();
}

}  // namespace raybundle
