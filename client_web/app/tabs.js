// SPDX-License-Identifier: Apache-2.0
// The panel's tabs, by mouse and by keyboard (WAI-ARIA Authoring Practices, "Tabs").

/**
 * Makes tabs of the buttons in a list.
 *
 * @param {HTMLElement} list  of elements with role tab, each naming its page in aria-controls
 * @returns {(name: string) => void} shows a tab by its id
 */
export function addTabs(list) {
    const tabs = [...list.querySelectorAll('[role="tab"]')].map((tab) => /** @type {HTMLElement} */ (tab));
    const show = (/** @type {HTMLElement} */ chosen) => {
        if (chosen.getAttribute('aria-selected') !== 'true') {
            list.parentElement?.scrollTo({top: 0});  // another page begins at its beginning
        }
        for (const tab of tabs) {
            const on = tab === chosen;
            tab.setAttribute('aria-selected', String(on));
            tab.tabIndex = on ? 0 : -1;
            const page = document.getElementById(tab.getAttribute('aria-controls') ?? '');
            page?.toggleAttribute('hidden', !on);
        }
    };
    tabs.forEach((tab, i) => {
        tab.addEventListener('click', () => show(tab));
        tab.addEventListener('keydown', (event) => {
            const steps = {ArrowLeft: i - 1, ArrowRight: i + 1, Home: 0, End: tabs.length - 1};
            const to = steps[/** @type {keyof typeof steps} */ (event.key)];
            if (to !== undefined) {
                event.preventDefault();
                const next = tabs[(to + tabs.length) % tabs.length];
                show(next);
                next.focus();
            }
        });
    });
    return (name) => {
        const tab = tabs.find(({id}) => id === name);
        if (tab) {
            show(tab);
        }
    };
}
