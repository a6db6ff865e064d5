/** The demo page: composes address, scene, camera, light and panel. */

import { MathUtils } from 'three';
import { FurGovernor } from '../fur/index.ts';
import { directionUnder, listenToDrags } from '../page/aim.ts';
import { Lamp, lampDistance } from '../page/lamp.ts';
import { MovingLight, turned } from '../page/light.ts';
import { addressWriter, parseAddress, type Triple } from './address.ts';
import { OrbitCamera } from './camera.ts';
import { type EnvironmentName, loadEnvironment } from './environments.ts';
import { hasWebGL2, showFallback } from './fallback.ts';
import { listenToKeys } from './keys.ts';
import { firstView, folderOf, loadMenu, loadModel, type MenuEntry, offered, sourceAt } from './models.ts';
import { notice } from './notice.ts';
import { Overlay } from './overlay.ts';
import { Panel } from './panel.ts';
import { Stage } from './scene.ts';
import { watchSize } from './size.ts';
import { GpuTimer } from './timer.ts';

/** From the side: light from the front is flat. */
const defaultLight: Triple = [-0.82, 0.57, -0.02];
const defaultCamera: Triple = [0, 8, 1];
const crowdCamera: Triple = [10, 13, 0.5];

function element<T extends HTMLElement>(id: string): T {
	const found = document.getElementById(id);
	if (!found) throw new Error(`#${id} is not in the page`);
	return found as T;
}

function setState(state: 'loading' | 'ready' | 'failed'): void {
	document.documentElement.dataset.state = state;
}

