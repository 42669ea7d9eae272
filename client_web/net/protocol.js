// SPDX-License-Identifier: Apache-2.0
// Types of the messages in protocol/raybundle.proto, as their JSON reads, and what names them; those of the scene and of
// what is measured are in scene_types.js and measure_types.js. Lengths in metres, Y up, right-handed; times in
// milliseconds.

/** Version of the protocol that this client speaks, "major.minor". */
export const PROTOCOL_VERSION = '1.0';

/** WebSocket subprotocol. */
export const SUBPROTOCOL = 'raybundle.v1';

/**
 * @typedef {import('./scene_types.js').Effect} Effect
 * @typedef {import('./measure_types.js').Measured} Measured
 * @typedef {import('./measure_types.js').ProbeGridResult} ProbeGridResult
 * @typedef {import('./measure_types.js').ProbeResult} ProbeResult
 * @typedef {import('./measure_types.js').Requirement} Requirement
 * @typedef {import('./scene_types.js').Scene} Scene
 * @typedef {import('./scene_types.js').SceneChanged} SceneChanged
 * @typedef {import('./scene_types.js').Vec3} Vec3
 * @typedef {import('./scene_types.js').View} View
 *
 * @typedef {{width: number, height: number}} Viewport  pixels
 * @typedef {'VIEWER' | 'REVIEWER' | 'EDITOR'} Role
 */

/**
 * Viewports beyond the last two are served smaller. The first two are those of servers without the others.
 *
 * @typedef {object} Limits
 * @property {number} maxWidth
 * @property {number} maxHeight
 * @property {number} [maxMessageBytes]
 * @property {number} [maxSnapshotEdge]  pixels
 * @property {number} [maxViewportPixels]
 * @property {number} [maxViewportEdge]  pixels
 */

/**
 * @typedef {object} Welcome
 * @property {string} protocol
 * @property {string} server
 * @property {number} viewer
 * @property {Role} role
 * @property {number} epoch
 * @property {Scene} scene
 * @property {Limits} limits
 * @property {Viewport} [viewport]  that is served
 * @property {string} [renderer]  of the server's GL
 * @property {boolean} [softwareRendering]
 * @property {boolean} [canOpenScenes]
 * @property {Saving} [saving]
 * @property {string} [name]  that others see
 * @property {Pin[]} [pins]
 * @property {SavedViewpoint[]} [viewpoints]
 * @property {Measured[]} [zones]
 * @property {Requirement[]} [requirements]
 */

/**
 * @typedef {object} Solution
 * @property {number} epoch
 * @property {number} iterations
 * @property {number} iterationsPerSecond
 * @property {number} settled  0..1
 * @property {number} [relativeError]  absent: not known yet
 * @property {number} [errorLow]  95 % interval of relativeError
 * @property {number} [errorHigh]
 * @property {boolean} [errorMeasured]  at some pixels, by path tracing
 * @property {number} [darkerThan]  cd/m²; next to no light arrives, relativeError is absent
 * @property {number} [secondsToTarget]
 * @property {boolean} [targetOutOfReach]  it lies below what samples can reach; the server rests
 * @property {Saving} [saving]
 */

/** @typedef {'SAVING_UNSPECIFIED' | 'SAVED' | 'NOT_SAVED' | 'FAILING'} Saving  whether changes outlast a restart */

/**
 * @typedef {object} FrameHeader
 * @property {number} frame  counts up; numbers of dropped frames are skipped
 * @property {number} epoch
 * @property {number} cameraId  id of the last setCamera that the picture answers; 0: none
 * @property {'JPEG' | 'PNG' | 'VP9'} codec
 * @property {boolean} [key]  of VP9: it is decoded without the frames before it
 * @property {number} width  pixels of the encoded image
 * @property {number} height
 * @property {number} quality
 * @property {number} iterations
 * @property {number} settled  0..1
 * @property {number} [relativeError]  absent: not known yet
 * @property {number} [errorLow]
 * @property {number} [errorHigh]
 * @property {boolean} [errorMeasured]  at some pixels, by path tracing
 * @property {number} [darkerThan]  cd/m²; next to no light arrives, relativeError is absent
 * @property {number} exposure  EV (log2)
 * @property {number} [scaleMaximum]  upper end of the colour scale, lx or cd/m²; absent: a photograph
 * @property {boolean} [scaleLinear]  it begins at 0; absent or false: logarithmic
 * @property {boolean} [scaleIlluminance]  it is one of illuminance, else of luminance
 * @property {number} serverTimeMs
 * @property {number} [depthBytes]  at the end of the message; absent: the frame has no depths
 * @property {number} [depthColumns]
 * @property {number} [depthRows]
 * @property {number} [depthNearest]  metres
 */

