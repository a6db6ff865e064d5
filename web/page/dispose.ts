/** Freeing of a scene's GPU objects. */

import {
	InstancedMesh,
	type IUniform,
	Material,
	Mesh,
	type Object3D,
	Scene,
	SkinnedMesh,
	Sprite,
	Texture,
} from 'three';

/** Frees geometries, materials and textures; drawing again uploads them again. */
export function disposeAll(object: Object3D): void {
	object.traverse((child) => {
		if (child instanceof Scene && child.background instanceof Texture) child.background.dispose();
		if (!(child instanceof Mesh || child instanceof Sprite)) return;
		if (child instanceof InstancedMesh) child.dispose();
		if (child instanceof SkinnedMesh) child.skeleton.dispose();
		child.geometry.dispose();
		for (const material of [child.material, child.customDepthMaterial, child.customDistanceMaterial].flat()) {
			if (!(material instanceof Material)) continue;
			const uniforms = 'uniforms' in material ? Object.values(material.uniforms as Record<string, IUniform>) : [];
			for (const value of [...Object.values(material), ...uniforms.map((uniform) => uniform.value)])
				if (value instanceof Texture) value.dispose();
			material.dispose();
		}
	});
}
