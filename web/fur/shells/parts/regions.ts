/** Several furs on one body. */

export { default as dissolve } from '../../shaders/hair/regions/dissolve.glsl?raw';
export { default as furs } from '../../shaders/hair/regions/furs.glsl?raw';
export { markFurs } from './markFurs.ts';
export { harden, regionUniforms } from './regionUniforms.ts';
