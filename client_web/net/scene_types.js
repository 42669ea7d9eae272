// SPDX-License-Identifier: Apache-2.0
// Types of protocol/raybundle.proto, as their JSON reads: the scene, and changes of it.
// Lengths in metres, Y up, right-handed.

/**
 * @typedef {{x: number, y: number, z: number}} Vec3
 * @typedef {{x: number, y: number, z: number, w: number}} Quaternion
 * @typedef {{min: Vec3, max: Vec3}} Bounds  world space
 * @typedef {{translation?: Vec3, rotation?: Quaternion, scale?: Vec3}} Transform
 *     local transform of a node, relative to its parent
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
 * @property {number} [colourRendering]  Ra, at least; absent: not known
 * @property {number} [colourRenderingMost]  where only a group of Ra is known
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

/** @typedef {{object: number, transform: Transform, final?: boolean}} MoveObject */

/**
 * What is absent stays.
 *
 * @typedef {{light: number, intensity?: number, on?: boolean, colour?: Vec3, group?: string, dim?: number,
 *     maintenanceFactor?: number, colourRendering?: number, position?: Vec3, aim?: Vec3, rotation?: number, innerCone?: number,
 *     outerCone?: number, photometry?: string, sameType?: boolean, fadeSeconds?: number}} SetLight
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

export {};
