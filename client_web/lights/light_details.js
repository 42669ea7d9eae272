// SPDX-License-Identifier: Apache-2.0
// What is seldom changed of a light: where it is, where it is aimed, its cones, its group, its maintenance factor, its Ra.

import {LiveField, field, fieldNote, input} from '../ui/elements.js';
import {renderingText} from '../measure/zones.js';
import {aimOf, anglesOf} from './light_place.js';

/**
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('../net/scene_types.js').SetLight} SetLight
 * @typedef {import('../scene/surface_change.js').SurfaceChange} SurfaceChange
 * @typedef {Omit<SetLight, 'light'>} Values
 * @typedef {object} Deeds
 * @property {() => void} aim  the next click in the picture says where it is aimed at
 * @property {() => void} remove
 * @property {string[]} files  photometric ones of the server
 */

/** What a number field of a light is about: what it shows, and what a number typed there sets. Degrees and metres. */
/**
 * @type {{name: string, unit: string, has: (light: Light) => boolean, get: (light: Light) => number,
 *     set: (light: Light, value: number) => Values, emptied?: () => Values, hint?: string, title?: (light: Light) => string}[]}
 *     get: NaN: there is none; emptied: what a field without text sets
 */
const NUMBERS = [
    ...(/** @type {const} */ (['x', 'y', 'z'])).map((axis) => ({
        name: axis === 'y' ? 'Height y' : axis,
        unit: 'm',
        has: (/** @type {Light} */ light) => light.position !== undefined,
        get: (/** @type {Light} */ light) => light.position?.[axis] ?? 0,
        set: (/** @type {Light} */ light, /** @type {number} */ value) => ({
            position: {x: 0, y: 0, z: 0, ...light.position, [axis]: value},
        }),
    })),
    ...(/** @type {const} */ (['tilt', 'heading'])).map((angle) => ({
        name: angle === 'tilt' ? 'Tilt from down' : 'Heading',
        unit: '°',
        has: (/** @type {Light} */ light) => light.aim !== undefined,
        get: (/** @type {Light} */ light) => (light.aim ? anglesOf(light.aim)[angle] : 0),
        set: (/** @type {Light} */ light, /** @type {number} */ value) =>
            light.aim ? {aim: aimOf({...anglesOf(light.aim), [angle]: value})} : {},
    })),
    {
        name: 'Turn about its aim',
        unit: '°',
        has: ({rotation}) => rotation !== undefined,
        get: ({rotation}) => rotation ?? 0,
        set: (_, rotation) => ({rotation}),
    },
    {
        name: 'Inner cone ±',
        unit: '°',
        has: ({innerCone}) => innerCone !== undefined,
        get: ({innerCone}) => innerCone ?? 0,
        set: (_, innerCone) => ({innerCone}),
    },
    {
        name: 'Outer cone ±',
        unit: '°',
        has: ({outerCone}) => outerCone !== undefined,
        get: ({outerCone}) => outerCone ?? 0,
        set: (_, outerCone) => ({outerCone}),
    },
    {
        name: 'Maintenance factor',
        unit: '',
        has: ({maintenanceFactor}) => maintenanceFactor !== undefined,
        get: ({maintenanceFactor}) => maintenanceFactor ?? 1,
        set: (_, maintenanceFactor) => ({maintenanceFactor}),
    },
    {
        name: 'Colour rendering Ra',
        unit: '',
        // Where nobody knows it the server does not tell it; lamps that have it have a maintenance factor, too.
        has: ({maintenanceFactor}) => maintenanceFactor !== undefined,
        get: ({colourRendering}) => colourRendering ?? NaN,
        set: (_, colourRendering) => ({colourRendering}),
        emptied: () => ({colourRendering: 0}),
        hint: 'not known',
        title: (/** @type {Light} */ light) => (light.colourRendering === undefined
            ? 'Its file does not state Ra: enter it'
            : `Ra ${renderingText(light)}. Empty it to go by the file`),
    },
];

/**
 * Whether there is anything to set: older servers tell nothing of it, and the sky has none of it.
 *
 * @param {Light} light
 */
export const hasDetails = (light) => light.group !== undefined || NUMBERS.some(({has}) => has(light));

/**
 * Whether it can be taken away: lamps that are no surfaces, and have a place.
 *
 * @param {Light} light
 */
export const isLuminaire = ({kind}) => kind === 'POINT' || kind === 'SPOT';

