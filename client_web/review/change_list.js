// SPDX-License-Identifier: Apache-2.0
// What has been changed in the scene, by whom, when, from what to what: everybody's, also before this page came.

import {nameOf} from './arrivals.js';
import {luminance, toHex, temperatureOf} from '../measure/colour.js';
import {byId, replaceRows, showValue} from '../ui/elements.js';
import {metres} from '../ui/format.js';
import {subjectOf} from '../scene/history.js';
import {deedOf} from '../scene/placement.js';
import {threeDigits} from '../ui/units.js';
import {completeTransform, length, matrixVector, scale, sub} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').SceneChanged} SceneChanged
 * @typedef {import('../scene/scene_model.js').SceneModel} SceneModel
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {object} LogEntry
 * @property {Date} time
 * @property {number} epoch
 * @property {number} before  epoch of the scene before it, and before the steps of a drag
 * @property {string} by  name of who has done it
 * @property {boolean} mine
 * @property {string} text  what has been done, in the past tense, e.g. "moved short box by 0.50 m"
 */

const MAX_ENTRIES = 1000;
/** So many are listed in the panel, the newest ones. */
const MAX_LISTED = 50;
/** A control that is in the hand changes again within so long, ms; as the server counts. */
const IN_HAND_MS = 2000;

/**
 * @param {LogEntry} entry
 * @returns {string} for who uses this page
 */
export const entryText = ({by, mine, text}) => `${mine ? 'You' : by} ${text}`;

/** Events: `change`. */
export class ChangeList extends EventTarget {
    /** Newest last. @type {SceneChanged[]} */
    #changes = [];
    #list = byId('changes', HTMLElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        super();
        this.app = app;
        app.on('sceneChanged', (change) => {
            this.#add(this.#completed(change));
            this.#show();
        });
        app.on('anew', () => {
            this.#changes = [];
            this.#show();
        });
        app.on('welcome', () => this.#ask());
    }

    /** Changes that are done, oldest first. @returns {LogEntry[]} */
    get entries() {
        const own = this.app.client.welcome?.viewer;
        const known = this.app.scene?.objects ?? [];
        const loaded = this.#loadedTransforms(known.flatMap(({id, loaded: then}) => (then ? [[id, completeTransform(then)]] : [])));
        return this.#changes
            .filter(({moveObject}) => moveObject?.final !== false)
            // Of what an animation has moved one row is enough.
            .filter((change, at, all) => !all.slice(at + 1).some((later) => sameRun(change, later)))
            .map((change) => ({
                time: new Date(change.atMs ?? 0),
                epoch: change.epoch,
                before: (change.firstEpoch ?? change.epoch) - 1,
                by: change.by === 0 ? 'The server' : nameOf({viewer: change.by, name: change.byName ?? ''}),
                mine: this.#isOwn(change, own),
                text: describeChange(this.app.scene, change, loaded.get(change.moveObject?.object ?? 0)),
            }));
    }

