/** furbake for three.js: load baked fur, light it with three's own lights. */

export { type Fur, FurLoaderPlugin } from './FurLoaderPlugin.ts';
export { FurMaterial, type FurMaterialParameters, type FurTextures } from './FurMaterial.ts';
export { type Basis, EXTENSION, type FurAsset, type Pelt, VERSION } from './format.ts';
export { BODY_RADIUS, type Direction, evaluateBasis, lightMoments, relight, smoothFunctions } from './moments.ts';
export { FurShells, MAX_SHELLS } from './shells.ts';
