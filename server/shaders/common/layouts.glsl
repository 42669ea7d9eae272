// SPDX-License-Identifier: Apache-2.0
// GPU layouts and bindings, written once: C++ includes this text through gpu/layouts.h, shaders
// directly. Everything is std430 (storage) or made of vec4/mat4/uvec4 only (uniform blocks, std140).

#define NO_PATCH 0xffffffffu
#define NO_HIT 0xffffffffu
#define NOT_GLOSSY 0xffffffffu

// Storage bindings.
#define BINDING_VERTICES 0         // vec4[]: object-space position, w = object index (bits)
#define BINDING_WORLD_POSITIONS 1  // vec4[2 * vertices]: place 0 = now, place 1 = before the change
#define BINDING_TRIANGLES 2        // uvec4[]: vertex indices; material and, in bits 29..31, creases
#define BINDING_PATCHES 3          // PatchGeometry[2 * patches]: place 0, then place 1
#define BINDING_PATCH_TRIANGLE 4   // uint[]: triangle of a patch, its largest where it has several
#define BINDING_BACK_SIDE 5        // uint[]: side that is a triangle's back or NO_PATCH
#define BINDING_SURFACES 6         // PatchSurface[]
#define BINDING_RADIANCE 7         // vec4[]: main part of the radiance (radiance units), w = p_j / A_j of the larger of a patch's two places, 1/m^2
#define BINDING_IRRADIANCE 8       // vec4[]: mean irradiance (radiance units), w = weight
#define BINDING_ACCUMULATOR 9      // uint[6 * patches]: fixed-point sums, see accumulator.glsl
#define BINDING_POWER 10           // vec4[]: see solution_power.comp
#define BINDING_SHOOTERS 11        // Shooter[]
#define BINDING_COUNTERS 12        // Counters
#define BINDING_LAYER_COUNTS 13    // uint[window pixels]: surfaces that the pixel's line meets
#define BINDING_LAYER_SURFACES 14  // uint[capacity * window pixels]: see layers.glsl
#define BINDING_OBJECTS 15         // mat4[2 * objects]: world_from_object, place 0 then place 1
#define BINDING_MATERIALS 16       // MaterialData[]
#define BINDING_TEXELS 17          // uint[]: RGBA8 texels of all textures, see solution/geometry/texture_levels.h
#define BINDING_VERTEX_DATA 18     // VertexData[]
#define BINDING_VERTEX_TRIANGLES 19  // uint[]: triangles round each vertex
#define BINDING_PIXELS 20          // PixelSurface[]
#define BINDING_PIXEL_IRRADIANCE 21  // vec4[]: see PixelSum in pixel_sum.glsl
#define BINDING_PIXEL_DELTA 22     // vec4[]: signed increments of a special phase, w = sum of magnitudes
#define BINDING_PIXEL_SCATTER 23   // float[SCATTER_SUMS * probes]: see view_scatter.glsl
#define BINDING_VERTEX_IRRADIANCE 24  // vec4[]
#define BINDING_STATISTICS 25      // vec4[]: partial sums of a reduction
#define BINDING_FRAME 26           // uint[]: finished picture, RGBA8
#define BINDING_SOURCE 27          // vec4[]: irradiance iterate that is transferred
#define BINDING_CHECKPOINT 28      // vec4[]: state at the last change, see checkpoint.glsl
#define BINDING_PICK 29            // PickResult[]
#define BINDING_CDF 30             // float[]: cumulative p within blocks of POWER_BLOCK patches
#define BINDING_FACETS 31         // FacetGeometry[2 * facets]: place 0, then place 1
#define BINDING_FACET_INDICES 32  // uint[3 * facets]: vertices
#define BINDING_FLUX 33           // FluxSums[]: per block of patches, then the totals
#define BINDING_BALANCE 34        // Balance
#define BINDING_REFLECTORS 35     // vec4[]: base colour, reflectance record of a glossy patch (bits) or NOT_GLOSSY
#define BINDING_GLOSS 36          // uvec4[]: glossy part of a patch's radiance, see gloss.glsl
#define BINDING_CHAIN 37          // vec2[]: importance of the accepted sample, its scale C
#define BINDING_PIXEL_GLOSS 38    // vec4[]: see pixel_gloss.glsl
#define BINDING_PIXEL_GLOSS_DELTA 39  // vec4[]: signed increments of it
#define BINDING_SPECULAR_GROUPS 40    // see specular_groups.glsl
#define BINDING_SPECULAR_FLAGS 41     // uint[]: 1: the group of pixels is in the list
#define BINDING_SENT 42               // vec4[]: as BINDING_RADIANCE, but towards a parallel bundle's direction
#define BINDING_CONFIDENCE 43         // vec2[]: see view_confidence.glsl
#define BINDING_CONFIDENCE_SUMS 44    // vec4[]: two a tile
#define BINDING_EDGE_COUNTS 43        // uint[]: see edge_counts.glsl
#define BINDING_SMOOTHED 44           // as BINDING_FRAME, with smooth edges
#define BINDING_CAUSTICS 45           // vec4[]: radiance that caustics make of patches, see patch_source.glsl
#define BINDING_CAUSTIC_IRRADIANCE 46 // vec4[]: of patches, by caustics, radiance units
#define BINDING_CAUSTIC_FLUX 47       // vec4[2 * patches]: on patches, by all rays of lamps together, lm; then by those of other surfaces, see solution_caustics.comp
#define BINDING_CAUSTIC_DEPOSITS 48   // vec4[]: new sums of that flux; w: patch (bits)
#define BINDING_SCATTER 49            // vec2[scouts]: see scatter.glsl
#define BINDING_INCREMENTS 50         // vec4[]: increments of a special phase, w = their variance (luminance)
#define BINDING_STAGE 51              // vec4[]: sum over the bundles of its running stage, w = sum of squares (luminance)
#define BINDING_CHANGED_RADIANCE 52   // vec4[]: as BINDING_RADIANCE, of what a special phase sends
#define BINDING_OLD_SURFACES 53       // PatchSurface[]: before the change
#define BINDING_FIRST_SHOT 54         // vec4[2 * patches]: see patch_source.glsl
#define BINDING_PUNCTUAL 55           // PunctualData[]
#define BINDING_PIXEL_FIRST_SHOT 56   // vec4[]: see view_first_shot.comp
#define BINDING_IES 57                // float[IES_ROWS * IES_COLUMNS] for each profile: cd
#define BINDING_TRANSMITTANCE 58      // vec4[]: rgb: share of the light on a patch's back that it sends from its front
#define BINDING_TILES 59              // see tiles.glsl
#define BINDING_CONTINUED 60          // ContinuedPixel[]
#define BINDING_CONTINUED_TILES 61    // uint[]: see continued.glsl
#define BINDING_CONTINUED_RADIANCE 62 // vec4[]: of what specular surfaces show, radiance units
#define BINDING_CROWDED 63            // see crowded_pixels.glsl
#define BINDING_LUMINAIRES 64         // LuminaireHead, then LuminaireData[]: see view_luminaires.glsl
// Bound for one pass, on numbers that others are bound on for theirs.
#define BINDING_SLOPES 42             // RadianceSlope[]
#define BINDING_ZONES 33              // zones of patches and their levels, see zone_level.glsl
#define BINDING_KEPT 50               // vec4[]: mean irradiance that was kept over the last change, w = weight
#define BINDING_SHELTERED 52         // uint[]: see sky_openings.glsl; not in special phases
#define BINDING_COMPLETION 50         // vec4[]: what patches emit, then the reflected light that the first group of bundles lacks
#define BINDING_SINCE 51              // vec4[]: mean irradiance since then, w = weight
#define BINDING_OTHERS 53             // vec4[]: mean irradiance since then by other workers' samples, w = weight; not in special phases
#define BINDING_ZONE_ORDER 59         // uint[]: patches by zone in blocks of POWER_BLOCK, else NO_PATCH; or first blocks, or rays
#define BINDING_ZONE_RAYS 60          // ZoneRay[]; FluxSums[] where BINDING_ZONES is in use
#define BINDING_ZONE_SUMS 61          // vec4[]: of zones, then of pairs of zones, see solution/store/zone_balance.cpp
#define BINDING_MEMBERS 60            // uvec2[]: see patch_members.glsl
#define BINDING_LIGHT_SOURCES 25      // uint[]: where values of light come from, as BINDING_VERTEX_IRRADIANCE has it
#define BINDING_LIGHT_VALUES 26       // uint[]: see view_light_values.comp
#define BINDING_OLD_FIRST_SHOT 26    // as BINDING_FIRST_SHOT, before the change
#define BINDING_VERTEX_LIGHT 24       // VertexLight[]
#define BINDING_LAMP_CELLS 47         // uint[patches]: see lamps.glsl; with the other first shots
#define BINDING_LAMP_PROPOSALS 48     // uvec2[LAMP_SLOTS * cells]: lamps drawn, and their weights; likewise
#define BINDING_LAMP_POINTS 46        // LampPoint[]: see lamps.glsl, as the next ones
#define BINDING_LAMP_MASKS 63         // uint[]: lamps of the slots that reach a point, bit by bit
#define BINDING_LAMP_SLOTS 29         // uint[LAMP_SLOTS * cells]
#define BINDING_GLOSS_RAYS 29         // GlossRay[]: see gloss_ray.glsl
#define BINDING_LAMP_ORDER 60         // uint[patches]
#define BINDING_LAMP_SUMS 61          // vec4[3 * patches]: see lamps_patches.comp
#define BINDING_LAMP_CHANCES 59       // uvec2[]: see lamps_patches.comp
#define BINDING_LAMP_LEVELS 44        // vec4[(levels + 1) * patches]: irradiance by the lamps of a level; last gloss, see lamps_publish.comp
#define BINDING_LAMP_PIXELS 43        // vec4[]: see view_lamps.comp
#define BINDING_FIRST_SHOT_REST 61    // as BINDING_FIRST_SHOT: what rounding left of the sums, see shot_pass.glsl
#define BINDING_SHOT_MASKS 47         // uint[words * patches]: lights of which a change reaches patches, bit by bit
#define BINDING_PIXEL_SHOT_REST 43    // as BINDING_PIXEL_FIRST_SHOT: likewise

