/** Notice where a script or style of the page is missing, as after an update of the site: what needs it never runs then. */

const tell = () => {
	const notices = document.getElementById('notices');
	if (!notices || notices.querySelector('[data-about="missing"]')) return;
	const asked = new URLSearchParams(location.search).get('lang');
	const chinese = (asked ?? navigator.language).startsWith('zh');
	const box = document.createElement('div');
	box.className = 'notice error';
	box.dataset.about = 'missing';
	const sentence = document.createElement('p');
	sentence.textContent = chinese ? '本页有一个文件无法加载。' : 'A file of this page cannot be loaded. ';
	const again = document.createElement('a');
	again.href = '';
	again.textContent = chinese ? '重新加载' : 'Reload';
	sentence.append(again);
	box.append(sentence);
	notices.append(box);
	// The header is filled by the page.
	if (document.querySelector('nav.site:empty')) document.documentElement.dataset.state = 'failed';
};

addEventListener(
	'error',
	({ target }) => {
		if (target instanceof HTMLScriptElement || target instanceof HTMLLinkElement) tell();
	},
	true,
);
// Of scripts that are fetched with their first use.
addEventListener('vite:preloadError', tell);
