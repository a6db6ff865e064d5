/** Light of format 1.x. */

export { default as dip } from '../../shaders/light/horizon/dip.glsl?raw';
export { default as horizon } from '../../shaders/light/horizon/horizon.glsl?raw';
