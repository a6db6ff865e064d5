/** Drawing within some columns of the picture, so that two methods share one render of the scene. */

import { Vector4, type WebGLRenderer } from 'three';

/** Range of columns, shares of the picture's width, 0..1 from the left. */
export interface FurColumns {
	/** Left edge. */
	from: number;
	/** Right edge. */
	to: number;
}

const viewport = new Vector4();
const own = new Vector4();
const box = new Vector4();

/** Restrict draws to these columns, if any, within the renderer's own scissor. */
export function beginClip(renderer: WebGLRenderer, columns: FurColumns | undefined): void {
	if (!columns) return;
	const { x, y, z: width, w: height } = renderer.getCurrentViewport(viewport);
	const left = Math.round(x + columns.from * width);
	const right = Math.round(x + columns.to * width);
	box.set(left, y, Math.max(right - left, 0), height);
	if (readScissor(renderer)) {
		const first = Math.max(box.x, own.x);
		const last = Math.min(box.x + box.z, own.x + own.z);
		box.set(first, own.y, Math.max(last - first, 0), own.w);
	}
	renderer.state.scissor(box);
	renderer.state.setScissorTest(true);
}

/** Restore the renderer's own scissor. @param columns as in `beginClip` */
export function endClip(renderer: WebGLRenderer, columns: FurColumns | undefined): void {
	if (!columns) return;
	const on = readScissor(renderer);
	renderer.state.scissor(own);
	renderer.state.setScissorTest(on);
}

/** Copy the scissor of the current target to `own`. @returns whether it is on */
function readScissor(renderer: WebGLRenderer): boolean {
	const target = renderer.getRenderTarget();
	if (target) own.copy(target.scissor);
	else renderer.getScissor(own).multiplyScalar(renderer.getPixelRatio()).floor();
	return target ? target.scissorTest : renderer.getScissorTest();
}
