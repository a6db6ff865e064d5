import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { typeset } from '../../../web/tools/site/lesson.mjs';

const text = (language: string) =>
	readFileSync(new URL(`../../../web/learn/text/${language}.md`, import.meta.url), 'utf8');
const all = (html: string, pattern: RegExp) => [...html.matchAll(pattern)].map(([, found]) => found);
const figures = (html: string) => all(html, /<figure data-figure="(\w+)">/g);
const sections = (html: string) => all(html, /<section id="(\w+)"/g);
/** LaTeX of what stands on lines of its own, as KaTeX keeps it beside what it has set. */
const equations = (html: string) =>
	all(html, /<span class="katex-display">.*?<annotation encoding="application\/x-tex">(.*?)<\/annotation>/gs);

describe('the lesson', () => {
	const [en, zh] = ['en', 'zh'].map((language) => typeset(text(language))) as [string, string];

	it('has the same steps, figures and equations in both languages', () => {
		expect(sections(en).length).toBeGreaterThanOrEqual(12);
		expect(sections(zh)).toEqual(sections(en));
		expect(figures(zh)).toEqual(figures(en));
		expect(equations(en).length).toBeGreaterThanOrEqual(9);
		expect(equations(zh)).toEqual(equations(en));
	});

	it.each(['shells', 'slices', 'body', 'nap', 'rivals', 'paper', 'swing', 'wet'])(
		'says %s in at most 120 words and ends with something to try',
		(id) => {
			const [, section = ''] = new RegExp(`<section id="${id}">(.*?)</section>`, 's').exec(text('en')) ?? [];
			expect(section).toContain('class="try"');
			const words = section
				.replace(/\$\$.*?\$\$|<fig.*?<\/figure>|<p class="try">.*?<\/p>|##.*/gs, ' ')
				.split(/\s+/)
				.filter((word) => /\w/.test(word));
			expect(words.length).toBeLessThanOrEqual(120);
		},
	);

	it('leaves no mark of Markdown or LaTeX unset, and ships no program', () => {
		for (const html of [en, zh]) {
			const shown = html.replace(/<annotation.*?<\/annotation>/gs, '').replace(/<[^>]*>/g, '');
			expect(shown).not.toMatch(/\*\*|\$|\\[a-z]+/);
			const own = html.replace(/<a href="https:[^"]*">/g, '');
			expect(own).not.toMatch(/<script|on\w+=|https?:(?!\/\/www\.w3\.org\/)/);
		}
	});

	it('keeps a sign on the line of the equation before it', () => {
		const html = typeset('$U$、$V$ 与 $W$ 和 $X$。');
		expect(html.match(/<span class="unbroken"><span class="katex">/g)).toHaveLength(2);
		expect(html).toMatch(/、<\/span><span class="katex">/);
		expect(html.replace(/<annotation.*?<\/annotation>/gs, '')).toMatch(/。<\/span><\/p>/);
	});

	it('refuses an equation that is none', () => {
		expect(() => typeset('$\\nonsense{$')).toThrow(/KaTeX/);
	});
});
