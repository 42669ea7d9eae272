// SPDX-License-Identifier: Apache-2.0
// The list of projects, as /projects.json has it. Asked for again every few seconds while it is looked at.

/**
 * @typedef {object} Project
 * @property {string} name
 * @property {string} title
 * @property {string} path  of its page, from this one
 * @property {string} state  OFF, STARTING, AWAKE, ASLEEP, ENDING or FAILED
 * @property {boolean} needsToken
 * @property {number} [sceneBytes]  this and what follows only for those who may know
 * @property {number} [memoryBytes]
 * @property {number} [maxViewers]
 * @property {string[]} [people]  names
 * @property {string} [picture]  path, from this page
 * @property {string} [problem]  why it cannot be shown for now
 */

const AGAIN_MS = 3000;
const TOKEN = 'projectsToken';
const THEME = 'raybundle.theme';

/**
 * @template {HTMLElement} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 */
function byId(id, type) {
    const found = document.getElementById(id);
    if (!(found instanceof type)) {
        throw new Error(`The page lacks ${type.name} #${id}.`);
    }
    return found;
}

/**
 * @param {string} tag
 * @param {string} className
 * @param {...(string | Node)} parts
 */
function element(tag, className, ...parts) {
    const made = document.createElement(tag);
    made.className = className;
    made.append(...parts);
    return made;
}

/**
 * Nothing is kept where the browser does not allow it.
 *
 * @template T
 * @param {() => T} action
 * @returns {T | undefined}
 */
function stored(action) {
    try {
        return action();
    } catch {
        return undefined;
    }
}

/**
 * @param {number} bytes
 * @returns {string}
 */
export function size(bytes) {
    const megabytes = bytes / 1e6;
    return megabytes >= 1000
        ? `${(megabytes / 1000).toFixed(1)} GB`
        : megabytes >= 10
          ? `${megabytes.toFixed(0)} MB`
          : megabytes >= 0.1
            ? `${megabytes.toFixed(1)} MB`
            : `${Math.ceil(bytes / 1000)} kB`;
}

/**
 * Who is there, or why nobody is.
 *
 * @param {Project} project
 * @returns {string}
 */
export function stateText(project) {
    const people = (project.people ?? []).map((name) => name.trim() || 'Somebody');
    if (project.problem) {
        return `Not available: ${project.problem}`;
    }
    if (people.length > 0) {
        return people.length > 4
            ? `${people.slice(0, 3).join(', ')} and ${people.length - 3} more`
            : people.join(', ');
    }
    /** @type {Record<string, string>} */
    const texts = {
        OFF: 'Nobody there',
        STARTING: 'Starting',
        AWAKE: 'Awake',
        ASLEEP: 'Asleep, wakes at once',
        ENDING: 'Nobody there',
        FAILED: 'Starts again at a visit',
    };
    return texts[project.state] ?? project.state;
}

/**
 * Sizes, as far as they are known.
 *
 * @param {Project} project
 * @returns {string}
 */
export function moreText(project) {
    const parts = [];
    if (project.sceneBytes) {
        parts.push(`Scene ${size(project.sceneBytes)}`);
    }
    if (project.memoryBytes) {
        parts.push(`memory ${size(project.memoryBytes)}`);
    }
    if (project.maxViewers) {
        parts.push(`up to ${project.maxViewers} ${project.maxViewers === 1 ? 'person' : 'people'}`);
    }
    if (project.needsToken) {
        parts.push(parts.length > 0 ? 'with a token' : 'Opens with a token');
    }
    return parts.join(' · ');
}

class ProjectsPage {
    #token = stored(() => sessionStorage.getItem(TOKEN)) ?? '';
    /** Object URLs of pictures by their paths @type {Map<string, string>} */
    #pictures = new Map();
    #shown = '';

    constructor() {
        const given = new URLSearchParams(location.hash.slice(1)).get('token');
        if (given) {
            this.#remember(given);
            history.replaceState(null, '', location.pathname);
        }
        byId('access', HTMLFormElement).addEventListener('submit', (event) => {
            event.preventDefault();
            this.#remember(byId('token', HTMLInputElement).value.trim());
            void this.refresh();
        });
        document.addEventListener('visibilitychange', () => void this.refresh());
        setInterval(() => void this.refresh(), AGAIN_MS);
        void this.refresh();
    }

