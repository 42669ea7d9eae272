// SPDX-License-Identifier: Apache-2.0
// brdf.glsl against scene/material/brdf.h and scene/material/reflectance_table.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../unit/random_brdf.h"
#include "embedded_file.h"
#include "gpu/egl_context.h"
#include "gpu/layouts.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"
#include "solution/geometry/reflectance_tables.h"

namespace raybundle::brdf_gpu_test {
namespace {

using test::RandomBrdfs;

constexpr char probe_main[] = R"(
struct Query { vec4 normal; vec4 w_in; vec4 w_out; vec4 colour; };  // normal.w: material
struct Answer { vec4 value; vec4 albedo; vec4 difference; };        // albedo.w: importance
layout(std430, binding = 0) readonly buffer Queries { Query queries[]; };
layout(std430, binding = 1) writeonly buffer Answers { Answer answers[]; };
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(queries.length())) {
        return;
    }
    Query q = queries[i];
    vec3 n = q.normal.xyz;
    Brdf b = make_brdf(uint(q.normal.w), q.colour.rgb);
    vec4 at_in = brdf_at(b, dot(n, q.w_in.xyz));
    vec4 at_out = brdf_at(b, dot(n, q.w_out.xyz));
    vec3 value = brdf_value(b, n, q.w_in.xyz, q.w_out.xyz, at_in.z * at_out.z);
    vec3 difference = brdf_difference(b, n, q.w_in.xyz, q.w_out.xyz, at_in, at_out);
    answers[i] = Answer(vec4(value, 0.0), vec4(brdf_albedo(b, at_in), at_in.w), vec4(difference, 0.0));
}
)";

std::string shader_text(std::string_view name) {
    for (const EmbeddedFile& file : shader_files()) {
        if (file.name.substr(file.name.rfind('/') + 1) == name) {
            return std::string(file.contents);
        }
    }
    throw GpuError("no such shader: " + std::string(name));
}

/// A program of the test's own: it is no part of the executable.
Program build_probe(const std::vector<std::string>& defines) {
    std::string text = "#version 450 core\n";
    for (const std::string& define : defines) {
        text += "#define " + define + "\n";
    }
    text += shader_text("layouts.glsl") + shader_text("brdf.glsl") + probe_main;
    const char* source = text.c_str();
    Program program(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source));
    GLint linked = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        char log[4096] = "";
        glGetProgramInfoLog(program.get(), sizeof log, nullptr, log);
        throw GpuError(log);
    }
    return program;
}

struct Query {
    glm::vec4 normal, w_in, w_out, colour;
};
struct Answer {
    glm::vec4 value, albedo, difference;
};

std::vector<Answer> ask(const ReflectanceTables& tables, const std::vector<Query>& queries) {
    const Program program = build_probe(tables.defines());
    const Buffer input = Buffer::from<Query>("queries", queries);
    const Buffer output("answers", queries.size() * sizeof(Answer));
    input.bind_storage(0);
    output.bind_storage(1);
    tables.bind();
    glUseProgram(program.get());
    glDispatchCompute(static_cast<GLuint>(queries.size() / 64 + 1), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<Answer> answers(queries.size());
    output.read<Answer>(answers);
    return answers;
}

enum class Lobes { plain, max_phong, clear_coat };

Scene random_scene(unsigned seed, int materials, Lobes lobes) {
    RandomBrdfs random(seed);
    Scene scene;
    for (int i = 0; i < materials; ++i) {
        Material material = random.material();
        if (lobes != Lobes::max_phong) {
            material.max_phong.reset();
        }
        if (lobes == Lobes::clear_coat && i % 4 != 3) {  // smoother ones pixels have no lobe of
            material.clear_coat = random.uniform();
            material.clear_coat_roughness = 0.11F + 0.89F * random.uniform();
        }
        if (i % 10 == 0) {  // a Lambert surface, and the smoothest of all
            material.metallic = material.specular = 0.0F;
        } else if (i % 10 == 1) {
            material.roughness = 0.0F;
        }
        if (specular_kind(material) == SpecularKind::mirror) {  // bundles have a lobe of their own
            material.roughness = std::nextafter(mirror_roughness, 1.0F);
        } else if (has_smooth_lobe(material)) {  // pixels have one below a map of normals alone
            material.normal_texture.texture = 0;
        }
        scene.materials.push_back(material);
    }
    return scene;
}

/// Every relative error is measured by the CPU's value, that of a difference by its two terms.
void expect_equal(const Scene& scene, const ReflectanceTables& tables,
                  const std::vector<Query>& queries, const std::vector<glm::mat3>& frames,
                  float tolerance) {
    const std::vector<Answer> answers = ask(tables, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Query& q = queries[i];
        const auto material = static_cast<std::size_t>(q.normal.w);
        const Brdf brdf = make_brdf(scene.materials[material], glm::vec3(q.colour));
        const ReflectanceTable& table = tables.table(material);
        const glm::mat3 local_from_world = glm::transpose(frames[i]);
        const glm::vec3 w_in = local_from_world * glm::vec3(q.w_in);
        const glm::vec3 w_out = local_from_world * glm::vec3(q.w_out);
        const glm::vec3 f = evaluate(brdf, w_in, w_out);
        const glm::vec3 mean = table.albedo(brdf, w_in.z) / glm::pi<float>();
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(answers[i].value[c], f[c], tolerance * f[c] + 1e-12F)
                << i << " material " << material << " kind " << static_cast<int>(brdf.lobe.kind)
                << " alpha " << brdf.lobe.alpha << " exponent " << brdf.lobe.exponent << " cos "
                << w_in.z << " " << w_out.z;
            ASSERT_NEAR(answers[i].albedo[c], mean[c] * glm::pi<float>(),
                        tolerance * mean[c] * glm::pi<float>())
                << i << " material " << material << " cos " << w_in.z;
            ASSERT_NEAR(answers[i].difference[c], f[c] - mean[c], tolerance * (f[c] + mean[c]));
        }
        const float importance = table.importance(w_in.z);
        ASSERT_NEAR(answers[i].albedo.w, importance, tolerance * importance);
    }
}

