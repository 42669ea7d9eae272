// SPDX-License-Identifier: Apache-2.0
// Starts the page: the application, its tools and panels, its keys, buttons and gestures.

import {RaybundleApp} from './app/app.js';
import {Collisions} from './camera/collisions.js';
import {addDrawing} from './drawing/drawing_switch.js';
import {Compare} from './review/compare.js';
import {DisplayPanel} from './measure/display_panel.js';
import {swung} from './scene/doors.js';
import {addEffects} from './scene/effects.js';
import {announce, byId, fileName, returnFocus, saveFile, whileAsked} from './ui/elements.js';
import {Gizmo} from './scene/gizmo.js';
import {Grabbing} from './scene/grabbing.js';
import {GlarePanel} from './measure/glare_panel.js';
import {LightArrowsLayer} from './measure/light_arrows_layer.js';
import {OutlinesLayer} from './measure/outlines_layer.js';
import {WorkPlanePanel} from './measure/work_plane_panel.js';
import {ZonesPanel} from './measure/zones_panel.js';
import {Documents} from './review/documents.js';
import {GridPanel} from './measure/grid_panel.js';
import {ChangeList} from './review/change_list.js';
import {History, addHistory, subjectOf} from './scene/history.js';
import {IsolineNumbers} from './measure/isolines.js';
import {addKeys} from './app/keys.js';
import {AnimationPanel} from './scene/animation_panel.js';
import {DaylightPanel} from './scene/daylight_panel.js';
import {Fade} from './lights/fade.js';
import {LightGroups} from './lights/light_groups.js';
import {LightPanel} from './lights/light_panel.js';
import {Luminaires} from './scene/luminaires.js';
import {Lost} from './camera/lost.js';
import {Marks} from './picture/marks.js';
import {Measuring} from './measure/measure.js';
import {MeasuredStrip} from './measure/measured_strip.js';
import {People} from './review/people.js';
import {PICTURE_SIZES} from './picture/picture.js';
import {Pins} from './review/pins.js';
import {Plans} from './camera/plans.js';
import {PointerControl} from './camera/pointer_control.js';
import {reportHtml} from './review/report.js';
import {SavingState} from './ui/saving.js';
import {SceneFiles} from './scene/scene_files.js';
import {ScenePanel} from './scene/scene_panel.js';
import {SceneSaving} from './scene/scene_saving.js';
import {fromHash, toHash} from './review/share.js';
import {SnapshotPanel} from './review/snapshot_panel.js';
import {Things} from './scene/things.js';
import {addTabs} from './app/tabs.js';
import {addTheme} from './app/theme.js';
import {TargetPanel} from './measure/target_panel.js';
import {Viewpoints} from './review/viewpoints.js';
import {FirstHint, Walking, remembered} from './camera/walking.js';

/** Below this width the panel starts closed, CSS pixels. */
const PHONE_WIDTH = 700;

/** The WebSocket beside this page. */
function socketUrl() {
    const url = new URL('ws', location.href);
    url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
    url.search = url.hash = '';
    return url.href;
}

const shared = fromHash(location.hash);
const inAddress = new URLSearchParams(location.hash.slice(1));
const app = new RaybundleApp({
    url: socketUrl(),
    name: inAddress.get('name') ?? remembered('name') ?? '',
    token: inAddress.get('token') ?? '',
    view: shared.view,
    video: {on: true, off: false}[inAddress.get('video') ?? ''],
});
const history = new History();
const marks = new Marks(app);
const display = new DisplayPanel(app);
const drawing = addDrawing(app, display, inAddress.get('draw'));
const collisions = new Collisions(app);
const walking = new Walking(app, collisions);
const gizmo = new Gizmo(app);
const grabbing = new Grabbing(app);
const measuring = new Measuring(app, marks, display);
const gridPanel = new GridPanel(app, measuring, display);
const workPlane = new WorkPlanePanel(app, measuring, collisions);
const zones = new ZonesPanel(app, measuring, workPlane);
new OutlinesLayer(app, workPlane, zones);
new LightArrowsLayer(app, measuring, workPlane, zones);
new GlarePanel(app);
new Documents(app, measuring);
const people = new People(app, marks);
const pins = new Pins(app, marks, people, measuring);
const changes = new ChangeList(app);
app.on('sceneChanged', (/** @type {import('./net/scene_types.js').SceneChanged} */ change) => {
    if (change.by !== app.client.welcome?.viewer) {
        history.noteOther(subjectOf(change), people.name(change.by));
    }
});
app.on('missed', (/** @type {import('./scene/history.js').Subject[]} */ subjects) => {
    for (const subject of subjects) {
        history.noteOther(subjectOf(subject), 'Somebody');
    }
});
const compare = new Compare(app, display, changes);
const showTab = addTabs(/** @type {HTMLElement} */ (document.querySelector('[role="tablist"]')));
new MeasuredStrip(app, measuring, () => {
    setPanel(true);
    showTab('tab-measure');
    byId('tab-measure', HTMLElement).focus({preventScroll: true});
});
new ScenePanel(app, grabbing, history);
const plans = new Plans(app, collisions);
const saving = new SavingState(app);
new SceneSaving(app);
new SceneFiles(app, () => ({changes: changes.entries.length || (app.scene?.epoch ?? 0), pins: pins.pins.size, forgets: saving.forgets}));
new SnapshotPanel(app);
const things = new Things(app, history);
const luminaires = new Luminaires(app, things, collisions);
const fade = new Fade();
const lightPanel = new LightPanel(app, history, {things, luminaires, fade}, () => {
    setPanel(true);
    showTab('tab-light');
});
new LightGroups(app, history, fade);
new DaylightPanel(app, history);
new AnimationPanel(app, history);
new TargetPanel(app);
new Viewpoints(app);
new FirstHint(app);
new Lost(app, display, collisions);
new IsolineNumbers(app, display);
addHistory(app, history);
addEffects(app);
addTheme();
app.on('welcome', () => {
    byPinButton().hidden = !app.mayReview;
    byId('pins-how', HTMLElement).hidden = !app.mayReview;
    byId('pins-view-only', HTMLElement).hidden = app.mayReview;
    if (!app.mayReview && app.tool === 'pin') {
        setTool('select');
    }
});

