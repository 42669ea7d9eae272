// SPDX-License-Identifier: Apache-2.0
// Layered parallel bundle to patches (ch. 4.3, 4.3.1, "software z-buffer"): consecutive, mutually facing
// surfaces exchange radiance both ways.
//
// Each pixel's list is sorted by depth first. Surfaces that coincide are ordered so that the one facing
// the window comes first: then a thin wall is a wall, not a gap that two surfaces exchange light through
// (figure 4.4). Ties beyond that break by surface number, so that the order in which fragments arrived
// never shows: of faces that repeat one another the one with the lower number is seen from its front,
// as by every other bundle. Were it now this one and now that one, each would get a part of the light, and
// send it only where it is the one that is seen.
//
// Of a mesh that the rasteriser has folded (folded_over) a line meets one sheet more for each that is turned
// over: both are taken out, which leaves one sheet within the mesh and none outside of it. One that is met alone
// takes as much from its patch as others brought too much: in the mean a triangle, however small, gets the light
// of its area.
//
// SORTED: the lists come from rays (trace/facet_tracer.h), in order, and know no rounding of a rasteriser.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
uniform uint first_column;  // the rectangle of the window that is transferred
uniform uint first_row;
uniform uint last_column;   // one past the end
uniform uint run_columns;   // runs of run_length pixels a row
uniform uint rows;
uniform uint slot;          // of the iteration in its group
#include "parallel_runs.glsl"
#include "layers.glsl"
layout(binding = UNIT_LAYERS) uniform usamplerBuffer layer_texels;  // the first four surfaces of a pixel

/// A surface that a line meets.
struct Hit {
    float depth;
    float step;  // of the depth from pixel to pixel along the row
    uint surface;
};

const Hit no_hit = Hit(beyond_all, 0.0, NO_HIT);

// What this invocation works on.
int first_column_of_run = 0;
uvec4 sorted_lists[run_length];  // nearest four surfaces of every pixel, NO_HIT where there are fewer
int pair_index = 0;              // of the pair being transferred: its surface ahead is number pair_index + 1

uint pixel_index(ivec2 texel) { return uint(texel.y) * bundle.resolution.x + uint(texel.x); }

uint nth(uvec4 list, int k) { return k <= 0 ? list.x : k == 1 ? list.y : k == 2 ? list.z : list.w; }

/// Whether radiance may pass between two consecutive surfaces, either of which may be NO_HIT.
bool face_each_other(uvec2 pair) {
#ifdef SKY
    return pair != uvec2(NO_HIT);
#elif defined(DOUBLE_SIDED)
    return pair.y != NO_HIT;
#else
    return pair.y != NO_HIT && faces_far(pair.x) && !faces_far(pair.y);
#endif
}

uvec2 load_pair(ivec2 texel) {
    uvec4 list = sorted_lists[texel.x - first_column_of_run];
    uvec2 pair = uvec2(pair_index < 0 ? NO_HIT : nth(list, pair_index), nth(list, pair_index + 1));
    RARELY(pair_index >= 3) {
        uint pixel = pixel_index(texel);
        uint k = uint(pair_index);
        uint count = layer_counts[pixel];
        // Short lists are sorted at hand alone.
        pair.x = k == 3u ? list.w : k < count ? layer_surfaces[layer_slot(k, pixel)] : NO_HIT;
        pair.y = k + 1u < count ? layer_surfaces[layer_slot(k + 1u, pixel)] : NO_HIT;
    }
    return face_each_other(pair) ? pair : uvec2(NO_HIT);
}

#ifndef SORTED
bool before(Hit a, Hit b) {
    uint rank_a = faces_far(a.surface) ? ~a.surface : a.surface;
    uint rank_b = faces_far(b.surface) ? ~b.surface : b.surface;
    return a.depth != b.depth ? a.depth < b.depth : rank_a < rank_b;
}

Hit make_hit(uint surface, vec3 point, vec3 pixel_step) {
    vec4 plane = facet_plane(facet_base + facet_of(surface));
    float depth = plane_depth(plane, point);
#ifdef FOLDS
    surface = surface < turned_over && folded_over(surface, plane) ? (surface ^ 1u) | turned_over : surface;
#elif defined(THIN_WALLS)
    surface = folded_over(surface, plane) ? surface ^ 1u : surface;
#endif
    return Hit(depth, plane_depth(plane, point + pixel_step) - depth, surface);
}

