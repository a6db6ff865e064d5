/** Question in a figure: predict, then see the answer in the figure itself. */

import './ask.css';

export interface Question {
	/** The question itself. */
	ask: string;
	answers: readonly string[];
	right: string;
	wrong: string;
}

/** Answer of the figure: index of the right one, and the numbers behind it. */
export interface Answer {
	right: number;
	because: string;
}

let made = 0;

/** @param reveal brings the figure to the state that shows the answer */
export function ask(
	place: Element,
	{ ask, answers, right, wrong }: Question,
	reveal: () => Answer | Promise<Answer>,
): void {
	const set = document.createElement('fieldset');
	set.className = 'ask choice';
	const legend = document.createElement('legend');
	legend.textContent = ask;
	const says = document.createElement('p');
	says.setAttribute('aria-live', 'polite');
	set.append(legend);
	const name = `ask-${++made}`;
	const inputs = answers.map((text, i) => {
		const label = document.createElement('label');
		const input = Object.assign(document.createElement('input'), { type: 'radio', name, value: String(i) });
		const span = document.createElement('span');
		span.textContent = text;
		label.append(input, span);
		set.append(label);
		return { input, label };
	});
	set.append(says);
	place.prepend(set);
	set.addEventListener('change', async () => {
		const picked = inputs.findIndex(({ input }) => input.checked);
		const answer = await reveal();
		for (const [i, { label }] of inputs.entries()) label.classList.toggle('right', i === answer.right);
		says.textContent = `${picked === answer.right ? right : wrong} ${answer.because}`;
		set.dataset.answer = picked === answer.right ? 'right' : 'wrong';
	});
}