#define NEAR_SHARE 1e-7  // of the scene's diameter: a shooter does not see nearer surfaces
#define TIE_SHARE 4e-6  // of it: closer surfaces coincide
#define SHOOTER_LIFT 1e-6  // of it: how far shooters stand above their patches, see solution_shooters.comp
#define POWER_BLOCK 256
#define SPECULAR_GROUP 64  // pixels
#define CROWDED_GROUP 64  // pixels
#define EDGE_SAMPLES 16  // sub-samples of a pixel that is smoothed
#define STAGGER_PERIOD 4  // pixels after which places in them repeat, see view_place.glsl
#define VIEW_TILE 8  // pixels along a tile of a viewer
#define MOST_DIFFERENCES 8  // pairs of bundles whose affected tiles are listed at once
#define MOST_MOVED 4  // objects that are elsewhere at once: components of a vector
#define MOST_BOXES 8  // that hold them, at either place
#define MOST_SCOUTS 4096  // patches that the scatter of the strategies is measured on, see scatter.glsl
#define SCATTER_PARALLEL 0u
#define SCATTER_PERSPECTIVE 1u
#define SCATTER_NOT_MEASURED 2u
#define CONFIDENCE_TILE 8  // pixels along an edge
#define CONFIDENCE_WHOLE 2  // values before those of the tiles
#define LAMP_SLOTS 16  // lamps that are looked at at once, see solution/direct/many_lamps.h
#define LAMP_POINT_MOVED 0x80000000u  // flag of LampPoint::cell
#define LAMP_CHANCES 16  // drawn from those that have not been looked at yet
#define GROUP_SIZE 8  // iterations that are planned together
#define SCATTER_SUMS 8  // of a probe pixel, see view_scatter.glsl
#define SCATTER_OF_RAY 7  // of them what the ray of the running sample has brought, see view_gloss_rays.comp
// A pixel has a ray of its lobe for each so many samples; see docs/decisions.md.
#define GLOSS_RAY_STRIDE 4
#define GLOSS_RAYS_OF_GROUP (SPECULAR_GROUP / GLOSS_RAY_STRIDE)
// Widest lobe that rays are drawn from: its peak 1/(4 pi alpha^2), a ray for every fourth sample, is twice the density 1/(2 pi) of
// parallel bundles then.
#define DRAWN_ALPHA 0.25
// Texture units. Read-only data of hot shaders goes through buffer textures: one fetch brings four
// components, where a software rasteriser loads storage buffers component by component, lane by lane.
#define UNIT_SURFACE_IDS 0
#define UNIT_DEPTHS 1
#define UNIT_PATCHES 2            // rgba32f: PatchGeometry, two texels each
#define UNIT_RADIANCE 3           // rgba32f
#define UNIT_PIXELS 4             // rgba32ui: PixelSurface, two texels each
#define UNIT_OLD_PIXELS 5         // rgba32ui
#define UNIT_PIXEL_IRRADIANCE 6   // rgba32f
#define UNIT_OLD_PIXEL_IRRADIANCE 7  // rgba32f
#define UNIT_VERTEX_IRRADIANCE 8  // rgba16f
#define UNIT_TRIANGLES 9          // rgba32ui
#define UNIT_WORLD_POSITIONS 10   // rgba32f
#define UNIT_VERTEX_DATA 11       // rgba32ui: VertexData, two texels each
#define UNIT_MATERIALS 12         // rgba32f: MaterialData, five texels each
#define UNIT_FACETS 13            // rgba32f: FacetGeometry, four texels each
#define UNIT_FACET_NODES 14       // rg32ui: FacetNode of scene/contact/facet_tree.h
#define UNIT_REFLECTANCE 15       // rgba32f: Reflectance, three texels each, of materials and then of grids, then tables, see brdf.glsl
#define UNIT_REFLECTORS 16        // rgba32f
#define UNIT_GLOSS 17             // rgba32f
#define UNIT_PIXEL_GLOSS 18       // rgba32f
#define UNIT_OLD_PIXEL_GLOSS 19   // rgba32f
#define UNIT_LAYERS 20            // rgba32ui: the first four surfaces of a window pixel, see layers.glsl

