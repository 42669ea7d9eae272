// SPDX-License-Identifier: Apache-2.0
// Pure camera maths. A view is what setCamera carries: eye, target, up, vertical field of view.
// Points of the picture are in normalised coordinates: (0, 0) is its top left, (1, 1) its bottom
// right corner.

import {
    UP, add, boundsOf, centre, clamp, contains, cross, diagonal, dot, intersectBounds, length, mix, normalise, scale, sub, vec3,
} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../ui/vector.js').Ray} Ray
 */

/** The line of sight stays this far from the vertical, radians. */
const POLE_MARGIN = 0.02;

/** Upright screens widen the field of view to this at most, radians. */
const WIDEST_FOV = 1.9;

/** Nearest distance between eye and target, metres. */
const MIN_DISTANCE = 0.01;

/**
 * Orthonormal axes of a view, all of length 1.
 *
 * @param {View} view
 * @returns {{right: Vec3, up: Vec3, forward: Vec3}}
 */
export function axes(view) {
    const forward = normalise(sub(view.target, view.eye));
    let right = cross(forward, view.up);
    if (length(right) < 1e-6) {
        right = cross(forward, Math.abs(forward.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 0, 1));
    }
    right = normalise(right);
    return {right, up: cross(right, forward), forward};
}

/**
 * Where a point appears in the picture.
 *
 * @param {View} view
 * @param {number} aspect  width over height
 * @param {Vec3} point
 * @returns {{x: number, y: number, depth: number}}  depth along the line of sight, metres; the
 *     point lies behind the eye where it is not positive, and x and y mean nothing then
 */
export function project(view, aspect, point) {
    const {right, up, forward} = axes(view);
    const offset = sub(point, view.eye);
    const depth = dot(offset, forward);
    const halfHeight = Math.tan(view.verticalFov / 2) * depth;
    return {
        x: 0.5 + (0.5 * dot(offset, right)) / (halfHeight * aspect),
        y: 0.5 - (0.5 * dot(offset, up)) / halfHeight,
        depth,
    };
}

/**
 * Ray from the eye through a point of the picture.
 *
 * @param {View} view
 * @param {number} aspect  width over height
 * @param {number} x  0..1 from the left
 * @param {number} y  0..1 from the top
 * @returns {Ray}  direction of length 1
 */
export function rayThrough(view, aspect, x, y) {
    const {right, up, forward} = axes(view);
    const halfHeight = Math.tan(view.verticalFov / 2);
    const across = scale(right, (2 * x - 1) * halfHeight * aspect);
    const along = scale(up, (1 - 2 * y) * halfHeight);
    return {origin: view.eye, direction: normalise(add(forward, add(across, along)))};
}

/**
 * Vertical field of view that shows what the camera's author framed: never less than a square
 * picture would, so that an upright screen does not crop the sides.
 *
 * @param {number} verticalFov  as the author set it, radians
 * @param {number} aspect  of the screen, width over height
 * @returns {number} radians
 */
export function framedFov(verticalFov, aspect) {
    const halfHeight = Math.tan(verticalFov / 2) / Math.min(aspect, 1);
    return Math.min(2 * Math.atan(halfHeight), Math.max(WIDEST_FOV, verticalFov));
}

/**
 * Heading and elevation of the line of sight, radians. Heading 0 looks along -z, a positive one
 * turns to the left. Where the view is vertical, its up vector tells the heading.
 *
 * @param {View} view
 * @returns {{heading: number, elevation: number}}
 */
export function angles(view) {
    const {forward, up} = axes(view);
    const elevation = Math.asin(clamp(forward.y, -1, 1));
    const vertical = Math.abs(forward.y) > 0.9999;
    const ahead = vertical ? scale(up, -Math.sign(forward.y)) : forward;
    return {heading: Math.atan2(-ahead.x, -ahead.z), elevation};
}

/**
 * Unit vector from angles as `angles` returns them.
 *
 * @param {number} heading
 * @param {number} elevation
 * @returns {Vec3}
 */
export function direction(heading, elevation) {
    const flat = Math.cos(elevation);
    return vec3(-Math.sin(heading) * flat, Math.sin(elevation), -Math.cos(heading) * flat);
}

/** @type {(view: View) => number} */
const distance = (view) => Math.max(length(sub(view.target, view.eye)), MIN_DISTANCE);

/**
 * Turned line of sight, short of the vertical.
 *
 * @param {View} view
 * @param {number} left  radians to the left
 * @param {number} upwards  radians upwards
 * @returns {Vec3}
 */
function turned(view, left, upwards) {
    const {heading, elevation} = angles(view);
    const limit = Math.PI / 2 - POLE_MARGIN;
    return direction(heading + left, clamp(elevation + upwards, -limit, limit));
}