const byPinButton = () => /** @type {HTMLElement} */ (document.querySelector('[data-tool="pin"]'));

/** What was selected before each of the last two clicks. @type {(number | null)[]} */
let selectedBefore = [];
/** Of clicks that select, the newest holds. */
let clicks = 0;

/**
 * What a click on the picture does, by tool.
 *
 * @param {import('./camera/pointer_control.js').Point} at
 */
async function clickAt(at) {
    if (app.tool === 'measure') {
        await measuring.measureAt(at);
    } else if (app.tool === 'pin') {
        await pins.askAt(at);
    } else if (app.tool === 'aim') {
        await lightPanel.aiming.clickAt(at);
    } else {
        selectedBefore = [...selectedBefore.slice(-1), app.selected?.id ?? null];
        const click = ++clicks;
        const object = await whileAsked(app.picture.element, at, app.pickAt(at.x, at.y));
        if (click === clicks) {
            app.select(object?.movable || object?.kind === 'STRUCTURE' ? object.id : null);
            lightPanel.pick(app.picker.material);
        }
    }
}

/**
 * A double click opens or closes a door, or else goes there; what its two clicks have selected is as it was.
 *
 * @param {import('./camera/pointer_control.js').Point} at
 */
async function doubleClickAt(at) {
    if (app.tool === 'select') {
        ++clicks;
        const door = await app.pickAt(at.x, at.y);
        if (door?.kind === 'DOOR' && door.loose && app.mayEdit) {
            app.select(door.id);
            app.mover.move(door, swung(door, app.view.eye));
            return;
        }
        if (selectedBefore.length > 0 && (app.selected?.id ?? null) !== selectedBefore[0]) {
            app.select(selectedBefore[0]);
        }
        walking.goTo(at);
    }
}

/** @param {string} tool */
function setTool(tool) {
    if (tool === 'pin' && app.scene && !app.mayReview) {
        app.status.notify('View only. Ask for reviewer access to add pins.');
        return;
    }
    pins.cancel();
    app.setTool(tool);
    for (const button of document.querySelectorAll('[data-tool]')) {
        const pressed = /** @type {HTMLElement} */ (button).dataset.tool === tool;
        button.setAttribute('aria-pressed', String(pressed));
    }
    if (tool !== 'select') {
        showTab(tool === 'measure' ? 'tab-measure' : 'tab-review');
    }
}

/** Link to what is on screen. */
function linkHere() {
    const url = new URL(location.href);
    url.hash = toHash({
        view: app.view,
        exposure: display.autoExposure ? null : display.exposure,
        mode: display.mode,
        selected: app.selected?.id ?? null,
    });
    return url.href;
}

async function copyLink() {
    const link = linkHere();
    try {
        await navigator.clipboard.writeText(link);
        app.status.notify('A link to this view has been copied.');
    } catch {
        // Without the right to the clipboard the address bar has it.
        window.history.replaceState(null, '', link);
        app.status.notify('The address of this page is now a link to this view.');
    }
}

