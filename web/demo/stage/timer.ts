/** GPU time of frames, where the browser has a timer. */

/** Queries in flight at most; frames beyond them are not measured. */
const MAX_QUERIES = 6;

export class GpuTimer {
	readonly #gl: WebGL2RenderingContext;
	readonly #queries: (WebGLQuery | null)[] = [];
	#extension: { TIME_ELAPSED_EXT: number; GPU_DISJOINT_EXT: number } | null = null;
	/** Index of the oldest query in flight, and their count. */
	#first = 0;
	#count = 0;
	#running = false;
	/** Milliseconds of the frame measured last; NaN before. */
	latest = Number.NaN;

	constructor(gl: WebGL2RenderingContext) {
		this.#gl = gl;
		this.restore();
	}

	/** False where there is no such timer. */
	get works(): boolean {
		return this.#extension !== null;
	}

	/** Makes the queries anew after a lost context. */
	restore(): void {
		this.#extension = this.#gl.getExtension('EXT_disjoint_timer_query_webgl2');
		this.#count = 0;
		this.#running = false;
		for (let i = 0; this.#extension && i < MAX_QUERIES; i++) this.#queries[i] = this.#gl.createQuery();
	}

	/** Call before a frame's first command. */
	begin(): void {
		if (!this.#extension || this.#count === MAX_QUERIES || this.#gl.isContextLost()) return;
		const query = this.#queries[(this.#first + this.#count) % MAX_QUERIES];
		if (!query) return;
		this.#gl.beginQuery(this.#extension.TIME_ELAPSED_EXT, query);
		this.#running = true;
	}

	/** Call after a frame's last command. */
	end(): void {
		if (!this.#extension || !this.#running) return;
		this.#gl.endQuery(this.#extension.TIME_ELAPSED_EXT);
		this.#running = false;
		this.#count++;
	}

	/** @returns milliseconds of the last frame that was finished since the last call; NaN for none */
	read(): number {
		const gl = this.#gl;
		let time = Number.NaN;
		while (this.#extension && this.#count > 0) {
			const query = this.#queries[this.#first];
			if (!query || !gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE)) break;
			// A disjoint time means nothing.
			if (!gl.getParameter(this.#extension.GPU_DISJOINT_EXT))
				time = this.latest = gl.getQueryParameter(query, gl.QUERY_RESULT) / 1e6;
			this.#first = (this.#first + 1) % MAX_QUERIES;
			this.#count--;
		}
		return time;
	}
}
