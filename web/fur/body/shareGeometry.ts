/** Geometries that share their vertices, and their end. */

import { BufferAttribute, BufferGeometry, InterleavedBuffer, InterleavedBufferAttribute } from 'three';

/** Another geometry of the same vertices. */
export function shareGeometry(source: BufferGeometry): BufferGeometry {
	const into = new BufferGeometry();
	into.setIndex(source.index);
	for (const [name, attribute] of Object.entries(source.attributes)) into.setAttribute(name, attribute);
	into.morphAttributes = { ...source.morphAttributes };
	into.morphTargetsRelative = source.morphTargetsRelative;
	for (const { start, count, materialIndex } of source.groups) into.addGroup(start, count, materialIndex);
	into.userData = source.userData;
	return into;
}

/**
 * Detaches shared attributes before such a geometry is disposed of, which would delete them on the GPU.
 *
 * @param others geometries that keep attributes of this one; undefined: all are kept elsewhere
 */
export function unshareGeometry(geometry: BufferGeometry, others?: readonly BufferGeometry[]): void {
	if (!others || others.some(({ index }) => index === geometry.index)) geometry.setIndex(null);
	for (const [name, attribute] of Object.entries(geometry.attributes))
		if (!others || others.some((other) => other.attributes[name] === attribute)) geometry.deleteAttribute(name);
}

/** Gives a geometry attributes of its own, of the same numbers: on the GPU they end with it alone. */
export function ownAttributes(geometry: BufferGeometry): void {
	for (const [name, attribute] of Object.entries(geometry.attributes)) {
		const { itemSize, normalized } = attribute;
		if ('data' in attribute) {
			const data = new InterleavedBuffer(attribute.data.array, attribute.data.stride);
			geometry.setAttribute(name, new InterleavedBufferAttribute(data, itemSize, attribute.offset, normalized));
		} else geometry.setAttribute(name, new BufferAttribute(attribute.array, itemSize, normalized));
	}
}
