// SPDX-License-Identifier: Apache-2.0
// Which changes have come of a request, where one request makes several. Knows no page.

/**
 * @typedef {import('../net/scene_types.js').SceneChanged} SceneChanged
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 */

/**
 * Does something, and notes the changes of the scene that this viewer has made meanwhile. Others' are not among them.
 *
 * @template T
 * @param {Pick<RaybundleClient, 'addEventListener' | 'removeEventListener' | 'welcome'>} client
 * @param {() => Promise<T>} work
 * @returns {Promise<{result: T, changes: SceneChanged[]}>}
 */
export async function withOwnChanges(client, work) {
    /** @type {SceneChanged[]} */
    const changes = [];
    const note = (/** @type {Event} */ event) => {
        const change = /** @type {CustomEvent<SceneChanged>} */ (event).detail;
        if (change.by === client.welcome?.viewer) {
            changes.push(change);
        }
    };
    client.addEventListener('sceneChanged', note);
    try {
        return {result: await work(), changes};
    } finally {
        client.removeEventListener('sceneChanged', note);
    }
}
