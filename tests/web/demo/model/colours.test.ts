import { Color } from 'three';
import { describe, expect, it } from 'vitest';
import { bakedColours, hasOwnColours, paint } from '../../../../web/demo/model/colours.ts';
import { type Fur, type FurAsset, FurColors } from '../../../../web/fur/index.ts';
import { coloured } from '../../fur/light/multiple.ts';

/** What colours are about of a fur, linear. */
function fur(plane: boolean, asset: Partial<FurAsset> = { pelts: [] }) {
	const material = {
		root: new Color(0.1, 0.05, 0.02),
		tip: new Color(0.4, 0.2, 0.1),
		tip2: new Color(0.8, 0.8, 0.8),
		skinColor: new Color(1, 0.5, 1),
	};
	const made = { asset, shells: { material }, textures: { colour: plane ? {} : undefined } };
	return { fur: made as unknown as Fur, material };
}

describe('the colours of root and tip', () => {
	it('are those of the ramp, in sRGB, and come back to the bit', () => {
		const { fur: one, material } = fur(false);
		expect(hasOwnColours(one)).toBe(false);
		expect(bakedColours(one)).toEqual([
			new Color(0.1, 0.05, 0.02).getHexString(),
			new Color(0.4, 0.2, 0.1).getHexString(),
		]);
		paint(one, ['ff0000', '00ff00']);
		expect(material.root.getHexString()).toBe('ff0000');
		expect(material.tip.getHexString()).toBe('00ff00');
		expect(material.tip2.toArray()).toEqual([0, 1, 0]);
		expect(material.skinColor.toArray()).toEqual([1, 0.5, 1]);
		expect(bakedColours(one)[0]).toBe(new Color(0.1, 0.05, 0.02).getHexString());
		paint(one, undefined);
		expect([material.root, material.tip, material.tip2].map((colour) => colour.toArray())).toEqual([
			[0.1, 0.05, 0.02],
			[0.4, 0.2, 0.1],
			[0.8, 0.8, 0.8],
		]);
	});

	it('tint all hairs where each has its own, by what the tip is of the baked one', () => {
		const { fur: one, material } = fur(true);
		expect(hasOwnColours(one)).toBe(true);
		paint(one, ['ff0000', new Color(0.2, 0.2, 0.1).getHexString()]);
		const [r = 0, g = 0, b = 0] = material.skinColor.toArray();
		expect(r).toBeCloseTo(0.5, 1);
		expect(g).toBeCloseTo(0.5, 1);
		expect(b).toBeCloseTo(1, 1);
		expect(material.root.toArray()).toEqual([0.1, 0.05, 0.02]);
		// However dark the baked colour is, white is no floodlight.
		paint(one, ['000000', 'ffffff']);
		expect(Math.max(...material.skinColor.toArray())).toBeLessThanOrEqual(4);
	});

	it('are picked as they are seen: hairs that take light from each other are paler than their fur', () => {
		const { fur: one, material } = fur(false, coloured);
		const seen = FurColors.of(coloured);
		if (!seen) throw new Error('no colours');
		paint(one, ['804020', 'c08040']);
		for (const [hairs, picked] of [
			[material.root, '804020'],
			[material.tip, 'c08040'],
		] as const) {
			const wanted = new Color(`#${picked}`);
			expect(hairs.r).toBeGreaterThan(wanted.r);
			expect(new Color(...hairs.toArray().map((part) => seen.seen(part))).getHexString()).toBe(picked);
		}
		// What the panel shows of the baked ones, picked, is what was baked.
		const [root, tip] = bakedColours(one);
		paint(one, [root, tip]);
		expect(material.root.r).toBeCloseTo(0.1, 2);
		expect(material.tip.toArray().map((part) => part.toFixed(1))).toEqual(['0.4', '0.2', '0.1']);
		expect(material.tip2.r).toBeCloseTo(0.8, 1);
		paint(one, undefined);
		expect(material.tip2.toArray()).toEqual([0.8, 0.8, 0.8]);
	});
});
