// SPDX-License-Identifier: Apache-2.0
// What stands around somebody who walks, as the server's cells tell it, and where a step among them ends. Pure maths:
// world space, metres.

import {add, length, scale, sub, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/protocol.js').WalkMap} WalkMap
 */

/** Half of the width that a person takes. */
const BODY = 0.2;
/** What one steps over or onto: two risers of steep stairs. */
const KNEE = 0.4;
/** From the eye to the top of the head. */
const ABOVE_EYE = 0.1;
/** Eyes of those who stand are within these heights above a floor; others fly. */
const LOWEST_EYE = 0.5;
const HIGHEST_EYE = 2.2;
/** What flies keeps off by this much upwards and downwards. */
const FLYING = 0.15;
/** A way is gone by pieces of this length. */
const PIECE = 0.05;
/** Directions in which one slides along what is in the way, degrees from the way. */
const SLIDES = [0, 15, -15, 30, -30, 45, -45, 60, -60, 75, -75, 88, -88];
/** On stairs the eye follows the floor by so many metres a metre walked. */
const FOLLOWING = 1.5;

export class WalkGrid {
    /** @param {WalkMap} map */
    constructor({origin, cell, layer, columns, layers, occupied, floor}) {
        this.origin = origin;
        this.cell = cell;
        this.layer = layer;
        this.columns = columns;
        this.layers = layers;
        const bytes = Uint8Array.from(atob(occupied), (c) => c.charCodeAt(0));
        /** Two words of 32 bits a column, the lower layers first. */
        this.words = new Uint32Array(bytes.buffer);
        /** Exact height of what is straight below the eye that the cells were asked for. */
        this.middleFloor = floor ?? null;
    }

    /**
     * Height of what one would stand on under a point: exact under the middle, elsewhere as the cells differ from there.
     *
     * @param {Vec3} eye
     * @returns {number | null} null: nothing is below, or it is not known
     */
    under(eye) {
        const middle = this.middleFloor;
        if (middle === null || !this.covers(eye)) {
            return null;
        }
        const [here, there] = [this.floor(eye.x, eye.z, eye.y), this.floor(this.middle.x, this.middle.z, middle + this.layer)];
        return here === null || there === null ? middle : middle + here - there;
    }

    /** Eye that the cells were asked for: the middle, in x and z. */
    get middle() {
        const half = (this.columns * this.cell) / 2;
        return add(this.origin, vec3(half, (this.layers * this.layer) / 2, half));
    }

    /**
     * Whether cells tell of the surroundings of a point.
     *
     * @param {Vec3} point
     */
    covers({x, z}) {
        const last = this.columns * this.cell - BODY;
        const inside = (/** @type {number} */ at) => at > BODY && at < last;
        return inside(x - this.origin.x) && inside(z - this.origin.z);
    }

    /**
     * Whether something is in a column between two heights.
     *
     * @param {number} column
     * @param {number} row
     * @param {number} low
     * @param {number} high
     */
    #taken(column, row, low, high) {
        if (column < 0 || row < 0 || column >= this.columns || row >= this.columns) {
            return false;
        }
        const first = Math.max(Math.ceil((low - this.origin.y) / this.layer), 0);
        const end = Math.min(Math.floor((high - this.origin.y) / this.layer), this.layers);
        const at = 2 * (row * this.columns + column);
        for (let k = first; k < end; ++k) {
            if ((this.words[at + (k >> 5)] >>> (k & 31)) & 1) {
                return true;
            }
        }
        return false;
    }

    /**
     * Horizontal distance to the nearest thing between two heights.
     *
     * @param {number} x
     * @param {number} z
     * @param {number} low
     * @param {number} high
     * @returns {number} metres; Infinity: nothing is within BODY
     */
    room(x, z, low, high) {
        const u = (x - this.origin.x) / this.cell;
        const v = (z - this.origin.z) / this.cell;
        const reach = BODY / this.cell;
        let nearest = Infinity;
        for (let row = Math.floor(v - reach); row <= Math.floor(v + reach); ++row) {
            for (let column = Math.floor(u - reach); column <= Math.floor(u + reach); ++column) {
                // To the nearest point of the cell.
                const du = Math.max(column - u, u - column - 1, 0);
                const dv = Math.max(row - v, v - row - 1, 0);
                const distance = Math.hypot(du, dv);
                if (distance <= reach && distance < nearest && this.#taken(column, row, low, high)) {
                    nearest = distance;
                }
            }
        }
        return nearest * this.cell;
    }

    /**
     * Top of what is highest below a height, under a point.
     *
     * @param {number} x
     * @param {number} z
     * @param {number} below
     * @returns {number | null} null: nothing is, as far as the cells tell
     */
    floor(x, z, below) {
        const column = Math.floor((x - this.origin.x) / this.cell);
        const row = Math.floor((z - this.origin.z) / this.cell);
        const top = Math.min(Math.floor((below - this.origin.y) / this.layer), this.layers);
        for (let k = top; k > 0; --k) {
            const y = this.origin.y + k * this.layer;
            if (this.#taken(column, row, y - this.layer - 1e-6, y + 1e-6)) {
                return y;
            }
        }
        return null;
    }

    /**
     * How far one comes on a straight line before something is in the way.
     *
     * @param {Vec3} from
     * @param {Vec3} to
     * @returns {Vec3}
     */
    reached(from, to) {
        const way = sub(to, from);
        const pieces = Math.ceil(length(way) / PIECE);
        const room = (/** @type {Vec3} */ {x, y, z}) => this.room(x, z, y - FLYING, y + FLYING);
        let there = from;
        for (let i = 1; i <= pieces; ++i) {
            const next = add(from, scale(way, i / pieces));
            if (!this.covers(next) || !noCloser(room(next), room(there))) {
                break;
            }
            there = next;
        }
        return there;
    }
}

