/** Words for those who do not see the picture, in Chinese. */

import type { en } from './spoken.en.ts';

export const zh: typeof en = {
	shown: (model) => `${model}，光源可移动`,
	nothing: '没有显示任何模型',
	arrived: (model) => `已显示${model}。`,
	keys: '方向键移动光源，按住 Shift 幅度更大；加号、减号拉近或拉远。按下“旋转视角”按钮后，方向键旋转视角。选用刷子时，方向键移动圆环，回车键在圆环处抚摸或涂抹。',
	lamp: (aside, up) => `光源：${aside}，${up}`,
	camera: (aside, up, distance) => `视角：${aside}，${up}，距离 ${distance}`,
	right: (degrees) => `偏右 ${degrees}°`,
	left: (degrees) => `偏左 ${degrees}°`,
	front: '正前方',
	behind: '正后方',
	above: (degrees) => `上方 ${degrees}°`,
	below: (degrees) => `下方 ${degrees}°`,
	painted: { stroke: '已抚摸', rain: '已淋湿', mud: '已弄脏' },
};