function saveReport() {
    const {canvas} = app.picture;
    const seen = [...pins.pins.values()].flatMap((pin) => {
        const {x, y, depth} = app.project(pins.positionOf(pin));
        const {clientWidth, clientHeight} = app.picture.element;
        const at = {pin: pin.pin, x: x / clientWidth, y: y / clientHeight};
        return depth > 0 && at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1 ? [at] : [];
    });
    const grid = gridPanel.shown && {
        object: gridPanel.shown.surface,
        columns: gridPanel.shown.grid.columns,
        rows: gridPanel.shown.grid.rows,
        ...gridPanel.shown.result,
    };
    const title = app.scene?.title ?? 'Scene';
    const html = reportHtml({
        title,
        server: app.client.welcome?.server ?? '',
        time: new Date(),
        epoch: app.scene?.epoch ?? 0,
        error: app.stats.relativeError,
        darkerThan: app.stats.darkerThan,
        picture: canvas.toDataURL('image/jpeg', 0.92),
        scale: display.scale,
        address: linkHere(),
        unit: measuring.unit,
        pins: [...pins.pins.values()],
        points: measuring.points,
        grid,
        changes: changes.entries,
        pinsInPicture: seen,
    });
    saveFile(new Blob([html], {type: 'text/html'}), `${fileName(title)}_review.html`);
}

/** @param {boolean} open */
function setPanel(open) {
    byId('app', HTMLElement).classList.toggle('panel-closed', !open);
    byId('panel-toggle', HTMLElement).setAttribute('aria-expanded', String(open));
}

/** Shows the list of keys, or closes it again. */
function showKeys() {
    const help = byId('help', HTMLDetailsElement);
    const seen = help.open && help.checkVisibility();
    help.open = !seen;
    if (!seen) {
        setPanel(true);
        help.scrollIntoView({block: 'start'});
        announce('The keys are listed at the end of the panel.');
    }
}

/** On a phone the panel, which takes half of the picture, closes too. */
function leave() {
    const panel = byId('panel', HTMLElement);
    if (innerWidth <= PHONE_WIDTH && panel.contains(document.activeElement)) {
        setPanel(false);
        byId('panel-toggle', HTMLElement).focus();
    } else {
        app.picture.element.focus({preventScroll: true});
    }
}

function addButtons() {
    for (const button of document.querySelectorAll('[data-tool]')) {
        button.addEventListener('click', (event) => {
            setTool(/** @type {HTMLElement} */ (button).dataset.tool ?? 'select');
            returnFocus(/** @type {MouseEvent} */ (event));
        });
    }
    const size = byId('picture-size', HTMLSelectElement);
    size.addEventListener('change', () => {
        if (size.value in PICTURE_SIZES) {
            app.picture.size = /** @type {import('./picture/picture.js').PictureSize} */ (size.value);
        }
    });
    const toggle = byId('panel-toggle', HTMLButtonElement);
    toggle.addEventListener('click', () => {
        setPanel(toggle.getAttribute('aria-expanded') !== 'true');
    });
    byId('summary', HTMLElement).addEventListener('click', () => {
        setPanel(true);
        showTab('tab-accuracy');
    });
    app.addEventListener('upload', () => {
        setPanel(true);
        showTab('tab-scene');
    });
    byId('share', HTMLElement).addEventListener('click', copyLink);
    byId('share-again', HTMLElement).addEventListener('click', copyLink);
    byId('report', HTMLElement).addEventListener('click', saveReport);
    setPanel(innerWidth > PHONE_WIDTH);
}

/** What a link says besides the view: once, at the first welcome. */
function restoreShared() {
    let restored = false;
    app.on('welcome', () => {
        if (restored) {
            return;
        }
        restored = true;
        if (shared.mode !== 'PHOTO') {
            display.setMode(shared.mode);
        }
        if (shared.exposure !== null) {
            display.autoExposure = false;
            display.setExposure(shared.exposure);
        }
        if (shared.selected !== null) {
            setTimeout(() => app.select(shared.selected));
        }
    });
}

const pointers = new PointerControl(app.picture.element, {
    grab: (at) => grabbing.grab(at),
    drag: (at) => grabbing.drag(at),
    release: (keep) => grabbing.release(keep),
    hover: (at) => grabbing.hover(at),
    click: clickAt,
    turn: (x, y) => app.camera.turn(x, y),
    pan: (x, y) => app.camera.pan(x, y),
    zoom: (factor) => app.camera.zoom(factor),
});
app.picture.element.addEventListener('dblclick', (event) => {
    const box = app.picture.element.getBoundingClientRect();
    doubleClickAt({x: event.clientX - box.left, y: event.clientY - box.top});
});
addButtons();
addKeys({
    app,
    walking,
    collisions,
    gizmo,
    grabbing,
    display,
    history,
    things,
    setTool,
    removeLastPoint: () => measuring.removeLast(),
    clickMiddle: () => {
        const {clientWidth, clientHeight} = app.picture.element;
        clickAt({x: clientWidth / 2, y: clientHeight / 2});
    },
    cancel: () => pins.cancel() || lightPanel.aiming.cancel() || gizmo.cancel() || pointers.cancel() || compare.close(),
    showKeys,
    leave,
});
restoreShared();
document.addEventListener('visibilitychange', () => {
    app.client.paused = document.hidden;
});
Object.assign(window, {raybundle: app, raybundleParts: {collisions, display, drawing, plans, walking, measuring, gridPanel, people, pins, compare, history}});
app.start();