class BrdfGpu : public testing::TestWithParam<Lobes> {};

/// Local frames, all angles (half of them grazing), a third near the mirrored direction.
TEST_P(BrdfGpu, AgreesWithTheCpu) {
    const Scene scene = random_scene(31, 120, GetParam());
    const ReflectanceTables tables(scene);
    RandomBrdfs random(32);
    std::vector<Query> queries;
    for (int i = 0; i < 60'000; ++i) {
        const glm::vec3 in = random.direction();
        glm::vec3 out = random.direction();
        if (i % 3 == 0) {
            out = glm::vec3(-in.x, -in.y, in.z) + 0.03F * random.uniform() * out;
            out = glm::normalize(out);
        } else if (i % 100 == 1) {
            out.z = -out.z;
        }
        queries.push_back({{0.0F, 0.0F, 1.0F, static_cast<float>(i % 120)},
                           glm::vec4(in, 0.0F),
                           glm::vec4(out, 0.0F),
                           glm::vec4(1.1F * random.colour(), 0.0F)});
    }
    const std::vector<glm::mat3> frames(queries.size(), glm::mat3(1.0F));
    expect_equal(scene, tables, queries, frames, 1e-4F);
}

/// Any normal. Cosines then have an error of 1e-7, which smooth lobes and grazing angles magnify.
TEST_P(BrdfGpu, AgreesWithTheCpuInAnyFrame) {
    Scene scene = random_scene(33, 60, GetParam());
    for (Material& material : scene.materials) {
        material.roughness = std::max(material.roughness, 0.25F);
    }
    const ReflectanceTables tables(scene);
    RandomBrdfs random(34);
    std::vector<Query> queries;
    std::vector<glm::mat3> frames;
    while (queries.size() < 20'000) {
        const glm::vec3 in = random.direction();
        const glm::vec3 out = random.direction();
        if (std::min(in.z, out.z) < 0.05F) {
            continue;
        }
        const glm::vec3 n = glm::normalize(random.direction() - glm::vec3(0, 0, 0.4F));
        const glm::vec3 t = glm::normalize(glm::cross(n, glm::vec3(0.3F, 0.8F, 0.1F)));
        frames.emplace_back(t, glm::cross(n, t), n);
        queries.push_back({glm::vec4(n, static_cast<float>(queries.size() % 60)),
                           glm::vec4(frames.back() * in, 0.0F),
                           glm::vec4(frames.back() * out, 0.0F), glm::vec4(random.colour(), 0.0F)});
    }
    expect_equal(scene, tables, queries, frames, 1e-3F);
}

