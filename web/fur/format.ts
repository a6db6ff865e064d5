/** Reading and checking of the glTF extension `FUR_ptm_shells`. Free of three. */

import { Validator } from '@cfworker/json-schema';
import schema from '../../baker/furbake/asset/schema/FUR_ptm_shells.schema.json';
import { checkSchema } from './format/schema.ts';
import { type Fin, type FurAsset, KNOTS, type Pelt, RADII, type Slot } from './format/types.ts';

export * from './format/types.ts';

/** Name of the extension in a glTF file. */
export const FUR_EXTENSION = 'FUR_ptm_shells';

/** Newest version that this reader supports; of a higher major version the skin alone is shown. */
export const FUR_VERSION = '2.3';

const validator = new Validator(schema as object, '2020-12', false);

/**
 * Checks the extension's object and returns it typed.
 *
 * @returns undefined for a newer major version
 * @throws Error that says what is wrong
 */
export function parseFur(extension: unknown): FurAsset | undefined {
	const version = (extension as { version?: unknown } | null)?.version;
	if (typeof version === 'string' && Number.parseInt(version, 10) > Number.parseInt(FUR_VERSION, 10)) return undefined;
	checkSchema(validator, extension, FUR_EXTENSION);
	const asset = extension as FurAsset;
	for (const [i, fur] of fursOf(asset).entries()) checkFur(fur, i === 0 ? '' : `${asset.regions?.furs[i - 1]?.name}.`);
	checkRegions(asset);
	return asset;
}

/** The furs of an asset, each as if it were alone: the coat, then those of its regions. */
export function fursOf({ regions, ...coat }: FurAsset): [FurAsset, ...FurAsset[]] {
	const furs = regions?.furs ?? [];
	return [
		coat,
		...furs.map(
			({ name: _, tile: __, ...own }) =>
				({ ...coat, eye: undefined, surge: undefined, bent: undefined, ...own }) as FurAsset,
		),
	];
}

/** Width of a tile of the coat, model units. */
export const tileOf = ({ regions, length, height }: Pick<FurAsset, 'regions' | 'length' | 'height'>): number =>
	regions?.tile ?? length / height;

/** Checks the numbers of one fur. @param prefix of names in messages */
function checkFur(asset: FurAsset, prefix: string): void {
	for (const [name, rows, wanted] of [
		['drift', asset.drift.length, asset.layers] satisfies Count,
		...curveCounts(asset),
		...lightCounts('', asset, asset.coefficients, asset.curves !== undefined),
		...asset.pelts.flatMap((pelt) => [
			...texelCounts(pelt.name, pelt, asset.coefficients),
			...(pelt.fin ? finCounts(`${pelt.name}.fin`, pelt.fin, asset.curves !== undefined) : []),
		]),
	]) {
		if (rows !== wanted) throw new Error(`${FUR_EXTENSION}/${prefix}${name}: got ${rows} entries, expected ${wanted}`);
	}
	if (asset.basis.kind === 'eigen') {
		const terms = (asset.basis.degree + 1) ** 2 + 2;
		const odd = asset.basis.matrix.find((row) => row.length !== terms);
		if (odd) throw new Error(`${FUR_EXTENSION}/basis.matrix: got a row of ${odd.length} weights, expected ${terms}`);
	}
	checkStates(asset);
}

/** Checks that the furs of all regions can be drawn together. */
function checkRegions({ regions, basis, pelts, eye }: FurAsset): void {
	if (!regions) return;
	const refuse = (where: string, got: unknown, expected: unknown) => {
		throw new Error(`${FUR_EXTENSION}/regions.${where}: got ${got}, expected ${expected} as of the coat`);
	};
	if (basis.kind !== 'ptm') refuse('basis', basis.kind, 'ptm');
	const traits = (list: readonly Pelt[]) =>
		list.map(({ name, wetness = 0, dirt = 0, colour, multiple, fin }) =>
			[name, wetness, dirt, colour === undefined, !multiple, fin?.width, fin?.height, !fin?.colour].join(' '),
		);
	for (const fur of regions.furs) {
		if ((fur.eye === undefined) !== (eye === undefined))
			refuse(`${fur.name}.eye`, fur.eye && 'one', eye ? 'one' : 'none');
		const [own, wanted] = [traits(fur.pelts), traits(pelts)];
		if (`${own}` !== `${wanted}`) refuse(`${fur.name}.pelts`, own.join(', '), wanted.join(', '));
	}
}