void order(inout Hit a, inout Hit b) {
    if (before(b, a)) {
        Hit c = a;
        a = b;
        b = c;
    }
}

/// True where two surfaces are one plane, back to back. It is measured on the line: the plane of a sliver is
/// true to it there, but not far away.
bool coincide(Hit a, Hit b) {
    vec3 normal_a = facet_plane(facet_base + facet_of(a.surface)).xyz;
    vec3 normal_b = facet_plane(facet_base + facet_of(b.surface)).xyz;
    float cosine = max(abs(dot(normal_a, bundle.axis_z.xyz)), abs(dot(normal_b, bundle.axis_z.xyz)));
    return dot(normal_a, normal_b) < -0.9999 && abs(a.depth - b.depth) * cosine <= bundle.sky.w;
}

/// Depths of coinciding surfaces may differ by this much, m: rounding, magnified at grazing angles.
float coincidence_range() { return 16.0 * bundle.weights.z; }

/// Puts the surface that faces the window before the one it coincides with.
void order_coincident(inout Hit a, inout Hit b) {
#ifdef THIN_WALLS
    if (faces_far(a.surface) && !faces_far(b.surface) && b.depth <= a.depth + coincidence_range() &&
        coincide(a, b)) {
        uint surface = a.surface;
        a.surface = b.surface;
        b.surface = surface;
    }
#endif
}

#ifdef SKY
#include "line_edges.glsl"
#endif

// The last list of more than four surfaces, nearest first, and the places that they had before.
float held_depth[LONGEST_LIST];
uint held_surface[LONGEST_LIST];
uint held_place[LONGEST_LIST];
uint held_count = 0u;
bool held_folded = false;  // some are turned over

/// Puts the surface at a place of the unsorted list among those that are held.
void hold(uint pixel, uint place, vec3 point) {
    Hit hit = make_hit(layer_surfaces[layer_slot(place, pixel)], point, vec3(0.0));
    uint k = held_count++;
    for (; k > 0u && before(hit, Hit(held_depth[k - 1u], 0.0, held_surface[k - 1u])); --k) {
        held_depth[k] = held_depth[k - 1u];
        held_surface[k] = held_surface[k - 1u];
        held_place[k] = held_place[k - 1u];
    }
    held_depth[k] = hit.depth;
    held_surface[k] = hit.surface;
    held_place[k] = place;
#ifdef FOLDS
    held_folded = held_folded || is_turned_over(hit.surface);
#endif
}

/// Number of the nearest surface that looks as number k does, from the same place but for what a fold may
/// be wide, or k.
uint other_sheet(uint k, uint count) {
    uint nearest = k;
    float distance = bundle.weights.z;
    for (uint i = 0u; i < count; ++i) {
        uint surface = held_surface[i];
        float apart = abs(held_depth[i] - held_depth[k]);
        if (surface != NO_HIT && surface < turned_over && (surface & 1u) == (held_surface[k] & 1u) && apart < distance) {
            nearest = i;
            distance = apart;
        }
    }
    return nearest;
}

/// Takes every surface that is turned over out of the held ones, together with the sheet that it folds, if
/// there is one. Returns how many are left. The places stay: they only tell the next list's order.
uint unfold(uint count) {
    for (uint k = 0u; k < count; ++k) {
        RARELY(is_turned_over(held_surface[k])) {
            uint other = other_sheet(k, count);
            held_surface[other] = other == k ? held_surface[k] : NO_HIT;
            held_surface[k] = held_surface[other];
        }
    }
    uint left = 0u;
    for (uint k = 0u; k < count; ++k) {
        if (held_surface[k] != NO_HIT) {
            held_depth[left] = held_depth[k];
            held_surface[left++] = held_surface[k];
        }
    }
    return left;
}