std::string name_of(const testing::TestParamInfo<Lobes>& test) {
    constexpr const char* names[] = {"WithoutMaxPhong", "WithMaxPhong", "WithClearCoat"};
    return names[static_cast<int>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Scenes, BrdfGpu,
                         testing::Values(Lobes::plain, Lobes::max_phong, Lobes::clear_coat),
                         name_of);

/// Pixels below a smooth coat lack its lobe, patches have it wide; nobody else has records more.
TEST(ReflectanceTables, SmoothCoatsHaveARecordForPatches) {
    Scene scene;
    Material lacquer;
    lacquer.metallic = lacquer.specular = 0.0F;
    lacquer.clear_coat = 1.0F;
    scene.materials = {lacquer, lacquer};
    scene.materials[1].clear_coat_roughness = 0.5F;
    const ReflectanceTables tables(scene);
    EXPECT_EQ(tables.defines(), (std::vector<std::string>{"CLEAR_COAT 1"}));
    EXPECT_EQ(tables.table(0).brdf().lobe.coat.strength, 0.0F);
    EXPECT_EQ(tables.patch_record(0, glm::vec2(0.0F)), 2U);
    EXPECT_FLOAT_EQ(tables.table(2).brdf().lobe.coat.alpha, 0.16F);
    EXPECT_NEAR(tables.table(2).brdf().lobe.coat.strength, 1.0F, 0.005F);
    EXPECT_EQ(tables.patch_record(1, glm::vec2(0.0F)), 1U);
    // Three tables, each with the nodes of a coat.
    EXPECT_EQ(tables.bytes(), 16U * (3U * 3U + 3U * 2U * reflectance_nodes));
}

TEST(ReflectanceTables, PolishedDielectricsHaveARecordForPatches) {
    Scene scene;
    Material porcelain;
    porcelain.metallic = porcelain.roughness = 0.0F;
    scene.materials = {porcelain, porcelain, porcelain};
    scene.materials[1].roughness = 0.5F;
    scene.materials[2].emission = glm::vec3(1.0F);
    const ReflectanceTables tables(scene);
    EXPECT_EQ(tables.table(0).brdf().f0, glm::vec3(0.0F));
    EXPECT_FLOAT_EQ(tables.table(3).brdf().lobe.alpha, 0.16F);
    EXPECT_NEAR(tables.table(3).brdf().f0.g, 0.04F, 0.0005F);
    EXPECT_EQ(tables.patch_record(0, glm::vec2(0.0F)), 3U);
    EXPECT_EQ(tables.patch_record(1, glm::vec2(0.0F)), 1U);
    // A lamp's reflections are those of its patches, in pictures too.
    EXPECT_FLOAT_EQ(tables.table(2).brdf().lobe.alpha, 0.16F);
    // Below a smooth coat its lobe stays where a map turns the normals, which view rays do not
    // know.
    Scene flakes;
    flakes.materials = {porcelain};
    flakes.materials[0].clear_coat = 1.0F;
    flakes.materials[0].normal_texture.texture = 0;
    EXPECT_NEAR(ReflectanceTables(flakes).table(0).brdf().f0.g, 0.04F, 0.0005F);
    // What is polished later needs another set of records.
    EXPECT_TRUE(tables.covers(scene, 1));
    scene.materials[1].roughness = 0.05F;
    EXPECT_FALSE(tables.covers(scene, 1));
}

TEST(ReflectanceTables, LambertScenesShareOneTable) {
    Scene scene;
    Material matte;
    matte.metallic = matte.specular = 0.0F;
    for (const float shade : {0.2F, 0.5F, 0.8F}) {
        matte.base_colour = glm::vec3(shade);
        scene.materials.push_back(matte);
    }
    const ReflectanceTables tables(scene);
    EXPECT_EQ(tables.table_count(), 1U);
    EXPECT_FALSE(tables.specular());
    EXPECT_TRUE(tables.defines().empty());
}

TEST(ReflectanceTables, EqualGlossyMaterialsShareOneTable) {
    Scene scene;
    Material plastic;
    plastic.metallic = 0.0F;
    plastic.roughness = 0.45F;  // as it is between surfaces, too
    scene.materials = {plastic, plastic, plastic};
    scene.materials[1].name = "the same under another name";
    scene.materials[2].roughness = 0.46F;
    const ReflectanceTables tables(scene);
    EXPECT_EQ(tables.table_count(), 2U);
    EXPECT_EQ(&tables.table(0), &tables.table(1));
    EXPECT_TRUE(tables.any_glossy());
    EXPECT_EQ(tables.bytes(), 16U * (3U * 3U + 2U * reflectance_nodes));
}

/// Bundles carry no lobe narrower than a roughness of 0.4; pixels know each as it is.
TEST(ReflectanceTables, NarrowLobesAreWideBetweenSurfaces) {
    Scene scene;
    for (const float roughness : {0.2F, 0.3F, 0.4F}) {
        Material metal;
        metal.roughness = roughness;
        scene.materials.push_back(metal);
    }
    const ReflectanceTables tables(scene);
    const auto between = [&](std::size_t material) {
        return &tables.table(tables.patch_record(material, {}));
    };
    EXPECT_EQ(between(0), between(1));
    EXPECT_EQ(between(0), &tables.table(2));
    EXPECT_NE(&tables.table(0), &tables.table(1));
    EXPECT_TRUE(tables.draws_lobes());
    for (Material& material : scene.materials) {
        material.roughness = 0.6F;
    }
    EXPECT_FALSE(ReflectanceTables(scene).draws_lobes());
}

}  // namespace
}  // namespace raybundle::brdf_gpu_test
