/** Deflate blocks that no packer here writes. */

/** Literals and nothing else, in one block: zeros take one bit, ones two. @param bytes zeros and ones */
export function oneBlock(bytes: Uint8Array): Uint8Array {
	const out = new Uint8Array(64 + bytes.length / 4);
	let at = 0;
	const write = (value: number, bits: number) => {
		for (let bit = 0; bit < bits; bit++, at++)
			if ((value >> bit) & 1) out[at >> 3] = (out[at >> 3] as number) | (1 << (at & 7));
	};
	// Last block, dynamic codes; 257 literals, 1 distance, 18 lengths of the code of lengths: 1 bit for 1, 2 for 2 and 18.
	write(0b101, 3);
	write(0, 5);
	write(0, 5);
	write(14, 4);
	for (const symbol of [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1])
		write({ 1: 1, 2: 2, 18: 2 }[symbol] ?? 0, 3);
	// Lengths of the codes: 1 and 2 bits, 254 times none, 2 for the end; 1 for the distance.
	write(0b0, 1);
	write(0b01, 2);
	for (const zeros of [138, 116]) {
		write(0b11, 2);
		write(zeros - 11, 7);
	}
	write(0b01, 2);
	write(0b0, 1);
	for (const byte of bytes) byte ? write(0b01, 2) : write(0, 1);
	write(0b11, 2);
	return out.subarray(0, Math.ceil(at / 8));
}

/** Zeros with a few ones, without a rhythm. */
export function sparse(length: number): Uint8Array<ArrayBuffer> {
	let state = 1;
	return Uint8Array.from({ length }, () => {
		state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
		return state >>> 28 === 0 ? 1 : 0;
	});
}
