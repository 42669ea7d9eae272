// SPDX-License-Identifier: Apache-2.0
// Links to what somebody sees: camera, exposure, mode and selection, after the address's `#`, which no
// browser sends over the network. A token is never part of a link.

/**
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../measure/display_panel.js').DisplayMode} DisplayMode
 * @typedef {object} Shared
 * @property {View | null} view
 * @property {number | null} exposure  EV; null: automatic
 * @property {DisplayMode} mode
 * @property {number | null} selected  Object.id
 */

const MODES = ['PHOTO', 'FALSE_LUMINANCE', 'FALSE_ILLUMINANCE'];

/** @type {(value: number) => string} */
const short = (value) => String(Number(value.toFixed(4)));

/**
 * @param {Shared} shared
 * @returns {string} to come after `#`
 */
export function toHash({view, exposure, mode, selected}) {
    const parts = new URLSearchParams();
    if (view) {
        const {eye, target, up, verticalFov} = view;
        const numbers = [eye, target, up].flatMap(({x, y, z}) => [x, y, z]);
        parts.set('view', [...numbers, verticalFov].map(short).join(','));
    }
    if (exposure !== null) {
        parts.set('ev', short(exposure));
    }
    if (mode !== 'PHOTO') {
        parts.set('show', mode);
    }
    if (selected !== null) {
        parts.set('object', String(selected));
    }
    return parts.toString();
}

/**
 * @param {string} hash  with or without `#`
 * @returns {Shared} with what it says and is valid
 */
export function fromHash(hash) {
    const parts = new URLSearchParams(hash.replace(/^#/, ''));
    const numbers = (parts.get('view') ?? '').split(',').map(Number);
    const [x, y, z, tx, ty, tz, ux, uy, uz, verticalFov] = numbers;
    const away = Math.hypot(tx - x, ty - y, tz - z);
    const valid =
        numbers.length === 10 &&
        numbers.every((value) => Number.isFinite(value) && Math.abs(value) < 1e9) &&
        away > 1e-6 &&
        Math.hypot(ux, uy, uz) > 1e-6 &&
        verticalFov >= 0.001 &&
        verticalFov <= 3.14;
    const view = valid
        ? {
              eye: {x, y, z},
              target: {x: tx, y: ty, z: tz},
              up: {x: ux, y: uy, z: uz},
              verticalFov,
          }
        : null;
    const mode = parts.get('show') ?? 'PHOTO';
    const exposure = parts.has('ev') ? Number(parts.get('ev')) : null;
    const selected = parts.has('object') ? Number(parts.get('object')) : null;
    return {
        view,
        exposure: exposure !== null && Math.abs(exposure) <= 30 ? exposure : null,
        mode: /** @type {DisplayMode} */ (MODES.includes(mode) ? mode : 'PHOTO'),
        selected: Number.isInteger(selected) ? selected : null,
    };
}