#define UNIT_VERTEX_CAUSTICS 21     // rgba16f: as UNIT_VERTEX_IRRADIANCE, of caustics
#define UNIT_FACET_BOXES 22         // rgba32f: FacetBox, two texels each
#define UNIT_SLOPES 23              // rgba32ui: RadianceSlope
#define UNIT_PIXEL_KEPT 25            // rgba32f: see view_keep.comp
#define UNIT_SHADOW_EDGES 24      // r8ui array: see first_shot.glsl
#define UNIT_SIDES 26               // rg32ui: patch and triangle of each side, in scenes with PATCH_SETS
#define UNIT_MEMBERS 31             // rg32ui: see patch_members.glsl
#define UNIT_CONFIDENCE 32          // rg32f: see view_confidence.glsl
#define UNIT_PIXEL_AIR 33           // rgba32f: see view_air.glsl
#define UNIT_MATERIAL_DETAILS 27   // rgba32f: MaterialDetails, MATERIAL_DETAILS_TEXELS each
#define UNIT_SHADOW_MAPS 28       // r32ui array: see first_shot.glsl
#define UNIT_PIXEL_FIRST_SHOT 29  // rgba32f
#define UNIT_ENVIRONMENT 30       // rgba32f, equirectangular: cd/m^2, see environment.glsl
#define UNIT_OUTSIDE_IDS 34       // r32ui: as UNIT_SURFACE_IDS, seen the other way from an opening
#define UNIT_CARRIED_SKY 35   // rgba32f, equirectangular: cd/m^2, what bundles carry of it

