// SPDX-License-Identifier: Apache-2.0
// Types of the messages in protocol/raybundle.proto, as their JSON reads, and what names them.
// Lengths in metres, Y up, right-handed; times in milliseconds.

/** Version of the protocol that this client speaks, "major.minor". */
export const PROTOCOL_VERSION = '1.0';

/** WebSocket subprotocol. */
export const SUBPROTOCOL = 'raybundle.v1';

/**
 * @typedef {{x: number, y: number, z: number}} Vec3
 * @typedef {{x: number, y: number, z: number, w: number}} Quaternion
 * @typedef {{min: Vec3, max: Vec3}} Bounds  world space
 * @typedef {{translation?: Vec3, rotation?: Quaternion, scale?: Vec3}} Transform
 *     local transform of a node, relative to its parent
 * @typedef {{width: number, height: number}} Viewport  pixels
 * @typedef {'VIEWER' | 'REVIEWER' | 'EDITOR'} Role
 * @typedef {{eye: Vec3, target: Vec3, up: Vec3, verticalFov: number}} View  fov in radians
 */

/**
 * @typedef {object} SceneObject
 * @property {number} id
 * @property {string} name
 * @property {boolean} movable
 * @property {Bounds} bounds
 * @property {Transform} transform
 * @property {number[]} [worldFromParent]  affine 4x4 matrix, column by column
 */

/**
 * @typedef {object} Light
 * @property {number} id
 * @property {string} name
 * @property {string} kind
 * @property {number} intensity  photometric, in `unit`
 * @property {string} unit
 * @property {Vec3} colour  of luminance 1
 * @property {boolean} on
 */

/**
 * @typedef {object} Scene
 * @property {string} name
 * @property {Bounds} bounds
 * @property {SceneObject[]} objects
 * @property {Light[]} lights
 * @property {(View & {name: string})[]} cameras
 * @property {{id: number, name: string}[]} materials
 * @property {{name: string, active: boolean, reason: string}[]} effects
 */

/**
 * @typedef {object} Welcome
 * @property {string} protocol
 * @property {string} server
 * @property {number} viewer
 * @property {Role} role
 * @property {number} epoch
 * @property {Scene} scene
 * @property {{maxWidth: number, maxHeight: number, maxMessageBytes: number}} limits
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
 * @property {number} [secondsToTarget]
 */

/**
 * @typedef {object} FrameHeader
 * @property {number} frame  counts up; numbers of dropped frames are skipped
 * @property {number} epoch
 * @property {number} cameraId  id of the last setCamera that the picture answers; 0: none
 * @property {'JPEG' | 'PNG'} codec
 * @property {number} width  pixels of the encoded image
 * @property {number} height
 * @property {number} quality
 * @property {number} iterations
 * @property {number} settled  0..1
 * @property {number} [relativeError]  absent: not known yet
 * @property {number} [errorLow]
 * @property {number} [errorHigh]
 * @property {number} exposure  EV (log2)
 * @property {number} serverTimeMs
 */

/** @typedef {{object: number, transform: Transform, final?: boolean}} MoveObject */

/** @typedef {{epoch: number, by: number, moveObject?: MoveObject}} SceneChanged */

/**
 * @typedef {object} ProbeResult
 * @property {boolean} hit
 * @property {Vec3} [position]
 * @property {Vec3} [normal]
 * @property {number} [object]  0: part of no object
 * @property {number} [patch]
 * @property {number} [illuminance]  lx
 * @property {number} [luminance]  cd/m²
 * @property {number} [relativeError]
 * @property {number} epoch
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
 */

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
