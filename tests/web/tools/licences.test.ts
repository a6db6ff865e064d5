import { describe, expect, it } from 'vitest';
import { licenceText, noticesIn } from '../../../web/tools/site/licences.mjs';

const entry = { name: 'thing', version: '1.0.0', identifier: 'MIT' };

describe('licenceText', () => {
	it('is what the package holds', () => {
		expect(licenceText({ ...entry, text: 'Do as you like.' }, 'Somebody')).toBe('Do as you like.');
	});

	it("is that of MIT with the author's name where the package only names it", () => {
		const text = licenceText(entry, 'Ada L. <ada@example.org> (https://example.org)');
		expect(text).toMatch(/^MIT License\n\nCopyright \(c\) Ada L\.\n\nPermission is hereby granted/);
		expect(text).toContain('WITHOUT WARRANTY OF ANY KIND');
	});

	it.each([
		[entry, undefined],
		[{ ...entry, identifier: 'Apache-2.0' }, 'Ada'],
		[{ name: 'thing', version: '1.0.0' }, 'Ada'],
	])('refuses a package without one: %j by %s', (nameless, author) => {
		expect(() => licenceText(nameless, author)).toThrow(
			/^thing 1\.0\.0: no licence text in the package \(.*\), expected/,
		);
	});
});

describe('noticesIn', () => {
	const terms = 'Redistribution is permitted provided that this notice is kept.';

	it('finds terms in comments of both kinds, without their marks', () => {
		const lines = `import a from 'a';\n\n// Copyright 2002, A\n\n// // ${terms}\nconst b = 1; // not this\n`;
		expect(noticesIn(lines)).toEqual([`Copyright 2002, A\n\n${terms}`]);
		expect(noticesIn(`/*\n * Copyright 2002, A\n * ${terms}\n */\nexport {};`)).toEqual([
			`Copyright 2002, A\n${terms}`,
		]);
	});

	it('finds none where no terms stand', () => {
		expect(noticesIn('// Copyright 2010-2021 Mike\nexport const copyright = "redistribute";\n')).toEqual([]);
	});
});
