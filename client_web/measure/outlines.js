// SPDX-License-Identifier: Apache-2.0
// Maths of areas in the picture: the part of a polygon before the eye, the cells of a grid, the colours of ratings.

import {verdictSign} from './zones.js';
import {add, mix, scale, sub} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {{x: number, y: number, depth: number}} Placed  CSS pixels, metres
 */

/** Points nearer to the eye's plane are cut off, metres. */
const NEAR = 0.02;
/** Longer names are shortened over the picture, characters. */
const NAME_LENGTH = 28;

/**
 * The part of a polygon that lies before the eye, in the picture.
 *
 * @param {Vec3[]} corners
 * @param {(point: Vec3) => Placed} place
 * @returns {Placed[]} empty: none of it does
 */
export function partBeforeEye(corners, place) {
    return corners.flatMap((corner, i) => {
        const next = corners[(i + 1) % corners.length];
        const [here, there] = [place(corner), place(next)];
        const seen = here.depth >= NEAR;
        // Depth is linear along an edge.
        const cut = seen === there.depth >= NEAR
            ? []
            : [place(mix(corner, next, (NEAR - here.depth) / (there.depth - here.depth)))];
        return seen ? [here, ...cut] : cut;
    });
}

/** SVG path of a polygon. @type {(corners: Placed[]) => string} */
export const pathOf = (corners) =>
    corners.length < 3 ? '' : `M${corners.map(({x, y}) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}Z`;

/**
 * Where the name of an outline stands: over the middle of its uppermost edge, within the picture.
 *
 * @param {Placed[]} corners
 * @param {number} width  of the picture, CSS pixels
 * @param {number} height
 * @returns {{x: number, y: number} | null}  null: nothing of the outline is in the picture
 */
export function nameSpot(corners, width, height) {
    const [xs, ys] = [corners.map(({x}) => x), corners.map(({y}) => y)];
    const beside = Math.max(...xs) < 0 || Math.min(...xs) > width || Math.max(...ys) < 0 || Math.min(...ys) > height;
    if (corners.length < 3 || beside) {
        return null;
    }
    const middles = corners.map((corner, i) => {
        const next = corners[(i + 1) % corners.length];
        return {x: (corner.x + next.x) / 2, y: (corner.y + next.y) / 2};
    });
    const top = middles.reduce((best, middle) => (middle.y < best.y ? middle : best));
    const within = (/** @type {number} */ value, /** @type {number} */ margin, /** @type {number} */ most) =>
        Math.min(Math.max(value, margin), Math.max(most - margin, margin));
    return {x: within(top.x, 60, width), y: within(top.y - 6, 16, height)};
}

/**
 * What stands at a zone's outline.
 *
 * @param {Measured} zone
 * @returns {string} e.g. "✓ Desk by the window"
 */
export function zoneLabel({name = '', verdict}) {
    const characters = [...name];
    const shown = characters.length > NAME_LENGTH ? `${characters.slice(0, NAME_LENGTH - 1).join('')}…` : name;
    return `${verdictSign(verdict)} ${shown}`.trim();
}

/**
 * The part of an area that each point of its grid stands for.
 *
 * @param {Measured} result
 * @returns {Vec3[][]} four corners each, as the points come; empty: of single points and of polygons, whose points are
 *     no whole grid
 */
export function gridCells({columns, rows, points, outline}) {
    if (!outline || outline.length !== 4 || columns * rows !== points.length) {
        return [];
    }
    const [origin, alongEnd, , acrossEnd] = outline;
    const across = scale(sub(acrossEnd, origin), 1 / rows);
    const along = scale(sub(alongEnd, origin), 1 / columns);
    const at = (/** @type {number} */ column, /** @type {number} */ row) =>
        add(origin, add(scale(along, column), scale(across, row)));
    return points.map((_, i) => {
        const [column, row] = [i % columns, Math.floor(i / columns)];
        return [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
    });
}

/** Limits of UGR in the tables of EN 12464-1. */
export const GLARE_LIMITS = [10, 13, 16, 19, 22, 25, 28];

/**
 * Colour of a glare rating, by the smallest limit that it keeps: darker where it glares more, so that no hue need be told
 * from another.
 *
 * @param {number} rating  UGR
 * @returns {string} CSS colour
 */
export function glareColour(rating) {
    const kept = GLARE_LIMITS.findIndex((limit) => rating <= limit);
    const share = (kept < 0 ? GLARE_LIMITS.length : kept) / GLARE_LIMITS.length;
    return `hsl(${Math.round(60 - 60 * share)} 90% ${Math.round(85 - 55 * share)}%)`;
}