// Uniform block bindings.
#define BINDING_BUNDLE 0
#define BINDING_VIEW 1
#define BINDING_OPENINGS 2

#define CREASE_SHIFT 29  // bit CREASE_SHIFT + k of a triangle's w: the edge opposite to vertex k is a crease
#define MATERIAL_MASK 0x0fffffffu
#define TRIANGLE_SMOOTH 0x10000000u  // vertex normals differ from the plane's
#define MATERIAL_MASK 0x0fffffffu
#define FACET_LEAF 0x80000000u  // FacetNode::leaf_bit

struct PatchGeometry {
    vec3 normal;   // world space, unit, out of the patch's front; of several triangles their area mean
    float offset;  // dot(normal, x) of points on the patch, or of its middle
    float area;    // m^2
    float inverse_area;
    uint object;
    uint triangle;  // its largest
};

// A flat triangle that is rasterised, and the root of its bisections.
struct FacetGeometry {
    vec3 normal;   // world space, unit
    float offset;  // dot(normal, x) of points on the facet
    vec4 weight1;  // dot(weight1, vec4(x, 1)): barycentric weight of corner 1
    vec4 weight2;
    uint root_code;
    uint root_first;
    uint object;
    uint material;
};

// Node of the tree of boxes round the facets, see solution/geometry/facet_boxes.h.
struct FacetBox {
    vec3 low;    // world space
    uint next;   // node after its subtree
    vec3 high;
    uint facet;  // NO_HIT: an inner node, whose first part is the next one
};

