/**
 * The arithmetic behind the pictures, on the CPU in double precision: light moments, means of slabs, the sky, springs, and
 * where the format stores what. For checks and measurements; no picture needs it.
 *
 * @module furbake/reference
 */

export {
	alphaChannel,
	type Basis,
	type Curves,
	channelOf,
	type Fin,
	type Multiple,
	type Pelt,
	type RGB,
	type RegionFur,
	type Slot,
} from './format.ts';
export { curvedMoments, type MeanCurves } from './light/curves.ts';
export { luminance, type Visit, visitEnvironment } from './light/furEnvironment.ts';
export {
	BODY_RADIUS,
	type Direction,
	environmentMoments,
	evaluateBasis,
	lightMoments,
	relight,
	smoothFunctions,
} from './light/moments.ts';
export { type Spring, springOf } from './motion/spring.ts';