/** Checks that states of one fur agree, so that they can be mixed. */
function checkStates({ pelts, coefficients, mud }: FurAsset): void {
	const [first, ...others] = pelts as [Pelt, ...Pelt[]];
	const refuse = (where: string, got: unknown, expected: string) => {
		throw new Error(`${FUR_EXTENSION}/${where}: got ${got}, expected ${expected}`);
	};
	if (first.wetness || first.dirt)
		refuse(
			'pelts',
			`${first.name} first, wet ${first.wetness ?? 0}, dirty ${first.dirt ?? 0}`,
			'the dry and clean one',
		);
	for (const pelt of others.filter(({ wetness, dirt }) => wetness || dirt)) {
		const { name, wetness, dirt, fin } = pelt;
		const before = pelts.slice(0, pelts.indexOf(pelt));
		if (wetness && dirt) refuse(name, `wetness ${wetness} with dirt ${dirt}`, 'one of the two');
		if (wetness && before.some((other) => (other.wetness ?? 0) >= wetness))
			refuse(`${name}.wetness`, wetness, 'more than of the pelts before it');
		if (dirt && before.some((other) => other.dirt)) refuse(`${name}.dirt`, dirt, 'no second dirty pelt');
		if (dirt && !mud) refuse('mud', 'none', 'the colour of dirt');
		if (dirt && coefficients < 4) refuse('coefficients', coefficients, '4 or more of fur that is dirty');
		for (const [where, got, wanted] of [
			['scale', pelt.scale, first.scale],
			['bias', pelt.bias, first.bias],
			['fin.scale', fin?.scale, first.fin?.scale],
			['fin.bias', fin?.bias, first.fin?.bias],
			['fin.width', fin?.width, first.fin?.width],
			['fin.height', fin?.height, first.fin?.height],
			// Muddy hairs have no colour plane.
			...(dirt ? [] : [['colour', pelt.colour !== undefined, first.colour !== undefined] as const]),
		] as const) {
			if (`${got}` !== `${wanted}`) refuse(`${name}.${where}`, got, `${wanted} as of ${first.name}`);
		}
	}
}

/** Number of entries, got and expected, of a list. */
type Count = [name: string, rows: number, wanted: number];

/** @param curved whether mean curves replace the environment matrices */
function lightCounts(
	prefix: string,
	{ basis, environment = [] }: Pick<Fin, 'basis' | 'environment'>,
	wanted: number,
	curved: boolean,
): Count[] {
	return [
		[`${prefix}environment`, environment.length, curved ? 0 : wanted],
		[`${prefix}basis.matrix`, basis.kind === 'eigen' ? basis.matrix.length : 6, wanted],
	];
}

/** Counts of the curves' tables, and of the weights of every pelt. */
function curveCounts({ version, curves, pelts, layers }: FurAsset): Count[] {
	const count = curves?.even.length ?? 0;
	return [
		['curves', curves ? 1 : 0, Number.parseInt(version, 10) > 1 ? 1 : 0],
		['curves.along', curves?.along.length ?? 0, count],
		...Object.entries(curves ?? {}).flatMap(([name, tables]) =>
			(tables as number[][][]).flatMap((table, q): Count[] => [
				[`curves.${name}.${q}`, table.length, RADII.length],
				...table.map((knots, b): Count => [`curves.${name}.${q}.${b}`, knots.length, KNOTS]),
			]),
		),
		...pelts.flatMap(({ name, weights = [], multiple }): Count[] => [
			[`${name}.weights`, weights.length, curves ? layers : 0],
			[`${name}.multiple`, multiple ? 1 : 0, curves && pelts[0]?.multiple ? 1 : 0],
			...Object.entries(multiple ?? {}).flatMap(([key, rows]): Count[] =>
				Array.isArray(rows) ? [[`${name}.multiple.${key}`, rows.length, layers]] : [],
			),
			...weights.map((row, k): Count => [`${name}.weights.${k}`, row.length, count]),
		]),
	];
}

function texelCounts(name: string, { scale, bias, planes }: Omit<Pelt, 'name'>, coefficients: number): Count[] {
	return [
		[`${name}.scale`, scale.length, coefficients],
		[`${name}.bias`, bias.length, coefficients],
		[`${name}.planes`, planes.length, coefficients > 3 ? 2 : 1],
	];
}

/** Counts of a fin: six coefficients, whatever the pelt's own number. */
function finCounts(name: string, fin: Fin, curved: boolean): Count[] {
	return [...lightCounts(`${name}.`, fin, 6, curved), ...texelCounts(name, fin, 6)];
}

/** Place of coefficient `i`. */
export function channelOf(i: number): Slot {
	if (i < 3) return { plane: 0, channel: i };
	return i === 5 ? { plane: 0, channel: 3 } : { plane: 1, channel: i - 3 };
}

/** Place of the coverage α. */
export function alphaChannel(coefficients: number): Slot {
	return coefficients > 3 ? { plane: 1, channel: 2 } : { plane: 0, channel: 3 };
}
