/** What the tests use of the Khronos validator, which comes without types. */
declare module 'gltf-validator' {
	export interface Report {
		issues: { numErrors: number; messages: { code: string; message: string; pointer?: string; severity: number }[] };
	}
	export function validateBytes(
		bytes: Uint8Array,
		options: { uri: string; externalResourceFunction: (uri: string) => Promise<Uint8Array> },
	): Promise<Report>;
}
