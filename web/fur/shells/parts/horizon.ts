/** Light of format 1.x. */

export { default as dip } from '../../shaders/light/dip.glsl?raw';
export { default as horizon } from '../../shaders/light/horizon.glsl?raw';
