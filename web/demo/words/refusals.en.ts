/** Reasons for refusal; each follows "NAME cannot be shown: ". */

const EXPECTED = 'a baked folder, its zip, a .glb or a .ptm';

/** Megabytes of 10⁶ bytes, as file managers count. */
const megabytes = (bytes: number) => `${Number((bytes / 1e6).toFixed(1))} MB`;

export const en = {
	// Kind of file.
	emptyFile: `it is an empty file; expected ${EXPECTED}`,
	emptyFolder: 'the folder is empty; expected a baked folder with model.gltf',
	mesh: (extension: string, command: string) =>
		`it is a mesh without fur (.${extension}). The baker reads it:\n${command}`,
	picture: (extension: string) => `it is a picture (.${extension}); expected ${EXPECTED}`,
	text: (extension: string) => `it is text (.${extension}); expected ${EXPECTED}`,
	archive: (extension: string) => `it is an archive of another kind (.${extension}); expected ${EXPECTED}`,
	plane: 'it is one file of a baked folder; drop the whole folder, or its zip',
	unknown: (extension: string) =>
		`${extension ? `it is a .${extension} file` : 'its kind is unknown'}; expected ${EXPECTED}`,
	unreadable: (why: string) => `the browser could not read it (${why})`,

	// The zip.
	noZip: 'it is not a zip file, despite its name',
	cutOff: 'the end is missing: it was not copied or downloaded completely',
	emptyZip: 'the zip is empty; expected a baked folder with model.gltf',
	zipTooLarge: (bytes: number, most: number) => `the zip is ${megabytes(bytes)}; at most ${megabytes(most)} are opened`,
	tooLarge: (bytes: number, most: number) => `its files are ${megabytes(bytes)}; at most ${megabytes(most)} are opened`,
	tooMany: (most: number) => `there are more than ${most} files in it; a baked folder has about ten`,
	badPath: (path: string) => `“${path}” leads out of the zip; such a zip is not opened`,
	backslash: (path: string) =>
		`“${path}” is written with a backslash; expected a zip with slashes, as today's systems pack`,
	twice: (path: string) => `${path}: it is in the zip twice`,
	encrypted: (path: string) => `${path}: it is encrypted; expected a zip without a password`,
	method: (path: string, method: number) =>
		`${path}: it is packed by method ${method}; expected deflate (8) or none (0), as any system packs`,
	zip64: 'the zip is in the ZIP64 format; expected an ordinary zip',
	badDirectory: "the zip's list of its files is damaged",
	damaged: (path: string) => `${path}: it is damaged in the zip`,
	swollen: (path: string, bytes: number) =>
		`${path}: it unpacks to more than the ${bytes} bytes that the zip states; such a zip is not opened`,

	// The model.
	noModel: (files: string) => `there is no model.gltf in it, only ${files}`,
	more: (count: number) => `and ${count} more`,
	modelMissing: 'model.gltf is missing: the other files of a baked folder are there',
	severalModels: (paths: string) => `there are several models in it (${paths}); expected one`,
	severalPictures: (paths: string) => `there are several pictures in it (${paths}); expected one`,
	notInZip: (path: string) => `${path}: it is not in the zip`,
	notInFolder: (path: string) => `${path}: it is not in the folder`,
	notBeside: (path: string) => `${path}: it was not dropped with the model; drop the whole folder, or its zip`,
	elsewhere: (address: string) => `${address}: it is on another site; nothing is fetched for a dropped model`,
	noGltf: (path: string) => `${path}: it is not a glTF file`,
	shortGlb: (path: string) => `${path}: the end is missing: it was not copied or downloaded completely`,
	oldGltf: (path: string, version: string) => `${path}: it is glTF ${version}; expected 2.0`,
	loop: (path: string) => `${path}: its nodes form a loop; expected a tree`,
	draco: (command: string) =>
		`its mesh is packed by Draco, which this page does not unpack. The baker does:\n${command}`,
	requires: (extensions: string) => `it requires ${extensions}, which this page does not know; export it without`,
	badPicture: (path: string) => `${path}: it is not a picture that this browser can read`,

	// Pictures of museums.
	relit: {
		noPtm: (_: string) => 'it is not a PTM file, despite its name',
		ptmKind: (got: string) =>
			`it is a PTM of another kind (${got}); expected PTM_1.2 as RGB, LRGB, JPEG_RGB or JPEG_LRGB`,
		header: (_: string) => 'its header is damaged; expected size, scales and biases of a PTM',
		short: (_: string) => 'it has fewer bytes than its header says: the end is missing, or the header is wrong',
		plane: (name: string) => `${name}: this plane is missing, damaged or of another size`,
		large: (size: string) => `it has ${size} pixels, more than this page opens`,
		relightKind: (got: string) => `its kind is unknown (${got}); expected ptm, hsh, sh, rbf or bilinear of relight`,
		info: (_: string) => 'info.json is damaged; expected the one that relight writes',
	},
};

export type Refusals = typeof en;
