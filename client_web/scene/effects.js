// SPDX-License-Identifier: Apache-2.0
// What of light the scene calls for, in words that need no study, with the field's terms beside them.

import {byId} from '../ui/elements.js';
import {percent} from '../ui/format.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Effect} Effect
 */

/** The server's names of effects, which are the field's terms, in plain words. */
const PLAIN = new Map([
    ['diffuse', 'Light between matt surfaces'],
    ['glossy', 'Blurred reflections'],
    ['specular-reflection', 'Mirror images'],
    ['refraction', 'Sight through glass'],
    ['caustics', 'Light from mirrors and through glass'],
    ['clear-coat', 'Varnish'],
    ['diffuse-transmission', 'Light through lampshades and curtains'],
    ['textures', 'Patterns of surfaces'],
    ['normal-maps', 'Relief of surfaces'],
    ['punctual-lights', 'Lamps without size'],
    ['ies', 'Lamps as their makers measured them'],
    ['sky', 'Light of the sky'],
    ['sun', 'Sunlight'],
    ['environment', 'Light of a picture of the surroundings'],
    ['medium', 'Haze and smoke'],
]);

/** Heckbert's letters. */
const STATIONS = new Map([
    ['L', 'lamp or sky'],
    ['D', 'matt'],
    ['G', 'glossy'],
    ['S', 'mirror or glass'],
    ['M', 'haze'],
    ['E', 'eye'],
]);

/** How often, by the sign that follows. */
const TIMES = new Map([
    ['*', ', 0 or more'],
    ['+', ', 1 or more'],
]);

/**
 * A class of light paths in words.
 *
 * @param {string} pathClass  Heckbert's notation, e.g. "L(D|G)*E"
 * @returns {string} e.g. "lamp or sky → matt or glossy, 0 or more → eye"
 */
export function pathInWords(pathClass) {
    const steps = [...pathClass.matchAll(/\(([A-Z|]+)\)([*+]?)|([A-Z])([*+]?)/g)];
    const words = steps.map(([, several, severalTimes, one, times]) => {
        const names = (several ?? one).split('|').map((letter) => STATIONS.get(letter) ?? letter);
        return names.join(' or ') + (TIMES.get(severalTimes || times) ?? '');
    });
    return words.join(' → ');
}

/**
 * What an effect of the plan costs and brings.
 *
 * @param {Effect} effect
 * @returns {string} empty where nothing is to be said
 */
export function effectCost({active, shareBound, bytesPerPatch, msPerIteration}) {
    if (!active) {
        return '';
    }
    const share = shareBound !== undefined && shareBound < 1 ? `at most ${percent(shareBound)} of the light` : '';
    const memory = bytesPerPatch ? `${bytesPerPatch} bytes a patch` : '';
    const time = msPerIteration === undefined ? '' : `${msPerIteration.toFixed(1)} ms an iteration`;
    return [share, time, memory].filter(Boolean).join(' · ');
}

/**
 * @param {string} className
 * @param {string} text
 */
function paragraph(className, text) {
    const element = document.createElement('p');
    element.className = className;
    element.textContent = text;
    return element;
}

/**
 * @param {Effect} effect
 * @returns {HTMLLIElement}
 */
function effectRow(effect) {
    const {name, active, reason, pathClass} = effect;
    const item = document.createElement('li');
    item.className = active ? 'on' : 'off';
    const term = name.replaceAll('-', ' ');
    const title = document.createElement('b');
    title.textContent = PLAIN.get(name) ?? term;
    const state = document.createElement('span');
    state.className = 'tag';
    state.textContent = active ? 'on' : 'off';
    item.append(title, state);
    item.append(paragraph('why', PLAIN.has(name) ? `${term}: ${reason}` : reason));
    if (active && pathClass) {
        const way = paragraph('way', pathInWords(pathClass));
        way.title = `The way of the light: paths ${pathClass} in Heckbert's notation`;
        item.append(way);
    }
    const cost = effectCost(effect);
    if (cost) {
        const figures = paragraph('cost', cost);
        figures.title = 'Iteration: one more sample of all light. Patch: one of the small pieces that surfaces are divided into.';
        item.append(figures);
    }
    return item;
}

/**
 * Lists the effects plan: what the scene calls for, and why; folded, what it does not, and why not.
 *
 * @param {Effect[]} effects
 */
export function showEffects(effects) {
    const on = effects.filter(({active}) => active);
    const off = effects.filter(({active}) => !active);
    byId('effects', HTMLElement).replaceChildren(...on.map(effectRow));
    byId('effects-off', HTMLElement).replaceChildren(...off.map(effectRow));
    byId('effects-off-count', HTMLElement).textContent = `Not needed here: ${off.length}`;
    byId('effects-off-details', HTMLElement).hidden = off.length === 0;
}

/**
 * The effects plan, and what each effect costs where somebody has it measured.
 *
 * @param {RaybundleApp} app
 */
export function addEffects(app) {
    const button = byId('measure-effects', HTMLButtonElement);
    const state = byId('effects-state', HTMLElement);
    app.on('welcome', (welcome) => {
        showEffects(welcome.scene.effects ?? []);
        button.hidden = !app.mayEdit;
        button.disabled = false;
        state.textContent = '';
    });
    button.addEventListener('click', async () => {
        button.disabled = true;
        state.textContent = 'Being measured, for some seconds; pictures come more slowly meanwhile.';
        const effects = (await app.ask({measureEffects: {}}))?.effectCosts?.effects;
        button.disabled = false;
        state.textContent = effects
            ? 'Measured beside all that the server does for everybody, so that a quiet one is faster.'
            : 'The costs could not be measured.';
        if (effects) {
            showEffects(effects);
        }
    });
}
