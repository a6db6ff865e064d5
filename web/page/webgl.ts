/** Varyings of four numbers that WebGL2 promises, and fur counts on. Browsers that resist fingerprinting allow eight. */
const VARYINGS = 15;

/** Whether a context is there, and does what WebGL2 promises. */
export const isWhole = (gl: WebGL2RenderingContext | null): gl is WebGL2RenderingContext =>
	gl !== null && gl.getParameter(gl.MAX_VARYING_VECTORS) >= VARYINGS;
