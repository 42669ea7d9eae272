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
 */
export function returnFocus(event) {
    if (event.detail > 0) {
        document.getElementById('picture')?.focus({preventScroll: true});
    }
}
