/** Frames on the GPU: how long they take, where the browser has a timer, and how many wait there. */

/** Milliseconds up to which a frame is quick, from handing it on to seeing that it is drawn. */
const QUICK = 100;
/**
 * Frames handed on and not drawn yet, at most. Of slow ones one is drawn while the next is made; that a quick one is drawn
 * browsers tell some refreshes of the display later.
 */
const MAX_WAITING = { slow: 2, quick: 4 };
/** Queries in flight at most; frames beyond them are not measured. */
const MAX_QUERIES = 6;

export class GpuFrames {
	readonly #gl: WebGL2RenderingContext;
	readonly #queries: (WebGLQuery | null)[] = [];
	#extension: { TIME_ELAPSED_EXT: number; GPU_DISJOINT_EXT: number } | null = null;
	/** Index of the oldest query in flight, and their count. */
	#first = 0;
	#count = 0;
	#running = false;
	/** Frames that were handed on, the oldest first: the fence behind each, and when that was. */
	readonly #waiting: { fence: WebGLSync; since: number }[] = [];
	/** Whether the one drawn last was quick. */
	#quick = false;
	/** Milliseconds of the frame measured last; NaN before. */
	latest = Number.NaN;

	constructor(gl: WebGL2RenderingContext) {
		this.#gl = gl;
		this.restore();
	}

	/** False where they cannot be timed. */
	get timed(): boolean {
		return this.#extension !== null;
	}

	/**
	 * @returns whether the next frame can be made. Browsers take frames faster than they draw them: where one takes a
	 * second, dozens wait, the page stands still meanwhile, and intervals are not times of drawing.
	 */
	hasRoom(): boolean {
		const gl = this.#gl;
		const [oldest] = this.#waiting;
		// A lost context says nothing of its fences.
		if (oldest && gl.getSyncParameter(oldest.fence, gl.SYNC_STATUS) !== gl.UNSIGNALED) {
			gl.deleteSync(oldest.fence);
			this.#waiting.shift();
			this.#quick = performance.now() - oldest.since <= QUICK;
		}
		return this.#waiting.length < MAX_WAITING[this.#quick ? 'quick' : 'slow'];
	}

	/** Makes the queries anew after a lost context. */
	restore(): void {
		this.#waiting.length = 0;
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
		const fence = this.#gl.fenceSync(this.#gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
		if (fence) this.#waiting.push({ fence, since: performance.now() });
		// A fence that waits in the browser is never passed.
		this.#gl.flush();
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
