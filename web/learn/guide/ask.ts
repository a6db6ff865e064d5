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
	says.setAttribute('role', 'status');
	// No radio buttons: arrow keys would answer on their way through them.
	const buttons = answers.map((text, i) => {
		const button = document.createElement('button');
		Object.assign(button, { type: 'button', textContent: text, ariaPressed: 'false' });
		button.addEventListener('click', () => void answer(i));
		return button;
	});
	const answer = async (picked: number) => {
		for (const [i, button] of buttons.entries()) button.ariaPressed = String(i === picked);
		const { right: index, because } = await reveal();
		for (const [i, button] of buttons.entries()) button.classList.toggle('right', i === index);
		says.textContent = `${picked === index ? right : wrong} ${because}`;
		set.dataset.answer = picked === index ? 'right' : 'wrong';
	};
	set.append(legend, ...buttons, says);
	place.prepend(set);
}
