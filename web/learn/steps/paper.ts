import type { Mount } from '../lesson.ts';

export const mount: Mount = async () => {};
