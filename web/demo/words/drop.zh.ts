/** 打开本机文件的用语。 */

import type { DropWords } from './drop.en.ts';

export const zh: DropWords = {
	drop: '拖入烘焙好的文件夹、其 zip 压缩包、.glb 或 .ptm 文件',
	open: '打开…',
	openTip: '打开本机上烘焙文件夹的 zip 压缩包、.glb 或 .ptm 文件，也可以直接拖到画面上。不会上传任何内容。',
	openFolder: '打开文件夹…',
	openFolderTip: '打开本机上烘焙好的文件夹或 relight 的文件夹，也可以直接拖到画面上。不会上传任何内容。',
	files: (count) => `${count} 个文件`,
	bakeIt: (name, command) => `${name} 还没有毛发，因此只显示皮肤。要让它长出毛发：\n${command}`,
	willMove: '动作会一并保留：毛发将随身体而动。',
	newer: (name, version, known) => `${name}：其毛发格式版本为 ${version}，高于本页支持的 ${known}，因此只显示皮肤`,
};
