import type { Words } from './index.ts';

export const zh: Words = {
	title: 'furbake · 光线如何进入毛发',
	description: '一页读完的课程：用多项式纹理映射（PTM）实时绘制毛发，所有插图都是实时的，共用同一盏灯。',
	steps: '课程目录',
	needsWebGL2: '此图为实时绘制，需要 WebGL2，而当前浏览器不支持。',
	failed: (reason) => `此图无法显示：${reason}`,
};
