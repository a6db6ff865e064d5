/** Whole number with thin spaces between thousands. */
export const whole = (number: number): string => number.toLocaleString('en-GB').replaceAll(',', '\u202f');