    /**
     * Where objects stood before all changes that are known: what `welcome` brings may be a restarted scene, and the first
     * changes may not be listed any more.
     *
     * @param {Iterable<[number, Required<Transform>]>} known
     * @returns {Map<number, Required<Transform>>}
     */
    #loadedTransforms(known = []) {
        const loaded = new Map(known);
        for (const {moveObject, objectBefore} of this.#changes) {
            if (moveObject && objectBefore && !loaded.has(moveObject.object)) {
                loaded.set(moveObject.object, completeTransform(objectBefore.transform));
            }
        }
        return loaded;
    }

    /**
     * Numbers of viewers begin anew when the server does; names stay.
     *
     * @param {SceneChanged} change
     * @param {number | undefined} own
     */
    #isOwn({by, byName}, own) {
        return by === own && (byName ?? '') === (this.app.client.welcome?.name ?? byName ?? '');
    }

    /** What has been changed before this page came, or while it was away. */
    async #ask() {
        // Servers of before know no history.
        const answer = await this.app.client.request({listChanges: {}}).answer.catch(() => null);
        if (answer?.changeHistory) {
            this.#changes = answer.changeHistory.changes;
            for (const [id, transform] of this.#loadedTransforms()) {
                const object = this.app.scene?.object(id);
                if (object) {
                    object.loaded = transform;
                }
            }
            this.#show();
            this.app.dispatchEvent(new CustomEvent('history'));
        }
    }

    /**
     * A change with what older servers do not tell.
     *
     * @param {SceneChanged} change
     * @returns {SceneChanged}
     */
    #completed(change) {
        const {moveObject, objectBefore, atMs} = change;
        const object = this.app.scene?.object(moveObject?.object);
        const before =
            objectBefore ?? (object ? {object: object.id, transform: object.earlier} : undefined);
        return {...change, objectBefore: before, atMs: atMs ?? Date.now()};
    }

    /** @param {SceneChanged} change */
    #add(change) {
        const {moveObject, objectBefore: then} = change;
        const moved = this.app.scene?.object(moveObject?.object);
        if (moved && then) {
            moved.loaded ??= completeTransform(then.transform);
        }
        const subject = subjectOf(change);
        const last = this.#changes.findLast((other) => subjectOf(other) === subject);
        const inHand = !change.moveObject && last === this.#changes.at(-1) && sinceOf(last, change) < IN_HAND_MS;
        const byHand = last?.by === change.by && !last.animation && !change.animation && (last.moveObject?.final === false || inHand);
        if (last && (byHand || sameRun(last, change))) {
            this.#changes.splice(this.#changes.indexOf(last), 1);
            const {objectBefore, lightBefore, materialBefore, daylightBefore} = last;
            change = {...change, objectBefore, lightBefore, materialBefore, daylightBefore, firstEpoch: last.firstEpoch ?? last.epoch};
        }
        this.#changes.push(change);
        this.#changes.splice(0, this.#changes.length - MAX_ENTRIES);
    }

    #show() {
        const entries = this.entries;
        const newest = entries.slice(-MAX_LISTED).reverse();
        showValue('lastChange', newest.length > 0 ? entryText(newest[0]) : '');
        const rows = newest.map((entry) => {
            const row = document.createElement('li');
            const when = document.createElement('time');
            when.dateTime = entry.time.toISOString();
            when.textContent = timeText(entry.time);
            row.append(when, ` ${entryText(entry)}`);
            return row;
        });
        replaceRows(this.#list, rows);
        byId('changes-none', HTMLElement).hidden = rows.length > 0;
        this.dispatchEvent(new Event('change'));
    }
}

/**
 * Whether an animation has made both since it was started or wound.
 *
 * @param {SceneChanged} a
 * @param {SceneChanged} b
 */
const sameRun = ({animation: a}, {animation: b}) => a && b && a.animation === b.animation && a.firstEpoch === b.firstEpoch;

/**
 * @param {SceneChanged | undefined} before
 * @param {SceneChanged} now
 */
const sinceOf = (before, now) => (now.atMs ?? 0) - (before?.atMs ?? 0);

/**
 * @param {Date} time
 * @returns {string} with the day, where it is not today
 */
export function timeText(time) {
    const today = time.toDateString() === new Date().toDateString();
    return time.toLocaleString([], today ? {timeStyle: 'short'} : {dateStyle: 'short', timeStyle: 'short'});
}

/**
 * @param {SceneModel | null} scene
 * @param {SceneChanged} change
 * @param {Required<Transform>} [loaded]  of the object that has moved; absent: as when the page opened
 * @returns {string} e.g. "dimmed LED panel: 100 → 50 %"
 */
export function describeChange(scene, change, loaded) {
    const {moveObject, setLight, setMaterial, setDaylight, objectBefore, lightBefore, materialBefore, animation} = change;
    if (animation) {
        return `played ${animation.animation} to ${animation.seconds.toFixed(2)}\u00a0s`;
    }
    if (setDaylight) {
        return describeDaylight(setDaylight);
    }
    if (moveObject) {
        return describeMove(scene?.object(moveObject.object) ?? null, moveObject, objectBefore, loaded);
    }
    const presence = describePresence(scene, change);
    if (presence) {
        return presence;
    }
    if (setLight) {
        return describeLight(scene?.lights.find(({id}) => id === setLight.light), setLight, lightBefore);
    }
    const material = scene?.materials.find(({id}) => id === setMaterial?.material);
    return describeMaterial(material?.name || 'a material', setMaterial, materialBefore);
}

/**
 * What has come or gone; empty: nothing.
 *
 * @param {SceneModel | null} scene
 * @param {SceneChanged} change
 */
