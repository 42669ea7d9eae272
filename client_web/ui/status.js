// SPDX-License-Identifier: Apache-2.0
// The state of the connection, what is being waited for, and passing notices.

import {byId, returnFocus, showValue} from './elements.js';
import {PREPARING} from '../net/raybundle_client.js';
import {OpeningCard} from '../scene/opening.js';

/**
 * @typedef {import('../net/raybundle_client.js').ConnectionState} ConnectionState
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 * @typedef {import('../net/protocol.js').Welcome} Welcome
 * @typedef {{state: ConnectionState, reason: string, code: string, retryAt: number}} StateChange
 */

const STATE_TEXTS = {
    idle: 'Disconnected',
    connecting: 'Connecting',
    connected: 'Connected',
    reconnecting: 'Reconnecting',
    refused: 'Refused',
};

/** How refusals begin: a message of the protocol and, mostly, one of its fields. */
const ABOUT_MESSAGE =
    /^(?:hello|snapshot|undo|follow|ack|probe|(?:set|move|add|remove|save|open|point|measure|probe)[A-Z]\w*)(?:\.\w+)*?(?:\.(\w+))?: (.*)$/s;

const NOTICE_MS = 8000;
const MAX_NOTICES = 3;
/** A lost connection and the next attempt are told without a reason, also where a server is there. */
const MOST_EMPTY = 2;

/**
 * What the banner says.
 *
 * @param {StateChange} change
 * @param {boolean} hasPicture
 * @param {string} opening  scene for which connections are closed and come back; empty: none
 * @returns {{title: string, retry: string, asksForToken: boolean}}  `retry` names the button
 */
export function bannerOf({state, code, reason}, hasPicture, opening = '') {
    const asksForToken = state === 'refused' && code === 'UNAUTHENTICATED';
    if (asksForToken) {
        return {title: 'This server asks for an access token', retry: '', asksForToken};
    }
    if (state === 'refused' && code === 'UNIMPLEMENTED') {
        const title = 'This page and the server speak different versions';
        return {title, retry: 'Load the page again', asksForToken};
    }
    const there = reason === PREPARING;  // as after one has set a name: the connection is new, not lost
    const away = hasPicture && !there ? 'The connection to the server is lost' : 'Waiting for the server';
    const lost = opening ? `Opening ${opening}` : away;
    const titles = {
        idle: 'Disconnected',
        connecting: 'Connecting to the server',
        connected: '',
        reconnecting: code === 'RESOURCE_EXHAUSTED' ? 'The server is full' : lost,
        refused: 'The server has refused the connection',
    };
    const soon = state === 'connecting' || state === 'connected' || there || (opening !== '' && code === '');
    const retry = soon ? '' : 'Try again now';
    return {title: titles[state], retry, asksForToken};
}

/**
 * Why, and what somebody can do, or need not do.
 *
 * @param {StateChange} change
 * @param {boolean} hasPicture
 * @param {string} opening  as for bannerOf()
 * @returns {string} empty: nothing
 */
export function adviceOf({state, code, reason}, hasPicture, opening = '') {
    const why = sentence(reason);
    if (state === 'refused' && code === 'UNAUTHENTICATED') {
        return reason.endsWith('is missing')
            ? 'Whoever runs the server can give you one.'
            : `${why} Check that you copied all of it. Whoever runs the server can give you another.`;
    }
    if (state === 'refused' && code === 'UNIMPLEMENTED') {
        return `The server has probably been updated. ${why} If loading the page again does not help, ask whoever runs the server.`;
    }
    if (state === 'reconnecting' && code === 'RESOURCE_EXHAUSTED') {
        const limit = sentence(reason.replace(/^the server is full, /, ''));
        return `${limit} You will be let in when there is room.`;
    }
    if (state === 'reconnecting' && opening) {
        return 'The page comes back by itself when it is ready.';  // silence is no news while the server prepares
    }
    if (state === 'reconnecting' && !reason && hasPicture && !opening) {
        return 'You see the last picture meanwhile. The page comes back by itself.';
    }
    return why;
}

export class Status {
    #banner = byId('banner', HTMLElement);
    #retry = byId('banner-retry', HTMLButtonElement);
    #connection = byId('connection', HTMLElement);
    #notices = byId('notices', HTMLElement);
    #tokenForm = byId('token-form', HTMLFormElement);
    #card = new OpeningCard();
    #hasPicture = false;
    /** How often in a row nothing was there to connect to. */
    #nobody = 0;
    /** @type {StateChange} */
    #shown = {state: 'idle', reason: '', code: '', retryAt: 0};

