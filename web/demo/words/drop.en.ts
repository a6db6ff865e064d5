/** Words for models from the visitor's machine. */

export const en = {
	drop: 'Drop a baked folder, its zip, a .glb or a .ptm',
	open: 'Open …',
	openTip:
		'A zip of a baked folder, a .glb or a .ptm from this device; or drop it on the picture. Nothing is uploaded.',
	openFolder: 'Open folder …',
	openFolderTip: 'A baked folder, or one of relight, from this device; or drop it on the picture. Nothing is uploaded.',
	/** Name of several files without a folder. */
	files: (count: number) => `${count} files`,
	bakeIt: (name: string, command: string) => `${name} has no fur yet, so its skin is shown. To grow some:\n${command}`,
	/** Added to that for a model with clips. */
	willMove: 'Its clips come along: the fur moves with the body.',
	newer: (name: string, version: string, known: string) =>
		`${name}: its fur is of version ${version}, newer than the ${known} that this page knows; the skin is shown alone`,
};

export type DropWords = typeof en;