/** The part of a light's card that unfolds. `show()` brings it up to date. */
export class LightDetails {
    /** @type {(() => void)[]} */
    #refresh = [];

    /**
     * @param {Light} light  changes as the server says
     * @param {string} name
     * @param {SurfaceChange} change
     * @param {Deeds} deeds
     */
    constructor(light, name, change, deeds) {
        this.light = light;
        this.name = name;
        this.change = change;
        this.note = document.createElement('p');
        this.note.className = 'field-note';
        this.note.setAttribute('role', 'status');
        this.note.hidden = true;
        const title = document.createElement('summary');
        title.textContent = light.aim || light.position ? 'Place, aim, group, file' : 'Group';
        this.element = document.createElement('details');
        this.element.className = 'light-details';
        this.element.append(title);
        if (light.group !== undefined) {
            this.element.append(this.#groupField());
        }
        for (const number of NUMBERS.filter(({has}) => has(light))) {
            this.element.append(this.#numberField(number));
        }
        if (light.photometry !== undefined && light.unit !== 'LX' && deeds.files.length > 0) {
            this.element.append(this.#fileField(deeds.files), this.#sameType());
        }
        this.element.append(this.note);
        if (light.aim && light.position) {
            this.element.append(this.#button('Aim at a point in the picture', deeds.aim));
        }
        if (isLuminaire(light)) {
            this.element.append(this.#button(`Remove ${name}`, deeds.remove));
        }
        if (light.carrier !== undefined) {
            const carried = document.createElement('p');
            carried.className = 'hint';
            carried.textContent = 'It hangs on an object: move or turn that.';
            this.element.append(carried);
        }
    }

    /**
     * @param {string} text
     * @param {() => void} action
     */
    #button(text, action) {
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = text;
        button.addEventListener('click', action);
        return button;
    }

    /**
     * What file it shines by.
     *
     * @param {string[]} files  of the server
     */
    #fileField(files) {
        const select = document.createElement('select');
        select.setAttribute('aria-label', `${this.name}, photometric file`);
        const own = this.light.photometry || '';
        const names = files.includes(own) ? files : [own, ...files];
        for (const name of names) {
            const option = document.createElement('option');
            option.value = name;
            option.textContent = name || 'as in the scene';
            select.append(option);
        }
        this.#refresh.push(() => {
            select.value = this.light.photometry || '';
        });
        select.addEventListener('change', () => {
            const all = this.allOfType?.checked ? {sameType: true} : {};
            const refused = (/** @type {string} */ why) => {
                this.show();
                fieldNote(this.note, why);
            };
            this.change.done({photometry: select.value, ...all}, refused);
        });
        return field('File', select);
    }

    /** Whether a file is chosen for all luminaires that shine by this one's. */
    #sameType() {
        const label = document.createElement('label');
        label.className = 'check';
        this.allOfType = input('checkbox', {'aria-label': `${this.name}, all of its type`});
        label.append(this.allOfType, ' for all of this type');
        return label;
    }

    #groupField() {
        const text = input('text', {maxlength: '64', list: 'light-group-names', 'aria-label': `${this.name}, group`});
        const live = new LiveField(text);
        this.#refresh.push(() => live.show(this.light.group ?? ''));
        text.addEventListener('change', () => this.change.done({group: text.value.trim()}));
        return field('Group', text);
    }

    /** @param {typeof NUMBERS[number]} number */
    #numberField({name, unit, get, set, emptied, hint = '', title}) {
        const typed = input('number', {step: 'any', 'aria-label': `${this.name}, ${name}`, placeholder: hint});
        const live = new LiveField(typed);
        this.#refresh.push(() => {
            const value = get(this.light);
            live.show(Number.isNaN(value) ? '' : String(Number(value.toFixed(unit === '°' ? 1 : 3))));
            typed.title = title?.(this.light) ?? '';
        });
        typed.addEventListener('change', () => {
            const value = typed.valueAsNumber;
            const refused = (/** @type {string} */ why) => {
                live.reset();
                fieldNote(this.note, why, typed);
            };
            if (Number.isFinite(value)) {
                this.change.done(set(this.light, value), refused);
            } else if (emptied && typed.value === '' && !typed.validity.badInput) {
                this.change.done(emptied(), refused);
            } else {
                refused('Enter a number. Nothing has been changed.');
            }
        });
        const unitText = document.createElement('span');
        unitText.className = 'unit';
        unitText.textContent = unit;
        return field(name, typed, unitText);
    }

    show() {
        this.#refresh.forEach((show) => show());
    }
}
