/** The same fur by five methods of lighting, and Table 1 measured on the reader's machine. */

import type { Fur, FurMethodName } from '../../fur/index.ts';
import { dressFur, furMethod } from '../../fur/index.ts';
import { ARTICLE, type Table1Row } from '../../measure/bench/results.ts';
import { action, controlRow, note, pane, panes } from '../controls.ts';
import { ARTICLE_FORM, loadFurry, reach } from '../data/assets.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { LAMP_NAMES, lampOf, truthPane } from '../rivals/truth.ts';
import ring from '../rivals/view.json';
import { View, type ViewOptions } from '../view.ts';

const SHELLS = 16;
const METHODS = ['unlit', 'lengyel', 'shadow-layers', 'ptm'] as const satisfies FurMethodName[];

export const mount: Mount = async (place, lesson) => {
	const [furry, article] = await Promise.all([loadFurry(ring.model, lesson), loadFurry(ARTICLE_FORM, lesson)]);
	pictures(place, lesson, furry.fur, dressFur(furry.fur, article.fur), reach(furry)).add(furry.object);
	table(place, lesson);
};

/** @param article same body in the article's form of texels */
function pictures(
	place: HTMLElement,
	lesson: Lesson,
	fur: Fur,
	article: Fur,
	around: Pick<ViewOptions, 'centre' | 'radius'>,
): View {
	const words = lesson.words.rivals;
	const { renderer } = lesson.painter;
	if (!renderer) throw new Error(lesson.words.needsWebGL2);
	for (const { shells, fins } of [fur, article]) {
		shells.shellCount = SHELLS;
		if (fins) fins.visible = false;
		Object.assign(shells.material, { gloss: 0, backlight: 0 });
	}
	const rivals = [
		...METHODS.map((name) => ({ name, of: fur, method: furMethod(fur, name, { renderer }) })),
		{ name: 'article' as const, of: article, method: furMethod(article, 'ptm') },
	];
	const row = panes(place, (rivals.length + 1) / 2);
	let view: View | undefined;
	for (const { name, of, method } of rivals) {
		const { element, caption } = pane(row);
		const options: ViewOptions = {
			label: words.picture(words.methods[name].name),
			aspect: 1,
			...ring.eye,
			...around,
			before() {
				for (const each of [fur, article]) each.shells.visible = each === of;
				method.apply();
				of.update(0);
			},
		};
		if (view) view.window(element, options);
		else view = new View(element, lesson, options);
		const strong = document.createElement('strong');
		strong.textContent = words.methods[name].name;
		caption.append(strong, ` ${words.methods[name].costs}`);
	}
	truthPane(row, lesson);
	const made = view as View;
	// Less ambient light than elsewhere, to show shadows.
	made.sky.intensity *= ring.sky;
	made.cast(fur.asset.length);
	const lamps = controlRow(place);
	lamps.append(words.lamp);
	for (const name of LAMP_NAMES) action(lamps, words.lamps[name], () => lesson.light.set(...lampOf(name).toArray()));
	return made;
}

/** Article's table, with room beside it for this machine's figures. */
function table(place: HTMLElement, { words: { rivals: words }, painter }: Lesson): void {
	const scroll = document.createElement('div');
	scroll.className = 'scroll';
	// Scrollable by arrow keys where wider than the window.
	scroll.tabIndex = 0;
	scroll.setAttribute('role', 'region');
	scroll.setAttribute('aria-label', words.table);
	const made = scroll.appendChild(document.createElement('table'));
	headings(made, words);
	const body = made.createTBody();
	const here = new Map<number, HTMLTableCellElement[]>();
	for (const row of ARTICLE) {
		const line = body.insertRow();
		const name = line.appendChild(document.createElement('th'));
		Object.assign(name, { scope: 'row', textContent: words.count(row.triangles) });
		for (const text of cells(row)) line.insertCell().textContent = text;
		here.set(
			row.triangles,
			cells(row).map(() => line.insertCell()),
		);
		for (const cell of here.get(row.triangles) ?? []) cell.textContent = '–';
	}
	place.append(scroll);

	const controls = controlRow(place);
	const line = note(place, true);
	let running: AbortController | undefined;
	const button = action(controls, words.measure, async () => {
		if (running) return running.abort();
		running = new AbortController();
		button.textContent = words.stop;
		// Pause the figures, which would disturb the measurement.
		painter.paused = true;
		try {
			// Fetched on demand.
			const { measureTable1 } = await import('../../measure/bench/table1.ts');
			const rows = await measureTable1({ quick: true }, running.signal, (share) => {
				line.textContent = words.measuring(share);
			});
			for (const row of rows)
				for (const [i, text] of cells(row).entries()) {
					const cell = here.get(row.triangles)?.[i];
					if (cell) cell.textContent = text;
				}
			line.textContent = words.measured;
		} catch (error) {
			line.textContent = running.signal.aborted ? words.stopped : words.cannot((error as Error).message);
		}
		running = undefined;
		painter.paused = false;
		button.textContent = words.measure;
	});
}

/** Caption and two rows of headings. */
function headings(table: HTMLTableElement, words: Lesson['words']['rivals']): void {
	table.createCaption().textContent = words.table;
	const [first, second] = [table.createTHead().insertRow(), table.createTHead().insertRow()];
	const head = (row: HTMLTableRowElement, text: string, span = 1) => {
		const cell = row.appendChild(document.createElement('th'));
		Object.assign(cell, { textContent: text, colSpan: span, scope: span > 1 ? 'colgroup' : 'col' });
	};
	first.insertCell();
	head(first, words.article, 3);
	head(first, words.here, 3);
	for (const text of [words.triangles, ...words.columns, ...words.columns]) head(second, text);
}

function cells({ layered, ptm, ratio }: Table1Row): string[] {
	return [layered.fps.toFixed(1), ptm.fps.toFixed(1), ratio.toFixed(2)];
}
