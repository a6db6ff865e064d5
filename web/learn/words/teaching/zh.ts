import type { teaching as english } from './en.ts';

export const teaching: typeof english = {
	hello: '一块狐狸毛。拖动或用方向键移动光源。',
	hair: {
		sketch: '毛发示意图上方沿弧线移动的灯。拖动或用方向键移动它。',
		degrees: (degrees) => `偏离竖直方向 ${degrees}°`,
		plot: '该点亮度随灯的位置变化：圆点为实测，抛物线挂在三个控制点上。',
		handles: ['左控制点', '中控制点', '右控制点'],
		across: 'lᵥ，灯沿皮肤的分量',
		up: 'L',
		best: '显示最佳抛物线',
		hide: '隐藏最佳抛物线',
		says: ([square, linear, constant], own, best) =>
			`你的抛物线：L = ${square}·lᵥ² + ${linear}·lᵥ + ${constant}，均方根误差 ${own}`.replaceAll('+ −', '− ') +
			`${best ? `；最佳为 ${best}。` : '。'}`,
	},
	mean: {
		measured: (high) => `实测，检验灯（不参与拟合），仰角 ${high}°`,
		relit: '由六个系数算得',
		off: (times) => `六个系数 − 实测，× ${times}`,
		offNow: (times, all, own) => `六个系数 − 实测，× ${times}。此灯：误差 ${all}%，去掉全层共有的部分后 ${own}%`,
		worst: '共有误差最大的灯',
		side: '平均范围',
		square: (side) => `${side} × ${side}`,
		shared: '全层共有的误差',
		sharing: { kept: '保留', taken: '去掉' },
		plot: '误差占该层平均亮度的百分比，随平均范围的边长变化。',
		percent: '误差，占平均亮度的 %',
		all: '全部误差',
		own: '去掉全层共有的部分',
		says: (side, all, own) =>
			`平均范围 ${side} × ${side} 个纹素，全部检验灯：误差 ${all}%，去掉全层共有的部分后为 ${own}%。`,
	},
	pose: {
		picture: '由两根骨骼带动的毛茸茸的肢体，以及一个顶点转动前后的标架。拖动或按方向键转动关节。',
		bars: '关节转动前后，这个顶点的六个光照矩。',
		columns: ['之前', '现在'],
		joint: '关节',
		degrees: (degrees) => `${degrees}°`,
		says: (before, now) => `乘以图 4 那块毛发的六个数：之前 L = ${before}，现在 ${now}。`,
	},
	ask: {
		dome: {
			ask: '先猜：灯从头顶降到地平线时，哪一层失去的亮度比例更大？',
			answers: ['靠近毛根的第 4 层', '靠近毛尖的第 14 层', '一样'],
			right: '对。',
			wrong: '不对。',
			because: (deep, high) =>
				`第 4 层失去 ${deep}%，第 14 层失去 ${high}%：灯越低，光线穿过的毛越多，到毛根的路上最多。`,
		},
		bits: {
			ask: '先猜：现在存的是 8 位。减到几位，量化造成的损失仍不到半分贝？',
			answers: ['七位', '六位', '四位'],
			right: '对。',
			wrong: '还可以更少。',
			because: (bits, now, all) => `${bits} 位时各层仍有 ${now} dB（8 位为 ${all} dB）：多项式本身的误差要大得多。`,
		},
		nap: {
			ask: '先猜：从哪里看，长毛绒比从正上方看更亮？',
			answers: ['与灯同侧', '在灯的对面', '都不是'],
			right: '对。',
			wrong: '不对。',
			because: (beside, opposite) => `与灯同侧，亮度 × ${beside}；在对面，× ${opposite}：那里看到的是毛背光的一侧。`,
		},
	},
};
