// SPDX-License-Identifier: Apache-2.0
// Who else is here: names and colours, where they look, following them, and showing them a place.

import {Arrivals, nameOf} from './arrivals.js';
import {axes, framedFov} from '../camera/camera.js';
import {byId, listRow, replaceRows, smallButton} from '../ui/elements.js';
import {svgElement} from '../ui/svg.js';
import {add, length, scale, sub} from '../ui/vector.js';
import {remember} from '../camera/walking.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../picture/marks.js').Marks} Marks
 * @typedef {import('../net/protocol.js').Viewer} Viewer
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../picture/overlay.js').OverlayFrame} OverlayFrame
 */

/** Colours that are told apart, on dark and on light. */
export const PEOPLE_COLOURS = Object.freeze([
    '#4f9bd9',
    '#d9774f',
    '#5fae6b',
    '#b57ad1',
    '#c9a227',
    '#d65c8a',
    '#3aa6a0',
    '#8c8f3a',
]);

/** Size of the pyramid that stands for a camera, as a share of the distance to what it looks at. */
const FRUSTUM_SHARE = 0.2;
const LARGEST_FRUSTUM = 0.6;
/** How long a place that somebody shows is marked, ms. */
const POINTED_MS = 8000;
/** Cameras this near to the own one would fill the picture, metres. */
const TOO_NEAR = 0.3;

/** @type {(viewer: number) => string} */
export const colourOf = (viewer) => PEOPLE_COLOURS[viewer % PEOPLE_COLOURS.length];

/** @type {(name: string) => string} */
const initials = (name) => {
    const words = name.split(/\s+/).filter(Boolean);
    const letters = words.length > 1 ? words[0][0] + words[words.length - 1][0] : name.slice(0, 2);
    return letters.toUpperCase();
};

/**
 * A few letters for each that tell all apart: initials, or the number of who has no name or the same ones.
 *
 * @param {{viewer: number, name: string}[]} viewers
 * @returns {string[]}
 */
export function avatarTexts(viewers) {
    const letters = viewers.map(({viewer, name}) => (name.trim() ? initials(name) : String(viewer)));
    return letters.map((text, i) =>
        letters.indexOf(text) === letters.lastIndexOf(text) ? text : String(viewers[i].viewer),
    );
}

/**
 * Corners of a pyramid that shows where a camera stands and looks.
 *
 * @param {Viewer} viewer
 * @returns {{eye: Vec3, corners: Vec3[]}}
 */
export function frustumOf({eye, target, up, verticalFov, aspect}) {
    const view = {eye, target, up: up ?? {x: 0, y: 1, z: 0}, verticalFov};
    const {right, up: upwards, forward} = axes(view);
    const depth = Math.min(FRUSTUM_SHARE * length(sub(target, eye)), LARGEST_FRUSTUM);
    const height = Math.tan(verticalFov / 2) * depth;
    const middle = add(eye, scale(forward, depth));
    const corners = [
        [-1, -1],
        [1, -1],
        [1, 1],
        [-1, 1],
    ].map(([x, y]) =>
        add(middle, add(scale(right, x * height * aspect), scale(upwards, y * height))),
    );
    return {eye, corners};
}

export class People {
    /** Everybody, this viewer included. @type {Viewer[]} */
    viewers = [];
    #arrivals = new Arrivals();
    #crowded = false;
    /** Whether this page has been in before. */
    #welcomed = false;
    #leaderName = '';
    /** Viewer whose camera is shown, 0: the own one. */
    following = 0;
    /** What the list shows. */
    #listed = '';
    /** Names in the picture, by number. @type {Map<number, HTMLElement>} */
    #names = new Map();