    /** @param {RaybundleClient} client */
    constructor(client) {
        this.#retry.addEventListener('click', () => {
            if (this.#shown.code === 'UNIMPLEMENTED') {
                location.reload();
            } else {
                client.connect();
            }
        });
        this.#tokenForm.addEventListener('submit', (event) => {
            event.preventDefault();
            client.settings.token = byId('token', HTMLInputElement).value.trim();
            client.connect();
        });
        setInterval(() => this.#tick(), 500);
    }

    /**
     * @param {StateChange} change
     * @param {boolean} hasPicture
     */
    show(change, hasPicture) {
        this.#shown = change;
        this.#hasPicture = hasPicture;
        const {state} = change;
        this.#nobody = state === 'reconnecting' && change.reason === '' ? this.#nobody + 1 : 0;
        if (this.#nobody > MOST_EMPTY) {
            this.showOpening(null, false);  // the server has ended, and the scene is not coming
        }
        this.#connection.dataset.state = state;
        byId('app', HTMLElement).classList.toggle('offline', state !== 'connected');
        this.#showState();
        const {title, retry, asksForToken} = bannerOf(change, hasPicture, this.#card.name);
        byId('banner-title', HTMLElement).textContent = title;
        this.#showBanner();
        this.#banner.classList.toggle('aside', hasPicture);
        this.#retry.hidden = retry === '';
        this.#retry.textContent = retry || 'Try again now';
        const asksAnew = asksForToken && this.#tokenForm.hidden;
        this.#tokenForm.hidden = !asksForToken;
        if (asksAnew) {
            byId('token', HTMLInputElement).focus();
        }
        this.#card.visible = this.#card.name !== '' && state !== 'refused';
        this.#tick();
    }

    /**
     * @param {Welcome} welcome
     * @param {string} title  of the scene
     * @param {boolean} hasPicture
     */
    showWelcome(welcome, title, hasPicture) {
        document.title = `${title} – Raybundle`;
        byId('scene-name', HTMLElement).textContent = title;
        showValue('server', welcome.server);
        this.showOpening(null, false);
        this.#card.visible = !hasPicture;
        const renderer = byId('renderer', HTMLElement);
        renderer.hidden = !welcome.softwareRendering;
        renderer.textContent =
            'This server draws without a graphics card, so pictures come a few times a second.' +
            ` (${welcome.renderer ?? ''})`;
    }

    /** The server answers already while it prepares a scene: nothing is wrong with the connection. */
    #showState() {
        const {state, reason} = this.#shown;
        const prepares = this.#card.name !== '' && (state === 'connecting' || state === 'reconnecting') && reason !== '';
        byId('connection-text', HTMLElement).textContent = prepares ? 'Preparing' : STATE_TEXTS[state];
    }

    /** Where the card says how far a scene is, that is all. */
    #showBanner() {
        const {state, code} = this.#shown;
        this.#banner.hidden = state === 'connected' || (this.#card.name !== '' && state !== 'refused' && code === '');
    }

    /** There is a picture now. */
    showPicture() {
        this.#card.visible = this.#card.name !== '';
    }

    /**
     * Says how far a scene is that is opened, or made ready.
     *
     * @param {import('../net/protocol.js').SceneOpening | null} opening  null: none any more
     * @param {boolean} mine
     */
    showOpening(opening, mine) {
        this.#card.show(opening, mine);
        this.#card.visible = opening !== null;
        this.#showState();
        this.#showBanner();
    }

    /**
     * Shows a notice for a while, and as long as somebody is at it; the same one only once at a time.
     *
     * @param {string} text
     * @param {'notice' | 'problem'} kind
     * @param {{label: string, run: () => void} | null} action  offered as a button
     * @returns {() => void} takes it away, where it is no longer true
     */
    notify(text, kind = 'notice', action = null) {
        const same = [...this.#notices.children].find((n) => n.firstChild?.textContent === text);
        if (same) {
            return () => same.remove();
        }
        const notice = document.createElement('div');
        notice.className = `notice ${kind}`;
        const message = document.createElement('span');
        message.textContent = text;
        notice.append(message);
        const addButton = (/** @type {string} */ label, /** @type {() => void} */ run) => {
            const button = document.createElement('button');
            button.type = 'button';
            button.textContent = label;
            button.addEventListener('click', (event) => {
                notice.remove();
                returnFocus(event, true);
                run();
            });
            notice.append(button);
            return button;
        };
        addButton('×', () => {}).setAttribute('aria-label', 'Dismiss');
        if (action) {
            addButton(action.label, action.run).className = 'notice-action';
        }
        this.#notices.append(notice);
        while (this.#notices.children.length > MAX_NOTICES) {
            this.#notices.firstElementChild?.remove();
        }
        const expire = () => {
            if (notice.matches(':hover, :focus-within')) {
                setTimeout(expire, NOTICE_MS);
            } else {
                notice.remove();
            }
        };
        setTimeout(expire, NOTICE_MS);
        return () => notice.remove();
    }

    #tick() {
        const {state, reason, retryAt} = this.#shown;
        const seconds = Math.max(0, Math.ceil((retryAt - performance.now()) / 1000));
        const next = seconds > 0 ? `Next attempt in ${seconds}\u00a0s.` : reason ? '' : 'Trying again.';
        // Apart, since screen readers say a changed text anew, and this one changes every second.
        this.#card.tick();
        const advice = adviceOf(this.#shown, this.#hasPicture, this.#card.name);
        byId('banner-reason', HTMLElement).textContent = advice;
        byId('banner-next', HTMLElement).textContent = state === 'reconnecting' ? next : '';
    }
}

/**
 * What a server says, for people: without the message that it is about, but with the field that is the
 * subject.
 *
 * @param {string} said  e.g. "hello.token: wrong"
 * @returns {string}
 */
export function sentence(said) {
    const [, field = '', rest = said] = ABOUT_MESSAGE.exec(said) ?? [];
    const text = /^(is|must|has)\b/.test(rest) && field ? `${field} ${rest}` : rest;
    return text && `${text[0].toUpperCase()}${text.slice(1)}${/[.!?]$/.test(text) ? '' : '.'}`;
}