function describePresence(scene, {addObject, removeObject, addLuminaire, removeLight}) {
    if (addObject) {
        return `added ${addObject.name || scene?.object(addObject.object)?.name || 'an object'}`;
    }
    if (addLuminaire) {
        const light = scene?.lights.find(({id}) => id === addLuminaire.light);
        return `added ${addLuminaire.name || light?.name || 'a light'}`;
    }
    if (removeObject) {
        return `removed ${scene?.goneNames.get(`object ${removeObject.object}`) || 'an object'}`;
    }
    return removeLight ? `removed ${scene?.goneNames.get(`light ${removeLight.light}`) || 'a light'}` : '';
}

/**
 * @param {import('../scene/scene_model.js').PlacedObject | null} object
 * @param {import('../net/scene_types.js').MoveObject} to
 * @param {import('../net/scene_types.js').MoveObject | undefined} from
 * @param {Required<Transform>} [loaded]
 */
function describeMove(object, to, from, loaded) {
    if (!object || !from) {
        return `moved ${object?.name ?? 'an object'}`;
    }
    const [before, after] = [completeTransform(from.transform), completeTransform(to.transform)];
    const original = loaded ?? object.original;
    const deed = deedOf(before, after, original);
    if (deed === 'put back') {
        return `put back ${object.name}`;
    }
    if (deed === 'resize') {
        const share = (/** @type {Required<import('../net/scene_types.js').Transform>} */ {scale}) =>
            Math.round((100 * length(scale)) / (length(original.scale) || 1));
        return `resized ${object.name}: ${share(before)} → ${share(after)} %`;
    }
    if (deed === 'turn') {
        const {rotation: p} = before;
        const {rotation: q} = after;
        const half = Math.min(Math.abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w), 1);
        return `turned ${object.name} by ${Math.round((360 / Math.PI) * Math.acos(half))}°`;
    }
    const place = (/** @type {Required<Transform>} */ transform) => {
        const {x, y, z} = object.baseAt(transform);
        return [x, y, z].map((value) => value.toFixed(2).replace('-', '−')).join(' ');
    };
    const by = length(matrixVector(object.worldFromParent, sub(after.translation, before.translation)));
    return `moved ${object.name} by ${metres(by)}: ${place(before)} → ${place(after)}\u00a0m`;
}

/** @param {import('../net/scene_types.js').SetDaylight} to */
function describeDaylight({sky, time}) {
    if (sky === 'loaded' || sky === 'none') {
        return sky === 'none' ? 'took the daylight away' : 'set the daylight as it was';
    }
    return `set the daylight: ${sky}${time ? `, ${time.slice(0, 16).replace('T', ' ')}` : ''}`;
}

/**
 * @param {import('../net/scene_types.js').Light | undefined} light
 * @param {import('../net/scene_types.js').SetLight} to
 * @param {import('../net/scene_types.js').SetLight | undefined} from
 */
function describeLight(light, to, from) {
    const name = light?.name || 'a light';
    if (!from) {
        return to.on === undefined ? `set ${name}` : `switched ${to.on ? 'on' : 'off'} ${name}`;
    }
    const parts = [];
    if (to.on !== undefined && to.on !== from.on) {
        parts.push(`switched ${to.on ? 'on' : 'off'} ${name}`);
    }
    const [before, after] = [from.intensity ?? 0, to.intensity ?? from.intensity ?? 0];
    if (!near(before, after)) {
        const whole = light?.loadedIntensity;
        const [one, unit] = whole ? [whole / 100, '%'] : [1, UNITS[light?.unit ?? ''] ?? ''];
        const value = (/** @type {number} */ intensity) =>
            whole ? String(Number((intensity / one).toPrecision(3))) : threeDigits(intensity / one);
        const verb = after < before ? 'dimmed' : 'brightened';
        parts.push(`${verb} ${name}: ${value(before)} → ${value(after)}\u00a0${unit}`.trimEnd());
    }
    if (to.colour && from.colour && !sameColour(to.colour, from.colour)) {
        parts.push(`changed the colour of ${name}: ${temperatureOf(from.colour)} → ${temperatureOf(to.colour)} K`);
    }
    parts.push(...describeControl(name, to, from));
    const slowly = to.fadeSeconds ? ` over ${Number(to.fadeSeconds.toFixed(1))}\u00a0s` : '';
    return parts.length > 0 ? parts.join(', ') + slowly : `set ${name} as it was`;
}

