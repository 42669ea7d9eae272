// SPDX-License-Identifier: Apache-2.0
// Where people stand: on top of slabs, not at their undersides, where the box of a storey begins.

/**
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** A slab is no thicker, metres. */
const MOST_THICK = 0.6;
/** Nor thicker than such a share of its shorter side. */
const MOST_THICK_SHARE = 0.25;
/** Slabs of one floor differ by less, metres. */
const LEVEL = 0.05;
/** A floor takes at least such a share of the area above it. */
const LEAST_SHARE = 0.15;
/** What lies on a slab is no thicker, metres. */
const MOST_BUILT_UP = 0.3;
/** The floor of a storey is no higher above its lowest part, metres; what is higher is a ceiling. */
const MOST_ABOVE_FOOT = 1;

/** @param {Bounds} bounds */
const areaOf = ({min, max}) => (max.x - min.x) * (max.z - min.z);

/** @param {Bounds} bounds */
function lies({min, max}) {
    const thick = max.y - min.y;
    return thick <= MOST_THICK && thick <= MOST_THICK_SHARE * Math.min(max.x - min.x, max.z - min.z);
}

/** @param {PlacedObject} object */
const isSlab = ({kind, movable, bounds}) => (kind === 'STRUCTURE' || !movable) && lies(bounds);

/**
 * Of a slab, what of it lies below or above an area.
 *
 * @param {Bounds} slab
 * @param {Bounds} bounds
 */
function shared(slab, bounds) {
    const x = Math.min(slab.max.x, bounds.max.x) - Math.max(slab.min.x, bounds.min.x);
    const z = Math.min(slab.max.z, bounds.max.z) - Math.max(slab.min.z, bounds.min.z);
    return Math.max(x, 0) * Math.max(z, 0);
}

/**
 * The floors below an area, the lowest first: tops of parts of the building that lie flat, and together take
 * a good part of the area.
 *
 * @param {readonly PlacedObject[]} objects
 * @param {Bounds} bounds
 * @returns {{height: number, area: number}[]} metres, square metres
 */
function floorsIn(objects, bounds) {
    const slabs = objects
        .filter((object) => isSlab(object) && shared(object.bounds, bounds) > 0)
        .sort((a, b) => a.bounds.max.y - b.bounds.max.y);
    /** @type {{height: number, area: number}[]} */
    const levels = [];
    for (const {bounds: slab} of slabs) {
        const last = levels.at(-1);
        const area = shared(slab, bounds);
        if (last && slab.max.y - last.height < LEVEL) {
            last.area += area;
            last.height = slab.max.y;
        } else {
            levels.push({height: slab.max.y, area});
        }
    }
    return levels.filter(({area}) => area >= LEAST_SHARE * areaOf(bounds));
}

/**
 * Height of the floor of the whole scene or of a storey: of its lowest floor.
 *
 * @param {readonly PlacedObject[]} objects  of the scene, or of the storey
 * @param {Bounds} bounds  of all of them
 * @returns {number | null} metres; null: no object is one
 */
export function lowestFloor(objects, bounds) {
    const highest = Math.min(bounds.min.y + MOST_ABOVE_FOOT, bounds.max.y - LEVEL);
    const [lowest, ...others] = floorsIn(objects, bounds).filter(({height}) => height < highest);
    let floor = lowest;
    for (const other of others) {  // what lies on most of a slab is stood on: screed, a raised floor
        const builtUp = floor && other.height - floor.height <= MOST_BUILT_UP && other.area >= 0.5 * floor.area;
        floor = builtUp ? other : floor;
    }
    return floor?.height ?? null;
}

/**
 * Height of the floor that something stands on, or hangs above. What is a floor itself is stood on.
 *
 * @param {readonly PlacedObject[]} objects
 * @param {Bounds} bounds  of it
 * @returns {number | null} metres; null: no object is one
 */
export function floorBelow(objects, bounds) {
    const foot = lies(bounds) ? bounds.max.y : bounds.min.y;
    return floorsIn(objects, bounds).findLast(({height}) => height <= foot + LEVEL)?.height ?? null;
}

/**
 * Underside of what lies flat straight above a point.
 *
 * @param {readonly PlacedObject[]} objects
 * @param {import('../net/scene_types.js').Vec3} point
 * @returns {number | null} height, metres; null: no object is there
 */
export function ceilingAbove(objects, {x, y, z}) {
    const undersides = objects
        .filter(isSlab)
        .filter(({bounds: {min, max}}) => min.y > y && x >= min.x && x <= max.x && z >= min.z && z <= max.z)
        .map(({bounds}) => bounds.min.y);
    return undersides.length > 0 ? Math.min(...undersides) : null;
}
