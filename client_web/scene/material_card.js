// SPDX-License-Identifier: Apache-2.0
// A card of a material: its colour, how much it reflects and how it shines.

import {fromHex, luminance, toHex} from '../measure/colour.js';
import {LiveField, field, input} from '../ui/elements.js';

/** @typedef {import('../net/scene_types.js').Material} Material */

/**
 * Materials by name, in their order; those without a name each alone.
 *
 * @param {Material[]} materials
 * @returns {Material[][]}
 */
export function byName(materials) {
    /** @type {Map<string, Material[]>} */
    const groups = new Map();
    for (const material of materials) {
        const key = material.name || `#${material.id}`;
        groups.set(key, [...(groups.get(key) ?? []), material]);
    }
    return [...groups.values()];
}

/**
 * A colour of another reflectance, as near to its hue as that goes: no part of the light is reflected more than wholly.
 *
 * @param {import('../net/scene_types.js').Vec3} colour  linear
 * @param {number} share  0..1
 * @returns {import('../net/scene_types.js').Vec3}
 */
export function reflecting(colour, share) {
    const now = luminance(colour);
    const even = {x: share, y: share, z: share};
    if (now <= 0) {
        return even;
    }
    const scaled = {x: (colour.x * share) / now, y: (colour.y * share) / now, z: (colour.z * share) / now};
    const most = Math.max(scaled.x, scaled.y, scaled.z);
    // Towards grey of the same reflectance, as far as needed.
    const hue = most > 1 ? (1 - share) / (most - share) : 1;
    const part = (/** @type {number} */ value) => share + hue * (value - share);
    return {x: part(scaled.x), y: part(scaled.y), z: part(scaled.z)};
}

/**
 * What people call a roughness.
 *
 * @param {number | undefined} roughness  0..1
 */
export function glossWord(roughness) {
    if (roughness === undefined) {
        return '–';
    }
    const words = /** @type {const} */ ([[0.05, 'polished'], [0.25, 'glossy'], [0.5, 'satin'], [0.8, 'eggshell']]);
    const [, word] = words.find(([most]) => roughness <= most) ?? [1, 'nearly matt'];
    return `${roughness.toFixed(2)} ${word}`;
}

/**
 * Controls for materials of one name.
 *
 * @param {Material[]} group  not empty
 * @param {string} name
 * @param {{going: (values: object) => void, done: (values: object) => void}} change
 * @param {() => boolean} mayEdit
 * @returns {{card: HTMLElement, show: () => void}} show: shows how they are now
 */
export function materialCard(group, name, change, mayEdit) {
    const [material] = group;
    const colour = input('color', {'aria-label': `${name}, colour`});
    const percent = input('number', {min: '0', max: '100', step: '1', 'aria-label': `${name}, reflectance, per cent`});
    const percentField = new LiveField(percent);
    const attributes = {min: '0', max: '1', step: '0.01', 'aria-label': `${name}, roughness`};
    const roughness = input('range', attributes);
    const roughnessField = new LiveField(roughness);
    const known = document.createElement('output');
    const metallic = input('range', {...attributes, 'aria-label': `${name}, metallic`});
    const metallicField = new LiveField(metallic);
    const metallicKnown = document.createElement('output');
    const metal = () => ({metallic: Number(metallic.value)});
    metallic.addEventListener('input', () => change.going(metal()));
    metallic.addEventListener('change', () => change.done(metal()));
    const painted = () => ({baseColour: fromHex(colour.value)});
    colour.addEventListener('input', () => change.going(painted()));
    colour.addEventListener('change', () => change.done(painted()));
    percent.addEventListener('change', () => {
        const wanted = percent.valueAsNumber / 100;
        if (material.baseColour && wanted >= 0 && wanted <= 1) {
            change.done({baseColour: reflecting(material.baseColour, wanted)});
        } else {
            percentField.reset();
        }
    });
    const rough = () => ({roughness: Number(roughness.value)});
    roughness.addEventListener('input', () => change.going(rough()));
    roughness.addEventListener('change', () => change.done(rough()));
    const note = document.createElement('p');
    note.className = 'hint';
    note.textContent = 'The file makes it perfectly matt: only as a metal does it get a gloss.';
    const show = () => {
        colour.value = toHex(material.baseColour ?? {x: 0.5, y: 0.5, z: 0.5});
        percentField.show(material.baseColour ? (100 * luminance(material.baseColour)).toFixed(0) : '');
        roughnessField.show(String(material.roughness ?? 1));
        // What is not told cannot be changed with sense.
        colour.hidden = material.baseColour === undefined;
        percent.disabled = !mayEdit() || material.baseColour === undefined;
        // Nor can what has no effect.
        const matt = material.matt === true && !((material.metallic ?? 0) > 0);
        known.textContent = matt ? 'matt' : glossWord(material.roughness);
        roughness.setAttribute('aria-valuetext', known.textContent);
        roughness.disabled = !mayEdit() || material.roughness === undefined || matt;
        note.hidden = !matt;
        metallicField.show(String(material.metallic ?? 0));
        metallicKnown.textContent = material.metallic?.toFixed(2) ?? '–';
        metallic.disabled = !mayEdit() || material.metallic === undefined;
    };
    const title = document.createElement('b');
    title.textContent = group.length > 1 ? `${name} (${group.length})` : name;
    const head = document.createElement('div');
    head.className = 'card-head';
    const reflectance = document.createElement('label');
    reflectance.className = 'reflectance';
    reflectance.title = 'Reflectance: the share of the light that it sends back; with a texture, of the texture’s own';
    reflectance.append(percent, '%');
    head.append(title, reflectance, colour);
    const card = document.createElement('li');
    card.dataset.materials = group.map(({id}) => id).join(' ');
    card.append(head, field('Roughness', roughness, known), note, field('Metallic', metallic, metallicKnown));
    return {card, show};
}
