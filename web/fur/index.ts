/** furbake for three.js: load baked fur, light it with three's own lights. */

export { type Coat, type FurMethod, furMethod, type MethodOptions } from './baselines/method.ts';
export { METHODS, type MethodName } from './baselines/names.ts';
export type { Columns } from './clip.ts';
export { curvedMoments, type MeanCurves } from './curves.ts';
export {
	type EnvironmentLight,
	environmentLight,
	type Lamp,
	luminance,
	type Visit,
	visitEnvironment,
} from './environment.ts';
export { FinMaterial, type FinMaterialParameters } from './FinMaterial.ts';
export { type DressOptions, dress, Fur, type HasStates } from './Fur.ts';
export { FurFade } from './FurFade.ts';
export { type FurLoaderOptions, FurLoaderPlugin } from './FurLoaderPlugin.ts';
export { FurMaterial, type FurMaterialParameters } from './FurMaterial.ts';
export { FurWeather, type WeatheredBody, type WeatherOptions } from './FurWeather.ts';
export { FurFins } from './fins.ts';
export { FOLLICLES_PER_ROW, Follicles } from './follicles.ts';
export {
	alphaChannel,
	type Basis,
	type Curves,
	channelOf,
	EXTENSION,
	type Fin,
	type FurAsset,
	type Multiple,
	type Pelt,
	type RGB,
	type Slot,
	VERSION,
} from './format.ts';
export { FurGovernor, type GovernorOptions } from './governor.ts';
export { FurInstances } from './instances.ts';
export { checkLimits, limitsOf, type TextureLimits } from './limits.ts';
export {
	BODY_RADIUS,
	type Direction,
	environmentMoments,
	evaluateBasis,
	lightMoments,
	relight,
	smoothFunctions,
} from './moments.ts';
export { FurMotion } from './motion/FurMotion.ts';
export type { MotionOptions } from './motion/options.ts';
export { type Spring, springOf } from './motion/spring.ts';
export type { WindSettings } from './motion/Wind.ts';
export { SeenColours } from './multiple.ts';
export { prepareFur } from './prepare.ts';
export { SmoothEdges } from './SmoothEdges.ts';
export { fitShadow } from './shadow.ts';
export { FurShells, MAX_SHELLS } from './shells.ts';
export type { FurTextures, SlabMeanCurves } from './texels.ts';
