import type { Part } from '../../measure/bench/plan.ts';
import type { Method } from '../../measure/bench/results.ts';
import type { Words } from './en.ts';

const duration = (seconds: number) => (seconds < 90 ? `${Math.ceil(seconds)} 秒` : `${Math.round(seconds / 60)} 分钟`);

const doing: Record<Part | 'loading', string> = {
	loading: '正在加载模型',
	results: '各种方法',
	layers: '各种方法（三角形数按所有层合计）',
	costs: '各项效果的开销',
	curves: '帧时间随壳层数和像素数的变化',
	card: '全尺寸画面与群体',
};

const methods: Record<Method, string> = {
	unlit: '无光照',
	lengyel: 'Lengyel 光照',
	'shadow-layers': '层状阴影图',
	ptm: 'PTM',
	ptm3: 'PTM，3 个系数',
	'ptm-colour': '论文原式 PTM：带颜色，无平均曲线',
};

export const zh: Words = {
	title: 'furbake · 测速',
	description: '在您眼前的这台机器上重测论文的表 1：用多项式纹理映射绘制毛发，与其他方法比较。',
	heading: '到底有多快？',
	intro:
		'同一个圆环、同样的毛发，用六种方法计算光照，由您眼前的这台机器轮流绘制：16 个壳层，一盏每帧都在移动的灯，此外别无他物。无光照的毛发是速度的上限；层状阴影图是论文表 1 中的对比方法，这里采用深度不透明度图（deep opacity maps）的形式，光源一动就要重新绘制。',
	measured: '其他机器的实测数据与测量方法（英文）',
	measure: '开始测量',
	again: '重新测量',
	stop: '停止',
	measuring: '正在测量……',
	done: '测量完成，结果见下。',
	stopped: '已停止。',
	quick: '快速测量：轮数较少，像素只有四分之一',
	share: '测量进度',
	download: '下载 JSON',
	copy: '复制',
	copied: '已复制',
	notCopied: '浏览器不允许复制',

	doing: (percent, secondsLeft, what) => {
		const left = secondsLeft === undefined ? '' : `，大约还需 ${duration(secondsLeft)}`;
		return `${percent}%${left}：${doing[what]}`;
	},
	machine: (device, cores, seconds, browser) =>
		`${device}，浏览器报告 ${cores} 核，共用时 ${duration(seconds)}。${browser}`,
	failed: (why) => `无法测量：${why}`,
	problems: (problems) => `网址中有误：${problems.join('；')}。`,
	problem: (given, expected) => `${given}，应为${expected}`,
	expected: {
		rounds: ' 1 到 99',
		size: '宽和高，各 16 到 9999 像素，例如 1280x720',
		post: '本站内的路径',
		some: (all) => ` ${all.join('、')} 中的若干项`,
	},

	methods,
	subject: (method, still, fins) =>
		[methods[method], ...(still ? ['光源静止'] : []), ...(fins ? ['带鳍片'] : [])].join('，'),
	picture: (subject) => `毛茸茸的圆环：${subject}`,
	costs: {
		plain: '基准',
		highlight: '高光',
		backlight: '背光透射',
		shadow: '阴影图',
		environment: '环境光',
		'all of them': '以上全部',
		'all of them, and fins': '以上全部，再加鳍片',
		'one, moving': '一盏移动的灯',
		'a still light': '光源静止',
		'8 lights': '8 盏灯',
		fins: '鳍片',
		'merged shells': '被遮挡的壳层合为一层',
		'48 shells': '48 层壳',
		'48 shells, merged': '48 层壳，被遮挡和稀疏的合并',
	},

	tables: {
		methods: '不同三角形数下每帧的毫秒数',
		layers: '每帧的毫秒数；三角形数按模型本身计，16 层合计为 512、4\u00a0608 和 16\u00a0896',
		milliseconds: (triangles) => `${triangles}：ms`,
		ofUnlit: '与无光照之比',
		article: '不同三角形数下的绘制效率（帧/秒）',
		shadowLayers: '层状阴影图',
		ptm: 'PTM',
		faster: 'PTM 加速比',
		theArticle: (triangles) => `${triangles}，论文`,
		here: (triangles) => `${triangles}，本机`,
		hereOfLayers: (triangles) => `${triangles}，本机，所有层合计`,
		features: '毛发的附加效果',
		light: '光照的开销',
		ofPlain: '与基准之比',
		ofOneLamp: '与一盏灯之比',
		overdraw: '每个被覆盖像素的片元数',
		covered: '覆盖率',
		shaded: '着色',
		blended: '混合',
		triangles: (count, fins) => `${count} 个三角形${fins ? '，带鳍片' : ''}`,
		card: '每帧的毫秒数（每秒帧数），按画面尺寸',
		shells: (count, bodies) => `${count} 层壳，${bodies} 个物体`,
	},

	methodsTitle: '各种方法',
	methodsText: (width, height, shells, rounds, reads) =>
		`${width} × ${height} 像素、${shells} 个壳层时每帧的毫秒数：各方法按先顺序、后逆序的次序轮流绘制，${rounds === 1 ? '共一轮' : `取 ${rounds} 轮的中位数`}；每帧以${reads ? '读回它的一个像素' : 'GPU 自身的计时器'}为结束标志。比值为各轮比值的中位数。`,
	growth: (steps) =>
		`PTM 的帧时间：三角形数${steps.map(({ from, to, ratio }) => `从 ${from} 增至 ${to} 时为 ${ratio}`).join('，')}。`,
	articleTitle: '论文的表 1',
	articleText:
		'每秒绘制的帧数。论文没有说明其三角形数是模型本身的，还是 16 层的总和，因此两种情形都作了测量。论文所用的显卡是 64 MB 显存的 Quadro NVS 110；作为对比的层状阴影图方法未见公开的文献。',
	overdrawTitle: '过度绘制',
	overdrawText:
		'毛发覆盖的画面比例，以及所覆盖的每个像素的片元数：至多需要着色的（位于皮肤之前），和真正参与混合的（高于 alpha 阈值且未被其他毛发遮住）。',
	costsTitle: '其他效果的开销',
	costsText:
		'4\u00a0608 个三角形的 PTM。先列出毛发的附加效果，逐项以及全部一起；再列出光照的开销：光源是否移动，一盏灯换成八盏灯，以及鳍片。',
	cardTitle: '全尺寸画面与群体',
	cardText: (device) =>
		`PTM，带鳍片，一盏移动的灯，每个物体每层壳 4\u00a0608 个三角形，设备为 ${device}：占满画面高度的一个物体，以及同样占满画面的一群物体。`,
	curvesTitle: '帧时间随什么增长',
	curvesText: '每帧的毫秒数随壳层数、像素数和三角形数的变化。',
	curves: {
		shells: ['壳层数', '壳层'],
		pixels: ['像素数', '百万像素'],
		triangles: ['三角形数', '三角形'],
		unit: 'ms',
	},
};
