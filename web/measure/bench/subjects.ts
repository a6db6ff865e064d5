/** Subject: one method on one body under its own lamp. */

import {
	type BufferGeometry,
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
	type Fur,
	type FurAsset,
	FurFinMaterial,
	FurFins,
	FurMaterial,
	FurShells,
	fitFurShadow,
	furMethod,
	updateFurs,
} from '../../fur/index.ts';
import type { Row } from './results.ts';
import type { BenchModels, Torus } from './tori.ts';

/** Optional features of fur, absent from the bench's own table. */
export interface Extras {
	gloss?: boolean;
	backlight?: boolean;
	shadow?: boolean;
	environment?: boolean;
	/** Whether hardly seen shells are drawn as one. */
	merged?: boolean;
	/** Number of directional lights. */
	lights?: number;
}

export interface Subject {
	row: Row;
	scene: Scene;
	/** Size of the scene over that of one body. */
	reach: number;
	/** Places the lamps for frame `step`; still ones stay as in the first frame. */
	turn(step: number): void;
	/** Redraws maps that the picture looks up, if outdated. */
	prepare(): void;
	dispose(): void;
}

/** Irradiance of all lamps together. */
export const IRRADIANCE = 6;
const SKIN = 0.35; // brightness of the skin over the roots' colour
/** Speed of moving lamps, radians a frame. */
const PACE = 0.37;

/** Light of a sky over a ground as spherical harmonics to the second order, without a symmetry that a shader could use. */
const SKY = [0.9, 0.3, 0.1, 0.05, 0.08, 0.04, 0.06, 0.03, 0.02];

/** Vector from the body's middle to lamp `i` in frame `step`: around the body at varying height. */
export function lampAt(step: number, i: number, to: Vector3): Vector3 {
	const angle = PACE * step + 2.4 * i;
	return to.set(Math.cos(angle), 0.7 + 0.5 * Math.sin(1.7 * angle), Math.sin(angle)).normalize();
}

/** @param row method and options, without the picture's size; @param models with the pelt of its method */
export function makeSubject(
	renderer: WebGLRenderer,
	row: Row,
	torus: Torus,
	models: BenchModels,
	extras: Extras = {},
): Subject {
	const { fur, surface } = torus;
	const scene = new Scene();
	const body = boundsOf(torus);
	const skin = makeSkin(torus);
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
	if (extras.shadow && lamps[0]) fitFurShadow(lamps[0], body, fur.asset.length);
	if (extras.environment) scene.add(makeSky());

	// Any pelt fits any torus.
	const { asset, textures } = models.pelts.get(row.method) ?? fur;
	const material = new FurMaterial(asset, textures, {
		environment: extras.environment ?? false,
		gloss: extras.gloss ? 0.5 : 0,
		backlight: extras.backlight ? 6 : 0,
	});
	const fins = row.fins ? makeFins(fur, asset, material) : undefined;
	const shells = new FurShells(surface, fur.shells, asset, material);
	Object.assign(shells, { shellCount: row.shells, merging: extras.merged ? 1 : 0 });
	fins?.join(shells, fur.shells);
	scene.add(...(fins ? [fins] : []), shells);
	const lit = { textures, shells, skin, motion: undefined, weather: undefined, method: undefined };
	const method = furMethod(lit, lightOf(row), { renderer, light: lamps[0] });
	method.apply();
	return {
		row,
		scene,
		reach: 1,
		turn,
		prepare() {
			updateFurs([lit], 0);
		},
		dispose() {
			for (const part of [fins, shells]) {
				part?.dispose();
				part?.material.dispose();
			}
			for (const part of [method, skin.material, ...lamps]) part.dispose();
		},
	};
}

/** Method of the library that lights a row's fur. */
const lightOf = ({ method }: Row) => (method === 'ptm3' || method === 'ptm-colour' ? 'ptm' : method);

/** Sphere around body and fur. */
export function boundsOf({ fur, surface }: Torus): Sphere {
	const body = new Sphere();
	surface.computeBoundingSphere();
	body.copy(surface.boundingSphere ?? body).applyMatrix4(fur.shells.matrix);
	body.radius += fur.asset.length;
	return body;
}

/** Body without fur, in the roots' colour, darkened. */
function makeSkin({ fur, surface }: Torus): Mesh<BufferGeometry, MeshBasicMaterial> {
	const material = new MeshBasicMaterial({ side: FrontSide });
	material.color.setRGB(...fur.asset.ramp.root).multiplyScalar(SKIN);
	const skin = new Mesh(surface, material);
	skin.applyMatrix4(fur.shells.matrix);
	return skin;
}

function makeSky(): LightProbe {
	const probe = new LightProbe();
	for (const [i, vector] of probe.sh.coefficients.entries()) vector.setScalar(SKY[i] ?? 0);
	return probe;
}

/** Make the body's fins in a material of their own; call it before making the shells. */
function makeFins({ fins }: Fur, asset: FurAsset, shells: FurMaterial): FurFins {
	const fin = asset.pelts[0]?.fin;
	if (!fins || !fin) throw new Error('model.gltf: got no fins, expected a model that was baked with them');
	const { plane0, plane1, colourPlane } = fins.material.uniforms;
	const textures = { plane0: plane0?.value, plane1: plane1?.value, colour: colourPlane?.value ?? undefined };
	return new FurFins(fins.geometry.clone(), new FurFinMaterial(fin, textures, shells));
}
