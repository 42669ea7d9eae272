// SPDX-License-Identifier: Apache-2.0
// The file's animations: play, pause, wind, loop, for everybody.

import {LiveField, byId, field, input, smallButton} from '../ui/elements.js';
import {NewestOnly} from './surface_change.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/scene_types.js').Animation} Animation
 * @typedef {import('../net/scene_types.js').PlayAnimation} PlayAnimation
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 */

/** Steps of the slider from one end to the other. */
const STEPS = 500;

/**
 * @param {number} seconds
 * @param {number} length  seconds
 */
export function timeText(seconds, length) {
    const digits = length < 10 ? 2 : 1;
    return `${seconds.toFixed(digits)} of ${length.toFixed(digits)} s`;
}

/**
 * What an animation moves and changes.
 *
 * @param {Animation} animation
 * @param {SceneModel} scene
 */
export function movedText({objects, lights, materials}, scene) {
    const names = [
        ...objects.map((id) => scene.object(id)?.name),
        ...lights.map((id) => scene.lights.find((light) => light.id === id)?.name),
        ...materials.map((id) => scene.materials.find((material) => material.id === id)?.name),
    ].filter(Boolean);
    const more = names.length - 4;
    return more > 1 ? `${names.slice(0, 4).join(', ')} and ${more} more` : names.join(', ');
}

export class AnimationPanel {
    /** @type {(() => void)[]} */
    #refresh = [];

    /**
     * @param {RaybundleApp} app
     * @param {History} history
     */
    constructor(app, history) {
        this.app = app;
        this.history = history;
        app.on('welcome', () => this.#showAll());
        app.on('sceneChanged', ({animation}) => {
            const playing = animation && this.app.scene?.animation(animation.animation);
            if (playing) {
                playing.state.seconds = animation.seconds;
                this.#show();
            }
        });
        app.on('message', ({animationChanged}) => animationChanged && this.#changed(animationChanged.state));
    }

    /** @param {PlayAnimation} state */
    #changed(state) {
        const animation = this.app.scene?.animation(state.animation);
        if (animation) {
            Object.assign(animation.state, state);
            this.#show();
        }
    }

    #showAll() {
        const animations = this.app.scene?.animations ?? [];
        this.#refresh = [];
        byId('animations-part', HTMLElement).hidden = animations.length === 0;
        byId('animations', HTMLElement).replaceChildren(...animations.map((animation) => this.#card(animation)));
        this.#show();
    }

    #show() {
        this.#refresh.forEach((show) => show());
    }

    /** @param {PlayAnimation} playAnimation */
    #ask(playAnimation) {
        return this.app.ask({playAnimation});
    }

    /**
     * A step of undo: from where it stood to where it goes.
     *
     * @param {Animation} animation
     * @param {string} label
     * @param {number} from  seconds
     * @param {PlayAnimation} again
     */
    #remember({name}, label, from, again) {
        this.history.add({
            label,
            subject: `animation ${name}`,
            undo: () => this.#ask({animation: name, playing: false, seconds: from}),
            redo: () => this.#ask(again),
        });
    }

    /** @param {Animation} animation */
    async #toggle(animation) {
        const {name, state} = animation;
        const {seconds} = state;
        const wanted = {animation: name, playing: !state.playing};
        if ((await this.#ask(wanted)) && wanted.playing) {
            this.#remember(animation, `play ${name}`, seconds, {...wanted, seconds});
        }
    }

    /**
     * @param {Animation} animation
     * @returns {[HTMLInputElement, HTMLOutputElement]}
     */
    #slider(animation) {
        const {name, seconds: length} = animation;
        const time = input('range', {min: '0', max: String(length), step: String(length / STEPS || 1), 'aria-label': `${name}, time`});
        const text = document.createElement('output');
        const live = new LiveField(time);
        const newest = new NewestOnly((body) => this.app.ask(body));
        /** @type {number | null} */
        let before = null;
        time.addEventListener('input', () => {
            before ??= animation.state.seconds;
            newest.push({playAnimation: {animation: name, playing: false, seconds: Number(time.value)}});
            text.textContent = timeText(Number(time.value), length);
        });
        time.addEventListener('change', () => {
            const seconds = Number(time.value);
            this.#remember(animation, `wind ${name}`, before ?? animation.state.seconds, {animation: name, playing: false, seconds});
            before = null;
        });
        this.#refresh.push(() => {
            time.disabled = !this.app.mayEdit;
            live.show(String(animation.state.seconds));
            time.setAttribute('aria-valuetext', timeText(animation.state.seconds, length));
            if (before === null) {
                text.textContent = timeText(animation.state.seconds, length);
            }
        });
        return [time, text];
    }

    /** @param {Animation} animation */
    #card(animation) {
        const {name, state} = animation;
        const play = smallButton('Play', `Play ${name}`, () => this.#toggle(animation));
        const loop = input('checkbox', {'aria-label': `Loop ${name}`});
        loop.addEventListener('change', () => this.#ask({animation: name, loop: loop.checked}));
        const round = document.createElement('label');
        round.className = 'check';
        round.append(loop, ' Loop');
        const title = document.createElement('b');
        title.textContent = name;
        title.title = this.app.scene ? movedText(animation, this.app.scene) : '';
        const head = document.createElement('div');
        head.className = 'card-head';
        head.append(title, round, play);
        const card = document.createElement('li');
        card.append(head, field('Time', ...this.#slider(animation)));
        this.#refresh.push(() => {
            for (const control of [play, loop]) {
                control.disabled = !this.app.mayEdit;
            }
            loop.checked = state.loop ?? false;
            const deed = state.playing ? 'Pause' : 'Play';
            play.textContent = deed;
            play.title = `${deed} ${name}`;
            play.setAttribute('aria-label', play.title);
        });
        return card;
    }
}
