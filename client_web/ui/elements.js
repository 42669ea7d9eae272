// SPDX-License-Identifier: Apache-2.0

/**
 * Element of the page by its id.
 *
 * @template {Element} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 */
export function byId(id, type) {
    const element = document.getElementById(id);
    if (!(element instanceof type)) {
        throw new Error(`The page lacks ${type.name} #${id}.`);
    }
    return element;
}

/**
 * Writes a text wherever the page shows a value.
 *
 * @param {string} name  of data-value
 * @param {string} text
 */
export function showValue(name, text) {
    for (const element of document.querySelectorAll(`[data-value="${name}"]`)) {
        if (element.textContent !== text) {
            element.textContent = text;
        }
    }
}

/**
 * Focus goes back to the picture after a click, so that its keys keep working; keyboard users stay
 * where they are.
 *
 * @param {MouseEvent} event
 * @param {boolean} gone  what has been clicked is no longer there for them either
 */
export function returnFocus(event, gone = false) {
    if (gone || event.detail > 0) {
        document.getElementById('picture')?.focus({preventScroll: true});
    }
}

/**
 * A row of a list that does something when it is pressed.
 *
 * @param {string} text
 * @param {() => void} action
 * @param {string} tag  shown at the end
 * @returns {HTMLLIElement}
 */
export function listRow(text, action, tag = '') {
    const item = document.createElement('li');
    const button = document.createElement('button');
    button.type = 'button';
    for (const part of [text, tag]) {
        const span = document.createElement('span');
        span.textContent = part;
        button.append(span);
    }
    button.lastElementChild?.classList.add('tag');
    button.title = text;
    button.addEventListener('click', (event) => {
        action();
        returnFocus(event);
    });
    item.append(button);
    return item;
}

/**
 * Exchanges the rows of a list. The focus stays where it was: on the same control of the same row, or of
 * the row that has taken its place.
 *
 * @param {Element} list
 * @param {HTMLElement[]} rows
 */
export function replaceRows(list, rows) {
    const focused = document.activeElement;
    const row = [...list.children].findIndex((child) => child.contains(focused));
    const control = [...(list.children[row]?.querySelectorAll('button') ?? [])].findIndex(
        (button) => button === focused,
    );
    list.replaceChildren(...rows);
    if (control >= 0) {
        const buttons = rows[Math.min(row, rows.length - 1)]?.querySelectorAll('button') ?? [];
        const next = buttons[Math.min(control, buttons.length - 1)] ?? document.getElementById('picture');
        next?.focus({preventScroll: true});
    }
}

/**
 * Says something to those who hear the page.
 *
 * @param {string} text
 */
export function announce(text) {
    byId('announcement', HTMLElement).textContent = text;
}

/**
 * A field that shows what is true, except while somebody changes it: from the first key or move to the `change`
 * that comes of it, or to leaving the field.
 */
export class LiveField {
    #text = '';
    #held = false;

    /** @param {HTMLInputElement} input */
    constructor(input) {
        this.input = input;
        input.addEventListener('input', () => {
            this.#held = true;
        });
        for (const type of ['change', ...(input.type === 'range' ? ['pointerup', 'keyup'] : [])]) {
            input.addEventListener(type, () => {
                this.#held = false;
            });
        }
        input.addEventListener('blur', () => this.#held && this.reset());
        input.addEventListener('keydown', (event) => {
            if (event.key === 'Escape' && this.#held) {
                this.reset();  // what has been typed is not meant
            }
        });
    }

    /**
     * @param {string} text  that is true now
     */
    show(text) {
        this.#text = text;
        if (!this.#held) {
            this.input.value = text;
        }
    }

    /** Shows what is true again, whatever has been typed. */
    reset() {
        this.#held = false;
        this.input.value = this.#text;
    }
}

/**
 * A line below fields that says why something has not been done. It is gone with the next thing typed.
 *
 * @param {HTMLElement} line
 * @param {string} text  empty: nothing is wrong
 * @param {HTMLInputElement | null} input  that it is about
 * @param {{label: string, run: () => void} | null} action  offered as a button
 */
export function fieldNote(line, text, input = null, action = null) {
    line.textContent = text;
    line.hidden = text === '';
    line.classList.remove('news');
    if (action) {
        const button = smallButton(action.label, action.label, () => {
            fieldNote(line, '');
            action.run();
        });
        line.append(' ', button);
    }
    input?.addEventListener('input', () => fieldNote(line, ''), {once: true});
}

/**
 * The same line where it says that something is done, or being done: nothing is wrong.
 *
 * @param {HTMLElement} line
 * @param {string} text
 */
export function fieldNews(line, text) {
    fieldNote(line, text);
    line.classList.add('news');
}

/**
 * A small button.
 *
 * @param {string} label  its text
 * @param {string} name  for those who hear it
 * @param {() => void} action
 */
export function smallButton(label, name, action) {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'plain';
    button.textContent = label;
    button.setAttribute('aria-label', name);
    button.title = name;
    button.addEventListener('click', action);
    return button;
}

/**
 * Hands a file to the user.
 *
 * @param {Blob} blob
 * @param {string} name
 */
export function saveFile(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** @type {(text: string) => string} */
export const fileName = (text) => text.replaceAll(/[^\p{L}\p{N}]+/gu, '_').replaceAll(/^_|_$/g, '');

/**
 * @param {string} kind  of the element
 * @param {Record<string, string>} attributes
 * @returns {HTMLInputElement}
 */
export function input(kind, attributes) {
    const element = document.createElement('input');
    element.type = kind;
    for (const [name, value] of Object.entries(attributes)) {
        element.setAttribute(name, value);
    }
    return element;
}

/**
 * @param {string} text
 * @param {...HTMLElement} parts
 */
export function field(text, ...parts) {
    const label = document.createElement('label');
    label.className = 'field';
    const name = document.createElement('span');
    name.textContent = text;
    label.append(name, ...parts);
    return label;
}

/** An answer that comes sooner is waited for unseen, ms: at which a response still seems immediate to people. */
const SOON_MS = 100;

/**
 * Marks a place while an answer about it is awaited, so that a click is not taken for lost.
 *
 * @template T
 * @param {HTMLElement} parent
 * @param {{x: number, y: number}} at  CSS pixels from its top left corner
 * @param {Promise<T>} answer
 * @returns {Promise<T>}
 */
export async function whileAsked(parent, {x, y}, answer) {
    const mark = document.createElement('span');
    mark.className = 'asked-at';
    mark.style.left = `${x}px`;
    mark.style.top = `${y}px`;
    const timer = setTimeout(() => parent.append(mark), SOON_MS);
    try {
        return await answer;
    } finally {
        clearTimeout(timer);
        mark.remove();
    }
}
