/** The public face of the library: a name more or less is a decision, and stands in the changelog. */

import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import * as library from '../../../web/fur/index.ts';
import * as reference from '../../../web/fur/reference.ts';

/** Types that an entry point exports. */
function typesOf(entry: string): string[] {
	const text = readFileSync(new URL(`../../../web/fur/${entry}.ts`, import.meta.url), 'utf8');
	const exported = [...text.matchAll(/export (type )?\{([^}]*)\}/g)].flatMap(([, all, names = '']) =>
		names
			.split(',')
			.map((name) => name.trim())
			.filter((name) => name && (all || name.startsWith('type ')))
			.map((name) => name.replace(/^type /, '')),
	);
	return exported.sort();
}

it('exports these names', () => {
	expect(Object.keys(library).sort()).toMatchInlineSnapshot(`
		[
		  "FUR_EXTENSION",
		  "FUR_VERSION",
		  "Fur",
		  "FurColors",
		  "FurEdgeEffect",
		  "FurFade",
		  "FurFinMaterial",
		  "FurFins",
		  "FurGovernor",
		  "FurInstances",
		  "FurLoaderPlugin",
		  "FurMaterial",
		  "FurMotion",
		  "FurShells",
		  "FurWeather",
		  "dressFur",
		  "fitFurShadow",
		  "furEnvironment",
		  "furLimits",
		  "furMethod",
		  "keepThinFurParts",
		  "prepareFur",
		  "updateFurs",
		]
	`);
	expect(typesOf('index')).toMatchInlineSnapshot(`
		[
		  "FurAsset",
		  "FurColumns",
		  "FurDressOptions",
		  "FurEnvironment",
		  "FurFinMaterialParameters",
		  "FurFollicles",
		  "FurGovernorOptions",
		  "FurLamp",
		  "FurLimits",
		  "FurLoaderOptions",
		  "FurMaterialParameters",
		  "FurMethod",
		  "FurMethodName",
		  "FurMethodOptions",
		  "FurMotionOptions",
		  "FurSimplifier",
		  "FurStates",
		  "FurTextures",
		  "FurWeatherOptions",
		  "FurWind",
		]
	`);
});

it('exports nothing but names of fur', () => {
	for (const name of [...Object.keys(library), ...typesOf('index')]) expect(name).toMatch(/^FUR_|^Fur|^fur|[a-z]Furs?/);
	expect(Object.keys(library).length).toBeLessThanOrEqual(25);
});

it('exports what is behind the pictures apart', () => {
	expect(Object.keys(reference).sort()).toMatchInlineSnapshot(`
		[
		  "BODY_RADIUS",
		  "alphaChannel",
		  "channelOf",
		  "curvedMoments",
		  "environmentMoments",
		  "evaluateBasis",
		  "lightMoments",
		  "luminance",
		  "relight",
		  "smoothFunctions",
		  "springOf",
		  "visitEnvironment",
		]
	`);
	expect(typesOf('reference')).toMatchInlineSnapshot(`
		[
		  "Basis",
		  "Curves",
		  "Direction",
		  "Fin",
		  "MeanCurves",
		  "Multiple",
		  "Pelt",
		  "RGB",
		  "RegionFur",
		  "Slot",
		  "Spring",
		  "Visit",
		]
	`);
});