struct PatchSurface {
    vec4 albedo;    // rgb, for light from everywhere alike; w: share of the patch that alpha MASK leaves
    vec4 emission;  // rgb, radiance units
};

// How the radiance that a patch sends differs from its mean where the patch's corners are, halves: r and g of corner 1,
// b of corner 1 and r of corner 2, g and b of corner 2. Corner 0 has what makes their sum zero. See radiance_slope.glsl.
struct RadianceSlope {
    uint corner1_rg;
    uint corner1_b_corner2_r;
    uint corner2_gb;
    uint pad0;
};

// Mean over the patches that share a vertex. Irradiance: radiance units, halves.
struct VertexLight {
    vec3 middle;  // world space: of these patches
    uint front_rg;
    uint front_b_back_r;  // back: of their back sides
    uint back_gb;
    uint pad0, pad1;
};

// A point that shoots a perspective bundle.
struct Shooter {
    vec3 position;   // world space
    uint patch_id;
    vec3 normal;     // world space, unit
    float density;   // p_j / A_j, 1/m^2; 0: the patch has no area
    uint object;
    uint glossy;     // 1: its radiance depends on direction
    float probability;  // p_j
    uint emitter;    // 1: it sends light of its own
    vec4 constant_radiance;  // rgb: see Balance
    vec4 lobe;       // world space: where most of the accepted light is reflected to; w: share of the power
    vec3 position_before;  // the same point at place 1
    float density_before;
    vec3 normal_before;
    uint pad0;
    vec4 weights;    // barycentric, of the point in the patch
};

struct Counters {
    vec4 shooter_radiance;  // radiance of the shooter in the running perspective iteration
    uint layers;            // most surfaces on a line of the running window, where there is no room for them
    uint non_finite;        // contributions dropped because they were not finite
    uint overflowed;        // 1: there was too little room, and the running window is not transferred
    uint wanted;            // most layers that any overflowing window wanted
    uint overflow_mask;     // bit s: the layered iteration in slot s of its group overflowed
    int escaped;            // share of the shooter's flux that no patch receives, unit 2^-24
    uint pad0, pad1;
};

// Flux sums, radiance units * m^2.
struct FluxSums {
    vec4 incident;   // sum of A x: what the iterate says the patches receive
    vec4 reflected;  // sum of A albedo x
    vec4 emitted;    // sum of A pi L_e; w: of A
};

// How the iterate of a zone's patches is changed: irradiance = scale * irradiance + offset (radiance units).
struct ZoneLevelData {
    vec4 scale;   // w: usual squared relative deviation of samples from their mean, see believed_weight()
    vec4 offset;  // w: samples that the zone's iterate is younger than that of others
    vec4 kept;  // rgb: factor of the mean that was kept over the last change; w: samples that it is worth at most
    vec4 shooting;  // x: factor of the power of its patches where shooters are chosen
};
#define MAX_ZONES 64
#define DIFFERENCE_UNIT 0.16  // squared relative deviation of a sample, as in corrected_weight.glsl
#define ITERATE_EXPONENT 0.8  // the iterate's step is its age in samples, plus 1, to the power of minus this

// A line of light that leaves a patch, which stands for so many m^2 of its zone.
struct ZoneRay {
    uint from;
    float area;
};

