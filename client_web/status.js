// SPDX-License-Identifier: Apache-2.0
// The state of the connection and passing notices.

import {byId, showValue} from './elements.js';

/** @typedef {import('./raybundle_client.js').ConnectionState} ConnectionState */

const STATE_TEXTS = {
    idle: 'Disconnected',
    connecting: 'Connecting',
    connected: 'Connected',
    reconnecting: 'Reconnecting',
    refused: 'Refused',
};

const TITLES = {
    idle: 'Disconnected',
    connecting: 'Connecting to the server',
    connected: '',
    reconnecting: 'The connection to the server is lost',
    refused: 'The server has refused the connection',
};

const NOTICE_MS = 8000;
const MAX_NOTICES = 3;

export class Status {
    #banner = byId('banner', HTMLElement);
    #retry = byId('banner-retry', HTMLButtonElement);
    #connection = byId('connection', HTMLElement);
    #notices = byId('notices', HTMLElement);
    /** @type {{state: ConnectionState, reason: string, retryAt: number}} */
    #shown = {state: 'idle', reason: '', retryAt: 0};

    /** @param {() => void} retry */
    constructor(retry) {
        this.#retry.addEventListener('click', retry);
        setInterval(() => this.#tick(), 500);
    }

    /**
     * @param {{state: ConnectionState, reason: string, retryAt: number}} change
     * @param {boolean} hasPicture
     */
    show(change, hasPicture) {
        this.#shown = change;
        const {state} = change;
        this.#connection.dataset.state = state;
        byId('app', HTMLElement).classList.toggle('offline', state !== 'connected');
        byId('connection-text', HTMLElement).textContent = STATE_TEXTS[state];
        const waiting = state === 'reconnecting' && !hasPicture;
        const title = waiting ? 'Waiting for the server' : TITLES[state];
        byId('banner-title', HTMLElement).textContent = title;
        this.#banner.hidden = state === 'connected';
        this.#banner.classList.toggle('aside', hasPicture);
        this.#retry.hidden = state === 'connecting' || state === 'connected';
        this.#tick();
    }

    /**
     * Shows a notice for a while; the same one only once at a time.
     *
     * @param {string} text
     * @param {'notice' | 'problem'} kind
     */
    notify(text, kind = 'notice') {
        const same = [...this.#notices.children].some((n) => n.firstChild?.textContent === text);
        if (same) {
            return;
        }
        const notice = document.createElement('div');
        notice.className = `notice ${kind}`;
        const message = document.createElement('span');
        message.textContent = text;
        const close = document.createElement('button');
        close.type = 'button';
        close.textContent = '×';
        close.setAttribute('aria-label', 'Dismiss');
        close.addEventListener('click', () => notice.remove());
        notice.append(message, close);
        this.#notices.append(notice);
        while (this.#notices.children.length > MAX_NOTICES) {
            this.#notices.firstElementChild?.remove();
        }
        setTimeout(() => notice.remove(), NOTICE_MS);
    }

    /** @param {string} server  name and version */
    showServer(server) {
        showValue('server', server);
    }

    #tick() {
        const {state, reason, retryAt} = this.#shown;
        const seconds = Math.max(0, Math.ceil((retryAt - performance.now()) / 1000));
        const next = seconds > 0 ? `Next attempt in ${seconds}\u00a0s.` : 'Trying again.';
        const parts = [reason, state === 'reconnecting' ? next : ''];
        const text = byId('banner-text', HTMLElement);
        text.textContent = parts.filter(Boolean).join(' ');
    }
}
