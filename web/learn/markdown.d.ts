/** Texts are HTML when the page gets them: see tools/lesson.mjs. */
declare module '*.md' {
	const html: string;
	export default html;
}