    /**
     * @param {RaybundleApp} app
     * @param {Marks} marks
     */
    constructor(app, marks) {
        this.app = app;
        this.marks = marks;
        this.group = app.overlay.group('people');
        app.overlay.add((frame) => this.#draw(frame));
        app.on('message', (/** @type {import('../net/protocol.js').ServerMessage} */ message) => {
            if (message.presence) {
                this.#update(message.presence.viewers);
                this.#tellCrowd(message.presence.crowded ?? false);
            }
            if (message.pointed) {
                this.#pointed(message.pointed.by, message.pointed.position);
            }
        });
        app.on('welcome', () => {
            this.following = 0;
            this.#showOwnName();
            if (this.#welcomed) {
                this.#arrivals.begin(performance.now());
            }
            this.#welcomed = true;
        });
        app.on('view', () => {
            if (this.following && !app.link.led) {
                this.following = 0; // who moves himself no longer follows; the server knows
                this.#showList();
            }
        });
        this.#addNameForm();
    }

    /** Number of this viewer. */
    get own() {
        return this.app.client.welcome?.viewer ?? 0;
    }

    /**
     * @param {number} viewer
     * @returns {string} its name, for people
     */
    name(viewer) {
        if (viewer === this.own) {
            return 'You';
        }
        const found = this.viewers.find((other) => other.viewer === viewer);
        return found ? nameOf(found) : viewer === 0 ? 'The server' : `Viewer ${viewer}`;
    }

    /**
     * Takes over somebody's camera.
     *
     * @param {number} viewer  0: nobody's
     */
    async follow(viewer) {
        if (await this.app.ask({follow: {viewer}})) {
            this.following = viewer;
            this.#leaderName = this.name(viewer);
            this.app.link.led = viewer !== 0;
            this.#showList();
            this.#lead();
        }
    }

    /**
     * Shows the others a place.
     *
     * @param {Vec3} position
     */
    async pointAt(position) {
        if (await this.app.ask({pointAt: {position}})) {
            this.#pulse(position, colourOf(this.own), 'Shown to the others');
        }
    }

    /** The name that others see; a token's cannot be changed here. */
    #showOwnName() {
        const {settings, welcome} = this.app.client;
        const shown = welcome?.name;
        const fixed = shown !== undefined && shown !== (settings.name ?? '').trim();
        const name = byId('own-name', HTMLInputElement);
        name.value = shown ?? settings.name ?? '';
        name.disabled = fixed;
        const button = byId('name-form', HTMLFormElement).querySelector('button');
        if (button) {
            button.hidden = fixed;
        }
        byId('name-note', HTMLElement).hidden = !fixed;
    }

