/** Long work in steps, so that the page around it can draw meanwhile. */

/** Runs steps one by one, yielding to other tasks in between. */
export async function unhurried<T>(steps: Generator<void, T>): Promise<T> {
	for (let step = steps.next(); ; step = steps.next()) {
		if (step.done) return step.value;
		await turn();
	}
}

/** Yields to other tasks. By a message, since hidden pages slow timers down. */
export function turn(): Promise<void> {
	return new Promise((resolve) => {
		const { port1, port2 } = new MessageChannel();
		port1.onmessage = () => {
			port1.close();
			resolve();
		};
		port2.postMessage(undefined);
	});
}