/**
 * Whether a step may lead from one place to another. Cells made anew lie elsewhere by less than one, so that who stood
 * at a wall may stand a little within what it takes: he goes on along it or off it, not through. Who is right within
 * something goes where he likes, to come out.
 *
 * @param {number} there  room, metres
 * @param {number} here  room, metres
 */
const noCloser = (there, here) => there >= here - 1e-9 || there === Infinity;

/** Somebody who walks: what height his eyes have above the floor. */
export class Walker {
    /** Null: he flies, or nothing is known. @type {number | null} */
    height = null;

    /**
     * Takes somebody who stands, or flies, where he is.
     *
     * @param {WalkGrid} grid
     * @param {Vec3} eye
     */
    stand(grid, eye) {
        const floor = grid.floor(eye.x, eye.z, eye.y - LOWEST_EYE);
        const height = floor === null ? Infinity : eye.y - floor;
        this.height = height <= HIGHEST_EYE ? height : null;
    }

    /**
     * @param {WalkGrid} grid
     * @param {Vec3} eye
     * @param {number} feet
     * @returns {number} metres; Infinity: nothing is near
     */
    #room(grid, eye, feet) {
        return this.height === null
            ? grid.room(eye.x, eye.z, eye.y - FLYING, eye.y + FLYING)
            : grid.room(eye.x, eye.z, feet + KNEE, feet + this.height + ABOVE_EYE);
    }

    /**
     * Goes a way over the floor, along what is in the way, up and down steps.
     *
     * @param {WalkGrid} grid
     * @param {Vec3} from  eye
     * @param {{x: number, z: number}} way  metres
     * @returns {Vec3} eye
     */
    walk(grid, from, way) {
        const far = Math.hypot(way.x, way.z);
        const pieces = Math.ceil(far / PIECE);
        let eye = from;
        for (let i = 0; i < pieces; ++i) {
            const next = this.#piece(grid, eye, way.x / pieces, way.z / pieces);
            if (!next) {
                break;
            }
            eye = next;
        }
        return eye;
    }

    /**
     * @param {WalkGrid} grid
     * @param {Vec3} eye
     * @param {number} dx
     * @param {number} dz
     * @returns {Vec3 | null} null: there is no way on
     */
    #piece(grid, eye, dx, dz) {
        const feet = eye.y - (this.height ?? 0);
        const room = this.#room(grid, eye, feet);
        for (const degrees of SLIDES) {
            const angle = (degrees * Math.PI) / 180;
            const [c, s] = [Math.cos(angle), Math.sin(angle)];
            const x = eye.x + c * (c * dx - s * dz);
            const z = eye.z + c * (s * dx + c * dz);
            if (!grid.covers({x, y: 0, z})) {
                return null;
            }
            const floor = this.height === null ? null : grid.floor(x, z, feet + KNEE);
            const stands = floor ?? feet;
            const there = vec3(x, eye.y, z);
            if (noCloser(this.#room(grid, there, Math.max(stands, feet)), room)) {
                return this.height === null ? there : vec3(x, this.#follow(eye.y, stands, dx, dz), z);
            }
        }
        return null;
    }

    /**
     * Height of the eye, on its way to where the floor has it.
     *
     * @param {number} y
     * @param {number} floor
     * @param {number} dx
     * @param {number} dz
     */
    #follow(y, floor, dx, dz) {
        const wanted = floor + (this.height ?? 0);
        const most = FOLLOWING * Math.hypot(dx, dz);
        return y + Math.min(Math.max(wanted - y, -most), most);
    }
}