    /** @param {boolean} crowded  time is short for so many */
    #tellCrowd(crowded) {
        if (crowded && !this.#crowded) {
            const {length: count} = this.viewers;
            this.app.status.notify(`${count} people share this server: pictures now come less often for everybody.`);
        }
        this.#crowded = crowded;
    }

    #addNameForm() {
        const name = byId('own-name', HTMLInputElement);
        name.value = this.app.client.settings.name ?? '';
        byId('name-form', HTMLFormElement).addEventListener('submit', (event) => {
            event.preventDefault();
            const text = name.value.trim();
            remember('name', text);
            this.app.client.settings.name = text;
            this.app.client.connect();
        });
    }

    /** @param {Viewer[]} viewers */
    #update(viewers) {
        this.viewers = viewers;
        const others = viewers.filter(({viewer}) => viewer !== this.own);
        for (const name of this.#arrivals.note(others, performance.now())) {
            this.app.status.notify(`${name} has joined.`);
        }
        const self = viewers.find(({viewer}) => viewer === this.own);
        if (self && this.following && self.following === 0) {
            if (this.app.link.led) {
                this.app.status.notify(`You stopped following ${this.#leaderName}.`);
            }
            this.following = 0;
            this.app.link.led = false;
        }
        this.#showList();
        this.#lead();
        this.app.drawOverlay();
    }

    /** Shows what the leader sees. */
    #lead() {
        const leader = this.viewers.find(({viewer}) => viewer === this.following);
        if (leader && this.app.link.led) {
            const {eye, target, up, verticalFov} = leader;
            this.app.adopt({eye, target, up: up ?? {x: 0, y: 1, z: 0}, verticalFov});
        }
    }

    #showList() {
        // Cameras move many times a second; a button must not vanish under a finger.
        const state = this.viewers.map(({viewer, name, role, following}) => [viewer, name, role, following]);
        const now = JSON.stringify([this.own, this.following, state]);
        if (now === this.#listed) {
            return;
        }
        this.#listed = now;
        const others = this.viewers.filter(({viewer}) => viewer !== this.own);
        const rows = this.viewers.map((viewer) => {
            const self = viewer.viewer === this.own;
            const follows = viewer.following ? `follows ${this.name(viewer.following)}` : '';
            const role = viewer.role.toLowerCase();
            const tag = self ? role : [role, follows].filter(Boolean).join(', ');
            const name = self ? `You${viewer.name ? `, ${viewer.name}` : ''}` : nameOf(viewer);
            const go = () => this.#goToView(viewer);
            const row = listRow(name, self ? () => {} : go, tag);
            row.style.setProperty('--person', colourOf(viewer.viewer));
            row.classList.add('person');
            if (!self) {
                const on = this.following === viewer.viewer;
                const text = on ? 'Stop' : 'Follow';
                const button = smallButton(text, `${text} ${on ? 'following ' : ''}${name}`, () =>
                    this.follow(on ? 0 : viewer.viewer),
                );
                button.dataset.follow = String(viewer.viewer);
                row.append(button);
            }
            return row;
        });
        replaceRows(byId('people', HTMLElement), rows);
        const texts = avatarTexts(others);
        const avatars = others.slice(0, 5).map((viewer, i) => {
            const item = document.createElement('li');
            const on = this.following === viewer.viewer;
            const name = nameOf(viewer);
            const label = `${on ? 'Stop following' : 'Follow'} ${name}`;
            const button = smallButton(texts[i], label, () =>
                this.follow(on ? 0 : viewer.viewer),
            );
            button.style.setProperty('--person', colourOf(viewer.viewer));
            button.setAttribute('aria-pressed', String(on));
            item.append(button);
            return item;
        });
        replaceRows(byId('avatars', HTMLElement), avatars);
        this.app.picture.element.classList.toggle('following', this.following !== 0);
        this.app.picture.element.style.setProperty('--leader', colourOf(this.following));
    }

    /** @param {Viewer} viewer */
    #goToView({eye, target, up, verticalFov}) {
        const fov = framedFov(verticalFov, this.app.picture.aspect);
        this.app.camera.flyTo({eye, target, up: up ?? {x: 0, y: 1, z: 0}, verticalFov: fov});
    }

    /**
     * @param {number} by
     * @param {Vec3} position
     */
    #pointed(by, position) {
        const name = this.name(by);
        this.#pulse(position, colourOf(by), name);
        const {view} = this.app;
        this.app.status.notify(`${name}: look here.`, 'notice', {
            label: 'Look',
            run: () => this.app.camera.flyAround({...view, target: position}),
        });
    }

    /**
     * Marks a place for a while.
     *
     * @param {Vec3} position
     * @param {string} colour
     * @param {string} text
     */
    #pulse(position, colour, text) {
        const mark = document.createElement('div');
        mark.className = 'pointed';
        mark.style.setProperty('--person', colour);
        mark.textContent = text;
        this.marks.add(mark, () => position);
        setTimeout(() => this.marks.remove(mark), POINTED_MS);
    }

    /** @param {OverlayFrame} frame */
    #draw({view, place}) {
        const others = this.viewers.filter(
            (viewer) =>
                viewer.viewer !== this.own &&
                viewer.viewer !== this.following &&
                length(sub(viewer.eye, view.eye)) > TOO_NEAR,
        );
        const paths = others.map((viewer) => {
            const {eye, corners} = frustumOf(viewer);
            const points = [eye, ...corners].map(place);
            const path = svgElement('path');
            if (points.every(({depth}) => depth > 0.05)) {
                const [tip, a, b, c, d] = points.map(({x, y}) => `${x.toFixed(1)} ${y.toFixed(1)}`);
                const sides = [a, b, c, d].map((corner) => `M${tip}L${corner}`).join('');
                path.setAttribute('d', `M${a}L${b}L${c}L${d}Z${sides}`);
            }
            path.setAttribute('stroke', colourOf(viewer.viewer));
            return path;
        });
        this.group.replaceChildren(...paths);
        this.#drawNames(others);
    }

    /** @param {Viewer[]} others */
    #drawNames(others) {
        for (const [viewer, element] of this.#names) {
            if (!others.some((other) => other.viewer === viewer)) {
                this.marks.remove(element);
                this.#names.delete(viewer);
            }
        }
        for (const viewer of others) {
            let element = this.#names.get(viewer.viewer);
            if (!element) {
                element = document.createElement('div');
                element.className = 'person-name';
                element.style.setProperty('--person', colourOf(viewer.viewer));
                this.#names.set(viewer.viewer, element);
                this.marks.add(element, () => {
                    const now = this.viewers.find((other) => other.viewer === viewer.viewer);
                    return (now ?? viewer).eye;
                });
            }
            element.textContent = nameOf(viewer);
        }
    }
}
