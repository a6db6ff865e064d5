/** Code of the fins, fetched with the first asset that has some. */

export { finQuads } from '../fins/finQuads.ts';
export { growFins } from '../shells/fins/growFins.ts';
