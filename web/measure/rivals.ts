/** A rival: one method on one body under its own lamp, ready to be drawn again and again. */

import {
	DirectionalLight,
	FrontSide,
	LightProbe,
	Mesh,
	MeshBasicMaterial,
	Scene,
	Sphere,
	Vector3,
	type WebGLRenderer,
} from 'three';
import {
	FinMaterial,
	type Fur,
	type FurAsset,
	FurFins,
	FurMaterial,
	FurShells,
	fitShadow,
	furMethod,
} from '../fur/index.ts';
import type { Row } from './results.ts';
import type { Torus, Wardrobe } from './tori.ts';

/** What fur can have besides, and the bench's own table leaves out. */
export interface Extras {
	gloss?: boolean;
	backlight?: boolean;
	shadow?: boolean;
	environment?: boolean;
	/** Directional lights in all. */
	lights?: number;
}

export interface Rival {
	row: Row;
	scene: Scene;
	/** Where the lamp stands in frame `step`; a still one stands where it stood in the first. */
	turn(step: number): void;
	/** Draws what the picture looks up, where that has changed. */
	prepare(renderer: WebGLRenderer): void;
	dispose(): void;
}

/** Of all lamps together. */
const IRRADIANCE = 6;
const SKIN = 0.35; // of the roots' colour
/** Radians a frame. */
const PACE = 0.37;

/** Light of a sky over a ground, as spherical harmonics to the second order; without a symmetry that a shader could use. */
const SKY = [0.9, 0.3, 0.1, 0.05, 0.08, 0.04, 0.06, 0.03, 0.02];

/** From the body's middle to lamp `i` in frame `step`: round the body, now high, now low. */
function lampAt(step: number, i: number, to: Vector3): Vector3 {
	const angle = PACE * step + 2.4 * i;
	return to.set(Math.cos(angle), 0.7 + 0.5 * Math.sin(1.7 * angle), Math.sin(angle)).normalize();
}

/** @param row what is drawn; its picture's size is the caller's; @param wardrobe with the pelt of its method */
export function makeRival(row: Row, torus: Torus, wardrobe: Wardrobe, extras: Extras = {}): Rival {
	const { fur, surface } = torus;
	const scene = new Scene();
	const body = new Sphere();
	surface.computeBoundingSphere();
	body.copy(surface.boundingSphere ?? body).applyMatrix4(fur.shells.matrix);
	body.radius += fur.asset.length;

	const skinMaterial = new MeshBasicMaterial({ side: FrontSide });
	skinMaterial.color.setRGB(...fur.asset.ramp.root).multiplyScalar(SKIN);
	const skin = new Mesh(surface, skinMaterial);
	skin.applyMatrix4(fur.shells.matrix);
	scene.add(skin);

	const { lights = 1 } = extras;
	const lamps = Array.from({ length: lights }, () => new DirectionalLight(0xffffff, IRRADIANCE / lights));
	const direction = new Vector3();
	const turn = (step: number) => {
		lamps.forEach((lamp, i) => {
			lamp.target.position.copy(body.center);
			lampAt(row.light === 'moving' ? step : 0, i, direction);
			lamp.position.copy(body.center).addScaledVector(direction, 4 * body.radius);
		});
	};
	for (const lamp of lamps) scene.add(lamp, lamp.target);
	turn(0);
	if (extras.shadow && lamps[0]) fitShadow(lamps[0], body, fur.asset.length);
	if (extras.environment) {
		const probe = new LightProbe();
		for (const [i, vector] of probe.sh.coefficients.entries()) vector.setScalar(SKY[i] ?? 0);
		scene.add(probe);
	}

	// Any pelt fits any of the tori.
	const { asset, textures } = wardrobe.pelts.get(row.method) ?? fur;
	const material = new FurMaterial(asset, textures, {
		environment: extras.environment ?? false,
		gloss: extras.gloss ? 0.5 : 0,
		backlight: extras.backlight ? 6 : 0,
	});
	const fins = row.fins ? makeFins(fur, asset, material) : undefined;
	const shells = new FurShells(surface, fur.shells, asset, material);
	shells.shellCount = row.shells;
	fins?.join(shells, fur.shells);
	if (fins) scene.add(fins);
	scene.add(shells);
	const light = row.method === 'ptm3' || row.method === 'ptm-colour' ? 'ptm' : row.method;
	const method = furMethod(light, { textures, shells, skin });
	method.wear();
	return {
		row,
		scene,
		turn,
		prepare(renderer) {
			if (lamps[0]) method.before(renderer, lamps[0]);
		},
		dispose() {
			method.dispose();
			for (const part of [fins, shells]) {
				part?.dispose();
				part?.material.dispose();
			}
			for (const lamp of lamps) lamp.dispose();
			skinMaterial.dispose();
		},
	};
}

/** The body's fins in a material of their own; they are to be made before the shells. */
function makeFins({ fins }: Fur, asset: FurAsset, shells: FurMaterial): FurFins {
	const fin = asset.pelts[0]?.fin;
	if (!fins || !fin) throw new Error('model.gltf: got no fins, expected a model that was baked with them');
	const { plane0, plane1, colourPlane } = fins.material.uniforms;
	const textures = { plane0: plane0?.value, plane1: plane1?.value, colour: colourPlane?.value ?? undefined };
	return new FurFins(fins.geometry.clone(), new FinMaterial(fin, textures, shells));
}
