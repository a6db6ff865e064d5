import { shareGeometry } from './body/shareGeometry.ts';
import { Fur } from './Fur.ts';
import { type FurAsset, tileOf } from './format.ts';
import { needFur } from './needFur.ts';
import { copyLight } from './shells/look.ts';

/** Options of `dressFur`. */
export interface FurDressOptions {
	/** Strength of the body's second tip colour (on its belly, in patches), 0..1; 0 suits a pelt of one colour. */
	tips?: number;
}

/**
 * A body in the fur of another asset: its meshes with the other's planes, basis, colours and light curves. Length and tile
 * size keep their ratio to the body's largest side.
 *
 *     const fox = dressFur(bunny, pelt); // both loaded: `gltf.userData.fur`
 *     bunny.visible = false;
 *
 * The result is visible, stands beside the body's own fur and copies its present settings (gloss and the like). It uses the
 * body's geometry and the pelt's textures without owning them: body and pelt have to outlive it. The pelt's model needs no
 * scene. Comb and length map are the body's. Of several furs the pelt's coat is worn
 * everywhere. The model's own texture coordinates (`--uv own`) may show a seam where they
 * close; lapped ones don't.
 */
export function dressFur(body: Fur, pelt: Fur, { tips = 1 }: FurDressOptions = {}): Fur {
	needFur('dressFur', body);
	needFur('dressFur', pelt);
	const { ground } = body;
	const length = (pelt.asset.length * ground.skin.extent) / pelt.ground.skin.extent;
	const tile = (length * tileOf(pelt.asset)) / pelt.asset.length;
	const { skin, shells, fins } = body.asset;
	const { fins: _, ...own } = pelt.asset;
	const tiles = ((body.asset.tiles ?? 1) * tileOf(body.asset)) / tile;
	const asset: FurAsset = { ...own, skin, shells, tiles, length, ...(fins !== undefined && { fins }) };
	const quads = body.fins && shareGeometry(body.fins.geometry);
	const worn = { ...ground, surface: body.shells.geometry, quads, quadPlacement: undefined };
	const dressed = new Fur(asset, pelt.pelt, worn, 'nothing');
	if (body.asset.regions || pelt.asset.regions) dressed.material.oneFur = true;
	dressed.swing = body.swing;
	dressed.motion = body.motion;
	dressed.weather = body.weather;
	copyLight(body.material, dressed.material);
	dressed.material.tipShare = tips;
	return dressed;
}