    /** @param {string} token */
    #remember(token) {
        this.#token = token;
        stored(() => sessionStorage.setItem(TOKEN, token));
    }

    /** @param {string} path */
    #fetch(path) {
        return fetch(path, {headers: this.#token ? {Authorization: `Bearer ${this.#token}`} : {}});
    }

    async refresh() {
        if (document.hidden) {
            return;
        }
        try {
            const answer = await this.#fetch('projects.json');
            byId('access', HTMLFormElement).hidden = answer.status !== 401;
            byId('access-problem', HTMLElement).hidden = answer.status !== 401 || !this.#token;
            if (answer.ok) {
                await this.#show((await answer.json()).projects);
            } else {
                this.#say(answer.status === 401 ? 'Needs a token' : `The server answers ${answer.status}`);
            }
        } catch {
            this.#say('No connection, trying again');
        }
    }

    /** @param {string} text */
    #say(text) {
        const summary = byId('summary', HTMLElement);
        if (summary.textContent !== text) {
            summary.textContent = text;
        }
    }

    /** @param {Project[]} projects */
    async #show(projects) {
        const people = projects.reduce((sum, project) => sum + (project.people?.length ?? 0), 0);
        this.#say(
            `${projects.length} ${projects.length === 1 ? 'project' : 'projects'}, ` +
                (people === 0 ? 'nobody there' : `${people} ${people === 1 ? 'person' : 'people'} there`),
        );
        byId('none', HTMLElement).hidden = projects.length > 0;
        const said = JSON.stringify(projects);
        if (said === this.#shown) {
            return;
        }
        this.#shown = said;
        await Promise.all(projects.map((project) => this.#loadPicture(project)));
        const list = byId('projects', HTMLUListElement);
        const focused = document.activeElement?.getAttribute('href');
        list.replaceChildren(...projects.map((project) => this.#card(project)));
        for (const link of list.querySelectorAll('a')) {
            if (focused && link.getAttribute('href') === focused) {
                link.focus();
            }
        }
    }

    /**
     * By a request with the token, which an image cannot send.
     *
     * @param {Project} project
     */
    async #loadPicture({picture}) {
        if (!picture || this.#pictures.has(picture)) {
            return;
        }
        const answer = await this.#fetch(picture);
        if (answer.ok) {
            this.#pictures.set(picture, URL.createObjectURL(await answer.blob()));
        }
    }

    /** @param {Project} project */
    #card(project) {
        const source = project.picture && this.#pictures.get(project.picture);
        const frame = element('div', 'card-picture');
        if (source) {
            const image = document.createElement('img');
            image.src = source;
            image.alt = '';
            frame.append(image);
        } else {
            frame.append(project.needsToken ? 'Picture needs a token' : 'No picture yet');
        }
        const dot = element('span', 'dot');
        dot.setAttribute('aria-hidden', 'true');
        const link = document.createElement('a');
        link.className = 'card';
        link.href = project.path;
        link.dataset.state = project.state;
        link.append(
            frame,
            element(
                'div',
                'card-text',
                element('h2', 'card-title', project.title),
                element('p', 'card-state', dot, element('span', '', stateText(project))),
                element('p', 'card-more', moreText(project)),
            ),
        );
        return element('li', '', link);
    }
}

/** Dark or light, as the page of a project remembers it. */
function addTheme() {
    const root = document.documentElement;
    const button = byId('theme', HTMLButtonElement);
    const light = matchMedia('(prefers-color-scheme: light)');
    const now = () => root.dataset.theme ?? (light.matches ? 'light' : 'dark');
    const show = () => {
        const other = now() === 'light' ? 'dark' : 'light';
        button.title = `Change to ${other} colours`;
        button.setAttribute('aria-label', button.title);
    };
    const last = stored(() => localStorage.getItem(THEME));
    if (last === 'dark' || last === 'light') {
        root.dataset.theme = last;
    }
    button.addEventListener('click', () => {
        root.dataset.theme = now() === 'light' ? 'dark' : 'light';
        stored(() => localStorage.setItem(THEME, root.dataset.theme ?? ''));
        show();
    });
    show();
}

if (globalThis.document?.getElementById('projects')) {
    addTheme();
    new ProjectsPage();
}
