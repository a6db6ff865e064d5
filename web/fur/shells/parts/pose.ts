/** Joints and morph targets of a body. */

export { FurPose } from '../../body/FurPose.ts';
export { Morphs } from '../../body/Morphs.ts';
export { default as joints } from '../../shaders/hair/pose/joints.glsl?raw';
export { default as morphs } from '../../shaders/hair/pose/morphs.glsl?raw';
