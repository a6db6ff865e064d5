/** Check of data against a JSON schema. */

import type { Validator } from '@cfworker/json-schema';

/**
 * @param where name of the data, put before the place of the fault
 * @throws Error with the place and what is wrong there
 */
export function checkSchema(validator: Validator, data: unknown, where: string): void {
	const { valid, errors } = validator.validate(data);
	if (valid) return;
	const { instanceLocation, error } = errors[errors.length - 1] ?? { instanceLocation: '#', error: 'unknown' };
	throw new Error(`${where}${instanceLocation.slice(1)}: ${error}`);
}