function start(): void {
	const { view, problems } = parseAddress(location.search);
	if (problems.length) notice(`In the address:\n${problems.join('\n')}`);
	document.body.classList.toggle('bare', !view.ui);

	const canvas = element<HTMLCanvasElement>('picture');
	const stage = new Stage(canvas);
	const camera = new OrbitCamera(canvas, view.still, cameraMoved);
	const calm = view.still || matchMedia('(prefers-reduced-motion: reduce)').matches;
	const light = new MovingLight(!calm);
	const lamp = new Lamp();
	lamp.visible = false;
	stage.scene.add(lamp);
	const timer = new GpuTimer(stage.gl);
	// In time at 60 Hz, with room for the browser's own work; intervals are 17 ms there at best.
	const governor = new FurGovernor(timer.works ? { target: 14 } : { target: 20, capped: true });
	const overlay = view.ui ? new Overlay(element('overlay'), stage, timer) : undefined;
	const write = addressWriter();
	const panel = new Panel(element('panel'), {
		model: (name) => void change(() => show(name)),
		environment: (name) => void move(name),
		shells: setShells,
		crowd: setCrowd,
	});

	// Frames: one after the other, or with still=1 only where something has changed.
	let before = performance.now();
	let requested = false;
	/** Whether the canvas has another size than the picture; whether it has any; whether anything has moved. */
	let stale = false;
	let visible = false;
	let moving = false;
	const render = () => {
		timer.begin();
		stage.render(camera);
		timer.end();
	};
	function frame(now: number): void {
		requested = false;
		const interval = now - before;
		const elapsed = Math.min(interval / 1000, 0.1);
		before = now;
		if (stale) resize();
		camera.glide();
		if (light.step(elapsed)) placeLight();
		lamp.glide(camera, calm ? Number.POSITIVE_INFINITY : elapsed);
		const time = timer.read();
		if (!view.still) stage.scale = governor.frame(timer.works ? time : interval, now, moving);
		moving = false;
		if (visible && overlay) overlay.frame(render);
		else if (visible) render();
		if (!view.still) request();
	}
	function request(): void {
		if (requested) return;
		requested = true;
		requestAnimationFrame(frame);
	}

	function placeLight(): void {
		moving = true;
		stage.light(light.direction);
		lamp.place(light.direction, stage.centre, stage.radius);
	}
	function resize(): void {
		const { clientWidth: width, clientHeight: height } = canvas;
		stale = false;
		visible = width > 0 && height > 0;
		if (!visible) return;
		stage.resize(width, height);
		camera.frame(stage.centre, stage.radius, width, height, stage.closest);
		request();
	}
	function cameraMoved(): void {
		moving = true;
		request();
		if (!camera.chosen) return;
		view.camera = camera.orbit;
		write(view);
	}
	function lightTaken(): void {
		element('hint').hidden = true;
		view.light = light.wanted;
		write(view);
		request();
	}
	function setShells(count: number | undefined): void {
		const fur = stage.model?.fur;
		if (!fur) return;
		if (count) fur.shells.shellCount = count;
		else fur.shells.automatic = true;
		view.shells = count;
		write(view);
		request();
	}
	function setCrowd(count: number): void {
		view.crowd = count;
		stage.gather(count);
		updatePanel();
		placeLight();
		resize();
		write(view);
	}
	function updatePanel(): void {
		const fur = stage.model?.fur;
		panel.update(shown, fur?.shells, fur && (view.crowd ?? 1));
	}

	// What is on show, and whether that is all that was asked for.
	let pending = 0;
	/** Says so when the picture is on show. */
	function settle(): void {
		if (pending > 0) return;
		const ready = () => pending === 0 && !stage.gl.isContextLost() && setState('ready');
		if (stage.model) requestAnimationFrame(() => requestAnimationFrame(ready));
		else setState('failed');
	}
	async function change(what: () => Promise<void>): Promise<void> {
		pending++;
		setState('loading');
		await what();
		pending--;
		settle();
	}

	// Places.
	let place: EnvironmentName | 'none' = 'none';
	let latestPlace = 0;
	let sun: Triple | undefined;
	/** Has another place's light fall on the model; where that fails, says why and stays. */
	async function enter(name: EnvironmentName | 'none'): Promise<void> {
		const turn = ++latestPlace;
		try {
			const [x, , z] = defaultLight;
			const environment = name === 'none' ? undefined : await loadEnvironment(name, Math.atan2(z, x));
			if (turn !== latestPlace) return environment?.background.dispose();
			stage.surround(environment);
			sun = environment?.key.direction?.toArray();
			place = name;
			if (stage.model && !view.light) light.put(firstLight(), true);
			placeLight();
			request();
		} catch (error) {
			if (turn !== latestPlace) return;
			notice(`The environment ${name} cannot be shown: ${(error as Error).message}`, 'error');
		}
		panel.place(place);
	}
	async function move(name: EnvironmentName | 'none'): Promise<void> {
		await change(() => enter(name));
		if (place !== name) return;
		view.env = name;
		write(view);
	}
	const firstLight = () =>
		view.light ?? sun ?? firstView(menu.find(({ name }) => name === shown)).light ?? defaultLight;

	const firstCamera = (entry: MenuEntry | undefined) =>
		(view.crowd && view.crowd > 1 ? crowdCamera : firstView(entry).camera) ?? defaultCamera;

	// Models.
	let menu: MenuEntry[] = [];
	let latest = 0;
	let shown = '';
	/** Shows a model of the menu or of the address; where that fails, says why and keeps the one before. */
	async function show(name: string): Promise<void> {
		const turn = ++latest;
		try {
			const folder = folderOf(name, menu, document.baseURI);
			if (!folder) throw new Error('it is neither a model of the menu nor the address of a folder');
			const model = await loadModel(sourceAt(folder), stage.limits);
			if (turn !== latest) return model.dispose();
			const first = stage.model === undefined;
			const entry = menu.find((item) => item.name === name);
			stage.show(model);
			stage.gather(view.crowd ?? 1);
			lamp.visible = view.ui;
			if (shown) {
				view.model = name;
				write(view);
			}
			shown = name;
			if (!camera.chosen) camera.orbit = view.camera ?? firstCamera(entry);
			if (first || light.drifting) light.put(firstLight(), !view.light);
			if (model.fur && view.shells) model.fur.shells.shellCount = view.shells;
			if (model.fur?.fins) model.fur.fins.visible = view.fins ?? true;
			if (!model.fur) notice(`${entry?.title ?? name}: this model has no fur that this page can grow`);
			placeLight();
			resize();
		} catch (error) {
			if (turn !== latest) return;
			notice(`${name} cannot be shown: ${(error as Error).message}`, 'error');
		}
		updatePanel();
	}

	// Hands on the picture.
	listenToDrags(canvas, {
		allowed: () => !camera.dragTurns,
		active: (active) => {
			lamp.active = active;
			request();
		},
		move: (pointer) => {
			light.want((wanted) => directionUnder(pointer, camera, stage.centre, stage.radius * lampDistance, wanted));
			lightTaken();
		},
	});
	listenToKeys({
		arrow: (right, up) => {
			if (camera.dragTurns) return camera.turn(right, up, 1);
			light.want((wanted) => turned(wanted, MathUtils.degToRad(right), MathUtils.degToRad(up)));
			lightTaken();
		},
		zoom: (factor) => camera.turn(0, 0, factor),
	});
	const orbit = element<HTMLButtonElement>('orbit');
	orbit.addEventListener('click', () => {
		camera.dragTurns = !camera.dragTurns;
		orbit.setAttribute('aria-pressed', String(camera.dragTurns));
	});
	canvas.addEventListener('contextmenu', (event) => event.preventDefault());
	canvas.addEventListener('webglcontextlost', () => {
		stage.forget();
		if (stage.model) setState('loading');
	});
	canvas.addEventListener('webglcontextrestored', () => {
		timer.restore();
		request();
		settle();
	});
	watchSize(canvas, () => {
		stale = true;
		request();
	});
	resize();

	async function open(): Promise<void> {
		try {
			menu = await loadMenu();
			panel.menu(offered(menu));
		} catch (error) {
			notice((error as Error).message, 'error');
		}
		const preset = menu[0]?.name ?? '';
		let name = view.model ?? preset;
		if (!folderOf(name, menu, document.baseURI) && preset) {
			const names = offered(menu).map((item) => item.name);
			notice(`model=${name}: expected ${names.join(', ')} or a folder; showing ${preset}`);
			name = preset;
		}
		if (view.camera) camera.chosen = true;
		camera.orbit = view.camera ?? defaultCamera;
		await change(async () => {
			await Promise.all([enter(view.env ?? 'none'), show(name)]);
		});
	}
	void open();
}

if (hasWebGL2()) {
	start();
} else {
	showFallback();
	setState('failed');
}