/**
 * @typedef {object} Pin
 * @property {number} pin
 * @property {number} by
 * @property {string} byName
 * @property {string} text
 * @property {Vec3} position
 * @property {number} illuminance  lx, when it was set
 * @property {number} epoch  when it was set
 * @property {boolean} removed
 * @property {number} setAtMs  Unix time
 * @property {number} object  0: none
 * @property {Vec3} localPosition  in the space of the object
 * @property {number} [relativeError]
 * @property {number} [change]  of the illuminance since then, relative
 * @property {{byName: string, text: string, atMs: number}[]} [replies]
 * @property {boolean} [resolved]
 * @property {string} [assignedTo]
 */

/**
 * @typedef {object} SavedViewpoint
 * @property {number} viewpoint
 * @property {number} by
 * @property {View & {name: string}} [camera]
 * @property {boolean} removed
 */

/**
 * @typedef {object} Viewer
 * @property {number} viewer
 * @property {string} name
 * @property {Role} role
 * @property {Vec3} eye
 * @property {Vec3} target
 * @property {Vec3} [up]
 * @property {number} verticalFov
 * @property {number} aspect
 * @property {number} following  0: nobody
 */

/**
 * @typedef {object} WalkMap
 * @property {Vec3} origin
 * @property {number} cell  width of a column, metres
 * @property {number} layer  height of a layer, metres
 * @property {number} columns  along x and along z
 * @property {number} layers
 * @property {string} occupied  base64: 8 bytes a column, at z * columns + x; bit k: something is in layer k
 * @property {number} [floor]  height of what is straight below the eye; absent: nothing is
 */

/**
 * @typedef {{name: string, bytes: number, changedAtMs: number}} SceneFile
 * @typedef {{scenes: SceneFile[], current: string, maxUploadBytes: number}} SceneList
 * @typedef {object} SceneOpening
 * @property {string} name
 * @property {number} by  viewer; 0: the server makes ready what it is to show, before the welcome
 * @property {string} byName
 * @property {'READING' | 'PREPARING' | 'COMPILING' | 'READY' | 'REJECTED'} stage
 * @property {string} reason  of REJECTED
 * @property {number} [secondsLeft]  as foreseen
 */

/**
 * @typedef {object} ServerMessage
 * @property {number} [replyTo]
 * @property {Welcome} [welcome]
 * @property {{}} [ok]
 * @property {{code: string, message: string}} [error]
 * @property {SceneChanged} [sceneChanged]
 * @property {ProbeResult} [probeResult]
 * @property {{serverTimeMs: number}} [pong]
 * @property {Solution} [solution]
 * @property {Pin} [pinChanged]
 * @property {SavedViewpoint} [viewpointChanged]
 * @property {{by: number, position: Vec3}} [pointed]
 * @property {{viewers: Viewer[], crowded?: boolean}} [presence]
 * @property {{changes: SceneChanged[]}} [changeHistory]
 * @property {ProbeGridResult} [probeGridResult]
 * @property {Measured} [measured]
 * @property {WalkMap} [walkMap]
 * @property {SceneList} [sceneList]
 * @property {SceneOpening} [sceneOpening]
 * @property {{effects: Effect[]}} [effectCosts]
 * @property {SnapshotReady} [snapshotReady]
 * @property {SnapshotProgress} [snapshotProgress]
 * @property {LightScene} [lightScene]
 * @property {LightMaterial} [lightMaterial]
 * @property {LightSky} [lightSky]
 */

/** @typedef {{scene: number, url: string, values: number, blockValues: number}} LightScene */
/**
 * @typedef {object} LightMaterial  albedo: 4 numbers at each of 32 angles; none: the base colour at every angle
 * @property {number} material
 * @property {Vec3} baseColour
 * @property {number[]} [albedo]
 * @property {Vec3} transparency
 * @property {Vec3} transmittance
 */
/**
 * @typedef {object} LightSky  texels RGB9_E5, in units of `unit` cd/m²
 * @property {Vec3} uniform
 * @property {string} url  empty: no texels
 * @property {number} width
 * @property {number} height
 * @property {number} unit
 * @property {{direction: Vec3, cosine: number, radiance: Vec3}} [sun]
 */

/** @typedef {{url: string, relativeError: number, epoch: number, exposure: number}} SnapshotReady */

/** @typedef {{request: number, ahead: number, relativeError?: number, secondsLeft?: number}} SnapshotProgress */

/** An `error` message of the server, as an exception. */
export class ServerError extends Error {
    /**
     * @param {string} code  e.g. "UNIMPLEMENTED"
     * @param {string} message
     */
    constructor(code, message) {
        super(message);
        this.name = 'ServerError';
        this.code = code;
    }
}

/**
 * Major number of a version.
 *
 * @param {string} version  "major.minor"
 * @returns {string}
 */
export function majorVersion(version) {
    return String(version).split('.')[0];
}
