// Serves samples/three_vrm with the package that ./run web makes.
import { cp, mkdir, mkdtemp, rm, symlink } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { serve } from '../serve.mjs';

const root = fileURLToPath(new URL('../../..', import.meta.url));
/** Its address, and close(). */
export async function serveSample() {
  const folder = await mkdtemp(join(tmpdir(), 'panache-vrm-'));
  await cp(join(root, 'samples/three_vrm'), folder, { recursive: true });
  await mkdir(join(folder, 'node_modules'), { recursive: true });
  await symlink(join(root, 'build/npm'), join(folder, 'node_modules/panache'));
  for (const name of ['three', '@pixiv']) {
    await symlink(join(root, 'tests/web/node_modules', name), join(folder, 'node_modules', name));
  }
  const { server, address } = await serve((path) =>
    join(folder, path.replace(/\/$/, '/index.html')));
  const close = async () => {
    server.close();
    await rm(folder, { recursive: true });
  };
  return { address, close };
}
