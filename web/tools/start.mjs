/**
 * `npm start [-- --port N --host ADDRESS --open]`: installs and bakes missing parts, then serves the demo.
 */
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureNode } from './environment.mjs';
import { bakeDefaultModels } from './models.mjs';
import { command, Failure, root } from './process.mjs';

const options = /** @type {const} */ ({
	port: { type: 'string' },
	host: { type: 'string' },
	open: { type: 'boolean' },
});

await command(async () => {
	const { values } = parseArgs({ options });
	const port = values.port === undefined ? undefined : Number(values.port);
	if (port !== undefined && !(Number.isInteger(port) && port >= 0 && port < 65536))
		throw new Failure(`--port: got ${values.port}, expected a whole number below 65536`);

	await ensureNode();
	await bakeDefaultModels();

	const { createServer } = await import('vite');
	const server = await createServer({
		configFile: join(root, 'web', 'vite.config.ts'),
		server: { port, host: values.host, open: values.open },
	});
	await server.listen();
	for (const url of [...(server.resolvedUrls?.local ?? []), ...(server.resolvedUrls?.network ?? [])])
		console.log(`furbake is served at ${url}`);
});
