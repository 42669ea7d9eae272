// SPDX-License-Identifier: Apache-2.0
// Types of protocol/raybundle.proto, as their JSON reads: what is measured, and what is required of it.

/** @typedef {import('./scene_types.js').Vec3} Vec3 */

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

/**
 * @typedef {{what: string, required: number, atMost: boolean, verdict: Verdict, words?: string}} Check  words: of Ra which
 *     luminaires fall short, or do not state it
 */

/**
 * @typedef {{light: number, name: string, share: number, colourRendering?: number, colourRenderingMost?: number}} ZoneLuminaire
 *     share: of the light of all lamps there, 0..1; colourRendering: Ra, at least
 */

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
 * @property {boolean} [direct]  without light that surfaces have reflected
 * @property {string} [name]  of a zone
 * @property {string} [requirement]  that it is to meet
 * @property {Check[]} [checks]
 * @property {Verdict} [verdict]
 * @property {boolean} [removed]
 * @property {Vec3[]} [outline]  its corners, world space
 * @property {ZoneLuminaire[]} [luminaires]  that light a zone, the strongest first
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

export {};