// Flux that has left the scene, see solution_balance.comp.
struct Balance {
    vec4 escaped;    // weighted sum of estimates of the flux that no patch receives
    vec4 outgoing;   // weighted sum of the flux that was sent, w = weight
    vec4 constant;   // rgb: constant radiance term (ch. 5.5) of the running iterations, 0 where it is off
};

struct VertexData {
    vec2 normal;  // octahedral, object space
    vec2 uv;
    uint first_triangle;  // into BINDING_VERTEX_TRIANGLES
    uint triangle_count;
    uint object;
    uint colour;  // factor of the base colour, unorm 4x8, square-root encoded
};

struct MaterialData {
    vec4 base_colour;   // rgb factor of the Lambert albedo; w: alpha of the texture below which nothing is there, 0: none
    vec4 emission;      // rgb, radiance units; w: BundleGlass::tint of glass, see scene/material/specular_surface.h, else 0
    vec4 uv_row0;       // xyz: first row of uv_from_mesh_uv; w: BundleGlass::ior
    vec4 uv_row1;       // xyz: second row; w: 1/BundleGlass::surfaces
    uvec4 texture_info;  // offset into texels, width, height, flags: 1 repeat u, 2 repeat v; width 0: none
};

// What the textures of a material do besides its base colour.
struct MaterialDetails {
    vec4 factors;      // metallic, roughness, scale of a normal map's x and y; w: 1: unlit
    vec4 grid;         // of roughness: ln of the lowest, levels per unit of ln; of metalness: lowest, levels per unit
    uvec4 grid_levels;  // of roughness, of metalness; 0: neither is textured
    vec4 reflectance_row0;  // metallic-roughness texture: as uv_row0, uv_row1 and texture_info of MaterialData
    vec4 reflectance_row1;
    uvec4 reflectance_info;
    vec4 normal_row0;  // normal map
    vec4 normal_row1;
    uvec4 normal_info;
};
#define MATERIAL_DETAILS_TEXELS 9

#define MIN_ROUGHNESS 0.045  // smallest that is told apart, see scene/material/ggx_albedo.h
#define LEAST_VIEW_COSINE 0.02  // between a mapped normal and the view, see scene/material/normal_map.h
#define LEAST_MAP_HEIGHT 1e-3  // z of a normal map's normal at least
#define UNLIT_WHITE 80.0  // cd/m^2, see scene/scene.h
#define MAX_ALBEDO 0.999  // of a base colour: the iteration contracts
#define REFLECTANCE_NODES 80
#define LOBE_NONE 0
#define LOBE_GGX 1
#define LOBE_MAX_PHONG 2
#define LOBE_COATED 4    // GGX below a clear coat
#define LOBE_TEXTURED 3  // roughness and metalness vary: f0.x is the first record of its grid, see ReflectanceGrid

// A material's BRDF apart from its base colour, see scene/material/brdf.h.
struct Reflectance {
    vec4 f0;     // rgb: f0 of a colour of its own; w: share of the base colour in f0
    vec4 lobe;   // alpha (max-Phong: exponent), f90 (below 0: a lobe that view rays show, see traced_value), share of the
                 // base colour in lambert, 1/mean transmission
    vec4 table;  // grazing scale q (LOBE_COATED: texel of the coat's first node, see brdf.glsl), texel of its first
                 // node, LOBE_*; w: 1: glossy, see ReflectanceTables
};

// Directions of an IES profile on the GPU: half degrees from its aim, 2.5 degrees round it.
#define IES_ROWS 361
#define IES_COLUMNS 145

#define PUNCTUAL_POINT 0u
#define PUNCTUAL_SPOT 1u
#define PUNCTUAL_DIRECTIONAL 2u
#define NO_PROFILE 0xffffffffu
#define OPENING_POINT 0u  // the order of LuminousOpening::Shape
#define OPENING_RECTANGLE 1u
#define OPENING_ELLIPSE 2u
#define OPENING_QUARTER 3u

