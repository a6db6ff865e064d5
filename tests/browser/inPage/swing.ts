/** Runs inside the page: fur that swings beside fur that is combed as far. Its answers go to `swing.spec.ts`. */

import { BufferAttribute, DataTexture, FloatType, type Mesh, Sphere, Vector3, WebGLRenderer } from 'three';
import { dressFur, type Fur, FurInstances, fitFurShadow, furMethod } from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';
import { psnr, Stand } from './Stand.ts';

const SIZE = 120;
/** Where all hairs lean, before their normals are taken out of it. */
const BLOWN = new Vector3(0.35, 0.1, 0.3);

const renderer = new WebGLRenderer({ antialias: false });
renderer.shadowMap.enabled = true;
const gl = renderer.getContext() as WebGL2RenderingContext;
let linked = 0;
const link = gl.linkProgram.bind(gl);
gl.linkProgram = (program) => {
	linked++;
	link(program);
};

/** A furry body on a ground under a lamp that casts shadows. */
class Scenery extends Stand {
	constructor(readonly fur: Fur) {
		super(renderer, SIZE);
		this.addGround(-0.6);
		this.lamp.position.set(-6, 3, 3);
		fitFurShadow(this.lamp, new Sphere(new Vector3(), 2), fur.asset.length);
		this.scene.add(fur.skin.parent ?? fur.skin);
		this.camera.position.set(0, 3, 7);
		this.camera.lookAt(0, -0.2, 0);
		fur.shells.shellCount = 8;
	}

	/** Shells and fins, either alone, their shadow without them, and two rivals. */
	pictures(): Float32Array[] {
		const { shells, fins } = this.fur;
		if (!fins) throw new Error('no fins');
		const part = (shown: boolean, withFins: boolean) => {
			// What is not there casts no shadow; what is in no column does.
			shells.clip = shown ? undefined : { from: 0, to: 0 };
			fins.visible = withFins;
			return this.draw();
		};
		const shots = [part(true, true), part(true, false), part(false, true), part(false, false)];
		shells.clip = undefined;
		fins.visible = true;
		for (const name of ['lengyel', 'shadow-layers'] as const) {
			const method = furMethod(this.fur, name, { renderer });
			method.apply();
			this.fur.update(0);
			shots.push(this.draw());
			method.dispose();
		}
		return shots;
	}
}

/** A texel per follicle, in its tangent plane. */
function blow({ follicles: { count, columns, rows, normal } }: Fur): DataTexture {
	const texels = new Float32Array(4 * columns * rows);
	const n = new Vector3();
	for (let i = 0; i < count; i++) {
		n.fromArray(normal, 3 * i);
		n.multiplyScalar(-n.dot(BLOWN))
			.add(BLOWN)
			.toArray(texels, 4 * i);
	}
	const texture = new DataTexture(texels, columns, rows, undefined, FloatType);
	texture.needsUpdate = true;
	return texture;
}

/** Writes what the texture has into the attributes that say how the fur is combed. @returns what undoes it */
function comb({ shells, fins }: Fur, texels: Float32Array): () => void {
	if (!fins) throw new Error('no fins');
	const before = [shells, fins].map(({ geometry }) => ({ ...geometry.attributes }));
	const vector = (from: ArrayLike<number>, i: number) => new Vector3().fromArray(from as number[], i);
	const marks = (part: Mesh) => part.geometry.getAttribute('follicle').array;
	const { count } = shells.geometry.getAttribute('position');
	const own = shells.geometry.getAttribute('_comb');
	const combed = new Float32Array(3 * count);
	for (let i = 0; i < count; i++) {
		const swung = vector(texels, 4 * (marks(shells)[i] as number));
		if (own) swung.add(new Vector3().fromBufferAttribute(own, i));
		swung.toArray(combed, 3 * i);
	}
	shells.geometry.setAttribute('_comb', new BufferAttribute(combed, 3));
	const [normal, tangent, edge] = ['normal', 'tangent', '_edge'].map((name) => fins.geometry.getAttribute(name));
	if (!normal || !tangent || !edge) throw new Error('no fins');
	const edges = new Float32Array(4 * edge.count);
	for (let i = 0; i < edge.count; i++) {
		const n = new Vector3().fromBufferAttribute(normal, i).normalize();
		const across = new Vector3().fromBufferAttribute(tangent, i).cross(n).normalize();
		const along = new Vector3().crossVectors(n, across);
		const swung = vector(texels, 4 * (marks(fins)[i] as number));
		edges.set([edge.getX(i), edge.getY(i), edge.getZ(i) + swung.dot(along), edge.getW(i) + swung.dot(across)], 4 * i);
	}
	fins.geometry.setAttribute('_edge', new BufferAttribute(edges, 4));
	return () => {
		for (const [p, { geometry }] of [shells, fins].entries()) {
			for (const [name, attribute] of Object.entries(before[p] ?? {})) geometry.setAttribute(name, attribute);
			if (!before[p]?._comb) geometry.deleteAttribute('_comb');
		}
	};
}

const bits = (pixels: Float32Array) => new Uint32Array(pixels.buffer);
const same = (a: Float32Array, b: Float32Array) => bits(a).every((value, i) => value === bits(b)[i]);

/** All there is of it, hanging, swinging, combed as far, and hanging again. */
export async function swings(url: string) {
	const fur = await loadFur(url);
	const stage = new Scenery(fur);
	const hanging = stage.pictures();
	const programs = () => [...(renderer.info.programs ?? [])] as unknown as { getAttributes(): object }[];
	const active = programs().some((program) => 'follicle' in program.getAttributes());
	const texture = blow(fur);
	fur.swing = texture;
	const swinging = stage.pictures();
	const undo = comb(fur, texture.image.data as Float32Array);
	fur.swing = undefined;
	const combed = stage.pictures();
	undo();
	const again = stage.pictures();

	// Back and forth: no program is made for it.
	stage.draw();
	const before = linked;
	for (const swing of [texture, undefined, texture, undefined]) {
		fur.swing = swing;
		stage.draw();
	}
	const relinked = linked - before;

	const maps = furMethod(fur, 'shadow-layers', { renderer });
	maps.apply();
	const redrawn = [() => {}, () => {}, () => (fur.swing = texture), () => {}, () => texture.version++].map((change) => {
		change();
		return fur.update(0);
	});
	maps.dispose();

	// Another fur of the body, and a herd of one that was made before the fur moved.
	const plain = stage.draw();
	const dressed = dressFur(fur, fur);
	dressed.shells.shellCount = 8;
	fur.visible = false;
	const worn = psnr(stage.draw(), plain);
	dressed.dispose();
	fur.visible = true;
	fur.swing = undefined;
	const fresh = await loadFur(url);
	const herd = new FurInstances(fresh, 1, [8]);
	herd.height = SIZE;
	fur.skin.parent?.removeFromParent();
	fresh.shells.shellCount = 8;
	stage.scene.add(herd);
	stage.draw();
	fresh.swing = texture;
	const crowd = psnr(stage.draw(), plain);
	return {
		active,
		alike: swinging.map((picture, i) => psnr(picture, combed[i] as Float32Array)),
		moved: swinging.map((picture, i) => psnr(picture, hanging[i] as Float32Array)),
		back: again.every((picture, i) => same(picture, hanging[i] as Float32Array)),
		relinked,
		redrawn,
		worn,
		crowd,
		error: gl.getError(),
	};
}
