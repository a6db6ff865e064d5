import { describe, expect, it } from 'vitest';
import { addressIn, languageOf } from '../../../web/page/language.ts';

describe('languageOf', () => {
	it.each([
		['', ['de-CH', 'zh-TW', 'en'], 'zh'],
		['', ['en-GB', 'zh'], 'en'],
		['', ['fr'], 'en'],
		['', [], 'en'],
		['?lang=zh', ['en'], 'zh'],
		['?model=x&lang=en', ['zh-CN'], 'en'],
		['?lang=fr', ['zh-CN'], 'zh'],
		['?lang=toString', ['en'], 'en'],
	])('%s for somebody who reads %j is %s', (search, preferred, language) => {
		expect(languageOf(search, preferred)).toBe(language);
	});
});

describe('addressIn', () => {
	it.each([
		['http://a/b/', 'http://a/b/?lang=zh'],
		['http://a/b/?lang=en&model=x', 'http://a/b/?model=x&lang=zh'],
		[
			'http://a/b/?model=models/x&light=0,1,.5&langue=1#top',
			'http://a/b/?model=models/x&light=0,1,.5&langue=1&lang=zh#top',
		],
	])('%s', (from, to) => {
		expect(addressIn('zh', from)).toBe(to);
	});
});
