/** Defines `<fur-view>`, once a page. */

import { FurView } from './FurView.ts';

export { FurView };

if (globalThis.customElements && !customElements.get('fur-view')) customElements.define('fur-view', FurView);
