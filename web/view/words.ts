/** Words of the element, English and Chinese. */

import { type Language, languageOf } from '../page/language.ts';

const en = {
	lang: 'en',
	label: 'Fur under a lamp',
	hint: 'Drag or press the arrow keys to move the light. With Shift they turn the view; + and - bring it nearer and farther.',
	controls: 'Light and view',
	turn: 'Turn the view by dragging',
	play: 'Play',
	pause: 'Pause',
	reset: 'Light and view as they were',
	loading: 'Growing fur …',
	noWebGL2: 'This picture is drawn live and needs WebGL2, which this browser does not offer.',
	notShown: 'This picture cannot be shown.',
};

/** Words of one language. */
export type Words = typeof en;

const zh: Words = {
	lang: 'zh-Hans',
	label: '灯下的毛发',
	hint: '拖动或按方向键移动光源；按住 Shift 则转动视角；+ 和 - 拉近或拉远。',
	controls: '光源与视角',
	turn: '拖动以转动视角',
	play: '播放',
	pause: '暂停',
	reset: '恢复光源与视角',
	loading: '毛发生长中……',
	noWebGL2: '这幅画面需要实时绘制，而此浏览器不支持 WebGL2。',
	notShown: '无法显示这幅画面。',
};

const WORDS: Record<Language, Words> = { en, zh };

/** Words for an element: by the nearest `lang` around it, else by the browser's preference. */
export function wordsFor(element: Element): Words {
	const lang = element.closest<HTMLElement>('[lang]')?.lang;
	return WORDS[languageOf('', [...(lang ? [lang] : []), ...navigator.languages])];
}
