/** Parts of the library that the first picture of most links does without: loaded after it, or with the first use. */

export { FurMotion, FurWeather, furMethod } from '../../fur/index.ts';
