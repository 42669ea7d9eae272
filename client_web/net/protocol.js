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
 * @typedef {{eye: Vec3, target: Vec3, up: Vec3, verticalFov: number, near?: number}} View  fov in radians; near: of plans
 *     and sections, what is nearer along the line of sight is not shown, metres
 */

/**
 * @typedef {object} SceneObject
 * @property {number} id
 * @property {string} name
 * @property {boolean} movable
 * @property {Bounds} bounds
 * @property {Transform} transform
 * @property {number[]} [worldFromParent]  affine 4x4 matrix, column by column
 * @property {'THING' | 'STRUCTURE' | 'DOOR'} [kind]  as names tell
 * @property {string[]} [path]  names of the nodes above it, the outermost first
 * @property {string} [storey]  empty: none
 * @property {boolean} [added]  not of the scene file
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
 * @typedef {object} Light
 * @property {number} id
 * @property {string} name
 * @property {string} kind
 * @property {number} intensity  photometric, in `unit`
 * @property {string} unit
 * @property {Vec3} colour  of luminance 1
 * @property {boolean} on
 * @property {number} [loadedIntensity]  as the scene file has it
 * @property {Vec3} [loadedColour]  likewise
 * @property {number} [flux]  lm, at loadedIntensity
 * @property {number} [peak]  largest luminous intensity, cd, at loadedIntensity
 * @property {number} [watts]  as its photometric file states it
 * @property {string} [group]  empty: none; absent: it can have none
 * @property {number} [dim]  0..1, share of `intensity` that it shines with
 * @property {number} [maintenanceFactor]
 * @property {Vec3} [position]  metres; absent: it has none of its own
 * @property {Vec3} [aim]  likewise
 * @property {number} [rotation]  about its aim, degrees
 * @property {number} [innerCone]  half of its angle, degrees
 * @property {number} [outerCone]
 * @property {number} [carrier]  object that carries it
 * @property {string} [photometry]  file that it shines by; empty: none, or not known
 * @property {boolean} [added]  not of the scene file
 */

/**
 * @typedef {object} Material
 * @property {number} id
 * @property {string} name
 * @property {Vec3} [baseColour]  linear Rec. 709; absent: not told
 * @property {number} [roughness]  0..1
 * @property {number} [metallic]  0..1
 * @property {boolean} [matt]  without gloss as long as metallic is 0
 */

/**
 * @typedef {object} Scene
 * @property {string} name
 * @property {Bounds} bounds
 * @property {SceneObject[]} objects
 * @property {Light[]} lights
 * @property {(View & {name: string})[]} cameras
 * @property {Material[]} materials
 * @property {Effect[]} effects
 * @property {{name: string, byName: string}[]} [lightingScenes]
 * @property {SetDaylight} [daylight]
 * @property {Animation[]} [animations]
 */

/**
 * @typedef {object} PlayAnimation
 * @property {string} animation
 * @property {boolean} [playing]
 * @property {number} [seconds]
 * @property {number} [speed]
 * @property {boolean} [loop]
 */

/**
 * @typedef {object} Animation
 * @property {string} name
 * @property {number} seconds  its length
 * @property {number[]} objects  that it moves
 * @property {number[]} lights
 * @property {number[]} materials
 * @property {PlayAnimation & {seconds: number}} state
 */

/**
 * @typedef {object} Effect
 * @property {string} name
 * @property {boolean} active
 * @property {string} reason
 * @property {string} [pathClass]  Heckbert's notation
 * @property {number} [shareBound]  0..1
 * @property {number} [bytesPerPatch]
 * @property {number} [msPerIteration]  measured
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
 * @property {'JPEG' | 'PNG'} codec
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

/** @typedef {{object: number, transform: Transform, final?: boolean}} MoveObject */

/**
 * What is absent stays.
 *
 * @typedef {{light: number, intensity?: number, on?: boolean, colour?: Vec3, group?: string, dim?: number,
 *     maintenanceFactor?: number, position?: Vec3, aim?: Vec3, rotation?: number, innerCone?: number,
 *     outerCone?: number, photometry?: string, sameType?: boolean}} SetLight
 */

/**
 * @typedef {object} SetDaylight
 * @property {string} [sky]
 * @property {{latitude: number, longitude: number}} [place]
 * @property {number} [north]
 * @property {string} [time]
 * @property {number} [sunElevation]
 * @property {number} [sunAzimuth]
 * @property {Light[]} [lights]  from the server: in place of those from the first one's id on
 */

/**
 * @typedef {{material: number, baseColour?: Vec3, roughness?: number, metallic?: number}} SetMaterial
 */

