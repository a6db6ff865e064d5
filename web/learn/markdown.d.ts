/** HTML of a Markdown text: see tools/site/lesson.mjs. */
declare module '*.md' {
	const html: string;
	export default html;
}
