/** A face of the model on the figure that performs. */

import type { Faces } from '../../web/element/face/faces.js';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test, type Stage } from './stage.js';

const story = '<raconteur-player src="/assets/stories/hello-world/story.eml" controls></raconteur-player>';

/** State that tests store in the page. */
type KeptFace = Window & { faces: Faces };

/** Opens the model in the page, as an embedder would. */
async function openModel(stage: Stage): Promise<void> {
  await stage.player.evaluate(async () => {
    const { openFaces } = (await import(new URL('/raconteur-player.js', location.href).href)) as { openFaces: (shapes: string, textures: string) => Promise<Faces> };
    (window as unknown as KeptFace).faces = await openFaces('/assets/faces/people.faces', '/assets/faces/people.skins');
  });
}

/** Puts a random face on the figure. */
const random = (stage: Stage, seed: number) =>
  stage.player.evaluate(async (p: RaconteurPlayer, s) => {
    const { faces } = window as unknown as KeptFace;
    faces.random(s);
    await p.setFace(faces.face(p.currentFigure ?? ''));
  }, seed);

test('a random face tells the story, and its own comes back', { tag: '@draws' }, async ({ stage }) => {
  await stage.open(story);
  await stage.ready();
  await stage.seek(1);
  const before = (await stage.picture()).png;
  await openModel(stage);
  await random(stage, 5);
  await stage.seek(1.01);
  const changed = (await stage.picture()).png;
  expect(await stage.difference(before, changed)).toBeGreaterThan(0.3);
  // It plays on, and the lips move.
  await stage.seek(1.6);
  expect(await stage.difference(changed, (await stage.picture()).png)).toBeGreaterThan(0.02);
  // No seek is needed: the player renders the frame again.
  await stage.seek(1);
  await stage.player.evaluate(async (p: RaconteurPlayer) => await p.setFace(undefined));
  await expect.poll(async () => await stage.difference(before, (await stage.picture()).png), { timeout: 20_000 }).toBeLessThan(0.05);
});

test('a face that is of another model is refused by name', async ({ stage }) => {
  await stage.open(story);
  await stage.ready();
  const told = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const refused = async (face: Parameters<RaconteurPlayer['setFace']>[0]) => {
      try {
        await p.setFace(face);
        return 'taken';
      } catch (error) {
        return String(error);
      }
    };
    const organs = new Float64Array(9);
    const skin = new Float64Array(300).fill(0.1);
    return [
      await refused({ skin, organs: organs.slice(1), factors: undefined }),
      await refused({ skin, organs, factors: undefined }),
      await refused({ skin: skin.fill(Number.NaN), organs, factors: undefined }),
    ];
  });
  expect(told[0]).toContain('nine finite numbers');
  for (const reason of told.slice(1)) expect(reason).toMatch(/head|vertices|finite/);
});

test('edits, what was kept, and errors of the model', async ({ stage }) => {
  await stage.open(story);
  await stage.ready();
  await openModel(stage);
  const seen = await stage.player.evaluate(() => {
    const { faces } = window as unknown as KeptFace;
    const told = (work: () => void) => {
      try {
        work();
        return '';
      } catch (error) {
        return error instanceof Error ? error.message : String(error);
      }
    };
    faces.example(7);
    const kept = faces.keep();
    const name = 'width of the mouth';
    const was = faces.value('shape', name);
    faces.add('shape', name, 0.5);
    const more = faces.value('shape', name) - was;
    faces.importFrom(3, 'texture', { segments: ['nose'], half: 'left' });
    faces.transform({ way: [0, 0.002, 0] }, { segments: ['eyebrows'] });
    faces.caricature('shape', 1.3);
    faces.constrain([{ part: 'shape', name, value: 0.2 }]);
    const held = faces.value('shape', name);
    const problems = [
      told(() => faces.add('shape', 'glow', 1)),
      told(() => faces.add('shape', name, 1, { segments: ['beak'] })),
      told(() => faces.example(1e6)),
      told(() => faces.restore(new Uint8Array(5))),
      told(() => faces.add('shape', name, Number.NaN)),
      told(() =>
        faces.constrain([
          { part: 'shape', name, value: 0.2 },
          { part: 'shape', name, value: 0.7 },
        ]),
      ),
    ];
    faces.restore(kept);
    const again = faces.keep();
    return { more, held, problems, isSame: again.every((byte, i) => byte === kept[i]) && again.length === kept.length, pack: { ...faces.pack, people: faces.pack.people.length } };
  });
  expect(seen.more).toBeCloseTo(0.5, 6);
  expect(seen.held).toBeCloseTo(0.2, 4);
  expect(seen.isSame).toBe(true);
  expect(seen.problems.map((p) => /glow|beak|no face|not a face of this pack|finite|together/.test(p))).toEqual([true, true, true, true, true, true]);
  expect(seen.pack.segments.length).toBe(22);
  // Table 5.2, and the course of a life.
  expect(new Set(seen.pack.attributes.filter((a) => a.group !== 'life').map((a) => a.name)).size).toBe(49);
  expect(seen.pack.people).toBe(seen.pack.faces);
});