// A punctual light in the shifted world, see scene/light/punctual_light.h.
struct PunctualData {
    vec4 position;   // w: half width of its map: tangent, or m (directional)
    vec4 axis_x;     // of its map; w: cosine of the inner cone
    vec4 axis_y;     // w: cosine of the outer cone
    vec4 axis_z;     // opposite to its direction; w: reach of its opening, m
    vec4 intensity;  // cd or lx, in radiance units
    uvec4 map;       // first layer; layers: 1, or 6 of a cube; PUNCTUAL_*; texels along an edge
    uvec4 profile;   // x: IES profile, or NO_PROFILE; y: 1: part of the sky, which view rays show; z: OPENING_*
    vec4 opening;    // along axis_x and axis_y: its middle from `position`, half its sizes; see LuminousOpening
    uvec4 touched[3];  // of each layer: first and last texel that a change reaches, 16 bits for each coordinate
    vec4 touched_cone;  // round all of them: axis; w: cosine of half its angle, below -1: everything
};

// The body of a luminaire that pictures show, in the shifted world, see scene/photometry/luminaire_body.h.
struct LuminaireData {
    vec4 position;   // w: radius of the ball round it that holds the body, m
    vec4 axis_x;     // w: half of its size along this axis, m
    vec4 axis_y;     // likewise
    vec4 axis_z;     // opposite to its direction; w: how far the housing reaches along it, m
    vec4 intensity;  // factor of the profile's, in radiance units; w: how far the luminous part reaches along axis_z, m, below 0
    vec4 heights;    // of what shines on the sides that face +x, +y, -x and -y, m
    uvec4 profile;   // x: IES profile; y: 1: round
};
#define MOST_LUMINAIRES 256
#define LUMINAIRES_IN_GROUP 16

// Luminaires that are near each other.
struct LuminaireGroup {
    vec4 ball;    // that holds them; w: its radius, m
    uvec4 range;  // x: the first, y: after the last
};

struct LuminaireHead {
    uvec4 counts;  // x: luminaires, y: groups, z: rays along an edge of a pixel
    vec4 cut;      // x: what is nearer along the line of sight is not drawn, m
    LuminaireGroup groups[MOST_LUMINAIRES / LUMINAIRES_IN_GROUP];
};

// What view_lamps.comp does, see view/pixel_lamps.h.
#define LAMPS_BEGIN 0u
#define LAMPS_ADD 1u
#define LAMPS_CHANGE 2u  // the same, of what counts already
#define LAMPS_COUNT 3u

// What a first shot of punctual lights does, see solution/direct/first_shot.h.
#define SHOT_LIGHTS 16     // that a dispatch looks at, at most
#define SHOT_ALL 0u        // all points, all lights
#define SHOT_TAKE_BACK 1u  // takes back the light that a change reaches, as it was
#define SHOT_ADD 2u        // adds it as it is
#define SHOT_RENEW 3u      // some points, all lights
#define SHOT_FIND 4u       // finds what a change reaches: BINDING_SHOT_MASKS

struct PixelSurface {
    vec3 position;   // world space
    uint side;       // see scene_geometry.glsl; NO_PATCH: background
    uint normal;     // shading normal, octahedral snorm 2x16
    uint albedo;     // at the angle of view, see pixel_albedo.glsl
    uint barycentric;  // unorm 2x16: weights of vertices 1 and 2
    uint facet;        // also of black backs; and flags, PIXEL_...
};

#define PIXEL_EMITTER 0x80000000u  // or, of a PIXEL_CONTINUED, shows one or the sky
#define PIXEL_SKY 0x40000000u
#define PIXEL_BACK 0x20000000u  // the facet's back is seen
#define PIXEL_GLOSSY 0x10000000u
#define PIXEL_UNLIT 0x08000000u  // shown as is
#define PIXEL_CONTINUED 0x04000000u  // specular: shows what lies at the ends of its view rays
#define PIXEL_CROWDED 0x02000000u  // other surfaces are near it, see view_crowded.comp
#define PIXEL_FACET_MASK 0x01ffffffu

#define CONTINUED_NONE 0xfffffffeu  // surface of a continued pixel that is not used

// An end of a view ray that specular surfaces have deflected: a pixel behind the picture.
struct ContinuedPixel {
    vec3 position;    // world space
    uint surface;     // 2 * facet + side, NO_HIT (sky) or CONTINUED_NONE
    vec3 throughput;  // share of its radiance that the pixel shows
    uint towards;     // direction back along the ray, octahedral snorm 2x16
    uint old_index;   // of the same end in the picture before, or NO_HIT
    uint branch;      // 0: the strongest of the pixel's ends
    uint added;       // 1: what a smooth coat reflects, besides what the pixel shows of itself
    float way;        // from the last deflection to the end, m
};

