/**
 * furbake for three.js: load baked fur, light it with three's own lights, move it, wet it.
 *
 * @module furbake
 */

export { type FurMethod, type FurMethodName, type FurMethodOptions, furMethod } from './baselines/furMethod.ts';
export type { FurFollicles } from './body/FurFollicles.ts';
export { keepThinFurParts } from './body/skin/thin.ts';
export { dressFur, type FurDressOptions } from './dressFur.ts';
export { Fur, type FurStates } from './Fur.ts';
export { type FurLoaderOptions, FurLoaderPlugin } from './FurLoaderPlugin.ts';
export { FUR_EXTENSION, FUR_VERSION, type FurAsset } from './format.ts';
export type { FurSimplifier } from './herd/FarSurface.ts';
export { FurInstances } from './herd/FurInstances.ts';
export { fitFurShadow } from './light/fitFurShadow.ts';
export { type FurEnvironment, type FurLamp, furEnvironment } from './light/furEnvironment.ts';
export { FurColors } from './light/multiple.ts';
export type { FurTextures } from './light/texels.ts';
export { FurMotion } from './motion/FurMotion.ts';
export type { FurMotionOptions } from './motion/options.ts';
export type { FurWind } from './motion/Wind.ts';
export { FurEdgeEffect } from './picture/FurEdgeEffect.ts';
export { FurFade } from './picture/FurFade.ts';
export { FurGovernor, type FurGovernorOptions } from './picture/FurGovernor.ts';
export { prepareFur } from './picture/prepareFur.ts';
export { type FurLimits, furLimits } from './planes/furLimits.ts';
export type { FurColumns } from './shells/clip.ts';
export { FurFinMaterial, type FurFinMaterialParameters } from './shells/FurFinMaterial.ts';
export { FurFins } from './shells/FurFins.ts';
export { FurMaterial, type FurMaterialParameters } from './shells/FurMaterial.ts';
export { FurShells } from './shells/FurShells.ts';
export { updateFurs } from './updateFurs.ts';
export { FurWeather, type FurWeatherOptions } from './weather/FurWeather.ts';
