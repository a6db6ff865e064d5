import type { Words } from './index.ts';

export const zh: Words = {
	title: 'furbake · 光线如何进入毛发',
	description: '一页读完的课程：用多项式纹理映射（PTM）实时绘制毛发，所有插图都是实时的，共用同一盏灯。',
	steps: '课程目录',
	print: '打印（含全部插图）',
	needsWebGL2: '此图为实时绘制，需要 WebGL2，而当前浏览器不支持。',
	failed: (reason) => `此图无法显示：${reason}`,
	shells: {
		askew: '斜上方看到的一块毛发。拖动或用方向键移动光源。',
		side: '同一块毛发的侧面。',
		slider: '壳层数',
		count: (shells) => String(shells),
	},
	slices: {
		picture: '一块毛发瓦片。拖动或用方向键移动光源。',
		stage: '显示',
		stages: { strands: '毛发丝', volume: '体数据', slices: '切片' },
		apart: '拉开',
		times: (times) => `× ${times.toFixed(1)}`,
		strands: (count) => `一块周期性瓦片中有 ${count} 根毛发`,
		volume: (size, layers, shown, solid) =>
			`${size} × ${size} × ${layers} 个体素；图中为毛发覆盖率超过 ${Math.round(100 * solid)}% 的 ${shown} 个`,
		slices: (layers, size, coefficients) =>
			`${layers} 层切片，每层 ${size} × ${size} 个纹素，每个纹素存 ${coefficients} 个系数与 α`,
	},
	body: {
		picture: '毛茸茸的兔子。拖动或用方向键移动光源。',
		show: '显示',
		parts: {
			fur: '壳层与鳍片',
			shells: '仅壳层',
			fins: '仅鳍片',
			patches: '按贴片着色',
			hull: '外壳',
		},
		numbers: ({ skin, patches, faces, overlap, fins }) =>
			`皮肤 ${skin} 个三角形 · ${patches} 个贴片共 ${faces} 个三角形，平均每个皮肤三角形 ${overlap.toFixed(2)} 个 · ` +
			`鳍片 ${fins} 个三角形`,
	},
	rivals: {
		picture: (method) => `用${method}照明的毛绒圆环。拖动或用方向键移动光源。`,
		methods: {
			unlit: { name: '无光照', costs: '只有颜色：任何光照方法的开销下限。' },
			lengyel: { name: 'Lengyel 局部光照', costs: '每根毛单独受光，每个片元取一次方向；阴影只按深浅估计。' },
			'shadow-layers': { name: '层状阴影图', costs: '有真实阴影；光源一动，就要从光源处把全部毛发重画一遍。' },
			ptm: { name: 'PTM', costs: '有真实阴影；无论光在何处，只需两次取样和一次点积。' },
			article: { name: '论文原式 PTM', costs: '只用多项式，没有平均曲线；毛色另需第三次取样。' },
		},
		table: '表 1：不同三角形数下的帧率（帧/秒），16 层壳层，光源移动',
		article: '论文（2009）',
		here: '本机实测',
		triangles: '三角形数',
		columns: ['阴影图', 'PTM', '比值'],
		count: (triangles) => triangles.toLocaleString('en-GB').replaceAll(',', '\u202f'),
		measure: '在本机测量',
		stop: '停止',
		stopped: '已停止。',
		measuring: (share) => `测量中……${Math.round(100 * share)}%`,
		measured: '在 640 × 360 像素下轮流测得。“测速”页测得更久、更全。',
		cannot: (reason) => `无法测量：${reason}`,
	},
	tuft: {
		picture: '平面上的一簇长毛及其阴影。拖动或用方向键移动光源。',
	},
	turning: {
		picture: (turn) => `一块毛发，光源转过 ${turn} 度。拖动或用方向键移动光源。`,
		brightness: (turn, brightness) => `${turn}°：平均 L = ${brightness.toFixed(2)}`,
	},
	short: {
		pictures: ['长毛。拖动或用方向键移动光源。', '短毛。拖动或用方向键移动光源。'],
		swing: (height, swing) => `毛高为瓦片宽的 ${height}：光源绕行一周，L 变化 ±${(100 * swing).toFixed(0)}%。`,
	},
	spring: {
		tufts: '同一弹簧上的三簇毛：真实摆动、精确步进、欧拉步进。拖动或用方向键把毛拨开，再松手。',
		ways: ['真实摆动', '精确步进', '欧拉步进'],
		plot: '两秒内毛尖的位置：真实曲线、精确步进的点、欧拉步进的点。',
		seconds: '秒',
		lengths: '毛尖位移（以毛长为单位）',
		step: '时间步长',
		rate: (rate) => `1/${rate} 秒`,
		frequency: '频率',
		hertz: (hertz) => `${hertz} Hz`,
		damping: '阻尼 ζ',
		letGo: '松手',
		off: (exact, euler, limit) =>
			`与曲线的最大偏差：精确步进 ${exact}，欧拉步进 ${euler}（以毛长为单位）。` +
			`步长不超过 2ζ/ω = ${limit} 毫秒时，欧拉步进才有界。`,
	},
	wind: {
		picture: '风中的一块毛发。拖动即抚摸，方向键移动光源。',
		wind: '风力',
		strength: (strength) => strength.toFixed(2),
		direction: '风向',
		degrees: (degrees) => `${degrees}°`,
		stroke: '抚摸一下',
		shake: '摇一摇',
	},
	wet: {
		picture: '介于两种状态之间的一块毛发。拖动或用方向键移动光源。',
		neighbours: ['两种状态中较干的一种。拖动或用方向键移动光源。', '两种状态中较湿的一种。拖动或用方向键移动光源。'],
		states: ['干', '微湿', '潮湿', '湿', '湿透'],
		share: (state, share) => `${state} ${(100 * share).toFixed(0)}%`,
		wetness: '湿度',
		dirt: '泥污',
		hair: (length, shade) => `毛高为干毛的 ${(100 * length).toFixed(0)}%，亮度为干毛的 ${shade.toFixed(2)}。`,
	},
};
