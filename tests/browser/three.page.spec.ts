/** Figures are the same in three.js: it reads them, and their outline is ours. */

import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';

const root = join(import.meta.dirname, '../..');
const figures = join(root, 'assets/figures');
const three = join(root, 'node_modules/three');
const program = join(process.env['CARGO_TARGET_DIR'] ?? join(root, 'target'), 'debug/raconteur');

/** Side of both images, pixels. */
const SIDE = 480;
/** Position of the first tile of `raconteur figure sheet`. */
const PLACE = 4;
/** Outlines overlap by this share at least. Strands of hair, which our renderer cuts out of cards and three.js draws whole, and one pixel along the edge are the rest. */
const MIN_OVERLAP = 0.97;

/** A bare page: unmodified three.js, loaded by an import map. */
const PAGE = `<!doctype html><meta charset="utf-8"><title>three</title>
<script type="importmap">{ "imports": { "three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/" } }</script>
<script type="module">
  import * as THREE from 'three';
  import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
  import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
  window.outline = async (url, side, ours, place) => {
    const { scene } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync(url);
    const stature = scene.userData.statureMetres;
    const room = new THREE.Scene();
    room.background = new THREE.Color(0, 0, 0);
    room.add(scene);
    let skinned = 0;
    scene.traverse((part) => {
      part.frustumCulled = false;
      if (!part.isMesh) return;
      skinned += part.isSkinnedMesh ? 1 : 0;
      const { side, map, alphaTest, transparent } = part.material;
      part.material = new THREE.MeshBasicMaterial({ side, alphaMap: null, alphaTest, map: alphaTest > 0 ? map : null });
      part.visible = !transparent;
    });
    // The camera of the silhouette: level, at half stature, 8 % of room, 0.3 rad high.
    const half = 0.54 * stature;
    const camera = new THREE.PerspectiveCamera((0.3 * 180) / Math.PI, 1, 0.1, 40);
    camera.position.set(0, stature / 2, half / Math.tan(0.15));
    camera.lookAt(0, stature / 2, 0);
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setSize(side, side);
    renderer.render(room, camera);
    const pixels = (source, x) => {
      const canvas = document.createElement('canvas');
      canvas.width = canvas.height = side;
      const context = canvas.getContext('2d');
      context.drawImage(source, x, x, side, side, 0, 0, side, side);
      return context.getImageData(0, 0, side, side).data;
    };
    const image = new Image();
    image.src = ours;
    await image.decode();
    const [a, b] = [pixels(renderer.domElement, 0), pixels(image, place)];
    let both = 0, any = 0;
    for (let i = 0; i < a.length; i += 4) {
      // A pixel counts when half of it is covered.
      const [p, q] = [a[i] > 127, b[i] > 127];
      both += p && q;
      any += p || q;
    }
    return { overlap: both / any, share: any / (side * side), skinned, picture: renderer.domElement.toDataURL() };
  };
  window.ready = true;
</script>`;

for (const file of readdirSync(figures).filter((name) => name.endsWith('.glb'))) {
  test(`${file} opens in three.js with the same outline`, async ({ page }, info) => {
    expect(existsSync(program), `${program} is built by "cargo build --package raconteur-cli"`).toBe(true);
    const sheet = join(mkdtempSync(join(tmpdir(), 'raconteur-')), 'sheet.png');
    execFileSync(program, ['figure', 'sheet', join(figures, file), '--part', 'silhouette', '--size', String(SIDE), '-o', sheet], { cwd: root });
    const problems: string[] = [];
    page.on('pageerror', (error) => problems.push(error.message));
    page.on('console', (message) => {
      if (message.type() === 'error' || /THREE/.test(message.text())) problems.push(message.text());
    });
    await page.route('**/bare.html', (route) => route.fulfill({ body: PAGE, contentType: 'text/html' }));
    await page.route('**/three/**', (route) =>
      route.fulfill({ body: readFileSync(join(three, new URL(route.request().url()).pathname.replace(/^\/three\//, ''))), contentType: 'text/javascript' }),
    );
    await page.goto('/bare.html');
    await page.waitForFunction(() => 'ready' in window);
    const ours = `data:image/png;base64,${readFileSync(sheet).toString('base64')}`;
    const seen = await page.evaluate(
      ([url, side, picture, place]) =>
        (window as unknown as { outline(...args: unknown[]): Promise<{ overlap: number; share: number; skinned: number; picture: string }> }).outline(url, side, picture, place),
      [`/assets/figures/${file}`, SIDE, ours, PLACE] as const,
    );
    await info.attach('three.js', { body: Buffer.from(seen.picture.split(',')[1] ?? '', 'base64'), contentType: 'image/png' });
    console.log(`${file}: ${(100 * seen.overlap).toFixed(2)} % of the outlines overlap, ${seen.skinned} skinned meshes`);
    expect(problems).toEqual([]);
    expect(seen.share).toBeGreaterThan(0.05);
    expect(seen.overlap).toBeGreaterThanOrEqual(MIN_OVERLAP);
  });
}
