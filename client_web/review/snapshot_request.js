// SPDX-License-Identifier: Apache-2.0
// A picture that the server is asked for, apart from what is on screen: how far it is, and the way to
// take it back.

import {count, percent} from '../ui/format.js';
import {ServerError} from '../net/protocol.js';
import {sentence} from '../ui/status.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/protocol.js').SnapshotProgress} SnapshotProgress
 * @typedef {import('../net/protocol.js').SnapshotReady} SnapshotReady
 */

const MINUTE_S = 60;

/**
 * How far a picture is, in words.
 *
 * @param {Omit<SnapshotProgress, 'request'>} progress
 * @returns {string}
 */
export function progressText({ahead, relativeError, secondsLeft}) {
    if (ahead > 0) {
        return `${count(ahead)} ${ahead === 1 ? 'picture is' : 'pictures are'} made before it`;
    }
    if (relativeError === undefined || relativeError >= 1) {
        return 'it has just begun';
    }
    const reached = `error below ${percent(relativeError)} so far`;
    if (secondsLeft === undefined) {
        return reached;
    }
    const left =
        secondsLeft < 2 * MINUTE_S
            ? `${Math.max(Math.round(secondsLeft), 1)} s`
            : `${Math.round(secondsLeft / MINUTE_S)} min`;
    return `${reached}, about ${left} left`;
}

/**
 * Asks for a picture. While it is being made, `cancel` takes it back.
 *
 * @param {RaybundleApp} app
 * @param {object} snapshot  body of the message
 * @param {HTMLButtonElement} cancel  shown meanwhile
 * @param {(text: string) => void} tell  how far it is
 * @returns {Promise<SnapshotReady | null>} null: it was taken back, or refused (which is told)
 */
export async function requestSnapshot(app, snapshot, cancel, tell) {
    const {id, answer} = app.client.request({snapshot});
    const onMessage = (/** @type {Event} */ event) => {
        const {snapshotProgress} = /** @type {CustomEvent} */ (event).detail;
        if (snapshotProgress?.request === id) {
            tell(progressText(snapshotProgress));
        }
    };
    const onCancel = () => {
        cancel.disabled = true;
        // It may be done by now.
        app.client.request({cancelSnapshot: {request: id}}).answer.catch(() => {});
    };
    app.addEventListener('message', onMessage);
    cancel.addEventListener('click', onCancel);
    cancel.disabled = false;
    cancel.hidden = false;
    try {
        return (await answer).snapshotReady ?? null;
    } catch (error) {
        if (error instanceof ServerError && error.code !== 'CANCELLED') {
            app.status.notify(sentence(error.message), 'problem');
        }
        return null;
    } finally {
        app.removeEventListener('message', onMessage);
        cancel.removeEventListener('click', onCancel);
        cancel.hidden = true;
    }
}