/**
 * Circles the eye around the target.
 *
 * @param {View} view
 * @param {number} left  radians that the line of sight turns to the left
 * @param {number} upwards  radians that the line of sight turns upwards
 * @returns {View}
 */
export function orbit(view, left, upwards) {
    const sight = turned(view, left, upwards);
    return {...view, eye: sub(view.target, scale(sight, distance(view))), up: UP};
}

/** An eye that circles within walls keeps this far from them and from what hangs there, metres, or this share of the room. */
const WALL_MARGIN = {metres: 0.75, share: 0.12};
/** Walls bring it no nearer to the target than this share of the distance. */
const NEAREST_SHARE = 0.6;
/** What is smaller than this in any direction is no room, metres. */
const SMALLEST_ROOM = 1.5;

/**
 * What is around an eye: the smallest of the parts of a building that it is inside of, or else the whole
 * scene.
 *
 * @param {Vec3} eye
 * @param {Bounds} scene
 * @param {Bounds[]} parts  that cannot be moved
 * @returns {Bounds | null}  null: it looks at the scene from outside
 */
export function roomAround(eye, scene, parts) {
    const rooms = parts.filter(({min, max}) => {
        const {x, y, z} = sub(max, min);
        return Math.min(x, y, z) >= SMALLEST_ROOM;
    });
    const around = [scene, ...rooms].filter((bounds) => contains(bounds, eye));
    around.sort((a, b) => diagonal(a) - diagonal(b));
    return around[0] ?? null;
}

/**
 * Where an eye that is in a room may go: not near the walls, unless it is there already.
 *
 * @param {Bounds} room
 * @param {Vec3} eye
 * @returns {Bounds}
 */
export function spaceIn({min, max}, eye) {
    const margin = (/** @type {'x' | 'y' | 'z'} */ axis) =>
        Math.min(WALL_MARGIN.metres, WALL_MARGIN.share * (max[axis] - min[axis]));
    const off = vec3(margin('x'), margin('y'), margin('z'));
    return boundsOf([add(min, off), sub(max, off), eye]);
}

/**
 * A view whose eye has come nearer to the target where it would leave a space.
 *
 * @param {View} view
 * @param {Bounds} space
 * @returns {View | null}  null: nothing of the space is between the two
 */
export function keptIn(view, space) {
    const away = sub(view.eye, view.target);
    const hit = intersectBounds({origin: view.target, direction: away}, space);
    if (!hit || hit.enter > 1) {
        return null;
    }
    return hit.leave < 1 ? {...view, eye: add(view.target, scale(away, hit.leave))} : view;
}

/**
 * Circles the eye around the target, nearer where a wall is in the way; but where it would come very near, or the
 * target is in the wall, it does not go on.
 *
 * @param {View} view
 * @param {number} left  radians, as orbit() has it
 * @param {number} upwards  radians
 * @param {number} reach  distance from the target, where there is room, metres
 * @param {Bounds} space
 * @returns {View}
 */
export function orbitIn(view, left, upwards, reach, space) {
    for (const [x, y] of [[left, upwards], [left, 0], [0, upwards]]) {
        const free = dolly(orbit(view, x, y), reach / distance(view), Infinity);
        const kept = keptIn(free, space);
        if (kept && distance(kept) >= NEAREST_SHARE * reach) {
            return kept;
        }
    }
    return view;
}

/**
 * A view of the whole of a box, looking the same way.
 *
 * @param {View} view
 * @param {Bounds} bounds
 * @param {number} aspect  width over height
 * @param {Bounds | null} space  that the eye does not leave
 * @returns {View}
 */
export function framing(view, bounds, aspect, space) {
    const half = Math.min(view.verticalFov / 2, Math.atan(Math.tan(view.verticalFov / 2) * aspect));
    const away = Math.max(diagonal(bounds) / 2 / Math.sin(half), MIN_DISTANCE);
    const target = centre(bounds);
    const framed = {...view, target, eye: sub(target, scale(turned(view, 0, 0), away)), up: UP};
    return (space && keptIn(framed, space)) ?? framed;
}

/**
 * Turns the head: the eye stays.
 *
 * @param {View} view
 * @param {number} left  radians
 * @param {number} upwards  radians
 * @returns {View}
 */
export function look(view, left, upwards) {
    const sight = turned(view, left, upwards);
    return {...view, target: add(view.eye, scale(sight, distance(view))), up: UP};
}

/**
 * Shifts eye and target in the plane of the picture.
 *
 * @param {View} view
 * @param {number} x  heights of the picture to the right, at the target's distance
 * @param {number} y  heights of the picture upwards
 * @returns {View}
 */
export function pan(view, x, y) {
    const {right, up} = axes(view);
    const height = 2 * Math.tan(view.verticalFov / 2) * distance(view);
    const shift = add(scale(right, x * height), scale(up, y * height));
    return {...view, eye: add(view.eye, shift), target: add(view.target, shift)};
}