/**
 * What has changed beside the light's own brightness and colour.
 *
 * @param {string} name
 * @param {import('../net/scene_types.js').SetLight} to
 * @param {import('../net/scene_types.js').SetLight} from
 */
function describeControl(name, to, from) {
    const parts = [];
    const percent = (/** @type {number} */ share) => Math.round(100 * share);
    if (to.dim !== undefined && from.dim !== undefined && !near(to.dim, from.dim)) {
        parts.push(`set the dimmer of ${name}: ${percent(from.dim)} → ${percent(to.dim)}\u00a0%`);
    }
    if (to.position && from.position && length(sub(to.position, from.position)) > SAME) {
        parts.push(`moved ${name} by ${metres(length(sub(to.position, from.position)))}`);
    }
    const turned = to.rotation !== undefined && from.rotation !== undefined && !near(to.rotation, from.rotation);
    if ((to.aim && from.aim && length(sub(to.aim, from.aim)) > SAME) || turned) {
        parts.push(`aimed ${name}`);
    }
    if ((to.innerCone ?? from.innerCone) !== from.innerCone || (to.outerCone ?? from.outerCone) !== from.outerCone) {
        parts.push(`changed the beam of ${name}`);
    }
    if (to.group !== undefined && to.group !== from.group) {
        parts.push(to.group ? `put ${name} into the group ${to.group}` : `took ${name} out of its group`);
    }
    if ((to.maintenanceFactor ?? from.maintenanceFactor) !== from.maintenanceFactor) {
        parts.push(`set the maintenance factor of ${name} to ${Number(to.maintenanceFactor?.toFixed(3))}`);
    }
    if ((to.colourRendering ?? from.colourRendering) !== from.colourRendering) {
        parts.push(to.colourRendering
            ? `set Ra of ${name} to ${Number(to.colourRendering.toFixed(1))}`
            : `left Ra of ${name} to its file`);
    }
    return parts;
}

/** @type {Record<string, string>} */
const UNITS = {CD_PER_M2: 'cd/m²', CD: 'cd', LX: 'lx', LM: 'lm'};

/**
 * @param {string} name
 * @param {import('../net/scene_types.js').SetMaterial | undefined} to
 * @param {import('../net/scene_types.js').SetMaterial | undefined} from
 */
function describeMaterial(name, to, from) {
    if (!to || !from) {
        return `set ${name}`;
    }
    const parts = [];
    if (to.baseColour && from.baseColour && !sameColour(to.baseColour, from.baseColour)) {
        parts.push(`painted ${name}: ${paintText(from.baseColour, to.baseColour)}`);
    }
    for (const part of /** @type {const} */ (['roughness', 'metallic'])) {
        const [before, after] = [from[part], to[part]];
        if (before !== undefined && after !== undefined && !near(before, after)) {
            parts.push(`set the ${part} of ${name}: ${before.toFixed(2)} → ${after.toFixed(2)}`);
        }
    }
    return parts.join(', ') || `set ${name} as it was`;
}

/**
 * Reflectances, as the card of a material has them, and the colours where these differ in more.
 *
 * @param {import('../net/scene_types.js').Vec3} before
 * @param {import('../net/scene_types.js').Vec3} after
 */
function paintText(before, after) {
    const percent = (/** @type {import('../net/scene_types.js').Vec3} */ colour) => (100 * luminance(colour)).toFixed(0);
    const sameHue = sameColour(scale(before, luminance(after)), scale(after, luminance(before)));
    return sameHue && percent(before) !== percent(after)
        ? `${percent(before)} → ${percent(after)}\u00a0%`
        : `${toHex(before)} → ${toHex(after)}, ${percent(before)} → ${percent(after)}\u00a0%`;
}

/** Relative difference of numbers that are the same but for single precision. */
const SAME = 1e-4;

/** @type {(a: number, b: number) => boolean} */
const near = (a, b) => Math.abs(a - b) <= SAME * Math.max(Math.abs(a), Math.abs(b));

/** @type {(a: import('../net/scene_types.js').Vec3, b: import('../net/scene_types.js').Vec3) => boolean} */
const sameColour = (a, b) => near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z);