/// Insertion sort of a list that is longer than four, or folded, in memory too. Returns its first four.
/// Neighbouring pixels mostly have the same surfaces, which have come in the same order: taken as the last
/// list was in the end, few are out of place.
uvec4 sort_long_list(uint pixel, inout uint count, vec3 point) {
    uint known = held_count;
    held_count = 0u;
    held_folded = false;
    for (uint k = 0u; k < known; ++k) {
        uint place = held_place[k];
        RARELY(place < count) {
            hold(pixel, place, point);
        }
    }
    for (uint place = known; place < count; ++place) {
        hold(pixel, place, point);
    }
#ifdef FOLDS
    RARELY(held_folded) {
        count = unfold(count);
        layer_counts[pixel] = count;
    }
#endif
#ifdef THIN_WALLS
    for (uint i = 0u; i + 1u < count; ++i) {
        Hit a = Hit(held_depth[i], 0.0, held_surface[i]);
        for (uint k = i + 1u; k < count && faces_far(a.surface); ++k) {
            Hit b = Hit(held_depth[k], 0.0, held_surface[k]);
            if (b.depth > a.depth + coincidence_range()) {
                break;
            }
            order_coincident(a, b);
            held_surface[k] = b.surface;
        }
        held_surface[i] = a.surface;
    }
#endif
#ifdef SKY
    for (uint k = 1u; k < count; ++k) {
        Hit a = Hit(held_depth[k - 1u], 0.0, held_surface[k - 1u]);
        Hit b = Hit(held_depth[k], 0.0, held_surface[k]);
        order_at_edge(a, b, point);
        held_surface[k - 1u] = a.surface;
        held_surface[k] = b.surface;
    }
#endif
    for (uint k = 0u; k < count; ++k) {
        layer_surfaces[layer_slot(k, pixel)] = held_surface[k];
    }
    return uvec4(count > 0u ? held_surface[0] : NO_HIT, count > 1u ? held_surface[1] : NO_HIT,
                 count > 2u ? held_surface[2] : NO_HIT, count > 3u ? held_surface[3] : NO_HIT);
}

/// Up to four surfaces of a line. The next pixel of the row often has the same ones in the same order.
struct ShortList {
    uvec4 unsorted;
    Hit h0, h1, h2, h3;
    bool folded;  // some are turned over
};

void sort_short_list(inout ShortList list, vec3 point, vec3 pixel_step) {
    list.h0 = make_hit(list.unsorted.x, point, pixel_step);
    list.h1 = make_hit(list.unsorted.y, point, pixel_step);
    list.h2 = no_hit;
    list.h3 = no_hit;
    RARELY(list.unsorted.z != NO_HIT) {
        list.h2 = make_hit(list.unsorted.z, point, pixel_step);
    }
    RARELY(list.unsorted.w != NO_HIT) {
        list.h3 = make_hit(list.unsorted.w, point, pixel_step);
    }
#ifdef FOLDS
    list.folded = is_turned_over(list.h0.surface) || is_turned_over(list.h1.surface) ||
                  is_turned_over(list.h2.surface) || is_turned_over(list.h3.surface);
#endif
    order(list.h0, list.h1);
    order(list.h2, list.h3);
    order(list.h0, list.h2);
    order(list.h1, list.h3);
    order(list.h1, list.h2);
    order_coincident(list.h0, list.h1);
    order_coincident(list.h0, list.h2);
    order_coincident(list.h0, list.h3);
    order_coincident(list.h1, list.h2);
    order_coincident(list.h1, list.h3);
    order_coincident(list.h2, list.h3);
#ifdef SKY
    order_at_edge(list.h0, list.h1, point);
    order_at_edge(list.h1, list.h2, point);
    order_at_edge(list.h2, list.h3, point);
#endif
}

/// Goes to the next pixel. Returns whether the order still holds.
bool advance(inout ShortList list) {
    list.h0.depth += list.h0.step;
    list.h1.depth += list.h1.step;
    list.h2.depth += list.h2.step;
    list.h3.depth += list.h3.step;
    return list.h0.depth < list.h1.depth && (list.h2.surface == NO_HIT || list.h1.depth < list.h2.depth) &&
           (list.h3.surface == NO_HIT || list.h2.depth < list.h3.depth);
}

#endif

/// Which pairs of a row of pixels have something to transfer.
struct Pairs {
    uint near;  // bits: k + 1 for pair_index k, -1..2
    int last;   // greatest pair_index
};

