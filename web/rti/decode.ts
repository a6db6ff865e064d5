/** Pictures by the browser's own decoders, every byte as it is. */

import { MAX_BYTES, type Pixels } from './relit.ts';

/** @throws Error for what is no picture, or one too large */
export async function decode(file: Blob): Promise<Pixels> {
	const bitmap = await createImageBitmap(file, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
	const { width, height } = bitmap;
	try {
		if (width * height * 4 > MAX_BYTES) throw new Error('too large');
		const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
		if (!context) throw new Error('no canvas');
		context.drawImage(bitmap, 0, 0);
		return { width, height, data: context.getImageData(0, 0, width, height).data };
	} finally {
		bitmap.close();
	}
}
