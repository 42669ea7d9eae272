// SPDX-License-Identifier: Apache-2.0
// Whether a GPU draws what a page tells WebGL to, or the processor.

/** @typedef {'gpu' | 'processor' | 'unknown'} Drawer */

/** Names of drawing without a GPU, as browsers know it. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** @type {Drawer} */
let known = 'unknown';

/**
 * Who draws in a context; all contexts of a page have the same drawer. Chromium says only by the renderer's name that
 * SwiftShader draws.
 *
 * @param {WebGL2RenderingContext} gl
 * @returns {Drawer}
 */
export function noteDrawer(gl) {
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    const name = String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
    known = SOFTWARE.test(name) ? 'processor' : 'gpu';
    return known;
}

/** Who draws here, as the last context has said. @returns {Drawer} */
export const drawer = () => known;