#ifdef SORTED
/// Loads the lists of pixels [first.x, end) of a row, which are in order (trace/line_order.h).
Pairs sort_lists(ivec2 first, int end) {
    Pairs pairs = Pairs(0u, -1);
    for (ivec2 texel = first; texel.x < end; ++texel.x) {
        uint pixel = pixel_index(texel);
        uint count = layer_counts[pixel];
        uvec4 sorted = texelFetch(layer_texels, int(pixel));
        sorted.x = count > 0u ? sorted.x : NO_HIT;
        sorted.y = count > 1u ? sorted.y : NO_HIT;
        sorted.z = count > 2u ? sorted.z : NO_HIT;
        sorted.w = count > 3u ? sorted.w : NO_HIT;
        sorted_lists[texel.x - first.x] = sorted;
        pairs.near |= face_each_other(uvec2(NO_HIT, sorted.x)) ? 1u : 0u;
        pairs.near |= face_each_other(sorted.xy) ? 2u : 0u;
        pairs.near |= face_each_other(sorted.yz) ? 4u : 0u;
        pairs.near |= face_each_other(sorted.zw) ? 8u : 0u;
#ifdef SKY
        pairs.last = max(pairs.last, int(count) - 1);
#else
        pairs.last = max(pairs.last, int(count) - 2);
#endif
    }
    return pairs;
}
#else
/// Sorts the lists of pixels [first.x, end) of a row into sorted_lists, longer ones in memory too.
Pairs sort_lists(ivec2 first, int end) {
    vec3 point = window_point(uvec2(first));
    vec3 pixel_step = bundle.weights.z * bundle.axis_x.xyz;
    Pairs pairs = Pairs(0u, -1);
    ShortList list = ShortList(uvec4(NO_HIT), no_hit, no_hit, no_hit, no_hit, false);
    for (ivec2 texel = first; texel.x < end; ++texel.x, point += pixel_step) {
        uint pixel = pixel_index(texel);
        uint count = layer_counts[pixel];
        uvec4 unsorted = uvec4(NO_HIT);
        RARELY(count > 0u && count <= 4u) {
            unsorted = texelFetch(layer_texels, int(pixel));
        }
        unsorted.y = count > 1u ? unsorted.y : NO_HIT;
        unsorted.z = count > 2u ? unsorted.z : NO_HIT;
        unsorted.w = count > 3u ? unsorted.w : NO_HIT;
        bool same = unsorted == list.unsorted && advance(list);
        list.unsorted = unsorted;
        uvec4 sorted = unsorted;
        RARELY(count > 1u && count <= 4u) {
            RARELY(!same) {
                sort_short_list(list, point, pixel_step);
            }
            sorted = uvec4(list.h0.surface, list.h1.surface, list.h2.surface, list.h3.surface);
        }
        bool folded = list.folded && count > 1u && count <= 4u;
        RARELY(count > 4u || folded) {
            sorted = sort_long_list(pixel, count, point);
        }
#ifdef SKY
        if (facet_base == 0u) {
            add_missed(sorted, count, point);
        }
#endif
        sorted_lists[texel.x - first.x] = sorted;
        pairs.near |= face_each_other(uvec2(NO_HIT, sorted.x)) ? 1u : 0u;
        pairs.near |= face_each_other(sorted.xy) ? 2u : 0u;
        pairs.near |= face_each_other(sorted.yz) ? 4u : 0u;
        pairs.near |= face_each_other(sorted.zw) ? 8u : 0u;
#ifdef SKY
        pairs.last = max(pairs.last, int(count) - 1);
#else
        pairs.last = max(pairs.last, int(count) - 2);
#endif
    }
    return pairs;
}

#endif

/// True where the lists have no room for all surfaces: nothing is transferred then.
bool note_overflow() {
    bool overflowed = counters.layers > layer_capacity();
    if (linear_index() == 0u) {
        counters.overflowed = overflowed ? 1u : 0u;
        if (overflowed) {
            counters.wanted = max(counters.wanted, counters.layers);
            counters.overflow_mask |= 1u << slot;
        }
    }
    return overflowed;
}

void main() {
    // Neighbouring invocations take neighbouring rows: their runs end at nearly the same places.
    uint block = linear_index() >> 3;
    uint row_block = block / run_columns;
    uint row = row_stride * (row_block * 8u + (linear_index() & 7u)) + row_phase;
    if (note_overflow() || row >= rows) {
        return;
    }
    ivec2 first = ivec2(first_column + (block - row_block * run_columns) * run_length, first_row + row);
    int end = min(first.x + int(run_length), int(last_column));
    first_column_of_run = first.x;
    Pairs pairs = sort_lists(first, end);
    for (pair_index = -1; pair_index <= pairs.last; ++pair_index) {
        RARELY(pair_index >= 3 || (pairs.near >> (pair_index + 1) & 1u) != 0u) {
            exchange_row(first, end);
        }
    }
}