/**
 * Brings the eye nearer to the target (factor < 1) or further away.
 *
 * @param {View} view
 * @param {number} factor  of the distance
 * @param {number} farthest  limit of the distance, metres
 * @returns {View}
 */
export function dolly(view, factor, farthest) {
    const offset = sub(view.eye, view.target);
    const wanted = clamp(distance(view) * factor, MIN_DISTANCE, farthest);
    return {...view, eye: add(view.target, scale(normalise(offset), wanted))};
}

/**
 * Walks on the level: eye and target move together, forwards meaning where the view heads.
 *
 * @param {View} view
 * @param {number} forwards  metres
 * @param {number} rightwards  metres
 * @param {number} upwards  metres
 * @returns {View}
 */
export function walk(view, forwards, rightwards, upwards) {
    const {heading} = angles(view);
    const ahead = direction(heading, 0);
    const aside = direction(heading - Math.PI / 2, 0);
    const shift = add(add(scale(ahead, forwards), scale(aside, rightwards)), vec3(0, upwards, 0));
    return {...view, eye: add(view.eye, shift), target: add(view.target, shift)};
}

/** Height of the eyes of somebody who stands, metres. */
export const EYE_HEIGHT = 1.6;

/** As near does a view go to what it is sent to, and no nearer than a third of the way, metres. */
const ARRIVAL = 2;

/**
 * Where a double click on a surface takes the viewer. On a floor, to stand there, looking the same
 * way; before anything else, to look at it from nearby.
 *
 * @param {View} view
 * @param {Vec3} point  that was clicked
 * @param {Vec3} normal  of its surface
 * @param {boolean} walking  otherwise the view is to circle around the point
 * @returns {View}
 */
export function goTo(view, point, normal, walking) {
    const sight = normalise(sub(point, view.eye));
    const away = length(sub(point, view.eye));
    if (walking && normal.y > 0.9) {
        const {heading} = angles(view);
        const eye = vec3(point.x, point.y + EYE_HEIGHT, point.z);
        return {...view, eye, target: add(eye, direction(heading, 0)), up: UP};
    }
    const eye = sub(point, scale(sight, Math.max(Math.min(ARRIVAL, away), away / 3)));
    const steep = Math.abs(sight.y) > Math.cos(POLE_MARGIN);
    return {...view, eye: steep ? add(eye, vec3(0, 0, POLE_MARGIN * away)) : eye, target: point, up: UP};
}

/**
 * The same view from another height.
 *
 * @param {View} view
 * @param {number} y  of the eye, metres
 * @returns {View}
 */
export function atHeight(view, y) {
    return walk(view, 0, 0, y - view.eye.y);
}

/**
 * The same view straight ahead, neither up nor down. One along the vertical stays as it is.
 *
 * @param {View} view
 * @returns {View}
 */
export function levelled(view) {
    const {x, y, z} = sub(view.target, view.eye);
    const across = Math.hypot(x, z);
    const longer = across > 0 ? Math.hypot(across, y) / across : 0;
    return longer > 0 ? {...view, target: add(view.eye, vec3(x * longer, 0, z * longer)), up: UP} : view;
}

/**
 * View on the way from one to another.
 *
 * @param {View} from
 * @param {View} to
 * @param {number} time  0 is `from`, 1 is `to`
 * @returns {View}
 */
export function between(from, to, time) {
    if (time >= 1) {
        return to;
    }
    const t = time * time * (3 - 2 * time);
    const start = angles(from);
    const end = angles(to);
    // Turn the short way round.
    const turn = Math.atan2(
        Math.sin(end.heading - start.heading),
        Math.cos(end.heading - start.heading),
    );
    const sight = direction(
        start.heading + t * turn,
        start.elevation + t * (end.elevation - start.elevation),
    );
    const eye = mix(from.eye, to.eye, t);
    const reach = distance(from) * (1 - t) + distance(to) * t;
    const up = normalise(mix(from.up, to.up, t));
    const safe = length(cross(sight, up)) > 0.01;
    return {
        eye,
        target: add(eye, scale(sight, reach)),
        up: safe ? up : to.up,
        verticalFov: from.verticalFov * (1 - t) + to.verticalFov * t,
    };
}

/**
 * Whether two views show the same picture.
 *
 * @param {View} a
 * @param {View} b
 * @returns {boolean}
 */
export function sameView(a, b) {
    const parts = /** @type {const} */ (['eye', 'target', 'up']);
    const moved = parts.some((part) => length(sub(a[part], b[part])) > 0);
    return !moved && a.verticalFov === b.verticalFov && (a.near ?? 0) === (b.near ?? 0);
}