struct PickResult {
    vec4 position;     // w = 1: hit; before the dispatch x = index of the pixel (bits)
    vec4 normal;       // w = object (bits)
    vec4 irradiance;   // radiance units; w = side (bits)
    vec4 radiance;     // radiance units; w = relative standard error, negative: not known
};

// One random bundle: which strategy found it, from where, with which densities.
struct BundleParameters {
    vec4 origin;         // perspective: shooting point; parallel: window's origin; w = near distance
    vec4 axis_x;         // unit; w: perspective: how far from their centres pixels sample, pixels; plane: its z, m
    vec4 axis_y;         // the same along y; w of parallel bundles: R, the depth of the window's slab, m
    vec4 axis_z;         // unit: normal of the shooter, or direction of the parallel bundle; w: p_j of the shooter
    vec4 densities;      // P1/(2 pi), P2/(2 pi R), P3, shooter's p_j/A_j
    vec4 sky;            // radiance from far along z where nothing is met, radiance units; w = tie distance, m
    vec4 sky_behind;     // the same from far against z
    vec4 constant;       // rgb: constant radiance term, what is transferred is radiance less this; w: weight of a
                         // glossy shooter's hemicube top
    vec4 side_weights;   // and of its sides; 0: not drawn
    vec4 weights;        // sign/weight of the transfer, iteration weight w, parallel: pixel size, m, perspective: noise
                         // limit of density.glsl, 0 = none
    vec4 slopes;         // barycentric weights of the shooter's point in its patch; w: share of the radiance slopes that
                         // is carried: 1, or 0 where patches send something else than the solution
    uvec4 resolution;    // hemicube or window: width, height; shooter patch or layer capacity; place (0 now, 1 before)
    ivec4 scissor[6];    // hemicube faces (x0, y0, x1, y1) in face pixels, [0] also the window's
    mat4 before_from_now[MOST_MOVED];  // rotations of the objects that are elsewhere at place 1
    uvec4 moved;                       // those objects, the rest NO_PATCH
};

// A box that light of the sky passes on its way to surfaces, see sky_openings.glsl.
struct SkyOpening {
    vec4 corner;    // world space; w: probability density of the points that bundles start from, 1/m^3
    vec4 across_u;  // edge / its square, 1/m: times (point - corner) it is 0 to 1 within
    vec4 across_v;
    vec4 across_w;
    vec4 inward;    // unit: light has a part of it
};
#define MOST_OPENINGS 24

struct OpeningParameters {
    SkyOpening opening[MOST_OPENINGS];
    uvec4 number;  // x: of openings in use
};

struct ViewParameters {
    mat4 clip_from_world;
    vec4 eye;           // world space
    vec4 right;         // scaled by tan(fov/2) * aspect
    vec4 up;            // scaled by tan(fov/2)
    vec4 forward;       // unit
    uvec4 size;         // width, height, probe columns, probe rows
    vec4 display;       // radiance unit (cd/m^2), exposure factor or top of the colour scale, 1: what is cut is hatched, unit of the isolines
    vec4 sky;           // background radiance, radiance units; w = factor of the environment's texels
    vec4 sun;           // to it, unit; w = cosine of its radius, above 1: none is drawn
    vec4 sun_radiance;  // cd/m^2
    vec4 weights;       // x: weight of all samples since the last resolve; since the scatter sums began, y: the same, z: sum of squared weights
    vec4 constant;      // rgb: irradiance by constant radiance terms, summed with these weights
    vec4 confidence;    // tiles in a row, 0: none, and in a column; z: a tile's edge, pixels; see view_confidence.glsl
    vec4 gain;          // of low-discrepancy samples: the variance of a mean falls faster, x: by this exponent, y: from so many on;
                        // z: of so many independent sequences are the patches' means
    vec4 places[STAGGER_PERIOD * STAGGER_PERIOD / 2];  // of the pixels' samples, two each, see view_place.glsl
};