/**
 * @typedef {object} SceneChanged
 * @property {number} epoch
 * @property {number} by
 * @property {MoveObject} [moveObject]
 * @property {SetLight} [setLight]
 * @property {SetDaylight} [setDaylight]
 * @property {SetDaylight} [daylightBefore]
 * @property {SetMaterial} [setMaterial]
 * @property {{object: number, name?: string}} [addObject]
 * @property {{object: number}} [removeObject]
 * @property {{light: number, name?: string}} [addLuminaire]
 * @property {{light: number}} [removeLight]
 * @property {SceneObject[]} [objects]  that have been added, or are there again
 * @property {Light[]} [lights]  likewise, and those that shine by another file
 * @property {Material[]} [materials]  that came with an object
 * @property {string} [byName]
 * @property {number} [atMs]  Unix time
 * @property {MoveObject} [objectBefore]  what it was like before
 * @property {SetLight} [lightBefore]
 * @property {SetMaterial} [materialBefore]
 * @property {number} [firstEpoch]  of several steps
 * @property {{animation: string, seconds: number, firstEpoch: number}} [animation]  that makes it
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

/** @typedef {{illuminance: number[], relativeError: number[], epoch: number}} ProbeGridResult */

/**
 * @typedef {object} MeasuredPoint
 * @property {Vec3} position
 * @property {number} [value]  lx, or % of DAYLIGHT_FACTOR; absent: the point lies in a solid
 * @property {number} [low]  of the 95 % interval
 * @property {number} [high]
 * @property {boolean} inside  in a solid
 * @property {Glare} [glare]  of UGR and DGP
 */

/**
 * @typedef {{name: string, light: number, position: Vec3, share: number, luminance: number, solidAngle: number,
 *     positionIndex: number}} GlareSource  share: 0..1 of what glares
 *
 * @typedef {object} Glare
 * @property {'RATED' | 'NO_SOURCE' | 'OUTSIDE'} state
 * @property {Vec3} direction  worst view
 * @property {number} background  cd/m², of DGP lx
 * @property {GlareSource[]} sources  the strongest first
 * @property {string} words  what is left out, or outside of the method's range
 * @property {number[]} luminances  of DGP, cd/m²: within 10, 30 and 60 degrees
 */

/** @typedef {'VERDICT_UNSPECIFIED' | 'MET' | 'MISSED' | 'NOT_YET_KNOWN'} Verdict */
/** @typedef {{what: string, required: number, atMost: boolean, verdict: Verdict}} Check */

/**
 * @typedef {object} Requirement
 * @property {string} name
 * @property {number} [mean]  lx
 * @property {number} [uniformity]
 * @property {number} [glare]  UGR at most
 * @property {number} [cylindrical]  lx
 * @property {number} [vertical]  lx
 * @property {number} [daylightFactor]  %
 * @property {number} [daylightGlare]  DGP at most
 * @property {number} [colourRendering]  Ra
 */

/**
 * @typedef {object} Measured  numbers of the area are absent where all points lie in solids
 * @property {number} measurement
 * @property {string} quantity
 * @property {number} epoch
 * @property {number} settled
 * @property {number} columns  0: single points
 * @property {number} rows
 * @property {MeasuredPoint[]} points
 * @property {number} [mean]
 * @property {number} [meanLow]
 * @property {number} [meanHigh]
 * @property {number} [minimum]
 * @property {number} [minimumLow]
 * @property {number} [minimumHigh]
 * @property {number} [maximum]
 * @property {number} [maximumLow]
 * @property {number} [maximumHigh]
 * @property {number} [uniformity]
 * @property {number} [uniformityLow]
 * @property {number} [uniformityHigh]
 * @property {number} [diversity]
 * @property {number} [diversityLow]
 * @property {number} [diversityHigh]
 * @property {number} [relativeError]
 * @property {number} factor
 * @property {number} [spacing]  m
 * @property {boolean} [maintained]
 * @property {string} [name]  of a zone
 * @property {string} [requirement]  that it is to meet
 * @property {Check[]} [checks]
 * @property {Verdict} [verdict]
 * @property {boolean} [removed]
 * @property {Vec3[]} [outline]  its corners, world space
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
 * @typedef {object} ProbeResult
 * @property {boolean} hit
 * @property {Vec3} [position]
 * @property {Vec3} [normal]
 * @property {number} [object]  0: part of no object
 * @property {number} [patch]
 * @property {number} [material]  Material.id
 * @property {number} [illuminance]  lx
 * @property {number} [luminance]  cd/m²
 * @property {number} [relativeError]
 * @property {number} epoch
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
