/** Ways to light the shells of a fur: its own, the limit, and its rivals. */
export const METHODS = ['ptm', 'unlit', 'lengyel', 'shadow-layers'] as const;

/** One of them. */
export type MethodName = (typeof METHODS)[number];
