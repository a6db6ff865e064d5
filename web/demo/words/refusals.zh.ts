/** 打不开的原因，各句接在“无法显示 NAME：”之后。 */

import type { Refusals } from './refusals.en.ts';

const EXPECTED = '烘焙好的文件夹、其 zip 压缩包、.glb 或 .ptm 文件';

const megabytes = (bytes: number) => `${Number((bytes / 1e6).toFixed(1))} MB`;

export const zh: Refusals = {
	emptyFile: `文件是空的；应为${EXPECTED}`,
	emptyFolder: '文件夹里没有文件；应为含 model.gltf 的烘焙文件夹',
	mesh: (extension, command) => `这是没有毛发的网格（.${extension}）。可先用烘焙器处理：\n${command}`,
	picture: (extension) => `这是图片（.${extension}）；应为${EXPECTED}`,
	text: (extension) => `这是文本（.${extension}）；应为${EXPECTED}`,
	archive: (extension) => `这是其他格式的压缩包（.${extension}）；应为${EXPECTED}`,
	plane: '这只是烘焙文件夹中的一个文件；请拖入整个文件夹或其 zip 压缩包',
	unknown: (extension) => `${extension ? `这是 .${extension} 文件` : '无法识别其类型'}；应为${EXPECTED}`,
	unreadable: (why) => `浏览器无法读取（${why}）`,

	noZip: '它不是 zip 压缩包，尽管扩展名如此',
	cutOff: '结尾缺失，复制或下载不完整',
	emptyZip: '压缩包是空的；应含有带 model.gltf 的烘焙文件夹',
	zipTooLarge: (bytes, most) => `压缩包有 ${megabytes(bytes)}，最多只打开 ${megabytes(most)}`,
	tooLarge: (bytes, most) => `其中的文件共 ${megabytes(bytes)}，最多只打开 ${megabytes(most)}`,
	tooMany: (most) => `其中的文件超过 ${most} 个；烘焙文件夹一般约有十个文件`,
	badPath: (path) => `“${path}”指向压缩包之外；不打开这样的压缩包`,
	backslash: (path) => `“${path}”使用了反斜杠；应为使用正斜杠的压缩包，请重新打包`,
	twice: (path) => `${path}：在压缩包中出现了两次`,
	encrypted: (path) => `${path}：已加密；应为没有密码的压缩包`,
	method: (path, method) => `${path}：压缩方法为 ${method}；应为 deflate（8）或不压缩（0）`,
	zip64: '压缩包采用 ZIP64 格式；应为普通 zip',
	badDirectory: '压缩包的文件目录已损坏',
	damaged: (path) => `${path}：在压缩包中已损坏`,
	swollen: (path, bytes) => `${path}：解压后超过压缩包所声明的 ${bytes} 字节；不打开这样的压缩包`,

	noModel: (files) => `其中没有 model.gltf，只有 ${files}`,
	more: (count) => `等（另有 ${count} 个）`,
	modelMissing: '缺少 model.gltf，而烘焙文件夹的其他文件都在',
	severalModels: (paths) => `其中有多个模型（${paths}）；应只有一个`,
	severalPictures: (paths) => `其中有多张图片（${paths}）；应只有一张`,
	notInZip: (path) => `${path}：不在压缩包中`,
	notInFolder: (path) => `${path}：不在文件夹中`,
	notBeside: (path) => `${path}：没有一起拖入；请拖入整个文件夹或其 zip 压缩包`,
	elsewhere: (address) => `${address}：它在另一个网站上，而本页不会为拖入的模型下载任何文件`,
	noGltf: (path) => `${path}：不是 glTF`,
	shortGlb: (path) => `${path}：结尾缺失，复制或下载不完整`,
	oldGltf: (path, version) => `${path}：是 glTF ${version}；应为 2.0`,
	loop: (path) => `${path}：其节点不构成树`,
	draco: (command) => `网格用 Draco 压缩，本页无法解压，烘焙器可以：\n${command}`,
	requires: (extensions) => `它需要 ${extensions}，本页不支持；请在导出时去掉`,
	badPicture: (path) => `${path}：不是本浏览器能读取的图片`,

	relit: {
		noPtm: () => '它不是 PTM 文件，尽管扩展名如此',
		ptmKind: (got) => `这是其他类型的 PTM（${got}）；应为 PTM_1.2 的 RGB、LRGB、JPEG_RGB 或 JPEG_LRGB`,
		header: () => '文件头已损坏；应有 PTM 的尺寸、比例和偏移',
		short: () => '字节数少于文件头所述：结尾缺失，或文件头有误',
		plane: (name) => `图层 ${name} 缺失、已损坏或尺寸不符`,
		large: (size) => `它有 ${size} 像素，超过本页能打开的大小`,
		relightKind: (got) => `无法识别其类型（${got}）；应为 relight 的 ptm、hsh、sh、rbf 或 bilinear`,
		info: () => 'info.json 已损坏；应为 relight 写出的文件',
	},
};
