import { FurLoaderPlugin } from 'furbake';
import {
	Color,
	DirectionalLight,
	HalfFloatType,
	LinearToneMapping,
	PerspectiveCamera,
	Scene,
	WebGLRenderer,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const renderer = new WebGLRenderer({ antialias: true, outputBufferType: HalfFloatType });
renderer.toneMapping = LinearToneMapping; // three draws straight to the canvas without
renderer.setSize(innerWidth, innerHeight);
document.body.replaceChildren(renderer.domElement);
document.body.style.cssText = 'margin: 0; overflow: hidden';

const camera = new PerspectiveCamera(30, innerWidth / innerHeight);
camera.position.z = 5;
const lamp = new DirectionalLight('white', 4);
const scene = new Scene().add(lamp);
scene.background = new Color('#2b3641');
const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
scene.add((await loader.loadAsync('models/bunny/model.gltf')).scene);

addEventListener('pointermove', ({ x, y }) =>
	lamp.position.set((4 * x) / innerWidth - 2, 2 - (4 * y) / innerHeight, 1),
);
renderer.setAnimationLoop(() => renderer.render(scene, camera));
