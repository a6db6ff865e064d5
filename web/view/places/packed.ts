/** All places, packed: what `web/tools/site/places.mjs` writes into `table.json`. */

import { packPlaces } from './pack.ts';

export default await packPlaces();
