import { afterEach, expect, test, vi } from 'vitest';
import { type Adapter, chooseBackends } from '../element/engine/backend.js';

const answer = (requestAdapter: () => Promise<Adapter | null>) => vi.stubGlobal('navigator', { gpu: { requestAdapter } });

afterEach(() => vi.unstubAllGlobals());

test('a graphics card draws by WebGPU', async () => {
  answer(async () => ({ info: { architecture: 'ampere', description: '' } }));
  expect(await chooseBackends()).toEqual(['webgpu', 'webgl']);
  // Some engines report nothing.
  answer(async () => ({}));
  expect(await chooseBackends()).toEqual(['webgpu', 'webgl']);
});

test('a processor draws by WebGL2', async () => {
  const adapters: Adapter[] = [
    { isFallbackAdapter: true },
    { info: { isFallbackAdapter: true } },
    { info: { architecture: 'swiftshader', description: '' } },
    { isFallbackAdapter: false, info: { architecture: '', description: 'llvmpipe (LLVM 15.0.6, 256 bits)' } },
    { info: { description: 'Microsoft Basic Render Driver' } },
  ];
  for (const adapter of adapters) {
    answer(async () => adapter);
    expect(await chooseBackends(), JSON.stringify(adapter)).toEqual(['webgl', 'webgpu']);
  }
});

test('without WebGPU, or an answer, there is WebGL2', async () => {
  vi.stubGlobal('navigator', {});
  expect(await chooseBackends()).toEqual(['webgl']);
  answer(async () => null);
  expect(await chooseBackends()).toEqual(['webgl']);
  answer(() => Promise.reject(new Error('no')));
  expect(await chooseBackends()).toEqual(['webgl']);
});
